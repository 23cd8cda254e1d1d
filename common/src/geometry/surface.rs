//! The point that a ray found: worked out once, for the hit that counts.

use super::{Facet, Geometry, Hit, RunKind, SolidShape, facing};
use crate::math::{DVec3, UNIT_ROUNDOFF, Vec3, sum3};
use crate::ray::Ray;
use crate::shape::{plane, sphere};

/// A point of a surface with what shading and secondary rays need.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// The point, in world space, on the true surface but for `error`.
    pub point: DVec3,
    /// How far the true surface may be from `point` rounded to `f32`, along each axis.
    pub error: DVec3,
    /// Unit normal on the side that the shape calls outside (front of a triangle), to shade
    /// with. That of a smooth mesh is interpolated, and faces whoever the surface itself faces.
    pub normal: Vec3,
    /// The normal of the surface itself in `f64`, for deciding sides.
    pub geometric_normal: DVec3,
    /// Index into the scene's materials.
    pub material: u32,
    /// Number of the primitive in file order.
    pub primitive: u32,
    /// Barycentric weights of a triangle's second and third corner; 0 for other primitives.
    pub weights: [f32; 2],
}

impl Surface {
    /// Whether it is shaded with another normal than its own.
    #[inline]
    pub fn is_smooth(&self) -> bool {
        self.normal != self.geometric_normal.as_vec3()
    }

    /// The unit normal to shade with in `f64`: to the last bit the geometric one, unless the
    /// surface is smooth.
    #[inline]
    pub fn shading_normal(&self) -> DVec3 {
        if self.is_smooth() { self.normal.as_dvec3().normalize() } else { self.geometric_normal }
    }

    /// Where a ray that leaves along `direction` starts: beside the surface, on the side that
    /// the direction points to, as near as `f32` can tell apart.
    ///
    /// The distance comes from the error bound of this point (Ray Tracing Gems, chapter 6;
    /// Pharr et al., PBR 4th ed., 6.8), there is no fixed epsilon: the start lies strictly on
    /// its side of the surface, so a plane or a convex shape cannot hit itself.
    #[inline]
    pub fn leave(&self, direction: DVec3) -> Vec3 {
        self.departure().towards(direction)
    }

    /// How far beside the surface rays start.
    #[inline]
    pub fn away(&self) -> f64 {
        let n = self.geometric_normal;
        // Twice the bound: once for the surface, once for the rounding of the start itself.
        2.0 * sum3(n.x.abs() * self.error.x, n.y.abs() * self.error.y, n.z.abs() * self.error.z)
    }

    /// Where rays start that leave this point, for whoever sends several.
    pub fn departure(&self) -> Departure {
        let (n, away) = (self.geometric_normal, self.away());
        let beside = |side: DVec3| (self.point + side * away).as_vec3();
        Departure { normal: n, front: beside(n), back: beside(-n) }
    }
}

/// The two places beside a surface point where rays start; see [`Surface::leave`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Departure {
    normal: DVec3,
    front: Vec3,
    back: Vec3,
}

impl Departure {
    /// The one on the side that a direction points to.
    #[inline]
    pub fn towards(&self, direction: DVec3) -> Vec3 {
        if self.normal.dot(direction) < 0.0 { self.back } else { self.front }
    }
}

/// Bound of |p₃₂ − p| per axis: one rounding to `f32`, the `f64` arithmetic on coordinates of
/// size `scale` before it, and the smallest subnormal for points at the origin.
fn error_bound(p: DVec3, scale: f64) -> DVec3 {
    p.abs() * SINGLE + DVec3::splat(scale * DOUBLE + SUBNORMAL)
}

/// One rounding to `f32`, relative.
pub(super) const SINGLE: f64 = UNIT_ROUNDOFF * 1.0000001;

/// The `f64` arithmetic, relative.
pub(super) const DOUBLE: f64 = 1.0 / (1u64 << 48) as f64;

/// The smallest subnormal, 2⁻¹⁴⁹.
pub(super) const SUBNORMAL: f64 = f32::from_bits(1) as f64;

impl Geometry {
    /// The surface point of a hit that `ray` made.
    pub fn surface(&self, ray: &Ray, hit: &Hit) -> Surface {
        let (run, index) = self.locate(hit.primitive);
        let (point, normal, scale) = match run.kind {
            RunKind::Triangle => self.triangle_point(index, hit),
            RunKind::Solid => self.solid_point(index, ray.at(f64::from(hit.t))),
            RunKind::Sheet => {
                let plane = &self.sheets[index].plane;
                let point = plane::reproject(plane, ray.at(f64::from(hit.t)));
                (point, plane.normal, point.abs().max_element() + plane.offset.abs())
            }
        };
        let weights = [hit.u, hit.v];
        let shading = match &run.smooth {
            None => normal,
            Some(smooth) => {
                let sight = ray.direction.as_dvec3().normalize();
                let interpolated = smooth.normal((hit.primitive - run.first) as usize, weights, normal);
                facing(interpolated, sight, sight.dot(normal) > 0.0)
            }
        };
        Surface {
            point,
            error: error_bound(point, scale),
            normal: shading.as_vec3(),
            geometric_normal: normal,
            material: run.material,
            primitive: hit.primitive,
            weights,
        }
    }

    #[inline(always)]
    fn triangle_point(&self, index: usize, hit: &Hit) -> (DVec3, DVec3, f64) {
        let corners = &self.triangles[index];
        let facet = match self.facets.get(index) {
            Some(facet) => *facet,
            None => Facet::new(corners),
        };
        (facet.point(corners, [f64::from(hit.u), f64::from(hit.v)]), facet.normal, facet.scale)
    }

    fn solid_point(&self, index: usize, near: DVec3) -> (DVec3, DVec3, f64) {
        match &self.solids[index].shape {
            SolidShape::Sphere(s) => {
                let point = sphere::reproject(s, near);
                let normal = (point - s.center).normalize_or_zero();
                (point, normal, s.center.abs().max_element() + s.radius)
            }
            SolidShape::Ellipsoid(e) => {
                let (point, normal) = e.surface(near);
                let reach = e.half_extent().max_element() + e.center().abs().max_element();
                (point, normal, reach)
            }
        }
    }
}
