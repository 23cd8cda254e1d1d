//! How wrong each pixel probably is.

use crate::exposure::Sample;
use common::cli::GeneralArgs;
use common::math::{DVec3, Vec3};
use common::picture::Size;
use common::tiles::for_each_job;
use std::sync::{Mutex, PoisonError};

/// Pixels to each side that are asked how much better the pattern is than independent samples.
const NEAR: usize = 2;

/// What a pixel's samples tell. Squares are means over the three channels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Look {
    count: u32,
    mean: Vec3,
    /// Sum of squared distances of the samples from their mean.
    scatter: f32,
    /// Squared error of the mean, judged by how far its first and second half lie apart.
    change: f32,
}

/// Some samples of a pixel.
#[derive(Clone, Copy, Debug)]
struct Part {
    count: f64,
    mean: DVec3,
    scatter: f64,
}

impl Part {
    fn of(samples: &[Sample]) -> Self {
        let count = samples.len() as f64;
        let mean = samples.iter().map(|s| s.color.as_dvec3()).sum::<DVec3>() / count.max(1.0);
        let square = |s: &Sample| (s.color.as_dvec3() - mean).length_squared() / 3.0;
        Self { count, mean, scatter: samples.iter().map(square).sum() }
    }
}

impl Look {
    /// Adds samples as the second half, all before being the first (Chan, Golub & LeVeque,
    /// "Updating formulae and a pairwise algorithm for computing sample variances", 1979).
    fn add(&mut self, part: Part) {
        if part.count == 0.0 {
            return;
        }
        let (old, new) = (f64::from(self.count), part.count);
        let (all, apart) = (old + new, part.mean - self.mean.as_dvec3());
        let apart_squared = apart.length_squared() / 3.0;
        self.scatter += (part.scatter + apart_squared * old * new / all) as f32;
        // Independent halves differ by σ²(1/old + 1/new), their common mean errs by σ²/all.
        self.change = (apart_squared * old * new / (all * all)) as f32;
        self.mean = (self.mean.as_dvec3() + apart * (new / all)).as_vec3();
        self.count += new as u32;
    }

    /// Variance of a single sample.
    fn variance(&self) -> f64 {
        f64::from(self.scatter) / f64::from(self.count.saturating_sub(1).max(1))
    }
}

/// What is known of a pixel between two passes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Samples so far.
    pub samples: u32,
    /// Square of the standard error of the mean of the pixel's own samples.
    pub squared_error: f64,
}

/// What the samples of every pixel tell of its error.
///
/// Of n independent samples the variance s² tells the error of the mean, s²/n. A good pattern does
/// better, by a factor that nobody knows beforehand: it depends on what there is to see. So it is
/// measured: the first half of the samples and the second are as good as each other, and how far
/// they lie apart tells how good. One pixel's two halves may agree by chance; all pixels around do
/// not, and the factor is taken from their sums, while the variance is the pixel's own.
///
/// Where all samples of a pixel agree it may still have missed something that its neighbours saw:
/// each pixel counts one sample more, whose deviation is theirs.
pub struct Survey {
    size: Size,
    rows: Vec<Mutex<Vec<Look>>>,
}

impl Survey {
    /// No samples yet.
    pub fn new(size: Size) -> Self {
        let row = || Mutex::new(vec![Look::default(); size.width() as usize]);
        Self { size, rows: (0..size.height()).map(|_| row()).collect() }
    }

    /// Bytes of memory for a picture.
    pub fn bytes(size: Size) -> usize {
        size.pixels() * (size_of::<Look>() + size_of::<std::ops::Range<u32>>())
    }

    /// Adds samples of one pixel; the first to come are two halves by themselves.
    pub fn record(&self, samples: &[Sample]) {
        let Some((x, y)) = samples.first().map(|s| s.pixel) else { return };
        let mut row = self.row(y);
        let look = &mut row[x as usize];
        let first = if look.count == 0 { samples.len() / 2 } else { 0 };
        look.add(Part::of(&samples[..first]));
        look.add(Part::of(&samples[first..]));
    }

    fn row(&self, y: u32) -> std::sync::MutexGuard<'_, Vec<Look>> {
        self.rows[y as usize].lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Samples of each pixel, row by row from the bottom.
    pub fn counts(&self) -> Vec<u32> {
        (0..self.size.height())
            .flat_map(|y| self.row(y).iter().map(|l| l.count).collect::<Vec<_>>())
            .collect()
    }

    /// Applies `what` to all pixels, row by row from the bottom.
    pub fn map<T: Send>(&self, general: &GeneralArgs, what: impl Fn(Estimate) -> T + Sync) -> Vec<T> {
        let rows: Vec<Vec<Look>> = (0..self.size.height()).map(|y| self.row(y).clone()).collect();
        let made: Vec<Mutex<Vec<T>>> = rows.iter().map(|_| Mutex::new(Vec::new())).collect();
        let mut options = general.tile_options("judging");
        options.label = None;
        for_each_job(
            rows.len(),
            &options,
            || (),
            |(), y| {
                let row = (0..rows[y].len()).map(|x| what(estimate(&rows, x, y))).collect();
                *made[y].lock().unwrap_or_else(PoisonError::into_inner) = row;
            },
        );
        made.into_iter().flat_map(|row| row.into_inner().unwrap_or_else(PoisonError::into_inner)).collect()
    }
}

/// The error of a pixel as it and those around it tell.
fn estimate(rows: &[Vec<Look>], x: usize, y: usize) -> Estimate {
    let own = rows[y][x];
    let count = f64::from(own.count);
    let near = |at: usize, end: usize| at.saturating_sub(NEAR)..(at + NEAR + 1).min(end);
    let (mut change, mut expected, mut variance, mut pixels) = (0.0, 0.0, 0.0, 0.0);
    for row in &rows[near(y, rows.len())] {
        for look in &row[near(x, row.len())] {
            let own_variance = look.variance();
            variance += own_variance;
            pixels += 1.0;
            // Patterns get better with more samples: what has fewer says nothing of this pixel.
            if 2 * look.count >= own.count {
                change += f64::from(look.change);
                expected += own_variance / f64::from(look.count);
            }
        }
    }
    let better = if expected > 0.0 { change / expected } else { 0.0 };
    let squared_error = better * (own.variance() + variance / pixels / count) / count;
    Estimate { samples: own.count, squared_error }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampler::{Pattern, Sampler, pair};

    fn samples(pixel: (u32, u32), values: &[f32]) -> Vec<Sample> {
        values.iter().map(|v| Sample { pixel, at: [0.5; 2], color: Vec3::splat(*v) }).collect()
    }

    #[test]
    fn a7t6_mean_scatter_and_halves_come_out_as_by_definition() {
        let values = [1.0, 4.0, 2.0, 8.0, 5.0, 7.0, 3.0, 0.0];
        let survey = Survey::new(Size::new(2, 1).unwrap());
        survey.record(&samples((1, 0), &values[..4]));
        survey.record(&samples((1, 0), &values[4..]));
        let look = survey.row(0)[1];
        let mean = values.iter().sum::<f32>() / 8.0;
        let scatter: f32 = values.iter().map(|v| (v - mean).powi(2)).sum();
        assert_eq!((look.count, look.mean), (8, Vec3::splat(mean)));
        assert!((look.scatter - scatter).abs() < 1e-4);
        // Halves of means 3.75 and 3.75: then they agree, whatever the scatter.
        assert_eq!(look.change, 0.0);
        survey.record(&samples((1, 0), &[3.75 + 8.0; 8]));
        assert!((survey.row(0)[1].change - 16.0).abs() < 1e-5);
        assert_eq!(survey.counts(), [0, 16]);
    }

    /// Pixels with a slanted edge at a random place: mean of the squared errors, and of what was
    /// estimated, after so many samples.
    fn edge(pattern: Pattern, total: u32) -> (f64, f64) {
        let size = Size::new(40, 40).unwrap();
        let survey = Survey::new(size);
        let sampler = pattern.sampler(total, 40, 3);
        let shift = |(x, y): (u32, u32)| f64::from((x * 7 + y * 13) % 32) / 32.0 * 0.8 + 0.1;
        let mut true_error = 0.0;
        for pixel in (0..40).flat_map(|y| (0..40).map(move |x| (x, y))) {
            let value = |s: u32| {
                let [u, v] = sampler.pair(pixel, s, pair::PIXEL);
                // Its area on one side is `shift`.
                f32::from(u8::from(u + 0.2 * (v - 0.5) < shift(pixel)))
            };
            let values: Vec<f32> = (0..total).map(value).collect();
            survey.record(&samples(pixel, &values[..values.len() / 2]));
            survey.record(&samples(pixel, &values[values.len() / 2..]));
            true_error += (f64::from(values.iter().sum::<f32>()) / f64::from(total) - shift(pixel)).powi(2);
        }
        let estimates = survey.map(&GeneralArgs::default(), |e| e.squared_error);
        (true_error / 1600.0, estimates.iter().sum::<f64>() / 1600.0)
    }

    /// Honest for independent samples, and on the safe side of the truth, but not far, for good
    /// patterns, whose first half is not as good a half as the whole is a whole.
    #[test]
    fn a7t6_estimates_are_right_on_average() {
        for total in [8, 32, 128] {
            let (truth, estimate) = edge(Pattern::Random, total);
            let extra = 1.0 + 1.0 / f64::from(total);
            assert!((estimate / truth / extra - 1.0).abs() < 0.2, "random {total}: {estimate} {truth}");
            for pattern in [Pattern::Sobol, Pattern::Halton, Pattern::R2] {
                let (truth, estimate) = edge(pattern, total);
                let ratio = estimate / truth;
                assert!((0.9..4.5).contains(&ratio), "{pattern:?} {total}: {ratio}");
            }
        }
    }
}
