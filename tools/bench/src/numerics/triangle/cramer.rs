//! The plane first, then its point: what one writes before reading a paper.
//!
//! The ray is met with the plane; the point's weights follow from Cramer's rule for the two
//! edges' scalar products, and all three must be above zero.

use super::kernel::Kernel;
use crate::numerics::real::{Triple, along, cross, dot, minus, triple};
use common::math::Vec3;
use common::ray::Ray;

/// In single precision.
pub struct Cramer;

/// A corner, the two edges there, and their normal.
pub struct Flat {
    corner: Triple<f32>,
    edges: [Triple<f32>; 2],
    normal: Triple<f32>,
}

impl Kernel for Cramer {
    const NAME: &'static str = "plane + strict Cramer, f32";
    type Ray = [Triple<f32>; 2];
    type Triangle = Flat;

    fn ray(ray: &Ray) -> Self::Ray {
        [triple(ray.origin), triple(ray.direction)]
    }

    fn triangle(corners: &[Vec3; 3]) -> Flat {
        let [a, b, c] = corners.map(triple::<f32>);
        let edges = [minus(b, a), minus(c, a)];
        Flat { corner: a, edges, normal: cross(edges[0], edges[1]) }
    }

    #[inline(always)]
    fn hit([origin, direction]: &Self::Ray, flat: &Flat) -> Option<f64> {
        let approach = dot(flat.normal, *direction);
        if approach == 0.0 {
            return None;
        }
        let t = dot(flat.normal, minus(flat.corner, *origin)) / approach;
        let p = minus(along(*origin, *direction, t), flat.corner);
        let [e, f] = flat.edges;
        let (ee, ef, ff, pe, pf) = (dot(e, e), dot(e, f), dot(f, f), dot(p, e), dot(p, f));
        let total = ee * ff - ef * ef;
        let (u, v) = ((ff * pe - ef * pf) / total, (ee * pf - ef * pe) / total);
        (u > 0.0 && v > 0.0 && u + v < 1.0).then_some(f64::from(t))
    }
}
