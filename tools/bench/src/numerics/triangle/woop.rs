//! Woop, Benthin & Wald, "Watertight Ray/Triangle Intersection", JCGT 2013.
//!
//! The axis along which the ray runs most becomes depth; shearing the corners makes the ray that
//! axis, and what is left is which side of three edges the origin of the plane lies on. Two
//! triangles evaluate a common edge with the same numbers, so no ray slips between them; an edge
//! value of zero counts as inside for both. In the paper such values are worked out again in
//! double precision; the variant without shows what that is for.

use super::kernel::Kernel;
use common::math::Vec3;
use common::ray::Ray;

/// With or without the second look in double precision.
pub struct Woop<const SECOND_LOOK: bool>;

/// The ray's part of the work: which axes are across and deep, and the shear.
pub struct Sheared {
    axes: [usize; 3],
    shear: [f32; 3],
    origin: Vec3,
}

impl<const SECOND_LOOK: bool> Kernel for Woop<SECOND_LOOK> {
    const NAME: &'static str =
        if SECOND_LOOK { "Woop et al., f32, then f64" } else { "Woop et al., f32 only" };
    type Ray = Sheared;
    type Triangle = [Vec3; 3];

    fn ray(ray: &Ray) -> Sheared {
        let d = ray.direction;
        let size = d.abs();
        let deep = (0..3).fold(0, |best, axis| if size[axis] > size[best] { axis } else { best });
        let (mut x, mut y) = ((deep + 1) % 3, (deep + 2) % 3);
        if d[deep] < 0.0 {
            (x, y) = (y, x);
        }
        Sheared {
            axes: [x, y, deep],
            shear: [d[x] / d[deep], d[y] / d[deep], 1.0 / d[deep]],
            origin: ray.origin,
        }
    }

    fn triangle(corners: &[Vec3; 3]) -> [Vec3; 3] {
        *corners
    }

    #[inline(always)]
    fn hit(ray: &Sheared, corners: &[Vec3; 3]) -> Option<f64> {
        let [x, y, deep] = ray.axes;
        let [a, b, c] = corners.map(|corner| {
            let p = corner - ray.origin;
            [p[x] - ray.shear[0] * p[deep], p[y] - ray.shear[1] * p[deep], ray.shear[2] * p[deep]]
        });
        let mut side = [edge(b, c), edge(c, a), edge(a, b)];
        if SECOND_LOOK && (side[0] == 0.0 || side[1] == 0.0 || side[2] == 0.0) {
            side = [edge_f64(b, c), edge_f64(c, a), edge_f64(a, b)];
        }
        let [u, v, w] = side;
        if (u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0) {
            return None;
        }
        let total = u + v + w;
        let depth = u * a[2] + v * b[2] + w * c[2];
        (total != 0.0).then(|| f64::from(depth / total))
    }
}

/// On which side of the edge from p to q the ray passes.
#[inline(always)]
fn edge(p: [f32; 3], q: [f32; 3]) -> f32 {
    q[0] * p[1] - q[1] * p[0]
}

#[inline(always)]
fn edge_f64(p: [f32; 3], q: [f32; 3]) -> f32 {
    let wide = |a: f32, b: f32| f64::from(a) * f64::from(b);
    (wide(q[0], p[1]) - wide(q[1], p[0])) as f32
}
