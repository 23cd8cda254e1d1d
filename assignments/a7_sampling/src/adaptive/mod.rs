//! A7T6: samples where the picture still has error.
//!
//! Whole-picture passes: the first gives a few samples to every pixel, each later one doubles the
//! samples of those pixels whose error still seems too large. Who goes on is decided between
//! passes, from what all pixels have got so far, so neither tiles nor threads can matter.
//! [`Survey`] estimates the errors.

mod look;
mod survey;

pub use survey::Survey;

use crate::exposure::{Exposure, Sample, Watch};
use crate::film::Negative;
use crate::sampler::Pixel;
use common::cli::{AppError, Skip};
use common::counters::Counters;
use common::picture::Film;
use std::ops::Range;

/// Most samples of a pixel if no other number is given.
pub const MOST_SAMPLES: u32 = 1024;

/// Samples that every pixel gets, unless it may not have as many: the fewest that show most edges
/// which pass through a pixel or one beside it.
pub const FIRST_SAMPLES: u32 = 8;

/// Most bytes of a negative with all of its rows and of the survey.
const MOST_BYTES: usize = 8 << 30;

/// When a pixel has enough samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Adaptive {
    /// A pixel is done when its standard error is probably below this (root mean square of the
    /// three channels), after the filter.
    pub error: f64,
    /// It is also done when it has so many samples, at least 1.
    pub most: u32,
}

impl Adaptive {
    /// The picture, what each pixel took, and what was counted. `watch` is shown all samples, in
    /// no order of pixels. The sampler of `exposure` should be a sequence.
    ///
    /// # Errors
    /// If the picture is too large to keep all of its samples' sums.
    pub fn picture(
        &self,
        exposure: &Exposure,
        watch: Option<Watch>,
    ) -> Result<(Film, Survey, Counters), AppError> {
        let size = exposure.studio.size;
        let mut negative = Negative::new(size, exposure.kernel);
        check_memory(negative.bytes() + Survey::bytes(size))?;
        negative.extend_to(size.height());
        let gain = exposure.kernel.map_or(1.0, |kernel| kernel.noise_gain());
        let limit = self.error * self.error / gain;
        let (survey, mut counters) = (Survey::new(size), Counters::default());
        let record = |samples: &[Sample]| {
            survey.record(samples);
            watch.iter().for_each(|watch| watch(samples));
        };
        let mut plan = vec![0..self.most.min(FIRST_SAMPLES); size.pixels()];
        while plan.iter().any(|range| !range.is_empty()) {
            let which = |(x, y): Pixel| plan[y as usize * size.width() as usize + x as usize].clone();
            counters += exposure.expose(&mut negative, 0..size.height(), &which, Some(&record));
            plan = survey.plan(&exposure.cast.general, &plan, |estimate| self.next(estimate, limit));
        }
        let mut film = Film::new(size);
        negative.develop(0, &mut film);
        counters += self.spared(exposure, &survey);
        Ok((film, survey, counters))
    }

    /// The samples that pixels were spared, counted; or traced and forgotten, if they are not to
    /// be skipped.
    fn spared(&self, exposure: &Exposure, survey: &Survey) -> Counters {
        let (counts, size) = (survey.counts(), exposure.studio.size);
        if exposure.cast.general.skips(Skip::Converged) {
            let skipped_converged = counts.iter().map(|n| u64::from(self.most - n)).sum();
            return Counters { skipped_converged, ..Counters::default() };
        }
        let mut forgotten = Negative::new(size, exposure.kernel);
        forgotten.extend_to(size.height());
        let which = |(x, y): Pixel| counts[y as usize * size.width() as usize + x as usize]..self.most;
        exposure.expose(&mut forgotten, 0..size.height(), &which, None)
    }

    /// The samples that a pixel gets next.
    fn next(&self, estimate: survey::Estimate, limit: f64) -> Range<u32> {
        let taken = estimate.samples;
        let enough = taken >= self.most || estimate.squared_error <= limit;
        taken..if enough { taken } else { taken.saturating_mul(2).min(self.most) }
    }

    /// What `-stats` says of a picture.
    pub fn describe(&self, survey: &Survey) -> String {
        let counts = survey.counts();
        let total: u64 = counts.iter().map(|n| u64::from(*n)).sum();
        let (least, most) = (counts.iter().min().unwrap_or(&0), counts.iter().max().unwrap_or(&0));
        let full = counts.len() as f64 * f64::from(self.most);
        let ended = counts.iter().filter(|n| **n == self.most).count();
        format!(
            "samples taken: {total}; per pixel least {least}, most {most}, mean {:.2}; {:.2} % of {} for every pixel skipped; {:.2} % of the pixels took all",
            total as f64 / counts.len() as f64,
            100.0 * (1.0 - total as f64 / full),
            self.most,
            100.0 * ended as f64 / counts.len() as f64,
        )
    }
}

fn check_memory(bytes: usize) -> Result<(), AppError> {
    if bytes <= MOST_BYTES {
        return Ok(());
    }
    let gigabytes = |bytes: usize| bytes as f64 / f64::from(1 << 30);
    Err(AppError::Usage(format!(
        "-adaptive keeps the whole picture, here {:.1} GiB, and takes at most {} GiB: give a smaller -size, or a filter of a smaller radius",
        gigabytes(bytes),
        gigabytes(MOST_BYTES)
    )))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a7t6_samples_double_until_the_error_is_small_or_there_are_enough() {
        let plan = Adaptive { error: 0.1, most: 100 };
        let next = |samples, squared_error| plan.next(survey::Estimate { samples, squared_error }, 0.01);
        assert_eq!(next(8, 0.02), 8..16);
        assert_eq!(next(64, 0.02), 64..100);
        assert!(next(8, 0.01).is_empty() && next(100, 9.0).is_empty());
        assert!(next(8, f64::INFINITY) == (8..16));
    }

    #[test]
    fn too_large_a_picture_is_refused() {
        assert!(check_memory(MOST_BYTES).is_ok());
        let refusal = check_memory(MOST_BYTES + (1 << 30)).unwrap_err().report();
        assert!(refusal.contains("9.0 GiB"), "{refusal}");
    }
}
