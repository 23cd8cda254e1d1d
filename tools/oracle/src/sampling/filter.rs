//! The course's filters (§7.2).

/// How much a sample counts for a pixel, by its offset from the pixel's centre in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Filter {
    /// All alike inside a square of this half side, its edge included.
    Box(f64),
    /// A cone that ends at this radius.
    Tent(f64),
    /// A bell of this σ.
    Gaussian(f64),
}

impl Filter {
    /// Weight at an offset, not scaled.
    pub fn weight(&self, x: f64, y: f64) -> f64 {
        match *self {
            Self::Box(radius) => {
                if x.abs().max(y.abs()) <= radius {
                    1.0
                } else {
                    0.0
                }
            }
            Self::Tent(radius) => (1.0 - x.hypot(y) / radius).max(0.0),
            Self::Gaussian(sigma) => (-(x * x + y * y) / (2.0 * sigma * sigma)).exp(),
        }
    }

    /// How many pixels to each side have samples that count, all of them.
    pub fn support(&self) -> u32 {
        let reach = match *self {
            Self::Box(radius) | Self::Tent(radius) => radius,
            Self::Gaussian(sigma) => 2.0 * sigma,
        };
        (reach - 0.5).ceil().max(0.0) as u32
    }

    /// Whether it has a radius to speak of.
    pub(crate) fn is_sound(&self) -> bool {
        let (Self::Box(radius) | Self::Tent(radius) | Self::Gaussian(radius)) = *self;
        radius > 0.0 && radius.is_finite()
    }
}
