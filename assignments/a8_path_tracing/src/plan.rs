//! What the flags come to: which samples of which pixels, chosen how.

use crate::PathArgs;
use crate::film::{Aov, Frame, Identity, Layout, MAX_SAMPLES};
use crate::render::Goal;
use a7_sampling::Pattern;
use clap::ValueEnum;
use common::cli::AppError;
use common::picture::Size;
use common::tiles::Tile;
use std::time::Duration;

/// Samples of a pixel if nothing else is said.
const USUAL: u32 = 64;

/// Most samples of a pixel with `-error` if nothing else is said.
const MOST: u32 = 4096;

/// Most samples of a pixel if only time is to end it.
const ENDLESS: u32 = MAX_SAMPLES / 2;

/// Which samples of which pixels, chosen how.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// The picture, and which part of it.
    pub frame: Frame,
    /// The first sample.
    pub first: u32,
    /// When it is over.
    pub goal: Goal,
    /// How samples are chosen.
    pub pattern: Pattern,
    /// Samples of a pixel that the pattern is made for; for those that can go on it does not matter.
    pub spp: u32,
    /// Chooses among equally good sets of samples.
    pub seed: u64,
    /// What is kept of a pixel.
    pub layout: Layout,
}

fn usage<T>(text: impl Into<String>) -> Result<T, AppError> {
    Err(AppError::Usage(text.into()))
}

impl PathArgs {
    /// What these flags come to for a picture of this size.
    ///
    /// # Errors
    /// Numbers out of range, and parts of pictures that are none.
    pub fn plan(&self, size: Size) -> Result<Plan, AppError> {
        let (pattern, number) = self.choice();
        let (time, error) = (self.seconds()?, self.least_error()?);
        if pattern == Pattern::Uniform {
            // Every path would be scattered in the same few directions.
            return usage("the uniform pattern has nothing random, which paths need; take another sampler");
        }
        let usual = match (error, time) {
            (Some(_), _) => MOST,
            (None, Some(_)) => ENDLESS,
            (None, None) => USUAL,
        };
        let endless = error.is_some() || time.is_some() && number.is_none();
        if endless && !pattern.is_sequence() {
            return usage("-time and -error want a sampler that can go on: random, halton, r2 or sobol");
        }
        let spp = number.unwrap_or(usual);
        let (first, end) = self.range(pattern, number)?.unwrap_or((0, spp));
        let mut layout = Layout { halves: error.is_some(), ..Layout::default() };
        self.files.aovs()?.iter().for_each(|(aov, _)| layout.aovs[*aov as usize] = true);
        let frame = Frame { size, crop: self.crop(size)? };
        let seed = self.sampling.pattern.seed;
        Ok(Plan { frame, first, goal: Goal { end, time, error }, pattern, spp, seed, layout })
    }

    /// Pattern and number of samples, if one is given; the course's flags name both.
    fn choice(&self) -> (Pattern, Option<u32>) {
        let args = &self.sampling.pattern;
        let course = [
            (Pattern::Random, args.random_samples),
            (Pattern::Uniform, args.uniform_samples),
            (Pattern::Jittered, args.jittered_samples),
        ];
        let course = course.into_iter().find_map(|(pattern, samples)| Some((pattern, samples?)));
        let (pattern, number) = course.unzip();
        let pattern = pattern.unwrap_or_else(|| args.sampler.unwrap_or_default());
        (pattern, self.goal.spp.or(number).or(args.samples))
    }

    fn seconds(&self) -> Result<Option<Duration>, AppError> {
        let Some(seconds) = self.goal.time else { return Ok(None) };
        match Duration::try_from_secs_f64(seconds) {
            Ok(time) if seconds > 0.0 => Ok(Some(time)),
            _ => usage(format!("-time wants a number of seconds above 0, not {seconds}")),
        }
    }

    fn least_error(&self) -> Result<Option<f64>, AppError> {
        // Written so that NaN is refused.
        match self.goal.error {
            Some(error) if !(error > 0.0 && error.is_finite()) => {
                usage(format!("-error wants a number above 0, not {error}"))
            }
            error => Ok(error),
        }
    }

    /// The samples that `-spp_range` names.
    fn range(&self, pattern: Pattern, number: Option<u32>) -> Result<Option<(u32, u32)>, AppError> {
        let Some(&[first, end]) = self.part.spp_range.as_deref() else { return Ok(None) };
        if first >= end || end > ENDLESS {
            return usage(format!("-spp_range: there are no samples {first} to {end}"));
        }
        match number {
            Some(spp) if end > spp => usage(format!("-spp_range: sample {} is none of {spp}", end - 1)),
            None if !goes_on(pattern) => {
                usage("-spp_range with this sampler needs -spp too: how many samples there are in all")
            }
            _ => Ok(Some((first, end))),
        }
    }

    fn crop(&self, size: Size) -> Result<Tile, AppError> {
        let Some(&[x0, y0, x1, y1]) = self.part.crop.as_deref() else { return Ok(Frame::whole(size).crop) };
        if x0 >= x1 || y0 >= y1 {
            return usage(format!("-crop {x0} {y0} {x1} {y1} has no pixels; the upper bounds are excluded"));
        }
        if x1 > size.width() || y1 > size.height() {
            return usage(format!("-crop {x0} {y0} {x1} {y1} reaches beyond the picture of {size}"));
        }
        Ok(Tile { x0, y0, x1, y1 })
    }

    /// What the rendering is one of; `scene` is a number for the scene.
    pub fn identity(&self, plan: &Plan, scene: u64) -> Identity {
        let name = |value: Option<clap::builder::PossibleValue>| {
            value.map_or_else(String::new, |value| value.get_name().to_owned())
        };
        let bounces = self.sampling.accel.grid.whitted.bounces;
        let aovs: Vec<&str> =
            Aov::ALL.into_iter().filter(|aov| plan.layout.has(*aov)).map(Aov::name).collect();
        let all = Identity::default()
            .with("a scene of fingerprint", format_args!("{scene:016x}"))
            .with("-size", plan.frame.size)
            .with("-sampler", name(plan.pattern.to_possible_value()))
            .with("-seed", plan.seed)
            .with("-integrator", name(self.follow.integrator.to_possible_value()))
            .with("-bounces", bounces.map_or("without limit".to_owned(), |n| n.to_string()))
            .with("-rr_depth", self.follow.rr_depth)
            .with("-aov", if aovs.is_empty() { "none".to_owned() } else { aovs.join(" ") });
        let all = if goes_on(plan.pattern) { all } else { all.with("-spp", plan.spp) };
        match plan.goal.error {
            None => all,
            Some(error) => all.with("-error", error),
        }
    }
}

/// Whether the samples of a pattern do not depend on how many there will be.
fn goes_on(pattern: Pattern) -> bool {
    matches!(pattern, Pattern::Random | Pattern::Halton | Pattern::Sobol)
}
