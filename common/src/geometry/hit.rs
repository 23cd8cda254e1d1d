//! What a ray has hit, and which of two hits counts.

use crate::math::{Interval, Vec3};
use crate::shape::ExactRay;
use crate::shape::triangle::{self, TriangleHit};
use crate::simd::Simd;

/// What traversal carries of a hit: the least from which all else can be worked out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Ray parameter in units of the ray's direction.
    pub t: f32,
    /// Number of the primitive in file order.
    pub primitive: u32,
    /// Barycentric weight of a triangle's second corner; 0 for other primitives.
    pub u: f32,
    /// Barycentric weight of a triangle's third corner; 0 for other primitives.
    pub v: f32,
}

impl Hit {
    /// Whether this hit comes before `other`: smaller t, or the same t and a smaller number.
    #[inline]
    pub fn precedes(&self, other: Option<&Hit>) -> bool {
        other.is_none_or(|o| self.t < o.t || (self.t == o.t && self.primitive < o.primitive))
    }
}

/// Tests one triangle; `primitive` is put into the hit as it is.
pub fn hit_triangle(vertices: &[Vec3; 3], primitive: u32, ray: &ExactRay, interval: Interval) -> Option<Hit> {
    hit_within(triangle::intersect(ray, vertices)?, primitive, interval)
}

/// The same with given instructions.
#[inline(always)]
pub fn hit_triangle_with<S: Simd>(
    simd: S,
    vertices: &[Vec3; 3],
    primitive: u32,
    ray: &ExactRay,
    interval: Interval,
) -> Option<Hit> {
    hit_within(triangle::intersect_with(simd, ray, vertices)?, primitive, interval)
}

/// A hit of the triangle that is called `primitive`, if it counts.
#[inline(always)]
pub fn hit_within(hit: TriangleHit, primitive: u32, interval: Interval) -> Option<Hit> {
    interval.contains(hit.t).then_some(Hit { t: hit.t, primitive, u: hit.u, v: hit.v })
}
