//! How wrong each pixel probably is.

use super::look::{Look, Part};
use crate::exposure::Sample;
use common::cli::GeneralArgs;
use common::picture::Size;
use common::tiles::{TileOptions, for_each_job};
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// Pixels to each side that are asked how much better the pattern is than independent samples.
const NEAR: usize = 2;

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
        size.pixels() * (size_of::<Look>() + size_of::<Told>() + 2 * size_of::<Range<u32>>())
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

    /// What is known of the pixels now, to be read by many threads.
    fn told(&self, last: &[Range<u32>]) -> Vec<Vec<Told>> {
        let width = self.size.width() as usize;
        let told = |(look, last): (&Look, &Range<u32>)| Told {
            count: look.count,
            variance: look.variance() as f32,
            expected: look.variance() as f32 / look.count.max(1) as f32,
            change: look.change,
            is_new: !last.is_empty(),
        };
        let rows = last.chunks_exact(width).zip(0..);
        rows.map(|(last, y)| self.row(y).iter().zip(last).map(told).collect()).collect()
    }

    /// The samples that every pixel gets next, row by row from the bottom, as `next` says for its
    /// estimate. `last` are those of the last pass: where nobody near got any, nothing is new, and
    /// who had enough has enough.
    pub fn plan(
        &self,
        general: &GeneralArgs,
        last: &[Range<u32>],
        next: impl Fn(Estimate) -> Range<u32> + Sync,
    ) -> Vec<Range<u32>> {
        let rows = self.told(last);
        let made: Vec<Mutex<Vec<Range<u32>>>> = rows.iter().map(|_| Mutex::default()).collect();
        let options = TileOptions { label: None, ..general.tile_options("") };
        for_each_job(
            rows.len(),
            &options,
            || (),
            |(), y| {
                let fresh = fresh(&rows, y);
                let range = |x| if fresh[x] { next(estimate(&rows, x, y)) } else { 0..0 };
                *made[y].lock().unwrap_or_else(PoisonError::into_inner) =
                    (0..rows[y].len()).map(range).collect();
            },
        );
        made.into_iter().flat_map(|row| row.into_inner().unwrap_or_else(PoisonError::into_inner)).collect()
    }
}

/// What a pixel tells its neighbours.
#[derive(Clone, Copy, Debug)]
struct Told {
    count: u32,
    /// Of a single sample.
    variance: f32,
    /// Squared error of the mean if all samples were independent.
    expected: f32,
    /// As in [`Look`].
    change: f32,
    /// Whether it got samples in the last pass.
    is_new: bool,
}

/// The pixels near one along an axis of so many.
fn near(at: usize, end: usize) -> Range<usize> {
    at.saturating_sub(NEAR)..(at + NEAR + 1).min(end)
}

/// For every pixel of a row, whether one near it is new.
fn fresh(rows: &[Vec<Told>], y: usize) -> Vec<bool> {
    let around = &rows[near(y, rows.len())];
    let columns: Vec<bool> = (0..rows[y].len()).map(|x| around.iter().any(|row| row[x].is_new)).collect();
    (0..columns.len()).map(|x| columns[near(x, columns.len())].contains(&true)).collect()
}

/// The error of a pixel as it and those around it tell.
fn estimate(rows: &[Vec<Told>], x: usize, y: usize) -> Estimate {
    let own = rows[y][x];
    let count = own.count as f32;
    let (mut change, mut expected, mut variance, mut pixels) = (0.0, 0.0, 0.0, 0.0);
    for row in &rows[near(y, rows.len())] {
        for told in &row[near(x, row.len())] {
            variance += told.variance;
            pixels += 1.0;
            // Patterns get better with more samples: what has fewer says nothing of this pixel.
            if 2 * told.count >= own.count {
                change += told.change;
                expected += told.expected;
            }
        }
    }
    let better = if expected > 0.0 { change / expected } else { 0.0 };
    let squared_error = better * (own.variance + variance / pixels / count) / count;
    Estimate { samples: own.count, squared_error: f64::from(squared_error) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampler::{Pattern, pair};
    use common::math::Vec3;

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
        let rows = survey.told(&vec![0..1; size.pixels()]);
        let estimates = (0..1600).map(|i| estimate(&rows, i % 40, i / 40).squared_error);
        (true_error / 1600.0, estimates.sum::<f64>() / 1600.0)
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
