//! Convex bodies of every size and place, and landings on them.

use super::method::{Landing, Shape, Start};
use crate::numerics::draw::Draw;
use crate::world::{plain, scene_with};
use common::accel::{Accel, List};
use common::cli::AppError;
use common::counters::Counters;
use common::geometry::Geometry;
use common::math::{DVec3, Interval, Vec3};
use common::mesh::Mesh;
use common::ray::Ray;
use common::shape::plane::Plane;
use common::shape::sphere::{self, Sphere};
use common::shape::{ExactRay, plane};
use modeller::generated::sphere as ball_mesh;
use std::sync::Arc;

/// Kinds of body.
pub const KINDS: [&str; 3] = ["sphere", "triangle", "mesh"];
/// Their sizes.
pub const SIZES: [f64; 4] = [1e-3, 1.0, 1e3, 1e6];
/// How far from the origin, at most: in units of the size, which `f32` must be able to tell, and
/// in all.
const FARTHEST: (f64, f64) = (1e4, 1e6);
/// accuracy.md, property 7: what is this much of S beside a surface must not be lost.
pub const GAP: f64 = 64.0 * f32::EPSILON as f64;

/// A convex body alone in its scene.
pub struct Body {
    /// The scene.
    pub geometry: Geometry,
    ball: Option<(Vec3, f32)>,
    center: DVec3,
    size: f64,
    /// Its largest coordinate.
    reach: f64,
}

impl Body {
    /// One of [`KINDS`] of a size, somewhere.
    ///
    /// # Errors
    /// Never: all of them can be placed.
    pub fn new(kind: usize, size: f64, draw: &mut Draw) -> Result<Self, AppError> {
        let far = (size * FARTHEST.0).min(FARTHEST.1);
        let away = [0.0, size.min(far), far][draw.below(3)];
        let center = (draw.direction() * away).as_vec3();
        let ball = (kind == 0).then_some((center, size as f32));
        let (shape, mesh) = match ball {
            Some((c, radius)) => {
                (format!("Sphere {{ center {} {} {} radius {radius} }}", c.x, c.y, c.z), Mesh::default())
            }
            None => {
                let mesh = if kind == 1 { triangle(draw) } else { convex() };
                let place = |p: &Vec3| (center.as_dvec3() + p.as_dvec3() * size).as_vec3();
                let positions = mesh.positions.iter().map(place).collect();
                ("TriangleMesh { obj_file it }".to_owned(), Mesh { positions, ..mesh })
            }
        };
        let text = format!(
            "PerspectiveCamera {{ center 0 0 5 direction 0 0 -1 up 0 1 0 angle 40 }}
             Materials {{ numMaterials 1 Material {{ }} }}
             Group {{ numObjects 1 MaterialIndex 0 {shape} }}"
        );
        let geometry = Geometry::build(&scene_with(&text, &Arc::new(mesh))?)?;
        let reach = f64::from(center.abs().max_element()) + size;
        Ok(Self { geometry, ball, center: center.as_dvec3(), size, reach })
    }

    /// Where a ray from somewhere lands, and a way on from there that leads outward; `None` if it
    /// lands nowhere.
    pub fn land(&self, draw: &mut Draw) -> Option<Landing<'_>> {
        let origin = (self.center + draw.direction() * self.size * draw.between(1.5, 6.0)).as_vec3();
        let target = self.center + draw.cube() * self.size * 0.8;
        let direction = (target - origin.as_dvec3()).normalize_or_zero().as_vec3();
        let ray = Ray::new(origin, direction);
        let hit = List::new(&self.geometry).nearest(&ray, Interval::FORWARD, &mut Counters::default())?;
        let shape = match self.ball {
            Some((center, radius)) => Shape::Ball(center, radius),
            None => Shape::Facet(self.geometry.triangles()[hit.primitive as usize]),
        };
        let normal = self.geometry.surface(&ray, &hit).geometric_normal;
        // Meshes have an inside; both sides of a triangle are its outside.
        let outer = if self.geometry.len() == 1
            && self.ball.is_none()
            && normal.dot(ray.direction.as_dvec3()) > 0.0
        {
            -normal
        } else {
            normal
        };
        let direction = outward(outer, draw)?;
        Some(Landing { geometry: &self.geometry, shape, ray, hit, direction })
    }

    /// Whether a ray that starts like this hits the body that it leaves.
    pub fn is_hit_again(&self, start: Start, direction: Vec3) -> bool {
        let interval = Interval { min: start.min, max: f32::INFINITY };
        List::new(&self.geometry).any(&Ray::new(start.origin, direction), interval, &mut Counters::default())
    }

    /// Whether a ray that starts like this misses what covers the body at a distance of
    /// [`GAP`]·S: a larger sphere, or a plane beside the triangle that was left.
    pub fn loses_cover(&self, landing: &Landing, start: Start) -> bool {
        let gap = GAP * self.reach;
        let ray = ExactRay::new(&Ray::new(start.origin, landing.direction));
        let t = match landing.shape {
            Shape::Ball(center, radius) => {
                let cover = Sphere { center: center.as_dvec3(), radius: f64::from(radius) + gap };
                sphere::intersect(&ray, &cover).map(|[_, far]| far)
            }
            Shape::Facet(corners) => {
                let n = common::shape::triangle::normal(&corners);
                let n = if n.dot(landing.direction.as_dvec3()) < 0.0 { -n } else { n };
                let cover = Plane { normal: n, offset: n.dot(corners[0].as_dvec3()) + gap, disc: None };
                plane::intersect(&ray, &cover)
            }
        };
        t.is_none_or(|t| t <= f64::from(start.min))
    }
}

/// A direction on the side of the normal, nearly along the surface in a third of all cases;
/// `None` if rounding turned it back.
fn outward(normal: DVec3, draw: &mut Draw) -> Option<Vec3> {
    let d = draw.direction();
    let up = if d.dot(normal) < 0.0 { -d } else { d };
    let flat = up - normal * up.dot(normal);
    let tilted = if draw.below(3) == 0 { flat + normal * draw.magnitude(-6.0, 0.0) } else { up };
    let direction = tilted.normalize_or_zero().as_vec3();
    (direction.as_dvec3().dot(normal) > 0.0).then_some(direction)
}

fn triangle(draw: &mut Draw) -> Mesh {
    let positions = (0..3).map(|_| draw.cube().as_vec3()).collect();
    Mesh { positions, triangles: vec![[0, 1, 2]], ..Mesh::default() }
}

/// The ball of the modeller without its hills.
fn convex() -> Mesh {
    let mut mesh = plain(ball_mesh(320));
    mesh.positions.iter_mut().for_each(|p| *p = p.normalize());
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn landings_are_left_outward() {
        let mut draw = Draw::new(5);
        for (kind, name) in KINDS.iter().enumerate() {
            let body = Body::new(kind, 1.0, &mut draw).unwrap();
            let landings: Vec<Landing> = (0..200).filter_map(|_| body.land(&mut draw)).collect();
            assert!(landings.len() > 10, "{name}: {}", landings.len());
            for l in landings {
                let n = body.geometry.surface(&l.ray, &l.hit).geometric_normal;
                let side = n.dot(l.direction.as_dvec3());
                assert!(side > 0.0 || kind == 1 && side < 0.0);
            }
        }
    }

    /// A start in the gap finds the cover, one beyond it or blind for it does not.
    #[test]
    fn a_cover_is_lost_from_beyond_it_only() {
        let mut draw = Draw::new(6);
        for (kind, name) in KINDS.iter().enumerate() {
            let body = Body::new(kind, 1000.0, &mut draw).unwrap();
            let landing = (0..100).find_map(|_| body.land(&mut draw)).unwrap();
            let surface = body.geometry.surface(&landing.ray, &landing.hit);
            let n = surface.geometric_normal;
            let n = if n.dot(landing.direction.as_dvec3()) < 0.0 { -n } else { n };
            let start = |away: f64, min| Start { origin: (surface.point + n * away).as_vec3(), min };
            let gap = GAP * body.reach;
            assert!(!body.loses_cover(&landing, start(0.5 * gap, 0.0)), "{name}");
            assert!(body.loses_cover(&landing, start(0.5 * gap, f32::MAX)));
            assert!(kind == 0 || body.loses_cover(&landing, start(2.0 * gap, 0.0)));
        }
    }
}
