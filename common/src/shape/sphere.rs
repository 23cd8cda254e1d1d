//! Ray against sphere, stable at every distance.
//!
//! The textbook b² − 4ac subtracts numbers of the size of the squared distance. Here the centre
//! is first compared with the closest point of the line, so that only numbers of the size of the
//! radius are subtracted (Hearn & Baker; Haines et al., Ray Tracing Gems, chapter 7).

use super::ExactRay;
use crate::math::{DVec3, dot3};

/// A sphere in the space of the ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Centre.
    pub center: DVec3,
    /// Radius, above zero.
    pub radius: f64,
}

/// The two parameters at which the line of the ray meets the sphere, in increasing order.
/// `None` if it passes outside; a line that only touches gives two equal parameters.
#[inline]
pub fn intersect(ray: &ExactRay, sphere: &Sphere) -> Option<[f64; 2]> {
    let to_origin = ray.origin - sphere.center;
    let closest = -dot3(to_origin, ray.direction) / ray.length_squared;
    let offset = to_origin + ray.direction * closest;
    let distance_squared = dot3(offset, offset);
    let radius_squared = sphere.radius * sphere.radius;
    // Written so that NaN misses.
    let passes_inside = distance_squared <= radius_squared;
    if !passes_inside {
        return None;
    }
    let distance = distance_squared.sqrt();
    let half_chord_squared = (sphere.radius - distance).max(0.0) * (sphere.radius + distance);
    let half_chord = (half_chord_squared / ray.length_squared).sqrt();
    Some([closest - half_chord, closest + half_chord])
}

/// The point of the sphere nearest to `p`, which is close to it: takes the error of `p` along
/// the normal back to that of one rounding.
pub fn reproject(sphere: &Sphere, p: DVec3) -> DVec3 {
    sphere.center + (p - sphere.center).normalize_or(DVec3::Z) * sphere.radius
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec3;
    use crate::ray::Ray;

    fn roots(o: Vec3, d: Vec3, center: DVec3, radius: f64) -> Option<[f64; 2]> {
        intersect(&ExactRay::new(&Ray::new(o, d)), &Sphere { center, radius })
    }

    #[test]
    fn axis_ray_and_far_ray() {
        assert_eq!(roots(Vec3::Z * 5.0, -Vec3::Z, DVec3::ZERO, 1.0), Some([4.0, 6.0]));
        assert_eq!(roots(Vec3::Z * 1e9, -Vec3::Z, DVec3::ZERO, 1.0), Some([1e9 - 1.0, 1e9 + 1.0]));
        assert_eq!(roots(Vec3::new(2.0, 0.0, 5.0), -Vec3::Z, DVec3::ZERO, 1.0), None);
    }

    #[test]
    fn inside_has_one_root_behind_and_touching_has_two_equal() {
        let [near, far] = roots(Vec3::ZERO, Vec3::X * 2.0, DVec3::X, 2.0).unwrap();
        assert_eq!([near, far], [-0.5, 1.5]);
        let [near, far] = roots(Vec3::new(1.0, 0.0, 5.0), -Vec3::Z, DVec3::ZERO, 1.0).unwrap();
        assert_eq!(near, far);
    }
}
