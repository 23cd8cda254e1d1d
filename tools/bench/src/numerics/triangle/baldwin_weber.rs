//! Baldwin & Weber, "Fast Ray-Triangle Intersections by Coordinate Transformation", JCGT 2016.
//!
//! Of every triangle the map is kept that takes it to the corners (0, 0), (1, 0), (0, 1) of the
//! plane z = 0. The map may squeeze space along any direction that is not in the plane; taking
//! the axis nearest to the normal leaves nine numbers to keep, of which the code here keeps the
//! trivial ones too: three rows of four.

use super::kernel::Kernel;
use common::math::{DMat3, DVec3, Vec3};
use common::ray::Ray;

/// In single precision; the map is worked out in double precision beforehand.
pub struct BaldwinWeber;

/// A row of the map: what to multiply a point with, and what to add.
type Line = (Vec3, f32);

impl Kernel for BaldwinWeber {
    const NAME: &'static str = "Baldwin–Weber, f32";
    type Ray = Ray;
    type Triangle = [Line; 3];

    fn ray(ray: &Ray) -> Ray {
        *ray
    }

    fn triangle(corners: &[Vec3; 3]) -> [Line; 3] {
        let [a, b, c] = corners.map(|p| p.as_dvec3());
        let normal = (b - a).cross(c - a);
        let axis =
            DVec3::AXES.into_iter().max_by(|p, q| normal.dot(*p).abs().total_cmp(&normal.dot(*q).abs()));
        let to_unit = DMat3::from_cols(b - a, c - a, axis.unwrap_or(DVec3::Z)).inverse().transpose();
        [to_unit.x_axis, to_unit.y_axis, to_unit.z_axis].map(|row| (row.as_vec3(), -row.dot(a) as f32))
    }

    #[inline(always)]
    fn hit(ray: &Ray, [first, second, height]: &[Line; 3]) -> Option<f64> {
        let t = -(height.0.dot(ray.origin) + height.1) / height.0.dot(ray.direction);
        let p = ray.origin + ray.direction * t;
        let u = first.0.dot(p) + first.1;
        let v = second.0.dot(p) + second.1;
        (u >= 0.0 && v >= 0.0 && u + v <= 1.0).then_some(f64::from(t))
    }
}
