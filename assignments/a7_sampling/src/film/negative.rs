//! The film before it is developed.

use super::Shares;
use crate::filter::Kernel;
use common::math::{DVec4, Vec3, Vec4};
use common::picture::{Film, Size};
use std::collections::VecDeque;

/// Most bytes of rows that wait to be developed, but for a few rows that must.
const MOST_BYTES: usize = 1 << 28;

/// Rows of pixels with what their samples give (see [`Shares`]), in single precision. For each
/// pixel: the sum of its own samples with their number, and, if there is a kernel, weighted
/// colours and weights for the pixels around. Rows come from below and are dropped once they are
/// developed and nobody needs them any more.
pub struct Negative {
    size: Size,
    /// Pixels to each side that a pixel gives to; `None` if it keeps all to itself.
    support: Option<usize>,
    /// Number of the lowest row that is kept.
    first: u32,
    rows: VecDeque<Vec<Vec4>>,
}

impl Negative {
    /// No rows yet.
    pub fn new(size: Size, kernel: Option<Kernel>) -> Self {
        Self { size, support: kernel.map(|k| k.support()), first: 0, rows: VecDeque::new() }
    }

    /// Sums per pixel.
    fn stride(&self) -> usize {
        1 + self.support.map_or(0, |s| (2 * s + 1).pow(2))
    }

    /// How far pixels give, in rows.
    fn reach(&self) -> u32 {
        self.support.unwrap_or(0) as u32
    }

    /// How many rows to expose at a time.
    pub fn rows_at_a_time(&self) -> u32 {
        let row = self.stride() * size_of::<Vec4>() * self.size.width() as usize;
        let rows = (MOST_BYTES / row) as u32;
        rows.saturating_sub(2 * self.reach()).max(16)
    }

    /// Bytes of the whole picture.
    pub fn bytes(&self) -> usize {
        self.stride() * size_of::<Vec4>() * self.size.pixels()
    }

    /// Appends rows without samples, up to the row `end`, excluded.
    pub fn extend_to(&mut self, end: u32) {
        let blank = vec![Vec4::ZERO; self.stride() * self.size.width() as usize];
        self.rows.resize((end - self.first) as usize, blank);
    }

    /// One past the last row that is there.
    pub fn end(&self) -> u32 {
        self.first + self.rows.len() as u32
    }

    fn row(&self, y: u32) -> &[Vec4] {
        &self.rows[(y - self.first) as usize]
    }

    /// Adds what came in at a pixel since `shares` were cleared.
    ///
    /// # Panics
    /// If its row is not there.
    pub fn add(&mut self, x: u32, y: u32, shares: &Shares) {
        let stride = self.stride();
        let sums = &mut self.rows[(y - self.first) as usize][x as usize * stride..][..stride];
        let own = shares.plain().extend(f64::from(shares.count()));
        for (sum, more) in sums.iter_mut().zip(std::iter::once(&own).chain(shares.sums())) {
            *sum = (sum.as_dvec4() + *more).as_vec4();
        }
    }

    /// Sum of a pixel's own samples, and their number.
    ///
    /// # Panics
    /// If its row is not there.
    pub fn own(&self, x: u32, y: u32) -> Vec4 {
        self.row(y)[x as usize * self.stride()]
    }

    /// The plain average of a pixel's own samples; black if there are none.
    fn mean(&self, x: u32, y: u32) -> Vec3 {
        let own = self.own(x, y).as_dvec4();
        if own.w > 0.0 { (own.truncate() / own.w).as_vec3() } else { Vec3::ZERO }
    }

    /// Writes the rows from `done` on into the film, as far as they are complete, and drops those
    /// that no later row needs. Returns the first row that could not be written yet.
    pub fn develop(&mut self, done: u32, film: &mut Film) -> u32 {
        let complete = self.end() == self.size.height();
        let ready = if complete { self.end() } else { self.end().saturating_sub(self.reach()) };
        for y in done..ready {
            (0..self.size.width()).for_each(|x| film.set(x, y, self.pixel(x, y)));
        }
        while self.first + self.reach() < ready && !self.rows.is_empty() {
            self.rows.pop_front();
            self.first += 1;
        }
        ready.max(done)
    }

    /// A pixel of the picture: weighted colours over weights, added up in a fixed order. All pixels
    /// count alike, also those that have more samples than others: those know their part better, it
    /// is no larger. Where the
    /// weights come to nothing, because a narrow kernel caught no sample or its lobes cancelled
    /// out, it is the plain average of its own samples.
    ///
    /// # Panics
    /// If a row that gives to it is not there.
    pub fn pixel(&self, x: u32, y: u32) -> Vec3 {
        let Some(support) = self.support else { return self.mean(x, y) };
        let near = |at: u32, end: u32| {
            (at as usize).saturating_sub(support)..(at as usize + support + 1).min(end as usize)
        };
        let (side, stride) = (2 * support + 1, self.stride());
        let (mut sum, mut greatest) = (DVec4::ZERO, 0.0f64);
        for j in near(y, self.size.height()) {
            let row = self.row(j as u32);
            for i in near(x, self.size.width()) {
                // Where the giver (i, j) sees this pixel in its square.
                let (right, up) = (support + x as usize - i, support + y as usize - j);
                let count = f64::from(row[i * stride].w).max(1.0);
                let share = row[i * stride + 1 + up * side + right].as_dvec4() / count;
                sum += share;
                greatest = greatest.max(share.w.abs());
            }
        }
        // Weights are rounded to single precision, so where they cancel nothing is left to go by.
        if sum.w > greatest * 1e-3 { (sum.truncate() / sum.w).as_vec3() } else { self.mean(x, y) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampler::{Jittered, Sampler};

    const SIZE: (i64, i64) = (7, 5);

    /// A picture of `color(x, y)` in pixels, by nine jittered samples per pixel, exposed so many
    /// rows at a time.
    fn picture(kernel: Option<Kernel>, rows: u32, color: impl Fn(f64, f64) -> Vec3) -> Film {
        let size = Size::new(SIZE.0, SIZE.1).unwrap();
        let (mut film, mut negative, mut done) = (Film::new(size), Negative::new(size, kernel), 0);
        let (mut shares, sampler) = (Shares::new(kernel), Jittered::new(9, 1));
        while done < size.height() {
            let from = negative.end();
            let to = (from + rows).min(size.height());
            negative.extend_to(to);
            for (x, y) in (from..to).flat_map(|y| (0..size.width()).map(move |x| (x, y))) {
                shares.clear();
                for at in (0..9).map(|s| sampler.pair((x, y), s, 0)) {
                    shares.add(at, color(f64::from(x) + at[0], f64::from(y) + at[1]));
                }
                negative.add(x, y, &shares);
            }
            done = negative.develop(done, &mut film);
        }
        film
    }

    const KERNELS: [Kernel; 6] = [
        Kernel::Box(1.7),
        Kernel::Tent(2.3),
        Kernel::Gaussian(0.6),
        Kernel::Mitchell(2.0),
        Kernel::Lanczos(3.0),
        Kernel::BlackmanHarris(1.5),
    ];

    /// The rule of the course, sample by sample.
    fn by_definition(kernel: Kernel, x: u32, y: u32, color: impl Fn(f64, f64) -> Vec3) -> Vec3 {
        let (support, sampler) = (kernel.support() as i64, Jittered::new(9, 1));
        let (mut sum, mut weights) = (common::math::DVec3::ZERO, 0.0);
        for (i, j) in (0..SIZE.0).flat_map(|i| (0..SIZE.1).map(move |j| (i, j))) {
            if (i - i64::from(x)).abs() > support || (j - i64::from(y)).abs() > support {
                continue;
            }
            for s in 0..9 {
                let [u, v] = sampler.pair((i as u32, j as u32), s, 0);
                let (px, py) = (i as f64 + u, j as f64 + v);
                let w = kernel.weight(px - f64::from(x) - 0.5, py - f64::from(y) - 0.5);
                sum += color(px, py).as_dvec3() * w;
                weights += w;
            }
        }
        (sum / weights).as_vec3()
    }

    fn pattern(x: f64, y: f64) -> Vec3 {
        Vec3::new((x * 1.3 + y).sin() as f32, (x * y) as f32, if x > 3.3 { 9.0 } else { 0.0 })
    }

    #[test]
    fn a7t2_pixels_are_weighted_means_of_all_samples_near() {
        for kernel in KERNELS {
            let film = picture(Some(kernel), 5, pattern);
            for (x, y) in (0..5).flat_map(|y| (0..7).map(move |x| (x, y))) {
                let expected = by_definition(kernel, x, y, pattern);
                let off = (film.get(x, y) - expected).abs().max_element();
                assert!(off < 2e-5 * expected.abs().max_element().max(1.0), "{kernel:?} ({x}, {y}) {off}");
            }
        }
    }

    #[test]
    fn a7t2_one_color_stays_that_color() {
        for kernel in KERNELS.into_iter().map(Some).chain([None, Some(Kernel::Tent(0.1))]) {
            for pixel in picture(kernel, 5, |_, _| Vec3::new(1.0, 0.25, 3.0)).pixels() {
                let off = (*pixel - Vec3::new(1.0, 0.25, 3.0)).abs().max_element();
                assert!(off < 1e-6, "{kernel:?} {pixel}");
            }
        }
    }

    /// One pixel with a hundred times the samples of the others is no heavier than they are.
    #[test]
    fn a7t6_more_samples_are_no_more_weight() {
        let size = Size::new(3, 1).unwrap();
        let value = |x: u32| Vec3::splat(x as f32);
        let picture = |counts: [u32; 3]| {
            let kernel = Some(Kernel::Gaussian(0.8));
            let (mut negative, mut film) = (Negative::new(size, kernel), Film::new(size));
            negative.extend_to(1);
            for x in 0..3 {
                let mut shares = Shares::new(kernel);
                (0..counts[x as usize]).for_each(|_| shares.add([0.3, 0.6], value(x)));
                negative.add(x, 0, &shares);
            }
            negative.develop(0, &mut film);
            film
        };
        let (even, uneven) = (picture([2; 3]), picture([2, 200, 2]));
        for (a, b) in even.pixels().iter().zip(uneven.pixels()) {
            assert!((*a - *b).abs().max_element() < 1e-5, "{a} {b}");
        }
    }

    #[test]
    fn rows_may_come_a_few_at_a_time() {
        for kernel in KERNELS.into_iter().map(Some).chain([None]) {
            assert_eq!(picture(kernel, 1, pattern), picture(kernel, 5, pattern), "{kernel:?}");
        }
    }
}
