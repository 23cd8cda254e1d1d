//! Where a ray starts that leaves a surface, as others decide it.

use common::geometry::{Geometry, Hit};
use common::math::Vec3;
use common::ray::Ray;

/// What was hit, in the numbers that single precision holds.
#[derive(Clone, Copy, Debug)]
pub enum Shape {
    /// Centre and radius.
    Ball(Vec3, f32),
    /// Corners.
    Facet([Vec3; 3]),
}

/// A hit that is to be left.
pub struct Landing<'g> {
    /// What our own way works on.
    pub geometry: &'g Geometry,
    /// What was hit.
    pub shape: Shape,
    /// The ray that hit it.
    pub ray: Ray,
    /// Where.
    pub hit: Hit,
    /// Where to go from there: outward.
    pub direction: Vec3,
}

/// Where the next ray starts, and from which t on hits count.
#[derive(Clone, Copy, Debug)]
pub struct Start {
    /// Its origin.
    pub origin: Vec3,
    /// Hits count beyond this t.
    pub min: f32,
}

/// A way to find the start.
pub struct Method {
    /// What it is called in tables.
    pub name: &'static str,
    /// The way.
    pub start: fn(&Landing) -> Start,
}

/// All ways.
pub const METHODS: [Method; 6] = [
    Method { name: "tmin 1e-4", start: |l| Start { origin: l.along_ray(), min: 1e-4 } },
    Method { name: "tmin 1e-3", start: |l| Start { origin: l.along_ray(), min: 1e-3 } },
    Method { name: "tmin 1e-5 of size", start: relative },
    Method { name: "Wächter–Binder", start: by_integers },
    Method { name: "pbrt error bounds", start: by_error_bounds },
    Method { name: "ours", start: ours },
];

impl Landing<'_> {
    /// Origin plus t times direction, as it is mostly written.
    fn along_ray(&self) -> Vec3 {
        self.ray.origin + self.ray.direction * self.hit.t
    }

    /// The unit normal at a point of the surface, on the side that the ray goes to.
    fn normal(&self, p: Vec3) -> Vec3 {
        let n = match self.shape {
            Shape::Ball(center, _) => p - center,
            Shape::Facet([a, b, c]) => (b - a).cross(c - a),
        };
        let n = n.normalize_or_zero();
        if n.dot(self.direction) < 0.0 { -n } else { n }
    }
}

/// A share of the larger of distance and coordinates.
fn relative(l: &Landing) -> Start {
    let origin = l.along_ray();
    Start { origin, min: 1e-5 * origin.abs().max_element().max(l.hit.t) }
}

/// Wächter & Binder, "A Fast and Robust Method for Avoiding Self-Intersection", Ray Tracing Gems,
/// chapter 6: the bits of each coordinate are counted up by 256 times the normal's, and near zero,
/// where those steps get too small, a fixed step is taken. On triangles the point comes from the
/// corners.
fn by_integers(l: &Landing) -> Start {
    const NEAR_ZERO: f32 = 1.0 / 32.0;
    const FIXED: f32 = 1.0 / 65_536.0;
    const COUNTED: f32 = 256.0;
    let p = match l.shape {
        Shape::Ball(..) => l.along_ray(),
        Shape::Facet(corners) => blend(corners, &l.hit).0,
    };
    let n = l.normal(p);
    let moved = |axis: usize| {
        if p[axis].abs() < NEAR_ZERO {
            return p[axis] + FIXED * n[axis];
        }
        let steps = (COUNTED * n[axis]) as i32;
        let away_from_zero = if p[axis] < 0.0 { -steps } else { steps };
        f32::from_bits(p[axis].to_bits().wrapping_add_signed(away_from_zero))
    };
    Start { origin: Vec3::new(moved(0), moved(1), moved(2)), min: 0.0 }
}

/// Corners weighed as the hit says, and the sum of the magnitudes.
fn blend([a, b, c]: [Vec3; 3], hit: &Hit) -> (Vec3, Vec3) {
    let parts = [a * (1.0 - hit.u - hit.v), b * hit.u, c * hit.v];
    (parts[0] + parts[1] + parts[2], parts[0].abs() + parts[1].abs() + parts[2].abs())
}

/// n roundings: γₙ of Higham.
fn gamma(n: f32) -> f32 {
    let unit = f32::EPSILON * 0.5;
    n * unit / (1.0 - n * unit)
}

/// Pharr, Jakob & Humphreys, "Physically Based Rendering", 4th edition, section 6.8: the point
/// comes with bounds of its rounding errors, is moved along the normal until a box of that size
/// has left the surface, and is then rounded away from it.
fn by_error_bounds(l: &Landing) -> Start {
    let (p, error) = match l.shape {
        Shape::Ball(center, radius) => {
            let own = l.along_ray() - center;
            let own = own * (radius / own.length());
            let error = own.abs() * gamma(5.0) * (1.0 + gamma(3.0)) + (own.abs() + center.abs()) * gamma(3.0);
            (center + own, error)
        }
        Shape::Facet(corners) => {
            let (p, magnitude) = blend(corners, &l.hit);
            (p, magnitude * gamma(7.0))
        }
    };
    let n = l.normal(p);
    let offset = n * n.abs().dot(error);
    let moved = |axis: usize| {
        let x = p[axis] + offset[axis];
        match offset[axis] {
            o if o > 0.0 => x.next_up(),
            o if o < 0.0 => x.next_down(),
            _ => x,
        }
    };
    Start { origin: Vec3::new(moved(0), moved(1), moved(2)), min: 0.0 }
}

fn ours(l: &Landing) -> Start {
    let surface = l.geometry.surface(&l.ray, &l.hit);
    Start { origin: surface.leave(l.direction.as_dvec3()), min: 0.0 }
}
