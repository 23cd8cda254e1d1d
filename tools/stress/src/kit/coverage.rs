//! What a pixel is worth: integrals of filters over half planes and discs, by quadrature.
//!
//! The filters stand here a second time, as plain functions of the offset, and so does the rule
//! which samples count; only their names and radii come from the code under test.

use a7_sampling::Kernel;
use std::f64::consts::PI;

/// A part of the plane around the pixel's centre: for each x the interval of y that belongs to it.
#[derive(Clone, Copy, Debug)]
pub enum Region {
    /// All of it.
    Everything,
    /// y < offset + slope·x
    Below {
        /// Rise for each step to the right.
        slope: f64,
        /// Height at the pixel's centre.
        offset: f64,
    },
    /// A disc.
    Disc {
        /// Its centre, from that of the pixel.
        center: [f64; 2],
        /// Its radius.
        radius: f64,
    },
}

impl Region {
    /// Whether a point belongs to it.
    pub fn contains(&self, x: f64, y: f64) -> bool {
        let (low, high) = self.span(x);
        low < y && y < high
    }

    fn span(&self, x: f64) -> (f64, f64) {
        match *self {
            Self::Everything => (f64::NEG_INFINITY, f64::INFINITY),
            Self::Below { slope, offset } => (f64::NEG_INFINITY, offset + slope * x),
            Self::Disc { center: [cx, cy], radius } => {
                let half = (radius * radius - (x - cx).powi(2)).max(0.0).sqrt();
                (cy - half, cy + half)
            }
        }
    }

    /// Where its border is vertical or crosses the height `y`.
    fn corners(&self, y: f64) -> Vec<f64> {
        match *self {
            Self::Everything => Vec::new(),
            Self::Below { slope, offset } => vec![(y - offset) / slope],
            Self::Disc { center: [cx, cy], radius } => {
                let half = (radius * radius - (y - cy).powi(2)).max(0.0).sqrt();
                vec![cx - radius, cx - half, cx + half, cx + radius]
            }
        }
    }
}

/// The share of a filter's weight, over all that counts for a pixel, that falls into a region.
pub fn coverage(kernel: Kernel, region: Region) -> f64 {
    let whole = integral(kernel, Region::Everything);
    integral(kernel, region) / whole
}

fn integral(kernel: Kernel, region: Region) -> f64 {
    let end = half_side(kernel);
    let mut cuts = kinks(kernel);
    cuts.extend(cuts.clone().into_iter().flat_map(|y| region.corners(y)));
    if let Kernel::Tent(radius) = kernel {
        cuts.extend(rim_crossings(radius, region));
    }
    piecewise(-end, end, cuts, |x| {
        let (low, high) = region.span(x);
        let (low, high) = (low.max(-end), high.min(end));
        if low >= high {
            return 0.0;
        }
        let mut cuts = kinks(kernel);
        if let Kernel::Tent(radius) = kernel {
            let half = (radius * radius - x * x).max(0.0).sqrt();
            cuts.extend([-half, half]);
        }
        piecewise(low, high, cuts, |y| weight(kernel, x, y))
    })
}

/// Half the side of the square whose samples count: those of all pixels within the support.
fn half_side(kernel: Kernel) -> f64 {
    let reach = match kernel {
        Kernel::Gaussian(sigma) => 2.0 * sigma,
        Kernel::Box(r)
        | Kernel::Tent(r)
        | Kernel::Mitchell(r)
        | Kernel::Lanczos(r)
        | Kernel::BlackmanHarris(r) => r,
    };
    (reach - 0.5).ceil().max(0.0) + 0.5
}

/// Where the filter along an axis is not smooth, and the ends of the square.
fn kinks(kernel: Kernel) -> Vec<f64> {
    let end = half_side(kernel);
    let inner = match kernel {
        Kernel::Gaussian(_) => vec![],
        Kernel::Mitchell(r) => vec![-r, -r / 2.0, 0.0, r / 2.0, r],
        Kernel::Box(r) | Kernel::Tent(r) | Kernel::Lanczos(r) | Kernel::BlackmanHarris(r) => vec![-r, 0.0, r],
    };
    inner.into_iter().chain([-end, end]).collect()
}

/// Where the border of a region crosses the rim of the cone.
fn rim_crossings(rim: f64, region: Region) -> Vec<f64> {
    match region {
        Region::Everything => Vec::new(),
        Region::Below { slope, offset } => {
            // x² + (offset + slope·x)² = rim²
            let (a, b, c) = (1.0 + slope * slope, slope * offset, offset * offset - rim * rim);
            let root = (b * b - a * c).max(0.0).sqrt();
            vec![(-b - root) / a, (-b + root) / a]
        }
        Region::Disc { center: [cx, cy], radius } => {
            let apart = cx.hypot(cy);
            let along = (apart * apart + rim * rim - radius * radius) / (2.0 * apart);
            let aside = (rim * rim - along * along).max(0.0).sqrt();
            [-1.0, 1.0].map(|side| (along * cx - side * aside * cy) / apart).to_vec()
        }
    }
}

fn weight(kernel: Kernel, x: f64, y: f64) -> f64 {
    let sinc = |t: f64| if t == 0.0 { 1.0 } else { (PI * t).sin() / (PI * t) };
    let along = |t: f64| match kernel {
        Kernel::Box(r) => f64::from(u8::from(t <= r)),
        Kernel::Gaussian(sigma) => (-0.5 * (t / sigma).powi(2)).exp(),
        Kernel::Mitchell(r) => mitchell(2.0 * t / r),
        Kernel::Lanczos(r) => f64::from(u8::from(t < r)) * sinc(t) * sinc(t / r),
        Kernel::BlackmanHarris(r) => {
            let cosine = |k: f64| (PI * k * t / r).cos();
            let window = 0.35875 + 0.48829 * cosine(1.0) + 0.14128 * cosine(2.0) + 0.01168 * cosine(3.0);
            f64::from(u8::from(t < r)) * window
        }
        Kernel::Tent(_) => f64::NAN,
    };
    match kernel {
        Kernel::Tent(r) => (1.0 - x.hypot(y) / r).max(0.0),
        _ => along(x.abs()) * along(y.abs()),
    }
}

/// The published cubic for B = C = ⅓.
fn mitchell(t: f64) -> f64 {
    let (b, c) = (1.0 / 3.0, 1.0 / 3.0);
    let cubic = |k: [f64; 4]| ((k[0] * t + k[1]) * t + k[2]) * t + k[3];
    if t < 1.0 {
        cubic([12.0 - 9.0 * b - 6.0 * c, -18.0 + 12.0 * b + 6.0 * c, 0.0, 6.0 - 2.0 * b]) / 6.0
    } else if t < 2.0 {
        cubic([-b - 6.0 * c, 6.0 * b + 30.0 * c, -12.0 * b - 48.0 * c, 8.0 * b + 24.0 * c]) / 6.0
    } else {
        0.0
    }
}

/// ∫ f from `low` to `high`, piece by piece between the cuts that lie inside.
fn piecewise(low: f64, high: f64, mut cuts: Vec<f64>, f: impl Fn(f64) -> f64) -> f64 {
    cuts.retain(|x| low < *x && *x < high);
    cuts.extend([low, high]);
    cuts.sort_by(f64::total_cmp);
    cuts.windows(2).map(|piece| smooth(piece[0], piece[1], &f)).sum()
}

/// ∫ f over a piece inside which f is smooth, whatever it does at the ends: the double exponential
/// rule of Takahasi and Mori (1974).
fn smooth(low: f64, high: f64, f: impl Fn(f64) -> f64) -> f64 {
    const STEP: f64 = 1.0 / 10.0;
    let (middle, half) = ((low + high) / 2.0, (high - low) / 2.0);
    if half < 1e-14 {
        return 0.0;
    }
    let term = |k: i32| {
        let t = f64::from(k) * STEP;
        let u = PI / 2.0 * t.sinh();
        let share = PI / 2.0 * t.cosh() / u.cosh().powi(2);
        share * f(middle + half * u.tanh())
    };
    half * STEP * (-31..=31).map(term).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    const KERNELS: [fn(f64) -> Kernel; 6] = [
        Kernel::Box,
        Kernel::Tent,
        Kernel::Gaussian,
        Kernel::Mitchell,
        Kernel::Lanczos,
        Kernel::BlackmanHarris,
    ];

    #[test]
    fn half_planes_through_the_centre_are_one_half() {
        for kernel in KERNELS.into_iter().flat_map(|k| [0.5, 1.0, 1.7, 3.0].map(k)) {
            for slope in [0.3, -1.0, 7.0] {
                let found = coverage(kernel, Region::Below { slope, offset: 0.0 });
                assert!((found - 0.5).abs() < 1e-9, "{kernel:?} {slope}: {found}");
            }
        }
    }

    #[test]
    fn areas_under_the_box_and_volumes_under_the_cone() {
        let inside = |radius| Region::Disc { center: [0.05, -0.1], radius };
        let found = coverage(Kernel::Box(1.5), inside(1.2));
        assert!((found - PI * 1.44 / 9.0).abs() < 1e-9, "{found}");
        // A trapezium of the unit square, and of a cone what is within half its radius.
        let found = coverage(Kernel::Box(0.5), Region::Below { slope: 0.4, offset: 0.1 });
        assert!((found - 0.6).abs() < 1e-9, "{found}");
        let found = coverage(Kernel::Tent(2.0), Region::Disc { center: [1e-9, 0.0], radius: 1.0 });
        assert!((found - 0.5).abs() < 1e-8, "{found}");
    }
}
