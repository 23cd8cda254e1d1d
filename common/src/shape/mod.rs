//! Intersection tests, one file per shape.
//!
//! | shape | where | decided by |
//! |---|---|---|
//! | [`triangle`] | corners in world space, `f32` | sign-exact edge functions and a tie rule |
//! | [`triangle_block`], [`faces`], [`filter`] | eight triangles at a time | knows what is surely missed and surely hit, decides nothing else |
//! | [`gathered`] | eight of them from any blocks | puts them side by side for the exact test |
//! | [`unfolded`] | the same for eight rays at a time | knows which lines surely pass outside |
//! | [`sphere`] | centre and radius in world space, `f64` | the distance of closest approach |
//! | [`ellipsoid`] | a sphere under a general affine map | the sphere test in its own space |
//! | [`plane`] | unit normal and offset in world space, `f64` | one division |
//!
//! Every test works in `f64` on the `f32` ray and rounds t once at the end. All are pure
//! functions of ray and shape, so every structure that asks them gets the same bits.

pub mod ellipsoid;
pub mod faces;
pub mod filter;
pub mod gathered;
pub mod plane;
pub mod sphere;
pub mod triangle;
pub mod triangle_block;
pub mod unfolded;

use crate::math::{Bounds, DVec3, dot3};
use crate::ray::Ray;

/// A ray widened to `f64` once, with what every exact test wants to know of it.
#[derive(Clone, Copy, Debug)]
pub struct ExactRay {
    /// Origin.
    pub origin: DVec3,
    /// Direction, not zero.
    pub direction: DVec3,
    /// |direction|².
    pub length_squared: f64,
    /// Largest magnitude of a component of the direction.
    pub reach: f64,
}

impl ExactRay {
    /// Widens a usable ray (see [`Ray::is_usable`]).
    #[inline]
    pub fn new(ray: &Ray) -> Self {
        let direction = ray.direction.as_dvec3();
        Self {
            origin: ray.origin.as_dvec3(),
            direction,
            length_squared: dot3(direction, direction),
            reach: direction.abs().max_element(),
        }
    }

    /// By how much of t two hits of things inside `bounds` must differ for their order to be
    /// certain, beside the rounding of t itself: 2⁻²¹ of the farthest reach. A structure may leave
    /// out what begins that much after the best hit; what comes closer can still win or tie.
    #[inline]
    pub fn margin(&self, bounds: &Bounds) -> f64 {
        let origin = self.origin.as_vec3();
        f64::from(bounds.reach_from(origin)) / self.reach * 2f64.powi(-21)
    }
}
