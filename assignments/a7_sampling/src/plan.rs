//! The flags that say where samples lie and how they add up, and what they come to.

use crate::adaptive::{Adaptive, MOST_SAMPLES};
use crate::args::zoomed_file;
use crate::filter::{Kernel, KernelName};
use crate::sampler::Pattern;
use common::cli::AppError;
use std::path::PathBuf;

/// Samples when a pattern is named and their number is not.
const USUAL: u32 = 16;

/// Most samples per pixel.
const MOST: i64 = 1 << 20;

/// Where samples lie.
#[derive(Clone, Debug, Default, clap::Args)]
#[command(rename_all = "snake_case", next_help_heading = "Assignment 7: samples")]
pub struct PatternArgs {
    /// So many samples per pixel, each for itself
    #[arg(long, value_name = "N", group = "course_pattern", value_parser = clap::value_parser!(u32).range(1..=MOST))]
    pub random_samples: Option<u32>,

    /// So many samples per pixel, in the middle of the cells of a grid; N must be a square
    #[arg(long, value_name = "N", group = "course_pattern", value_parser = clap::value_parser!(u32).range(1..=MOST))]
    pub uniform_samples: Option<u32>,

    /// So many samples per pixel, one anywhere in each cell of a grid; N must be a square
    #[arg(long, value_name = "N", group = "course_pattern", value_parser = clap::value_parser!(u32).range(1..=MOST))]
    pub jittered_samples: Option<u32>,

    /// Where samples lie; sobol if only -samples is given
    #[arg(long, value_name = "NAME", value_enum, conflicts_with = "course_pattern")]
    pub sampler: Option<Pattern>,

    /// Samples per pixel; with -adaptive, most of them
    #[arg(long, value_name = "N", conflicts_with = "course_pattern", value_parser = clap::value_parser!(u32).range(1..=MOST))]
    pub samples: Option<u32>,

    /// Chooses among equally good sets of samples
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub seed: u64,

    /// Picture of where the samples lie, every pixel ZOOM × ZOOM times as large
    #[arg(long, num_args = 2, value_names = ["PICTURE", "ZOOM"])]
    pub render_samples: Option<Vec<String>>,

    /// Go on with a pixel until the error of its colour is probably below ERROR, then skip the rest
    #[arg(long, value_name = "ERROR", conflicts_with = "course_pattern")]
    pub adaptive: Option<f64>,

    /// Picture of how many samples each pixel took: dark grey the fewest, white the most, every
    /// doubling as large a step
    #[arg(long, value_name = "PICTURE", requires = "adaptive")]
    pub samples_image: Option<PathBuf>,
}

/// How samples add up.
#[derive(Clone, Debug, Default, clap::Args)]
#[command(rename_all = "snake_case", next_help_heading = "Assignment 7: filters")]
pub struct FilterArgs {
    /// All samples within R pixels along both axes count alike
    #[arg(long, value_name = "R", group = "kernel")]
    pub box_filter: Option<f64>,

    /// Samples count less with their distance, down to nothing R pixels away
    #[arg(long, value_name = "R", group = "kernel")]
    pub tent_filter: Option<f64>,

    /// Samples count by a bell of this standard deviation, in pixels
    #[arg(long, value_name = "SIGMA", group = "kernel")]
    pub gaussian_filter: Option<f64>,

    /// Any filter: box, tent, gaussian, mitchell (usually 2), lanczos (2 or 3), blackman_harris (1.5)
    #[arg(long, num_args = 2, value_names = ["NAME", "RADIUS"], group = "kernel")]
    pub filter: Option<Vec<String>>,

    /// Picture of the filter's weights, every pixel ZOOM × ZOOM times as large
    #[arg(long, num_args = 2, value_names = ["PICTURE", "ZOOM"])]
    pub render_filter: Option<Vec<String>>,
}

impl PatternArgs {
    /// Pattern and number of samples; `None` for one sample at the centre of every pixel.
    pub fn choice(&self) -> Option<(Pattern, u32)> {
        let course = [
            (Pattern::Random, self.random_samples),
            (Pattern::Uniform, self.uniform_samples),
            (Pattern::Jittered, self.jittered_samples),
        ];
        let course = course.into_iter().find_map(|(pattern, samples)| Some((pattern, samples?)));
        let asked = self.sampler.is_some() || self.samples.is_some() || self.adaptive.is_some();
        let usual = if self.adaptive.is_some() { MOST_SAMPLES } else { USUAL };
        course.or_else(|| asked.then(|| (self.sampler.unwrap_or_default(), self.samples.unwrap_or(usual))))
    }

    /// When pixels have enough samples, if they are to have different numbers of them.
    pub fn plan(&self) -> Option<Adaptive> {
        let (error, (_, most)) = self.adaptive.zip(self.choice())?;
        Some(Adaptive { error, most })
    }

    /// The picture of the samples and its zoom.
    ///
    /// # Errors
    /// If the zoom is no whole number of at least 1.
    pub fn picture(&self) -> Result<Option<(PathBuf, u32)>, AppError> {
        zoomed_file("-render_samples", self.render_samples.as_ref())
    }

    /// # Errors
    /// A number of cells that makes no square grid; an error that is none; a pattern that must
    /// know beforehand how many samples there will be.
    pub(crate) fn check(&self) -> Result<(), AppError> {
        self.picture()?;
        for (flag, samples) in
            [("-uniform_samples", self.uniform_samples), ("-jittered_samples", self.jittered_samples)]
        {
            if let Some(n) = samples.filter(|n| n.isqrt().pow(2) != *n) {
                let (below, above) = (n.isqrt().pow(2), (n.isqrt() + 1).pow(2));
                let text = format!("{flag} wants a square number, as {below} or {above}, not {n}");
                return Err(AppError::Usage(text));
            }
        }
        let Some(error) = self.adaptive else { return Ok(()) };
        // Written so that NaN is refused.
        if !(error > 0.0 && error.is_finite()) {
            return Err(AppError::Usage(format!("-adaptive wants a number above 0, not {error}")));
        }
        match self.sampler {
            Some(pattern) if !pattern.is_sequence() => Err(AppError::Usage(
                "-adaptive wants a sampler that can go on: random, halton, r2 or sobol".to_owned(),
            )),
            _ => Ok(()),
        }
    }
}

impl FilterArgs {
    /// The kernel asked for.
    ///
    /// # Errors
    /// A name that is none, or a radius out of range.
    pub fn kernel(&self) -> Result<Option<Kernel>, AppError> {
        let course = [
            (KernelName::Box, self.box_filter),
            (KernelName::Tent, self.tent_filter),
            (KernelName::Gaussian, self.gaussian_filter),
        ];
        if let Some((name, radius)) = course.into_iter().find_map(|(name, radius)| Some((name, radius?))) {
            return Ok(Some(name.with_radius(radius)?));
        }
        let Some(values) = &self.filter else { return Ok(None) };
        let name = <KernelName as clap::ValueEnum>::from_str(&values[0], false).map_err(|_| {
            AppError::Usage(format!(
                "-filter: `{}` is none of box, tent, gaussian, mitchell, lanczos, blackman_harris",
                values[0]
            ))
        })?;
        let wrong = || AppError::Usage(format!("-filter: RADIUS must be a number, not `{}`", values[1]));
        Ok(Some(name.with_radius(values[1].parse().map_err(|_| wrong())?)?))
    }

    /// The picture of the kernel and its zoom.
    ///
    /// # Errors
    /// If the zoom is no whole number of at least 1, or there is no kernel to show.
    pub fn picture(&self) -> Result<Option<(PathBuf, u32)>, AppError> {
        let picture = zoomed_file("-render_filter", self.render_filter.as_ref())?;
        if picture.is_some() && self.kernel()?.is_none() {
            return Err(AppError::Usage(
                "-render_filter needs a filter to show, as -box_filter 1".to_owned(),
            ));
        }
        Ok(picture)
    }
}
