//! What one pixel's samples give to the pixels around it.

use crate::Sample;
use crate::filter::{Kernel, MOST_RADIUS};
use common::math::{DVec4, Vec3};

/// Samples whose weights are worked out side by side: one after the other they would wait for each
/// other's.
const ABREAST: usize = 16;

/// The sums of one pixel while its samples come in: the plain sum, and weighted colour and weight
/// for every pixel within the kernel's support.
///
/// Sums are kept by the pixel that has the samples and not by the pixel that gets them: they then
/// depend on no other pixel, and adding them up in a fixed order afterwards makes the picture the
/// same, bit for bit, whatever the tiles and threads were.
pub struct Shares {
    kernel: Option<Kernel>,
    /// Pixels along a side of the square that gets shares: odd.
    side: usize,
    sums: Vec<DVec4>,
    /// Weights along both axes, of one sample after the other.
    factors: Vec<f64>,
}

impl Shares {
    /// No samples yet. Without a kernel a pixel is the average of its own samples.
    ///
    /// # Panics
    /// If the kernel reaches further than [`MOST_RADIUS`].
    pub fn new(kernel: Option<Kernel>) -> Self {
        let side = 2 * kernel.map_or(0, |k| k.support()) + 1;
        assert!(side <= 2 * MOST_RADIUS as usize + 1, "{kernel:?} reaches too far");
        let sums = vec![DVec4::ZERO; Self::sums_per_pixel(kernel)];
        Self { kernel, side, sums, factors: Vec::new() }
    }

    /// How many sums there are: one without a kernel.
    pub fn sums_per_pixel(kernel: Option<Kernel>) -> usize {
        1 + kernel.map_or(0, |k| (2 * k.support() + 1).pow(2))
    }

    /// Forgets all samples.
    pub fn clear(&mut self) {
        self.sums.fill(DVec4::ZERO);
    }

    /// Adds a sample at a place of the pixel, counted from its lower left corner.
    pub fn add(&mut self, at: [f64; 2], color: Vec3) {
        self.add_all(&[Sample { pixel: (0, 0), at, color }]);
    }

    /// Adds samples of the pixel, in order.
    #[inline(always)]
    pub fn add_all(&mut self, samples: &[Sample]) {
        for sample in samples {
            self.sums[0] += sample.color.as_dvec3().extend(1.0);
        }
        let Some(kernel) = self.kernel else { return };
        for samples in samples.chunks(ABREAST) {
            if kernel.is_product() {
                self.add_products(&kernel, samples);
            } else {
                samples.iter().for_each(|sample| self.add_weighted(&kernel, sample));
            }
        }
    }

    /// Adds a sample, weight by weight.
    fn add_weighted(&mut self, kernel: &Kernel, sample: &Sample) {
        // Pixel (i, j) of the square is i − support to the right and j − support up of this one.
        let (side, support) = (self.side, (self.side / 2) as f64);
        let color = sample.color.as_dvec3().extend(1.0);
        let [x, y] = sample.at.map(|at| at - 0.5);
        for (i, sum) in self.sums[1..].iter_mut().enumerate() {
            let (column, row) = ((i % side) as f64, (i / side) as f64);
            *sum += color * kernel.weight(x - (column - support), y - (row - support));
        }
    }

    /// Adds samples whose weights are products of one along each axis.
    #[inline(always)]
    fn add_products(&mut self, kernel: &Kernel, samples: &[Sample]) {
        let (side, support) = (self.side, (self.side / 2) as f64);
        self.factors.clear();
        for sample in samples {
            for at in sample.at {
                self.factors.extend((0..side).map(|i| (at - 0.5) - (i as f64 - support)));
            }
        }
        // A multiple of four is fastest.
        self.factors.resize(self.factors.len().next_multiple_of(4), 0.0);
        kernel.factors(&mut self.factors);
        let sums = &mut self.sums[1..];
        // The usual kernels reach one pixel or two far.
        match side {
            3 => return add_square::<3>(sums, samples, &self.factors),
            5 => return add_square::<5>(sums, samples, &self.factors),
            _ => {}
        }
        for (sample, factors) in samples.iter().zip(self.factors.chunks_exact(2 * side)) {
            let (color, (across, upward)) = (sample.color.as_dvec3().extend(1.0), factors.split_at(side));
            for (row, up) in sums.chunks_exact_mut(side).zip(upward) {
                for (sum, along) in row.iter_mut().zip(across) {
                    *sum += color * (along * up);
                }
            }
        }
    }

    /// First the sum of the colours of all samples and, last, their number; then, if there is a
    /// kernel, weighted colours and, last, weights for the pixels around, row by row from below.
    pub fn sums(&self) -> &[DVec4] {
        &self.sums
    }
}

/// Adds samples to a square of sums of a side that is known beforehand, so that a small one is kept
/// in registers. `factors` are those of one sample after the other, along both axes.
#[inline(always)]
fn add_square<const SIDE: usize>(sums: &mut [DVec4], samples: &[Sample], factors: &[f64]) {
    let mut square = [[[0.0; 4]; SIDE]; SIDE];
    for (place, sum) in square.as_flattened_mut().iter_mut().zip(&*sums) {
        *place = sum.to_array();
    }
    for (sample, factors) in samples.iter().zip(factors.chunks_exact(2 * SIDE)) {
        let color = sample.color.as_dvec3().extend(1.0).to_array();
        for row in 0..SIDE {
            for column in 0..SIDE {
                let weight = factors[column] * factors[SIDE + row];
                for channel in 0..4 {
                    square[row][column][channel] += color[channel] * weight;
                }
            }
        }
    }
    for (place, sum) in square.as_flattened().iter().zip(sums) {
        *sum = DVec4::from_array(*place);
    }
}
