//! Taking one of the ways that light can go.

use super::Bsdf;
use a4_whitted::{mirror, refract};
use common::math::Vec3;
use common::math::circle::{SINGLE, sine_and_cosine};
use std::f32::consts::FRAC_PI_4;

/// Where a path goes on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scattered {
    /// Unit direction, away from the surface.
    pub direction: Vec3,
    /// BSDF times cosine over density: what is left of light that comes from there.
    pub weight: Vec3,
    /// Density of the direction per steradian; infinite for mirrors and glass.
    pub pdf: f32,
}

impl Bsdf {
    /// A direction for a point of the unit square. `out` is where the path comes from, `normal`
    /// is on that side, both unit; `inside` says whether that side is the inside of the body.
    /// `None` where the chosen lobe sends nothing.
    #[inline]
    pub fn sample(&self, out: Vec3, normal: Vec3, inside: bool, [u, v]: [f32; 2]) -> Option<Scattered> {
        let [diffuse, glossy, mirrored, glass] = self.chances;
        // The chances sum to 1 but for rounding, so the last lobe takes what is left.
        if u < diffuse {
            return self.matt(out, normal, [within(u, 0.0, diffuse), v]);
        }
        if u < diffuse + glossy {
            let half = self.glossy.half_vector([within(u, diffuse, glossy), v], normal);
            let into = half * (2.0 * out.dot(half)) - out;
            return self.chosen(out, into, normal);
        }
        let specular = |direction: Vec3, weight| Scattered { direction, weight, pdf: f32::INFINITY };
        let mirror_of = |out: Vec3| mirror(-out.as_dvec3(), normal.as_dvec3()).as_vec3();
        if mirrored > 0.0 && (u < diffuse + glossy + mirrored || glass == 0.0) {
            return Some(specular(mirror_of(out), self.mirror / mirrored));
        }
        if glass == 0.0 {
            return None;
        }
        let below = diffuse + glossy + mirrored;
        let outward = if inside { -normal } else { normal };
        let crossing = refract(-out.as_dvec3(), outward.as_dvec3(), f64::from(self.index_of_refraction));
        // Which way is chosen by its share, so the shares cancel.
        let direction = match crossing.refracted {
            Some(direction) if f64::from(within(u, below, glass)) >= crossing.reflectance => {
                direction.as_vec3()
            }
            _ => mirror_of(out),
        };
        Some(specular(direction, self.glass / glass))
    }

    /// By the matt lobe: in proportion to the cosine.
    #[inline]
    fn matt(&self, out: Vec3, normal: Vec3, uv: [f32; 2]) -> Option<Scattered> {
        let (x, y) = disc(uv);
        let z = (1.0 - x * x - y * y).max(0.0).sqrt();
        let (a, b) = normal.any_orthonormal_pair();
        let into = (a * x + b * y + normal * z).normalize();
        if self.chances[0] == 1.0 {
            let pdf = z * std::f32::consts::FRAC_1_PI;
            return (z > 0.0).then_some(Scattered { direction: into, weight: self.diffuse, pdf });
        }
        self.chosen(out, into, normal)
    }

    /// A direction that either of the two broad lobes may have chosen.
    #[inline]
    fn chosen(&self, out: Vec3, into: Vec3, normal: Vec3) -> Option<Scattered> {
        let value = self.value(out, into, normal);
        let weight = value.response / value.pdf;
        (value.pdf > 0.0).then_some(Scattered { direction: into, weight, pdf: value.pdf })
    }
}

/// Where `u` lies between `from` and `from + length`, as a number in [0, 1).
#[inline]
pub(crate) fn within(u: f32, from: f32, length: f32) -> f32 {
    ((u - from) / length).clamp(0.0, 1.0 - f32::EPSILON)
}

/// Squares about the centre become circles about it, as for lenses ([`a7_sampling::aperture`]), but
/// in single precision: every surface asks, and in double precision pictures took 6 % longer.
#[inline]
fn disc([u, v]: [f32; 2]) -> (f32, f32) {
    let (x, y) = (2.0 * u - 1.0, 2.0 * v - 1.0);
    let is_wide = x.abs() > y.abs();
    let (radius, aside) = if is_wide { (x, y) } else { (y, x) };
    if radius == 0.0 {
        return (0.0, 0.0);
    }
    let (sine, cosine) = sine_and_cosine(FRAC_PI_4 * (aside / radius), SINGLE, |c| c as f32);
    if is_wide { (radius * cosine, radius * sine) } else { (radius * sine, radius * cosine) }
}
