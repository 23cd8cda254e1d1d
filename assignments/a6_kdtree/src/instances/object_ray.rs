//! A ray in the space of a mesh, with room for all that was rounded on the way.
//!
//! Write õ = M⁻¹(o − T) and d̃ = M⁻¹d for the ray taken back exactly, and ô, d̂ for what `f64` and
//! then `f32` make of them. With the bounds of [`super::placement`],
//!
//! > ε ≥ |ô − õ|: (u + 3f)|ô| + 2⁻¹⁴⁹ + 2⁻⁵⁰ ‖I‖ (|o| + |T|), and η ≥ |d̂ − d̃| likewise,
//!
//! in the largest component. Affine maps keep t and which side of an edge a line is on: the ray
//! (o, d) hits a baked triangle where (õ, d̃) hits the same triangle taken back exactly, whose
//! corners are within δ = *corner* of the mesh's. Let κ = δ + ε, M the farthest that the mesh's
//! box reaches from ô, D = |d̂|.
//!
//! **Boxes.** A hit lies within δ of the triangle's box at some |t| ≤ (M + κ)/(D − η). There,
//! ô + t d̂ is off by ε + |t|η. So boxes are widened by *room* = κ + η(M + κ)/(D − η).
//!
//! **Triangles.** The block's filter ([`common::shape::triangle_block`]) looks at weights
//! (c × d)·e, six products each, with c off by κ, d by η, an edge e by 2δ, |e| ≤ E ≤ 2M. With
//! P = κ(D + η) + Mη, telescoping gives
//!
//! | quantity | off by at most | taken |
//! |---|---|---|
//! | two weights | 6P·E + 12δ(P + MD) | 12P·E + 48δ(P + MD) |
//! | (e₁ × e₂)·d | 24P·E + 24δP | |
//! | third weight | 36P·E + 48δP + 24δMD | 48P·E + 48δ(P + MD) |
//!
//! beside the filter's own errors. It is not asked for t: where the line passes a triangle, the
//! exact test in the world says.

use super::placement::{DOUBLE, Placement, UNDERFLOW};
use crate::bvh::packet::Packet;
use common::math::{Bounds, UNIT_ROUNDOFF, Vec3};
use common::ray::Ray;
use common::shape::filter::{Errors, Filter};
use common::simd::Simd;

/// What a mesh's tree is asked with.
pub struct ObjectRay {
    /// For boxes.
    pub packet: Packet<1>,
    /// For triangles; knows nothing of t.
    pub filter: Filter,
}

/// More than what computing the bounds rounds.
const ROUNDED: f64 = 1.001;

impl ObjectRay {
    /// Takes a usable ray into the space of a mesh that lies within `bounds` there. Rays that
    /// leave the range of `f32` on the way may hit everything.
    #[inline(always)]
    pub fn new<S: Simd>(simd: S, placement: &Placement, ray: &Ray, bounds: &Bounds) -> Self {
        let (o, d) = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
        let origin = (placement.inverse * (o - placement.translation)).as_vec3();
        let direction = (placement.inverse * d).as_vec3();
        let relative = UNIT_ROUNDOFF * ROUNDED + 3.0 * placement.residual;
        let double = DOUBLE * placement.stretch;
        let off = f64::from(origin.abs().max_element()) * relative
            + UNDERFLOW
            + double * (o.abs().max_element() + placement.translation.abs().max_element());
        let step = f64::from(direction.abs().max_element());
        let turn = step * relative + UNDERFLOW + double * d.abs().max_element();

        let corner = placement.corner;
        let near = corner + off;
        let far = bounds.reach_from(origin);
        let reach = f64::from(far) * ROUNDED;
        let room = (near + turn * (reach + near) / (step - turn)) * ROUNDED;
        let product = near * (step + turn) + reach * turn;
        let mut errors = Errors::new(far, step as f32);
        errors.weight += (12.0 * product * ROUNDED) as f32;
        errors.floor += (48.0 * corner * (product + reach * step) * ROUNDED) as f32;
        errors.depth = f32::INFINITY;

        let known =
            step > 2.0 * turn && room < f64::from(f32::MAX) && origin.is_finite() && direction.is_finite();
        if !known {
            return Self::blind(simd, bounds, errors);
        }
        let mut packet = Packet::alone(simd, &Ray::new(origin, direction), bounds);
        packet.widen((room * ROUNDED) as f32);
        let filter = Filter { origin: origin.to_array(), direction: direction.to_array(), errors };
        Self { packet, filter }
    }

    /// Of which nothing is known: it may meet every box, and hit every triangle.
    #[cold]
    #[inline(never)]
    fn blind<S: Simd>(simd: S, bounds: &Bounds, errors: Errors) -> Self {
        let nowhere = Ray::new(Vec3::NAN, Vec3::X);
        let filter = Filter {
            origin: nowhere.origin.to_array(),
            direction: nowhere.direction.to_array(),
            errors: Errors { weight: f32::INFINITY, floor: f32::INFINITY, ..errors },
        };
        Self { packet: Packet::alone(simd, &nowhere, bounds), filter }
    }
}
