//! Property 6: maps that round nothing change nothing.

use super::reproducer;
use crate::Stress;
use crate::kit::Draw;
use common::math::Vec3;
use common::ray::Ray;
use common::shape::sphere::{self, Sphere};
use common::shape::{ExactRay, plane, triangle};

/// A world and a ray, moved by a map that no rounding sees: a power of two, a permutation of the
/// axes, a change of signs.
struct Lossless {
    factor: f32,
    order: [usize; 3],
    signs: Vec3,
}

impl Lossless {
    fn draw(draw: &mut Draw) -> Self {
        let orders = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
        let mut sign = || if draw.chance(0.5) { -1.0 } else { 1.0 };
        let signs = Vec3::new(sign(), sign(), sign());
        Self { factor: 2f32.powi(draw.below(41) as i32 - 20), order: draw.pick(&orders), signs }
    }

    fn vector(&self, p: Vec3) -> Vec3 {
        Vec3::from_array(self.order.map(|i| p[i])) * self.signs
    }

    fn point(&self, p: Vec3) -> Vec3 {
        self.vector(p) * self.factor
    }
}

/// t of triangle, sphere and plane is the very same number. (Who owns an edge that a ray meets
/// exactly may change with the axes, so rays are not aimed at edges here.)
pub fn lossless(stress: &Stress) {
    stress.run("p06 bit-equal", 601, 300_000, |draw| {
        let map = Lossless::draw(draw);
        let t = [draw.cube(), draw.cube(), draw.cube()].map(|p| p.as_vec3());
        let inside = t[0] * 0.3 + t[1] * 0.3 + t[2] * 0.4;
        let origin = (draw.cube() * 5.0).as_vec3();
        let ray = Ray::new(origin, inside - origin);
        let image = Ray::new(map.point(origin), map.point(ray.direction));
        let (here, there) = (ExactRay::new(&ray), ExactRay::new(&image));
        let hit = triangle::intersect(&here, &t);
        if hit.is_none() || hit != triangle::intersect(&there, &t.map(|v| map.point(v))) {
            return Err(format!("triangle {hit:?}\n{}", reproducer(&ray, &t)));
        }
        let single = |v: f64| v as f32;
        let (center, radius) = (t[0].as_dvec3(), 2.0);
        let factor = f64::from(map.factor);
        let image_sphere = Sphere { center: map.point(t[0]).as_dvec3(), radius: radius * factor };
        let roots = |r: &ExactRay, s: &Sphere| sphere::intersect(r, s).map(|x| x.map(single));
        if roots(&here, &Sphere { center, radius }) != roots(&there, &image_sphere) {
            return Err(format!("sphere\n{}", reproducer(&ray, &t)));
        }
        let normal = t[1].as_dvec3();
        let flat = plane::Plane { normal, offset: 0.7, disc: None };
        let image_normal = map.vector(t[1]).as_dvec3();
        let image_flat = plane::Plane { normal: image_normal, offset: 0.7 * factor, disc: None };
        let crossing = |r: &ExactRay, p: &plane::Plane| plane::intersect(r, p).map(single);
        match crossing(&here, &flat) == crossing(&there, &image_flat) {
            true => Ok(0.0),
            false => Err(format!("plane\n{}", reproducer(&ray, &t))),
        }
    });
}
