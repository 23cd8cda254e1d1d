//! Property 7: a ray that leaves a convex thing does not meet it again.

use crate::kit::{Draw, build, convex_sphere, ray_bits};
use crate::{Stress, Trials};
use common::accel::{Accel, List};
use common::counters::Counters;
use common::geometry::{Geometry, Surface};
use common::math::{DVec3, Interval, Vec3};
use common::mesh::Mesh;
use common::ray::Ray;

/// 2⁻²³.
pub(super) const EPS: f64 = 1.0 / (1u64 << 23) as f64;

/// A direction on the outer side of the surface, grazing in a third of all cases. It is an `f32`
/// direction already: what a caller rounds afterwards may point elsewhere.
fn outward(draw: &mut Draw, n: DVec3) -> Option<Vec3> {
    let d = draw.direction();
    let up = if d.dot(n) < 0.0 { -d } else { d };
    let along = up - n * up.dot(n);
    let tilted = if draw.chance(0.33) { along + n * draw.magnitude(-9.0, 0.0) } else { up };
    let direction = tilted.normalize_or_zero().as_vec3();
    (direction.as_dvec3().dot(n) > 0.0).then_some(direction)
}

/// Finds a point of the surface and leaves it outward: nothing may be hit again. The value is
/// the offset as a share of 64 eps·S, S the largest coordinate of the shape.
fn leaves(draw: &mut Draw, geometry: &Geometry, ray: &Ray, reach: f64) -> Result<f64, String> {
    let list = List::new(geometry);
    let mut counters = Counters::default();
    let Some(hit) = list.nearest(ray, Interval::FORWARD, &mut counters) else { return Ok(0.0) };
    let surface = geometry.surface(ray, &hit);
    // Both sides of a flat shape are its outside; of a body only the outer one.
    let body = !geometry.solids().is_empty() || geometry.triangles().len() > 1;
    let turned = !body && draw.chance(0.5);
    let n = if turned { -surface.geometric_normal } else { surface.geometric_normal };
    let Some(direction) = outward(draw, n) else { return Ok(0.0) };
    let away = Ray::new(surface.leave(direction.as_dvec3()), direction);
    if let Some(again) = list.nearest(&away, Interval::FORWARD, &mut counters) {
        return Err(format!("{again:?} again\nfound by {}\nleft by {}", ray_bits(ray), ray_bits(&away)));
    }
    let share = offset(&surface, away.origin) / (64.0 * EPS * reach);
    if share <= 1.0 { Ok(share) } else { Err(format!("offset {share} of the bound\n{}", ray_bits(ray))) }
}

fn offset(surface: &Surface, start: Vec3) -> f64 {
    (start.as_dvec3() - surface.point).length()
}

/// Size and place of a shape: sizes 10⁻⁶ … 10⁹, up to 10⁷ away, never so far that `f32` cannot
/// tell its two sides apart.
fn place(draw: &mut Draw) -> (f64, DVec3) {
    let size = draw.magnitude(-6.0, 9.0);
    let most = (size * 1e4).min(1e7);
    let center = draw.direction() * draw.pick(&[0.0, 1.0, most.max(1e-30)]).min(most);
    (size, center)
}

/// One geometry per few hundred rays: building it costs more than tracing it.
const RAYS: usize = 256;

/// Rays for each kind of shape in the full tier.
const FULL_RAYS: u64 = 10_000_000;

fn many(draw: &mut Draw, geometry: &Geometry, size: f64, center: DVec3, reach: f64) -> Result<f64, String> {
    let mut worst: f64 = 0.0;
    for _ in 0..RAYS {
        let origin = (center + draw.direction() * size * draw.between(0.0, 6.0)).as_vec3();
        let target = center + draw.cube() * size * 0.8;
        let direction = (target - origin.as_dvec3()).normalize_or(DVec3::X).as_vec3();
        worst = worst.max(leaves(draw, geometry, &Ray::new(origin, direction), reach)?);
    }
    Ok(worst)
}

fn shape_text(kind: usize, draw: &mut Draw, size: f64, c: DVec3) -> String {
    let d = draw.direction();
    let at = format!(
        "Translate {} {} {} Rotate {{ {} {} {} {} }}",
        c.x,
        c.y,
        c.z,
        d.x,
        d.y,
        d.z,
        draw.between(0.0, 360.0)
    );
    match kind {
        0 => format!("Sphere {{ center {} {} {} radius {size} }}", c.x, c.y, c.z),
        1 => {
            let s = [size, size * draw.between(0.1, 1.0), -size * draw.between(0.01, 1.0)];
            format!(
                "Transform {{ {at} Scale {} {} {} Sphere {{ center 0 0 0 radius 1 }} }}",
                s[0], s[1], s[2]
            )
        }
        2 => {
            let p: Vec<String> = (0..3)
                .map(|_| c + draw.cube() * size * draw.pick(&[1.0, 1.0, 1e-3]))
                .enumerate()
                .map(|(i, p)| format!("vertex{i} {} {} {}", p.x, p.y, p.z))
                .collect();
            format!("Triangle {{ {} }}", p.join(" "))
        }
        3 => format!("Plane {{ normal {} {} {} offset {} }}", d.x, d.y, d.z, d.dot(c)),
        _ => format!("Transform {{ {at} UniformScale {size} TriangleMesh {{ obj_file cube }} }}"),
    }
}

fn leave_convex(stress: &Stress, name: &str, kind: usize, rays: u64) {
    let cube = if kind == 4 { convex_sphere(2) } else { Mesh::default() };
    let each = RAYS as u64;
    let trials = Trials::new(rays / each, FULL_RAYS / each);
    let worst = stress.run(format!("p07 {name} (256 rays each), offset / 64 eps·S"), 701, trials, |draw| {
        let (size, center) = place(draw);
        let text = shape_text(kind, draw, size, center);
        let geometry = build(&text, cube.clone());
        let reach = center.abs().max_element() + 2.0 * size;
        // Rays meet a plane at a distance of their own; its points are as large as that.
        let reach = if kind == 3 { reach * 1e6 } else { reach };
        many(draw, &geometry, size, center, reach).map_err(|e| format!("{text}\n{e}"))
    });
    stress.expect(&format!("p07 {name}: some rays hit"), worst, |worst| worst > 0.0);
}

/// Leaving spheres.
pub fn spheres(stress: &Stress) {
    leave_convex(stress, "sphere", 0, 3_000_000);
}

/// Leaving ellipsoids.
pub fn ellipsoids(stress: &Stress) {
    leave_convex(stress, "ellipsoid", 1, 2_000_000);
}

/// Leaving triangles.
pub fn triangles(stress: &Stress) {
    leave_convex(stress, "triangle", 2, 2_000_000);
}

/// Leaving planes.
pub fn planes(stress: &Stress) {
    leave_convex(stress, "plane", 3, 2_000_000);
}

/// Leaving convex meshes.
pub fn meshes(stress: &Stress) {
    leave_convex(stress, "convex mesh", 4, 1_000_000);
}
