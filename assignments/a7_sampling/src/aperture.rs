//! A7T4: points of a lens.

use common::math::circle::{DOUBLE, sine_and_cosine};
use std::f64::consts::{FRAC_PI_4, TAU};

/// The shape of a lens's opening, of radius 1 about its middle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Aperture {
    /// A disc.
    Round,
    /// A regular polygon of this many corners, the first straight up.
    Polygon(u32),
}

impl Aperture {
    /// The opening of so many blades; a disc without any.
    pub fn new(blades: Option<u32>) -> Self {
        blades.map_or(Self::Round, Self::Polygon)
    }

    /// A point of the opening for a point of the unit square: equal areas go to equal areas, and
    /// neighbours to neighbours, so that a good pattern stays one.
    pub fn point(self, uv: [f64; 2]) -> (f64, f64) {
        match self {
            Self::Round => disc(uv),
            Self::Polygon(corners) => polygon(uv, corners),
        }
    }

    /// Its area.
    pub fn area(self) -> f64 {
        match self {
            Self::Round => TAU / 2.0,
            Self::Polygon(n) => f64::from(n) / 2.0 * (TAU / f64::from(n)).sin(),
        }
    }
}

/// Squares about the centre become circles about it (Shirley & Chiu, "A low distortion map
/// between disk and square", 1997).
pub fn disc([u, v]: [f64; 2]) -> (f64, f64) {
    let (x, y) = (2.0 * u - 1.0, 2.0 * v - 1.0);
    let is_wide = x.abs() > y.abs();
    let (radius, aside) = if is_wide { (x, y) } else { (y, x) };
    if radius == 0.0 {
        return (0.0, 0.0);
    }
    let (sine, cosine) = sine_and_cosine(FRAC_PI_4 * (aside / radius), DOUBLE, |c| c);
    if is_wide { (radius * cosine, radius * sine) } else { (radius * sine, radius * cosine) }
}

/// u chooses one of the triangles between the centre and two neighbouring corners, and the place
/// between these; √v the distance from the centre.
fn polygon([u, v]: [f64; 2], corners: u32) -> (f64, f64) {
    let corner = |i: f64| (i * TAU / f64::from(corners)).sin_cos();
    let place = u * f64::from(corners);
    let (first, between, out) = (place.floor(), place.fract(), v.sqrt());
    let (a, b) = (corner(first), corner(first + 1.0));
    (out * (a.0 + (b.0 - a.0) * between), out * (a.1 + (b.1 - a.1) * between))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points of a fine grid: mean, second moments and how many fall where, against the shape's.
    fn moments(aperture: Aperture) -> (f64, f64, f64) {
        const N: i32 = 400;
        let all = (0..N * N).map(|i| {
            let at = |i: i32| (f64::from(i) + 0.5) / f64::from(N);
            aperture.point([at(i % N), at(i / N)])
        });
        let count = f64::from(N * N);
        all.fold((0.0, 0.0, 0.0), |(x, y, r), p| {
            (x + p.0 / count, y + p.1 / count, r + (p.0 * p.0 + p.1 * p.1) / count)
        })
    }

    #[test]
    fn a7t4_openings_are_filled_evenly() {
        let (x, y, r) = moments(Aperture::Round);
        assert!(x.abs() < 1e-9 && y.abs() < 1e-9 && (r - 0.5).abs() < 1e-4, "{x} {y} {r}");
        for n in [3u32, 4, 6, 9] {
            let (x, y, r) = moments(Aperture::Polygon(n));
            // Polar moment over area of a regular polygon of circumradius 1.
            let expected = (2.0 + (TAU / f64::from(n)).cos()) / 6.0;
            assert!(x.abs() < 1e-3 && y.abs() < 1e-3 && (r - expected).abs() < 1e-3, "{n}: {x} {y} {r}");
        }
    }

    /// Not a line, as lenses of hasty programs are: the points reach every side of the opening,
    /// none lies outside, and cells of equal area get equally many.
    #[test]
    fn a7t4_openings_have_the_right_shape() {
        for (aperture, corners) in
            [(Aperture::Round, 3600), (Aperture::Polygon(5), 5), (Aperture::Polygon(6), 6)]
        {
            let step = TAU / f64::from(corners);
            let outside = |x: f64, y: f64| {
                let side = |k: i32| {
                    let (s, c) = ((f64::from(k) + 0.5) * step).sin_cos();
                    x * s + y * c > (step / 2.0).cos() + 1e-6
                };
                (0..corners).any(side)
            };
            let mut cells = [0u32; 64];
            for i in 0..65_536u32 {
                let at = |i: u32| (f64::from(i) + 0.5) / 256.0;
                let (x, y) = aperture.point([at(i % 256), at(i / 256)]);
                assert!(!outside(x, y), "{aperture:?} {x} {y}");
                cells[((x + 1.0) * 4.0) as usize + 8 * ((y + 1.0) * 4.0) as usize] += 1;
            }
            let inner = 65_536.0 / 16.0 / aperture.area();
            for cell in [27, 28, 35, 36] {
                assert!((f64::from(cells[cell]) / inner - 1.0).abs() < 0.05, "{aperture:?} {cells:?}");
            }
        }
    }

    #[test]
    fn a7t4_the_middle_of_the_square_is_the_middle_of_the_disc() {
        assert_eq!(disc([0.5, 0.5]), (0.0, 0.0));
        assert_eq!(Aperture::new(Some(7)), Aperture::Polygon(7));
    }
}
