//! accuracy.md, properties 3 and 6: yes and no are those of exact arithmetic, values are within
//! a few roundings, and turning or scaling the world changes no bit.

mod filter;
mod lossless;
mod triangles;

pub use filter::filter;
pub use lossless::lossless;
pub use triangles::{any_bits, decisions, values};

use crate::kit::{Draw, ray_bits, triangle_bits};
use common::math::{DVec3, Vec3};
use common::ray::Ray;

/// 2⁻²³.
const EPS: f64 = 1.0 / (1u64 << 23) as f64;

/// Turns the axes round by `turn` steps, so that no axis is special.
fn turned(p: DVec3, turn: usize) -> DVec3 {
    let a = p.to_array();
    DVec3::from_array([a[turn % 3], a[(turn + 1) % 3], a[(turn + 2) % 3]])
}

/// A triangle of every kind: plain, thin to 10⁻¹², small and far, on a lattice, without area.
pub(crate) fn any_triangle(draw: &mut Draw) -> [Vec3; 3] {
    let kind = draw.below(6);
    let (a, b, c) = (draw.cube(), draw.cube(), draw.cube());
    let turn = draw.below(3);
    let place = |p: [DVec3; 3]| p.map(|q| turned(q, turn).as_vec3());
    match kind {
        0 => place([a, b, c]),
        1 => {
            // Thin along an axis, where f32 can hold any aspect.
            let thin = draw.magnitude(-12.0, -1.0);
            place([a, b, c].map(|p| DVec3::new(p.x, p.y * thin, p.z * thin)))
        }
        2 => {
            // Thin in any direction: the third corner almost on the line of the others.
            let off = draw.direction() * draw.magnitude(-12.0, -1.0);
            place([a, b, a + (b - a) * draw.between(-0.5, 1.5) + off])
        }
        3 => {
            let (size, away) = (draw.magnitude(-6.0, 0.0), draw.direction() * draw.magnitude(0.0, 5.0));
            place([a, b, c].map(|p| p * size + away))
        }
        4 => place([a, b, c].map(|p| (p * 4.0).round())),
        _ => place([a, b, a + (b - a) * draw.dyadic_share()]),
    }
}

/// A ray at a corner, an edge, the middle or beside; its target is hit exactly on lattices.
pub(crate) fn any_ray(draw: &mut Draw, t: &[Vec3; 3]) -> Ray {
    let [a, b, c] = t.map(|v| v.as_dvec3());
    let (s, r) = (draw.dyadic_share(), draw.dyadic_share());
    let target = match draw.below(5) {
        0 => a,
        1 => a + (b - a) * s,
        2 => b + (c - b) * s,
        3 => a + ((b + (c - b) * s) - a) * r,
        _ => a + (b - a) * draw.between(-0.2, 1.2) + (c - a) * draw.between(-0.2, 1.2),
    };
    let distance = draw.magnitude(-1.0, 2.0) * (b - a).length().max(1e-3);
    let away = if draw.chance(0.3) { draw.cube() * 8.0 } else { draw.direction() * distance };
    let origin = if draw.chance(0.3) { (target + away).round() } else { target + away }.as_vec3();
    let way = (target - origin.as_dvec3()).as_vec3();
    Ray::new(origin, if way == Vec3::ZERO { Vec3::Z } else { way })
}

pub(crate) fn reproducer(ray: &Ray, t: &[Vec3; 3]) -> String {
    format!("{}\n{}", ray_bits(ray), triangle_bits(t))
}
