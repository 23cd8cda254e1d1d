//! Light offered to eight surfaces side by side.

use super::{AreaShape, Lights};
use crate::eight::{disc, orthonormal_pair};
use a7_sampling::light::EmitterShape;
use common::geometry::Abreast;
use common::math::lanes::{
    LANES, Stored, Vectors, add, dot, each, load_wide, narrow, normalize, normalize_or, scale, store,
    store_wide, subtract, widen,
};
use common::math::{DVec3, Vec3, circle};
use common::shape::sphere::Sphere;
use common::simd::{Select, Simd, SimdBase, SimdFloat, SimdMask, f64x8};
use std::f64::consts::TAU;

/// Eight of [`super::Offer`].
pub struct Offers {
    /// Unit directions towards the lights.
    pub direction: Stored<f64>,
    /// Where the shadow rays end.
    pub end: Stored<f32>,
    /// A bit for each that has no end.
    pub endless: u32,
    /// Radiance over the density of choosing it, per steradian.
    pub light: Stored<f32>,
    /// The density, per steradian; infinite if no path can meet the light.
    pub pdf: [f32; LANES],
    /// A bit for each to whom something is offered.
    pub made: u32,
}

/// Who is offered light: surface points, and the sides that look.
pub struct Receivers<'a> {
    /// Points.
    pub point: &'a Stored<f64>,
    /// Unit normals of the surfaces on those sides.
    pub normal: &'a Stored<f32>,
    /// How many of the eight there are.
    pub count: usize,
}

impl Lights<'_> {
    /// [`Lights::offer`] for points of the unit square, the first coordinates and the second ones.
    #[inline(always)]
    pub fn offers<S: Simd>(&self, simd: S, to: &Receivers, uv: &[[f64; LANES]; 2]) -> Offers {
        if let Some((sphere, radiance)) = self.only_ball() {
            return from_ball(simd, sphere, radiance, to, uv);
        }
        let mut offers = Offers {
            direction: [[0.0; LANES]; 3],
            end: [[0.0; LANES]; 3],
            endless: 0,
            light: [[0.0; LANES]; 3],
            pdf: [0.0; LANES],
            made: 0,
        };
        for lane in 0..to.count {
            let point = DVec3::from_array(to.point.map(|axis| axis[lane]));
            let normal = Vec3::from_array(to.normal.map(|axis| axis[lane]));
            let Some(offer) = self.offer(point, normal, uv.map(|axis| axis[lane])) else { continue };
            for axis in 0..3 {
                offers.direction[axis][lane] = offer.direction[axis];
                offers.end[axis][lane] = offer.end.unwrap_or(Vec3::ZERO)[axis];
                offers.light[axis][lane] = offer.light[axis];
            }
            offers.pdf[lane] = offer.pdf;
            offers.endless |= u32::from(offer.end.is_none()) << lane;
            offers.made |= 1 << lane;
        }
        offers
    }

    /// The only light of the scene and its radiance, if it is a ball.
    #[inline(always)]
    fn only_ball(&self) -> Option<(&Sphere, Vec3)> {
        match &self.areas[..] {
            [area] if self.placed.is_empty() && self.far_count() == 0 => match &area.shape {
                AreaShape::Round(EmitterShape::Sphere(sphere)) => {
                    let material = self.world.plain(self.geometry.material(area.primitive))?;
                    Some((sphere, material.emissive))
                }
                _ => None,
            },
            _ => None,
        }
    }
}

/// The cone that a ball fills, as [`a7_sampling::light::Cone`] samples it, and the points of the
/// ball in these directions.
#[inline(always)]
fn from_ball<S: Simd>(
    simd: S,
    sphere: &Sphere,
    radiance: Vec3,
    to: &Receivers,
    uv: &[[f64; LANES]; 2],
) -> Offers {
    let of = |x: f64| f64x8::splat(simd, x);
    let (from, center) =
        (load_wide(simd, to.point), [of(sphere.center.x), of(sphere.center.y), of(sphere.center.z)]);
    let (zero, one, two, radius) = (of(0.0), of(1.0), of(2.0), of(sphere.radius));
    let to_center = subtract(center, from);
    let distance = dot(to_center, to_center).sqrt();
    let sine = radius / distance;
    let sine_squared = sine * sine;
    let is_outside = distance.simd_gt(radius);
    let height = is_outside.select(sine_squared / (one + (one - sine_squared).sqrt()), two);
    let uv = [f64x8::from_slice(simd, &uv[0]), f64x8::from_slice(simd, &uv[1])];
    let (x, y) = disc(
        uv,
        circle::DOUBLE,
        #[inline(always)]
        |c| f64x8::splat(simd, c),
    );
    let down = height * (x * x + y * y);
    let spread = (height * (two - down)).max(zero).sqrt();
    let axis = normalize_or(simd, each(to_center, |c| c / distance), [zero, zero, one]);
    let [a, b] = orthonormal_pair(axis, one);
    let direction = add(add(scale(a, x * spread), scale(b, y * spread)), scale(axis, one - down));
    let direction = normalize(simd, direction);
    let half_chord = (radius * radius - distance * distance * (down * (two - down))).max(zero).sqrt();
    let along = distance * (one - down);
    let reach = is_outside.select(along - half_chord, along + half_chord);
    let near: Vectors<f64x8<S>> = each(add(from, scale(direction, reach)), |p| widen(simd, narrow(simd, p)));
    let (seen, _) = Abreast::on_balls(simd, center, radius, near);
    let front = dot(seen.normal, direction).simd_lt(zero) & is_outside;
    let pdf = one / (of(TAU) * height);
    let share = narrow(simd, one / pdf);
    Offers {
        direction: store_wide(direction),
        end: store(seen.beside(simd, one)),
        endless: 0,
        light: store([share * radiance.x, share * radiance.y, share * radiance.z]),
        pdf: *narrow(simd, pdf),
        made: front.to_bitmask() as u32,
    }
}
