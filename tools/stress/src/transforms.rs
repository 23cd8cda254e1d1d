//! accuracy.md, property 5: however deep transforms are nested, and however badly they stretch,
//! hits are those of the exact product of the matrices.

use crate::kit::{Draw, Dyadic, ray_bits, scene_of};
use crate::{Stress, Trials};
use common::accel::{Accel, List};
use common::counters::Counters;
use common::geometry::Geometry;
use common::math::{DMat3, DMat4, DVec3, Interval};
use common::mesh::Mesh;
use common::ray::Ray;
use common::scene::{Node, NodeKind, Scene, Xform};

/// 2⁻²³.
const EPS: f64 = 1.0 / (1u64 << 23) as f64;

/// The product of matrices without rounding, then rounded once.
fn exact_product(list: &[DMat4]) -> DMat4 {
    let lift = |m: &DMat4| m.to_cols_array_2d().map(|c| c.map(Dyadic::new));
    let mut product = lift(&DMat4::IDENTITY);
    for m in list {
        let m = lift(m);
        product = std::array::from_fn(|column| {
            std::array::from_fn(|row| {
                let terms = (0..4).map(|k| &product[k][row] * &m[column][k]);
                terms.reduce(|a, b| &a + &b).expect("four terms")
            })
        });
    }
    DMat4::from_cols_array_2d(&product.map(|c| c.map(|x| x.to_f64())))
}

/// `depth` transforms: turns, moves, mirrors, and stretches that multiply to the condition.
fn chain(draw: &mut Draw, depth: usize, condition: f64) -> Vec<Xform> {
    let each = condition.powf(1.0 / depth as f64);
    let axis = draw.below(3);
    let mut stretch = DVec3::ONE;
    stretch[axis] = each;
    let sign = |draw: &mut Draw| if draw.chance(0.2) { -1.0 } else { 1.0 };
    (0..depth)
        .flat_map(|_| {
            let flip = DVec3::new(sign(draw), sign(draw), sign(draw));
            let (turn, angle) = (draw.direction(), draw.between(-180.0, 180.0));
            // A stretch in a turned frame, turned back, so that the stretches add up.
            [
                Xform::Rotate(turn, angle),
                Xform::Scale(flip),
                Xform::Rotate(turn, -angle),
                Xform::Scale(stretch),
                Xform::Translate(draw.cube() * 0.1),
            ]
        })
        .collect()
}

/// One transform node per entry around one shape.
fn nested(shape: &str, list: &[Xform]) -> Scene {
    let mut scene = scene_of(shape, Mesh::default());
    let leaf = scene.nodes.pop().expect("the shape");
    let position = leaf.position;
    for xform in list {
        let parent = Some(scene.nodes.len() as u32 - 1);
        scene.nodes.push(Node { parent, kind: NodeKind::Transform(vec![*xform]), position });
    }
    let parent = Some(scene.nodes.len() as u32 - 1);
    scene.nodes.push(Node { parent, ..leaf });
    scene
}

/// Largest over smallest singular value, from norms: within a factor 3 of it.
fn condition(m: &DMat3) -> f64 {
    let norm = |m: &DMat3| m.to_cols_array().iter().map(|x| x * x).sum::<f64>().sqrt();
    norm(m) * norm(&m.inverse())
}

/// The nearer crossing of a unit sphere, in its own space, in `f64`.
fn sphere_t(o: DVec3, d: DVec3) -> Option<f64> {
    let (a, b) = (d.length_squared(), o.dot(d));
    // b² − a·c by Lagrange's identity: nothing cancels that is far larger than the sphere.
    let under = a - o.cross(d).length_squared();
    (under > 0.0).then(|| (-b - under.sqrt()) / a)
}

fn fault(what: &str, error: f64, depth: usize, ray: &Ray) -> Result<f64, String> {
    if error <= 1.0 {
        Ok(error)
    } else {
        Err(format!("{what}: {error} of the bound, depth {depth}\n{}", ray_bits(ray)))
    }
}

/// A ray at a point of the unit sphere's image, from a few sizes of the image away. Rays that
/// graze are not asked: there t depends on the last bits of the ray itself.
fn transformed_sphere(draw: &mut Draw, depth: usize, stretch: f64) -> Result<f64, String> {
    let list = chain(draw, depth, stretch);
    let matrix = exact_product(&list.iter().map(Xform::matrix).collect::<Vec<_>>());
    let linear = DMat3::from_mat4(matrix);
    let inverse = linear.inverse();
    let center = matrix.w_axis.truncate();
    let scene = nested("Sphere { center 0 0 0 radius 1 }", &list);
    let geometry = Geometry::build(&scene).map_err(|e| e.to_string())?;
    let accel = List::new(&geometry);
    let p = draw.direction();
    let normal = (inverse.transpose() * p).normalize();
    let out = (normal + draw.direction() * 0.5).normalize();
    let size = linear.to_cols_array().iter().fold(0.0f64, |m, x| m.max(x.abs()));
    let origin = (center + linear * p + out * size * draw.between(0.5, 3.0)).as_vec3();
    let ray = Ray::new(origin, (center + linear * p - origin.as_dvec3()).as_vec3());
    let inside = |v: DVec3| inverse * v;
    let (o, d) = (inside(origin.as_dvec3() - center), inside(ray.direction.as_dvec3()));
    let Some(t) = sphere_t(o, d) else { return Ok(0.0) };
    let at = o + d * t;
    let incidence = (at.dot(d) / d.length()).abs();
    // Neither this inverse nor the one under test is better than 2⁻⁵²·cond: so far, in radii, may
    // the ray be moved aside, and what grazes the sphere within that may miss it. (At a condition
    // of 10⁶ the bound of the promise, 32 eps·cond, is larger than the shape.)
    let moved = 64.0 * f64::EPSILON * condition(&linear) * o.length();
    if incidence * incidence < moved.max(1e-4) || t <= 0.0 {
        return Ok(0.0);
    }
    let Some(hit) = accel.nearest(&ray, Interval::FORWARD, &mut Counters::default()) else {
        return fault("missed", f64::INFINITY, depth, &ray);
    };
    let allowed = 32.0 * EPS * condition(&linear);
    let scale = size + center.length();
    let surface = geometry.surface(&ray, &hit);
    let true_normal = (inverse.transpose() * at).normalize();
    let t_error = (f64::from(hit.t) - t).abs() * ray.direction.as_dvec3().length() / scale;
    let p_error = (surface.point - (center + linear * at)).length() / scale;
    let n_error = (surface.geometric_normal - true_normal).length();
    fault("t", t_error / allowed, depth, &ray)
        .and_then(|a| Ok(a.max(fault("p", p_error / allowed, depth, &ray)?)))
        .and_then(|a| Ok(a.max(fault("n", n_error / allowed, depth, &ray)?)))
}

/// Errors grow with the condition, not with the depth.
pub fn depths(stress: &Stress) {
    for depth in [1, 4, 16, 64] {
        for power in [0, 2, 4, 6] {
            let trials = 512 / depth as u64;
            let worst = stress.run(
                format!("p05 depth {depth}, stretch 1e{power}, error / 32 eps·cond"),
                501,
                Trials::new(trials, 100 * trials),
                |draw| transformed_sphere(draw, depth, 10f64.powi(power)),
            );
            // Without stretches, no depth costs more than one eps·cond: errors do not add up.
            if power == 0 {
                stress.expect(&format!("p05 depth {depth}: errors do not add up"), worst, |w| w < 1.0 / 32.0);
            }
        }
    }
}

/// A tiny even scale is not singular, but a lost dimension is.
pub fn singular(stress: &Stress) {
    stress.case("p05 singular", || {
        lost_dimension();
        Ok(0.0)
    });
}

fn lost_dimension() {
    let tiny = nested("Sphere { center 0 0 0 radius 1 }", &[Xform::Scale(DVec3::splat(1e-6))]);
    let geometry = Geometry::build(&tiny).unwrap_or_else(|e| panic!("{e}"));
    let ray = Ray::new(common::math::Vec3::Z, -common::math::Vec3::Z);
    let hit = List::new(&geometry).nearest(&ray, Interval::FORWARD, &mut Counters::default());
    assert_eq!(hit.map(|h| h.t), Some((1.0 - 1e-6f64) as f32));
    let flat = nested("Sphere { center 0 0 0 radius 1 }", &[Xform::Scale(DVec3::new(1.0, 0.0, 1.0))]);
    assert!(Geometry::build(&flat).is_err());
}
