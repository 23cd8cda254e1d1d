//! What one pixel's samples give to the pixels around it.

use crate::filter::{Kernel, MOST_RADIUS};
use common::math::{DVec4, Vec3};

/// Pixels along a side of the square that gets shares, at most, and up to the next multiple of 4.
const MOST_SIDE: usize = (2 * MOST_RADIUS as usize + 1).next_multiple_of(4);

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
        Self { kernel, side, sums }
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
    #[inline(always)]
    pub fn add(&mut self, [x, y]: [f64; 2], color: Vec3) {
        let color = color.as_dvec3().extend(1.0);
        let (plain, weighted) = self.sums.split_at_mut(1);
        plain[0] += color;
        let Some(kernel) = self.kernel else { return };
        // Pixel (i, j) of the square is i − support to the right and j − support up of this one.
        let (side, support) = (self.side, (self.side / 2) as f64);
        let [x, y] = [x - 0.5, y - 0.5];
        if !kernel.is_product() {
            for (i, sum) in weighted.iter_mut().enumerate() {
                let (column, row) = ((i % side) as f64, (i / side) as f64);
                *sum += color * kernel.weight(x - (column - support), y - (row - support));
            }
            return;
        }
        // Both axes in one row, each up to a multiple of four.
        let (mut row, used) = ([0.0; 2 * MOST_SIDE], side.next_multiple_of(4));
        for i in 0..used {
            let place = i as f64 - support;
            (row[i], row[used + i]) = (x - place, y - place);
        }
        kernel.factors(&mut row[..2 * used]);
        let (across, upward) = row.split_at(used);
        for (row, up) in weighted.chunks_exact_mut(side).zip(upward) {
            for (sum, along) in row.iter_mut().zip(across) {
                *sum += color * (along * up);
            }
        }
    }

    /// First the sum of the colours of all samples and, last, their number; then, if there is a
    /// kernel, weighted colours and, last, weights for the pixels around, row by row from below.
    pub fn sums(&self) -> &[DVec4] {
        &self.sums
    }
}
