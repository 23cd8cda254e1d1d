//! Lines and triangles side by side: the filter's arithmetic.
//!
//! One ray may be held against several triangles ([`super::triangle_block`]), or several rays against one
//! ([`super::unfolded`]): what there is one of stands in all lanes. Vectors may be of any width. Written without
//! closures: one that is not inlined would lose the instructions that `simd` stands for.

use super::filter::Filter;
use crate::math::lanes::Vectors;
use crate::simd::{Floats, Select, Simd};

/// Triangles, and what does not depend on the ray.
#[derive(Clone, Copy)]
pub struct Faces<V> {
    pub(super) corner: Vectors<V>,
    /// The first is turned round, so that no sign need be turned below.
    pub(super) edges: [Vectors<V>; 2],
    pub(super) normal: Vectors<V>,
    /// Largest magnitude of a component of an edge.
    pub(super) size: V,
}

/// Rays, prepared for triangles.
pub struct Rays<V> {
    origin: Vectors<V>,
    direction: Vectors<V>,
    /// As in [`Errors`](super::filter::Errors).
    weight: V,
    along: V,
    depth: V,
    floor: V,
    /// Where hits begin to count.
    min: V,
}

impl<V> Rays<V> {
    /// Of these origins and directions, whose hits count from `min` on; `errors` are those of
    /// [`Errors::abreast`](super::filter::Errors::abreast).
    #[inline(always)]
    pub fn new<S: Simd>(
        simd: S,
        [origin, direction]: [Vectors<V>; 2],
        [reach, weight, along, depth, floor]: [V; 5],
        min: f32,
    ) -> Self
    where
        V: Floats<S>,
    {
        // No triangle is before that, and the product with it cannot overflow.
        let min = V::splat(simd, min).max(-reach);
        Self { origin, direction, weight, along, depth, floor, min }
    }

    /// The same ray in all lanes, whose hits count from `min` on, which is within its reach.
    #[inline(always)]
    pub(super) fn everywhere<S: Simd>(simd: S, filter: &Filter, min: f32) -> Self
    where
        V: Floats<S>,
    {
        Self {
            origin: splat(simd, filter.origin),
            direction: splat(simd, filter.direction),
            weight: V::splat(simd, filter.errors.weight),
            along: V::splat(simd, filter.errors.along),
            depth: V::splat(simd, filter.errors.depth),
            floor: V::splat(simd, filter.errors.floor),
            min: V::splat(simd, min),
        }
    }
}

/// How lines pass triangles.
pub(super) struct Passages<V> {
    /// From the origins to the first corners.
    from: Vectors<V>,
    /// n·d.
    along: V,
    /// Least and greatest weight.
    low: V,
    high: V,
    /// How wrong they may be.
    error: V,
}

impl<V> Passages<V> {
    /// Which lines surely pass outside: the weights are of certain and mixed signs.
    #[inline(always)]
    pub(super) fn outside<S: Simd>(&self) -> V::Mask
    where
        V: Floats<S>,
    {
        self.high.min(-self.low).simd_gt(self.error)
    }

    /// Which surely pass inside: all weights are of one sign.
    #[inline(always)]
    pub(super) fn inside<S: Simd>(&self) -> V::Mask
    where
        V: Floats<S>,
    {
        self.low.max(-self.high).simd_gt(self.error)
    }
}

/// Where lines meet the planes of triangles: t is `height` over `size`, both made positive by turning planes round.
pub(super) struct Depths<V> {
    size: V,
    height: V,
    /// How wrong they may be.
    size_error: V,
    height_error: V,
    /// Height above where hits begin to count.
    after_start: V,
}

impl<V> Depths<V> {
    /// Where it is sure that the plane is met at all.
    #[inline(always)]
    pub(super) fn sure<S: Simd>(&self) -> V::Mask
    where
        V: Floats<S>,
    {
        self.size.simd_gt(self.size_error)
    }

    /// Where that would be before hits count.
    #[inline(always)]
    pub(super) fn before_start<S: Simd>(&self) -> V::Mask
    where
        V: Floats<S>,
    {
        self.after_start.simd_lt(-self.height_error)
    }

    /// Where it would be later than `last`, and where it is surely between.
    #[inline(always)]
    pub(super) fn after_and_between<S: Simd>(&self, last: V) -> (V::Mask, V::Mask)
    where
        V: Floats<S>,
    {
        let before_end = self.size * last - self.height;
        let after = before_end.simd_lt(-self.height_error);
        (after, self.after_start.simd_gt(self.height_error) & before_end.simd_gt(self.height_error))
    }

    /// Where the plane is met at the earliest, if that is sure.
    #[inline(always)]
    pub(super) fn earliest<S: Simd>(&self) -> V
    where
        V: Floats<S>,
    {
        (self.height - self.height_error) / (self.size + self.size_error)
    }

    /// Where it is met at the latest.
    #[inline(always)]
    pub(super) fn latest<S: Simd>(&self) -> V
    where
        V: Floats<S>,
    {
        (self.height + self.height_error) / (self.size - self.size_error)
    }
}

impl<V> Faces<V> {
    /// Of three corners each.
    #[inline(always)]
    pub(super) fn new<S: Simd>([a, b, c]: [Vectors<V>; 3]) -> Self
    where
        V: Floats<S>,
    {
        let (e1, e2) = (minus(a, b), minus(c, a));
        Self { corner: a, edges: [e1, e2], normal: cross(e2, e1), size: size(e1).max(size(e2)) }
    }

    /// How the lines of rays pass them.
    #[inline(always)]
    pub(super) fn pass<S: Simd>(&self, simd: S, rays: &Rays<V>) -> Passages<V>
    where
        V: Floats<S>,
    {
        let from = minus(self.corner, rays.origin);
        let along = dot(self.normal, rays.direction);
        // Two weights of where the line meets the plane, times n·d.
        let r = cross(from, rays.direction);
        let (low, high) = extremes(simd, [dot(r, self.edges[1]), dot(r, self.edges[0])], along);
        Passages { from, along, low, high, error: self.size.mul_add(rays.weight, rays.floor) }
    }

    /// Where they meet the planes.
    #[inline(always)]
    pub(super) fn depths<S: Simd>(&self, simd: S, rays: &Rays<V>, passages: &Passages<V>) -> Depths<V>
    where
        V: Floats<S>,
    {
        let (size, height) = (passages.along.abs(), dot(self.normal, passages.from));
        let height = passages.along.simd_lt(V::splat(simd, 0.0)).select(-height, height);
        let area = self.size * self.size;
        Depths {
            size,
            height,
            size_error: area.mul_add(rays.along, rays.floor),
            height_error: area.mul_add(rays.depth, rays.floor),
            after_start: height - size * rays.min,
        }
    }
}

/// The least and the greatest of all three weights, of which two are known and the sum is `along`; of
/// the third a quarter, because it may be wrong by four times as much.
#[inline(always)]
fn extremes<S: Simd, V: Floats<S>>(simd: S, [v1, v2]: [V; 2], along: V) -> (V, V) {
    let v0 = (along - (v1 + v2)) * V::splat(simd, 0.25);
    (v1.min(v2).min(v0), v1.max(v2).max(v0))
}

#[inline(always)]
pub(super) fn splat<S: Simd, V: Floats<S>>(simd: S, v: [f32; 3]) -> Vectors<V> {
    [V::splat(simd, v[0]), V::splat(simd, v[1]), V::splat(simd, v[2])]
}

#[inline(always)]
fn minus<S: Simd, V: Floats<S>>(a: Vectors<V>, b: Vectors<V>) -> Vectors<V> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
fn cross<S: Simd, V: Floats<S>>(a: Vectors<V>, b: Vectors<V>) -> Vectors<V> {
    [a[1].mul_sub(b[2], a[2] * b[1]), a[2].mul_sub(b[0], a[0] * b[2]), a[0].mul_sub(b[1], a[1] * b[0])]
}

#[inline(always)]
pub(super) fn dot<S: Simd, V: Floats<S>>(a: Vectors<V>, b: Vectors<V>) -> V {
    a[0].mul_add(b[0], a[1].mul_add(b[1], a[2] * b[2]))
}

/// Largest magnitude of a component.
#[inline(always)]
fn size<S: Simd, V: Floats<S>>(a: Vectors<V>) -> V {
    a[0].abs().max(a[1].abs()).max(a[2].abs())
}
