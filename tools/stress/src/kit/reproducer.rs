//! One ray, one triangle as text that brings back the very bits.

use common::math::Vec3;
use common::ray::Ray;

fn bits(v: Vec3) -> String {
    format!("[{:#010x}, {:#010x}, {:#010x}]", v.x.to_bits(), v.y.to_bits(), v.z.to_bits())
}

/// A ray in decimal and in bits.
pub fn ray_bits(ray: &Ray) -> String {
    let (o, d) = (ray.origin, ray.direction);
    format!("origin {o:?} = {}\ndirection {d:?} = {}", bits(o), bits(d))
}

/// A triangle in bits.
pub fn triangle_bits(vertices: &[Vec3; 3]) -> String {
    format!("triangle {} {} {}", bits(vertices[0]), bits(vertices[1]), bits(vertices[2]))
}
