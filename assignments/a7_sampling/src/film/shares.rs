//! What one pixel's samples give to the pixels around it.

use crate::filter::Kernel;
use common::math::{DVec3, DVec4, Vec3};

/// The sums of one pixel while its samples come in: weighted colour and weight for every pixel
/// within the kernel's support, and the plain sum.
///
/// Sums are kept by the pixel that has the samples and not by the pixel that gets them: they then
/// depend on no other pixel, and adding them up in a fixed order afterwards makes the picture the
/// same, bit for bit, whatever the tiles and threads were.
pub struct Shares {
    kernel: Option<Kernel>,
    /// Pixels along a side of the square that gets shares: odd.
    side: usize,
    sums: Vec<DVec4>,
    plain: DVec3,
    count: u32,
    across: Vec<f64>,
    upward: Vec<f64>,
}

impl Shares {
    /// No samples yet. Without a kernel a pixel is the average of its own samples.
    pub fn new(kernel: Option<Kernel>) -> Self {
        let side = 2 * kernel.map_or(0, |k| k.support()) + 1;
        let axis = vec![0.0; side];
        Self {
            kernel,
            side,
            sums: vec![DVec4::ZERO; side * side],
            plain: DVec3::ZERO,
            count: 0,
            across: axis.clone(),
            upward: axis,
        }
    }

    /// Forgets all samples.
    pub fn clear(&mut self) {
        self.sums.fill(DVec4::ZERO);
        (self.plain, self.count) = (DVec3::ZERO, 0);
    }

    /// Adds a sample at a place of the pixel, counted from its lower left corner.
    pub fn add(&mut self, [x, y]: [f64; 2], color: Vec3) {
        let color = color.as_dvec3();
        self.plain += color;
        self.count += 1;
        let Some(kernel) = self.kernel else { return };
        // Pixel (i, j) of the square is i − support to the right and j − support up of this one.
        let support = (self.side / 2) as f64;
        let offset = |at: f64, i: usize| at - 0.5 - (i as f64 - support);
        let color = color.extend(1.0);
        if kernel.axis(0.0).is_none() {
            for (i, sum) in self.sums.iter_mut().enumerate() {
                let (column, row) = (i % self.side, i / self.side);
                *sum += color * kernel.weight(offset(x, column), offset(y, row));
            }
            return;
        }
        for i in 0..self.side {
            self.across[i] = kernel.axis(offset(x, i)).unwrap_or(0.0);
            self.upward[i] = kernel.axis(offset(y, i)).unwrap_or(0.0);
        }
        for (row, up) in self.sums.chunks_exact_mut(self.side).zip(&self.upward) {
            for (sum, along) in row.iter_mut().zip(&self.across) {
                *sum += color * (along * up);
            }
        }
    }

    /// Samples added since the last [`Shares::clear`].
    pub fn count(&self) -> u32 {
        self.count
    }

    /// Sum of the colours of all samples.
    pub fn plain(&self) -> DVec3 {
        self.plain
    }

    /// Weighted colours and, last, weights for the pixels around, row by row from below.
    pub fn sums(&self) -> &[DVec4] {
        &self.sums
    }
}
