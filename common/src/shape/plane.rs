//! Ray against plane, without a threshold for "parallel".

use super::ExactRay;
use crate::math::{DVec3, dot3};

/// The points p with p · normal = offset, or the part of them within a disc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Unit normal.
    pub normal: DVec3,
    /// Signed distance from the origin along the normal.
    pub offset: f64,
    /// Centre (on the plane) and radius, if only a disc of it exists.
    pub disc: Option<(DVec3, f64)>,
}

/// The parameter at which the line of the ray crosses the plane; `None` if it does not.
///
/// Only a ray whose direction is exactly perpendicular to the normal is parallel. Any other
/// crosses somewhere, perhaps beyond the range of `f32`, which the caller's interval rejects.
#[inline]
pub fn intersect(ray: &ExactRay, plane: &Plane) -> Option<f64> {
    let approach = dot3(plane.normal, ray.direction);
    let t = (plane.offset - dot3(plane.normal, ray.origin)) / approach;
    if approach == 0.0 || !t.is_finite() {
        return None;
    }
    let Some((center, radius)) = plane.disc else {
        return Some(t);
    };
    let from_center = ray.origin + ray.direction * t - center;
    (from_center.length_squared() <= radius * radius).then_some(t)
}

/// The point of the plane nearest to `p`.
pub fn reproject(plane: &Plane, p: DVec3) -> DVec3 {
    p - plane.normal * (dot3(plane.normal, p) - plane.offset)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec3;
    use crate::ray::Ray;

    const FLOOR: Plane = Plane { normal: DVec3::Y, offset: -2.0, disc: None };

    fn hit(o: Vec3, d: Vec3, plane: &Plane) -> Option<f64> {
        intersect(&ExactRay::new(&Ray::new(o, d)), plane)
    }

    #[test]
    fn down_along_and_almost_along() {
        assert_eq!(hit(Vec3::ZERO, -Vec3::Y, &FLOOR), Some(2.0));
        assert_eq!(hit(Vec3::ZERO, Vec3::X, &FLOOR), None);
        assert_eq!(hit(Vec3::Y * -2.0, Vec3::X, &FLOOR), None, "a ray inside the plane does not cross it");
        assert_eq!(hit(Vec3::ZERO, Vec3::new(1.0, -1e-30, 0.0), &FLOOR).map(|t| t as f32), Some(2e30));
    }

    #[test]
    fn disc_ends_at_its_rim() {
        let disc = Plane { disc: Some((DVec3::new(0.0, -2.0, 0.0), 1.0)), ..FLOOR };
        assert!(hit(Vec3::X, -Vec3::Y, &disc).is_some());
        assert!(hit(Vec3::X * 1.0001, -Vec3::Y, &disc).is_none());
    }
}
