//! Ray against a sphere under a general affine map.
//!
//! The ray is taken into the sphere's own space in `f64` with its direction not normalised, so
//! that t means the same in both spaces.

use super::ExactRay;
use super::sphere::{self, Sphere};
use crate::math::{Affine, DVec3, dot3};

/// A sphere and the map that takes it to the space of the ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipsoid {
    /// The sphere in its own space.
    pub sphere: Sphere,
    /// From its own space to that of the ray.
    pub to_world: Affine,
}

impl Ellipsoid {
    fn ray_inside(&self, ray: &ExactRay) -> ExactRay {
        let direction = self.to_world.inverse_vector(ray.direction);
        ExactRay {
            origin: self.to_world.inverse_point(ray.origin),
            direction,
            length_squared: dot3(direction, direction),
            reach: direction.abs().max_element(),
        }
    }

    /// The two parameters at which the line of the ray meets it, in increasing order.
    pub fn intersect(&self, ray: &ExactRay) -> Option<[f64; 2]> {
        sphere::intersect(&self.ray_inside(ray), &self.sphere)
    }

    /// The point of the surface next to `p` (which is close to it) and the outward unit normal
    /// there, both in the space of the ray.
    pub fn surface(&self, p: DVec3) -> (DVec3, DVec3) {
        let inside = sphere::reproject(&self.sphere, self.to_world.inverse_point(p));
        let normal = self.to_world.normal(inside - self.sphere.center).normalize_or_zero();
        (self.to_world.point(inside), normal)
    }

    /// Half the extent of its box along each axis, around [`Ellipsoid::center`]: the length of
    /// each row of the linear part, times the radius.
    pub fn half_extent(&self) -> DVec3 {
        let rows = self.to_world.linear.transpose();
        DVec3::new(rows.x_axis.length(), rows.y_axis.length(), rows.z_axis.length()) * self.sphere.radius
    }

    /// Where its centre lies in the space of the ray.
    pub fn center(&self) -> DVec3 {
        self.to_world.point(self.sphere.center)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{DMat4, Vec3};
    use crate::ray::Ray;

    #[test]
    fn squashed_sphere() {
        let to_world = Affine::from_matrix(&DMat4::from_scale(DVec3::new(1.0, 0.25, 1.0))).unwrap();
        let e = Ellipsoid { sphere: Sphere { center: DVec3::ZERO, radius: 1.0 }, to_world };
        let down = ExactRay::new(&Ray::new(Vec3::Y * 3.0, -Vec3::Y * 0.5));
        assert_eq!(e.intersect(&down), Some([5.5, 6.5]));
        let (p, n) = e.surface(DVec3::new(0.0, 0.2500001, 0.0));
        assert_eq!((p, n), (DVec3::new(0.0, 0.25, 0.0), DVec3::Y));
        assert_eq!(e.half_extent(), DVec3::new(1.0, 0.25, 1.0));
    }
}
