//! How wrong each pixel probably is, for `-error`.
//!
//! When a pixel has 2ᵐ samples, its first and its second half are two estimates, each from a
//! whole piece of a low-discrepancy sequence, as odd and even samples would not be. Half their
//! difference is about the error of their mean. One difference may be small by chance, so those
//! of the 5 × 5 pixels around are taken together. A neighbour that was stopped earlier counts with
//! the error that it would have with as many samples.
//!
//! Errors are relative, as relMSE has them: squared error over squared brightness plus 0.01. So a
//! white wall and a grey one are equally good if equally grainy, and what is black on any screen
//! is not worked on for ever.

use super::{Layout, Sums, fixed};

/// Pixels to each side that are asked as well.
const NEAR: usize = 2;

/// Samples before which no pixel is stopped.
const FEWEST: u32 = 16;

/// Added to squared brightness.
const DARK: f64 = 0.01;

impl Sums {
    /// Whether it is time to look at errors, see [`Sums::survey`].
    pub fn wants_survey(&self) -> bool {
        let done = self.done();
        self.layout.halves && done.is_power_of_two() && done >= FEWEST / 2 && done != self.surveyed
    }

    /// Stops pixels whose relative error is probably below `error`, and returns how many there
    /// were. To be called when, and only when, [`Sums::wants_survey`]: what a later survey will
    /// compare is taken down. The outcome follows from the sums and the errors of earlier surveys,
    /// on whatever machine.
    pub fn survey(&mut self, error: f64) -> usize {
        self.surveyed = self.done();
        let enough = if self.done() < FEWEST { Vec::new() } else { self.good_pixels(error * error) };
        enough.iter().for_each(|number| self.stopped[*number] = true);
        self.take_down_halves();
        enough.len()
    }

    /// Active pixels whose surroundings have at most this squared error.
    fn good_pixels(&self, most: f64) -> Vec<usize> {
        // Squared errors fall at least as the number of samples grows.
        let of_one_sample = |number: usize| self.squared_error(number) * f64::from(self.taken[number]);
        let errors: Vec<f64> = (0..self.taken.len()).map(of_one_sample).collect();
        let most = most * f64::from(self.done());
        (0..errors.len())
            .filter(|number| !self.stopped[*number] && self.around(&errors, *number) <= most)
            .collect()
    }

    /// Relative squared error of one pixel's mean, judged by its halves.
    fn squared_error(&self, number: usize) -> f64 {
        let (values, taken) = (self.values_of(number), self.taken[number]);
        let (mut apart, mut brightness) = (0.0, 0.0);
        for channel in 0..3 {
            let (sum, half) = (values[Layout::RADIANCE + channel], values[Layout::HALF + channel]);
            let difference = fixed::mean(sum - half, taken / 2) - fixed::mean(half, taken / 2);
            apart += difference * difference / 3.0;
            brightness += fixed::mean(sum, taken) / 3.0;
        }
        apart / 4.0 / (brightness * brightness + DARK)
    }

    /// Mean of the errors around a pixel, as far as the picture goes.
    fn around(&self, errors: &[f64], number: usize) -> f64 {
        let (width, height) = (self.frame.crop.width() as usize, self.frame.crop.height() as usize);
        let (x, y) = (number % width, number / width);
        let (left, right) = (x.saturating_sub(NEAR), (x + NEAR).min(width - 1));
        let rows = y.saturating_sub(NEAR)..=(y + NEAR).min(height - 1);
        let (mut sum, mut count) = (0.0, 0);
        for row in rows {
            let near = &errors[row * width + left..=row * width + right];
            sum += near.iter().sum::<f64>();
            count += near.len();
        }
        sum / count as f64
    }

    /// What active pixels have now is the first half of what they will have.
    fn take_down_halves(&mut self) {
        let stride = self.layout.stride();
        for (values, stopped) in self.values.chunks_exact_mut(stride).zip(&self.stopped) {
            if !stopped {
                values.copy_within(Layout::RADIANCE..Layout::RADIANCE + 3, Layout::HALF);
            }
        }
    }
}
