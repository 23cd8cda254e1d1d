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
    /// Sums per pixel.
    stride: usize,
    /// Number of the lowest row that is kept.
    first: u32,
    rows: VecDeque<Vec<Vec4>>,
}

impl Negative {
    /// No rows yet.
    pub fn new(size: Size, kernel: Option<Kernel>) -> Self {
        let (support, stride) = (kernel.map(|k| k.support()), Shares::sums_per_pixel(kernel));
        Self { size, support, stride, first: 0, rows: VecDeque::new() }
    }

    /// How far pixels give, in rows.
    fn reach(&self) -> u32 {
        self.support.unwrap_or(0) as u32
    }

    /// How many rows to expose at a time.
    pub fn rows_at_a_time(&self) -> u32 {
        let row = self.stride * size_of::<Vec4>() * self.size.width() as usize;
        let rows = (MOST_BYTES / row) as u32;
        rows.saturating_sub(2 * self.reach()).max(16)
    }

    /// Bytes of the whole picture.
    pub fn bytes(&self) -> usize {
        self.stride * size_of::<Vec4>() * self.size.pixels()
    }

    /// Appends rows without samples, up to the row `end`, excluded.
    pub fn extend_to(&mut self, end: u32) {
        let blank = vec![Vec4::ZERO; self.stride * self.size.width() as usize];
        self.rows.resize((end - self.first) as usize, blank);
    }

    /// One past the last row that is there.
    pub fn end(&self) -> u32 {
        self.first + self.rows.len() as u32
    }

    fn row(&self, y: u32) -> &[Vec4] {
        &self.rows[(y - self.first) as usize]
    }

    /// Adds what came in at a pixel, as [`Shares::sums`] says.
    ///
    /// # Panics
    /// If its row is not there.
    pub fn add(&mut self, x: u32, y: u32, shares: &[DVec4]) {
        let stride = self.stride;
        let sums = &mut self.rows[(y - self.first) as usize][x as usize * stride..][..stride];
        for (sum, more) in sums.iter_mut().zip(shares) {
            *sum = (sum.as_dvec4() + *more).as_vec4();
        }
    }

    /// Sum of a pixel's own samples, and their number.
    ///
    /// # Panics
    /// If its row is not there.
    pub fn own(&self, x: u32, y: u32) -> Vec4 {
        self.row(y)[x as usize * self.stride]
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
    /// is no larger. Where the weights come to nothing, because a narrow kernel caught no sample or
    /// its lobes cancelled out, it is the plain average of its own samples.
    ///
    /// # Panics
    /// If a row that gives to it is not there.
    pub fn pixel(&self, x: u32, y: u32) -> Vec3 {
        let Some(support) = self.support else { return self.mean(x, y) };
        let near = |at: u32, end: u32| {
            (at as usize).saturating_sub(support)..(at as usize + support + 1).min(end as usize)
        };
        let (side, stride) = (2 * support + 1, self.stride);
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
mod tests;
