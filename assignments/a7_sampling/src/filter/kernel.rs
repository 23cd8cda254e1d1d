//! The kernels, as functions of the distance from a pixel's centre, in pixels.

use super::bell::bell;
use common::cli::AppError;
use std::f64::consts::PI;

/// Greatest radius: beyond it a picture of our sizes is a blur, and a pixel has 33 × 33 shares.
pub const MOST_RADIUS: f64 = 16.5;

/// A weight for every place around the centre of a pixel. Colours are divided by the sum of the
/// weights, so none of the kernels is scaled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kernel {
    /// 1 where |x| and |y| are at most the radius.
    Box(f64),
    /// A cone: 1 at the centre, 0 at the radius.
    Tent(f64),
    /// exp(−d²/2σ²) of this σ, as far as its support reaches.
    Gaussian(f64),
    /// Two cubic pieces with a little overshoot (Mitchell & Netravali 1988, B = C = ⅓).
    Mitchell(f64),
    /// The ideal low pass, faded out by its own main lobe (Lanczos; Duchon 1979).
    Lanczos(f64),
    /// Four cosines with side lobes below −92 dB (Harris 1978).
    BlackmanHarris(f64),
}

/// The kernels by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
#[value(rename_all = "snake_case")]
pub enum KernelName {
    /// All samples alike
    Box,
    /// A cone
    Tent,
    /// A bell; its radius is σ
    Gaussian,
    /// Cubic, sharpens edges a little
    Mitchell,
    /// Windowed sinc: sharpest, rings
    Lanczos,
    /// Smoothest bell
    BlackmanHarris,
}

impl KernelName {
    /// The kernel of a radius in pixels (of σ for the Gaussian).
    ///
    /// # Errors
    /// A radius that is not above 0 or reaches too far.
    pub fn with_radius(self, radius: f64) -> Result<Kernel, AppError> {
        let kernel = match self {
            Self::Box => Kernel::Box(radius),
            Self::Tent => Kernel::Tent(radius),
            Self::Gaussian => Kernel::Gaussian(radius),
            Self::Mitchell => Kernel::Mitchell(radius),
            Self::Lanczos => Kernel::Lanczos(radius),
            Self::BlackmanHarris => Kernel::BlackmanHarris(radius),
        };
        // Written so that NaN is refused.
        if radius > 0.0 && kernel.reach() <= MOST_RADIUS {
            return Ok(kernel);
        }
        let most = MOST_RADIUS * radius / kernel.reach();
        let most = if most.is_finite() { most } else { MOST_RADIUS };
        Err(AppError::Usage(format!("a filter's radius must be above 0 and at most {most}, not {radius}")))
    }
}

impl Kernel {
    /// Weight of a sample at this offset from the pixel's centre.
    pub fn weight(&self, x: f64, y: f64) -> f64 {
        match *self {
            Self::Tent(radius) => (1.0 - (x * x + y * y).sqrt() / radius).max(0.0),
            _ => self.along(x) * self.along(y),
        }
    }

    /// Whether it is a product over both axes; the cone is not.
    pub fn is_product(&self) -> bool {
        !matches!(self, Self::Tent(_))
    }

    /// The factors of weights for offsets from pixels' centres along an axis, in place of those; a
    /// multiple of four of them is fastest.
    #[inline(always)]
    pub fn factors(&self, offsets: &mut [f64]) {
        match *self {
            // A loop of its own, which becomes vector code.
            Self::Gaussian(s) => offsets.iter_mut().for_each(|x| *x = bell(-*x * *x / (2.0 * s * s))),
            _ => offsets.iter_mut().for_each(|x| *x = self.along(*x)),
        }
    }

    fn along(&self, x: f64) -> f64 {
        match *self {
            Self::Box(radius) => f64::from(u8::from(x.abs() <= radius)),
            Self::Tent(radius) => (1.0 - x.abs() / radius).max(0.0),
            Self::Gaussian(sigma) => bell(-x * x / (2.0 * sigma * sigma)),
            Self::Mitchell(radius) => mitchell(2.0 * x.abs() / radius),
            Self::Lanczos(radius) if x.abs() < radius => sinc(x) * sinc(x / radius),
            Self::BlackmanHarris(radius) if x.abs() < radius => blackman_harris(x / radius),
            _ => 0.0,
        }
    }

    /// How much of the noise of single pixels is left after the filter: the variance of a pixel of
    /// the picture over that of the plain mean of one pixel's samples, if all pixels around have as
    /// many, equally noisy and independent samples. 1 for a box over the pixel, less for wider
    /// kernels.
    pub fn noise_gain(&self) -> f64 {
        const STEPS: i32 = 16;
        let pixels = 2 * self.support() as i32 + 1;
        let at = |i: i32| (f64::from(i) + 0.5) / f64::from(STEPS) - f64::from(pixels) / 2.0;
        let places = (0..pixels * STEPS).flat_map(|i| (0..pixels * STEPS).map(move |j| (at(i), at(j))));
        let (sum, squares) = places
            .map(|(x, y)| self.weight(x, y))
            .fold((0.0, 0.0), |(sum, squares), w| (sum + w, squares + w * w));
        squares * f64::from(STEPS * STEPS) / (sum * sum)
    }

    /// From how far away samples count, in pixels along an axis.
    fn reach(&self) -> f64 {
        match *self {
            Self::Gaussian(sigma) => 2.0 * sigma,
            Self::Box(r) | Self::Tent(r) | Self::Mitchell(r) | Self::Lanczos(r) | Self::BlackmanHarris(r) => {
                r
            }
        }
    }

    /// How many pixels to each side have samples that count: ⌈r − ½⌉, and for the Gaussian
    /// ⌈2σ − ½⌉. All samples of those pixels do, whatever their distance.
    pub fn support(&self) -> usize {
        (self.reach() - 0.5).ceil().max(0.0) as usize
    }
}

/// Mitchell and Netravali's cubic on [0, 2], 0 beyond.
fn mitchell(x: f64) -> f64 {
    match x {
        0.0..1.0 => (21.0 * x - 36.0) * x * x / 18.0 + 16.0 / 18.0,
        1.0..2.0 => ((-7.0 * x + 36.0) * x - 60.0) * x / 18.0 + 32.0 / 18.0,
        _ => 0.0,
    }
}

/// sin(πx)/πx.
fn sinc(x: f64) -> f64 {
    if x.abs() < 1e-8 { 1.0 } else { (PI * x).sin() / (PI * x) }
}

/// The four-term window on [−1, 1].
fn blackman_harris(x: f64) -> f64 {
    let angle = PI * (x + 1.0);
    0.35875 - 0.48829 * angle.cos() + 0.14128 * (2.0 * angle).cos() - 0.01168 * (3.0 * angle).cos()
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Kernel; 6] = [
        Kernel::Box(1.7),
        Kernel::Tent(1.7),
        Kernel::Gaussian(0.6),
        Kernel::Mitchell(2.0),
        Kernel::Lanczos(3.0),
        Kernel::BlackmanHarris(2.0),
    ];

    #[test]
    fn a7t2_kernels_peak_at_the_centre_and_are_symmetric() {
        for kernel in ALL {
            let peak = kernel.weight(0.0, 0.0);
            assert!(peak > 0.7 && peak < 1.00001, "{kernel:?} {peak}");
            for (x, y) in [(0.3, 0.1), (1.1, 0.7), (0.0, 1.6), (2.4, 0.2)] {
                let w = kernel.weight(x, y);
                assert!(w <= peak, "{kernel:?}");
                for (a, b) in [(-x, y), (x, -y), (y, x)] {
                    assert!((kernel.weight(a, b) - w).abs() < 1e-12, "{kernel:?} at {a} {b}");
                }
                if kernel.is_product() {
                    let mut factors = [x, y];
                    kernel.factors(&mut factors);
                    assert_eq!(factors[0] * factors[1], w);
                }
            }
        }
    }

    #[test]
    fn a7t2_values_of_the_course() {
        assert_eq!((Kernel::Box(0.5).weight(0.5, -0.5), Kernel::Box(0.5).weight(0.51, 0.0)), (1.0, 0.0));
        assert!((Kernel::Tent(1.5).weight(0.6, 0.8) - 1.0 / 3.0).abs() < 1e-12);
        assert_eq!(Kernel::Tent(1.5).weight(1.2, 1.2), 0.0);
        assert!((Kernel::Gaussian(0.5).weight(0.5, 0.5) - (-1.0f64).exp()).abs() < 1e-12);
        assert!(Kernel::Gaussian(0.5).weight(1.5, 1.5) > 0.0, "not cut to a disc");
        let supports = [
            Kernel::Box(0.5),
            Kernel::Box(0.6),
            Kernel::Tent(1.5),
            Kernel::Gaussian(0.4),
            Kernel::Gaussian(2.3),
        ];
        assert_eq!(supports.map(|k| k.support()), [0, 1, 1, 1, 5]);
    }

    /// Cubic pieces meet, sum to one over the pixels, and end at zero.
    #[test]
    fn a7t2_mitchell_is_a_partition_of_unity() {
        for i in 0..100 {
            let x = f64::from(i) / 100.0;
            let sum: f64 = (-3..=3).map(|k| Kernel::Mitchell(2.0).weight(x + f64::from(k), 0.0)).sum();
            assert!((sum - 8.0 / 9.0).abs() < 1e-12, "{sum}");
        }
    }

    #[test]
    fn a7t2_lanczos_and_blackman_harris_at_known_places() {
        let lanczos = Kernel::Lanczos(3.0);
        assert!((lanczos.weight(0.0, 0.0) - 1.0).abs() < 1e-12);
        assert!([1.0, 2.0, 3.0].iter().all(|x| lanczos.weight(*x, 0.0).abs() < 1e-12));
        assert!(lanczos.weight(1.5, 0.0) < 0.0, "it has negative lobes");
        let harris = Kernel::BlackmanHarris(2.0);
        assert!((harris.weight(0.0, 0.0) - 1.0).abs() < 1e-12);
        assert!(harris.weight(1.9999, 0.0).abs() < 1e-4);
    }

    #[test]
    fn a7t6_wide_kernels_leave_less_noise() {
        let close = |kernel: Kernel, gain: f64| (kernel.noise_gain() / gain - 1.0).abs() < 0.02;
        assert!(close(Kernel::Box(0.5), 1.0) && close(Kernel::Box(1.5), 1.0 / 9.0));
        // ∫w² = πσ² over (∫w)² = (2πσ²)², of which 97.555 % along each axis are within 2.25 σ.
        assert!(close(Kernel::Gaussian(2.0), 1.0 / (16.0 * PI) / 0.97555f64.powi(4)));
        assert!(Kernel::Tent(0.5).noise_gain() > 1.0, "a narrow one wastes samples");
        ALL.iter().for_each(|kernel| assert!((0.01..2.0).contains(&kernel.noise_gain()), "{kernel:?}"));
    }

    #[test]
    fn radii_out_of_range_are_refused() {
        for radius in [0.0, -1.0, f64::NAN, f64::INFINITY, 17.0] {
            assert!(KernelName::Box.with_radius(radius).is_err(), "{radius}");
        }
        assert!(KernelName::Gaussian.with_radius(9.0).is_err());
        assert_eq!(KernelName::Gaussian.with_radius(0.4).ok(), Some(Kernel::Gaussian(0.4)));
    }
}
