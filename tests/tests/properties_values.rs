//! accuracy.md, properties 3 and 6: yes and no are those of exact arithmetic, values are within
//! a few roundings, and turning or scaling the world changes no bit.

use common::math::{Bounds, DVec3, Interval, Vec3};
use common::ray::Ray;
use common::shape::filter::Filter;
use common::shape::sphere::{self, Sphere};
use common::shape::triangle_block::TriangleBlock;
use common::shape::{ExactRay, plane, triangle};
use common::simd::dispatch;
use std::sync::atomic::{AtomicU64, Ordering};
use tests::property::{Draw, Dyadic, exact_triangle, ray_bits, run, simd_levels, triangle_bits};

/// 2⁻²³.
const EPS: f64 = 1.0 / (1u64 << 23) as f64;

/// Turns the axes round by `turn` steps, so that no axis is special.
fn turned(p: DVec3, turn: usize) -> DVec3 {
    let a = p.to_array();
    DVec3::from_array([a[turn % 3], a[(turn + 1) % 3], a[(turn + 2) % 3]])
}

/// A triangle of every kind: plain, thin to 10⁻¹², small and far, on a lattice, without area.
fn any_triangle(draw: &mut Draw) -> [Vec3; 3] {
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
fn any_ray(draw: &mut Draw, t: &[Vec3; 3]) -> Ray {
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

fn reproducer(ray: &Ray, t: &[Vec3; 3]) -> String {
    format!("{}\n{}", ray_bits(ray), triangle_bits(t))
}

#[test]
fn p03_triangles_are_hit_exactly_when_exact_arithmetic_says_so() {
    let hits = run("p03 decisions", 301, 300_000, |draw| {
        let t = any_triangle(draw);
        let ray = any_ray(draw, &t);
        let truth = exact_triangle(&ray, &t);
        match triangle::intersect(&ExactRay::new(&ray), &t).is_some() == truth.is_some() {
            true => Ok(f64::from(u8::from(truth.is_some()))),
            false => Err(format!("exact: {truth:?}\n{}", reproducer(&ray, &t))),
        }
    });
    assert_eq!(hits, 1.0, "no ray hit anything");
}

/// t within 16 eps·S/cos; u and v as lengths over the triangle within the same.
#[test]
fn p03_t_u_v_of_triangles() {
    run("p03 t, share of the bound 16 eps·S/cos", 302, 300_000, |draw| triangle_value(draw, |v| v.t));
    run("p03 u v, share of the bound 16 eps·S/cos", 303, 200_000, |draw| {
        triangle_value(draw, |v| v.weights)
    });
}

struct ValueErrors {
    t: f64,
    weights: f64,
}

fn triangle_value(draw: &mut Draw, pick: impl Fn(ValueErrors) -> f64) -> Result<f64, String> {
    let t = any_triangle(draw);
    let ray = any_ray(draw, &t);
    let Some(hit) = triangle::intersect(&ExactRay::new(&ray), &t) else { return Ok(0.0) };
    let truth = exact_triangle(&ray, &t).ok_or_else(|| reproducer(&ray, &t))?;
    let [a, b, c] = t.map(|v| v.as_dvec3());
    let (o, d) = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
    let s = [a, b, c].iter().map(|v| (*v - o).length()).fold(0.0, f64::max);
    // The area vector as exact arithmetic has it, so that the cosine of a sliver is right.
    let area = exact_area_vector(&t);
    let cos = (area.dot(d) / (area.length() * d.length())).abs();
    let bound = 16.0 * EPS * s / cos.max(f64::MIN_POSITIVE);
    let height = |base: DVec3| area.length() / base.length();
    let u_error = (f64::from(hit.u) - truth.u).abs() * height(c - a);
    let v_error = (f64::from(hit.v) - truth.v).abs() * height(b - a);
    let errors = ValueErrors {
        t: (f64::from(hit.t) - truth.t).abs() * d.length() / bound,
        weights: u_error.max(v_error) / bound,
    };
    let value = pick(errors);
    let finite = hit.t.is_finite() && (0.0..=1.0).contains(&hit.u) && (0.0..=1.0).contains(&hit.v);
    if finite && value <= 1.0 {
        return Ok(value);
    }
    Err(format!("{value} of the bound: {hit:?}, exact {truth:?}\n{}", reproducer(&ray, &t)))
}

fn exact_area_vector(t: &[Vec3; 3]) -> DVec3 {
    let [a, b, c] = t.map(|v| v.to_array().map(|x| Dyadic::new(f64::from(x))));
    let (p, q): ([Dyadic; 3], [Dyadic; 3]) =
        (std::array::from_fn(|i| &b[i] - &a[i]), std::array::from_fn(|i| &c[i] - &a[i]));
    let minor = |i: usize, j: usize| (&(&p[i] * &q[j]) - &(&p[j] * &q[i])).to_f64();
    DVec3::new(minor(1, 2), minor(2, 0), minor(0, 1))
}

#[test]
fn p03_no_triangle_of_any_bits_gives_nan() {
    run("p03 any bits", 304, 1_000_000, |draw| {
        let mut any = || loop {
            let x = f32::from_bits(draw.bits());
            if x.is_finite() {
                return x;
            }
        };
        let mut point = || Vec3::new(any(), any(), any());
        let ray = Ray::new(point(), point());
        let mut t = [point(), point(), point()];
        match draw.below(4) {
            0 => t[1] = t[0],
            1 => t[2] = (t[0] + t[1]) / 2.0,
            2 => t = t.map(|v| v * 1e-40),
            _ => {}
        }
        if !t.iter().all(|v| v.is_finite()) {
            return Ok(0.0);
        }
        match triangle::intersect(&ExactRay::new(&ray), &t) {
            Some(h) if h.t.is_nan() || !(0.0..=1.0).contains(&h.u) || !(0.0..=1.0).contains(&h.v) => {
                Err(format!("{h:?}\n{}", reproducer(&ray, &t)))
            }
            _ => Ok(0.0),
        }
    });
}

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
#[test]
fn p06_scaling_by_two_turning_and_mirroring_change_no_bit() {
    run("p06 bit-equal", 601, 300_000, |draw| {
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

/// The single-precision filter discards no triangle that is hit, is certain of none that is
/// missed, and knows a t that is not too early.
#[test]
fn p03_the_filter_is_never_wrong() {
    let certain = AtomicU64::new(0);
    for (name, level) in simd_levels() {
        run(&format!("p03 filter, {name}"), 305, 60_000, |draw| {
            let triangle = any_triangle(draw);
            let ray = any_ray(draw, &triangle);
            if !ray.is_usable() {
                return Ok(0.0);
            }
            let end = draw.magnitude(-2.0, 2.0) as f32;
            let interval = if draw.chance(0.5) { Interval::ALL } else { Interval { min: -end, max: end } };
            let filter = Filter::new(&ray, &Bounds::of_points(triangle));
            let block = TriangleBlock::pack([(0, triangle)]);
            let verdict = dispatch!(level, s => block.judge(s, &filter, interval));
            let hit = triangle::intersect(&ExactRay::new(&ray), &triangle).filter(|h| interval.contains(h.t));
            if hit.is_some() && verdict.possible & 1 == 0 {
                return Err(format!("hit and discarded: {ray:?} {triangle:?} {interval:?}"));
            }
            if verdict.certain & 1 == 1 {
                certain.fetch_add(1, Ordering::Relaxed);
                let latest = verdict.latest[0];
                if hit.is_none_or(|h| h.t > latest + latest.abs() * EPS as f32) {
                    return Err(format!(
                        "{hit:?} but certain until {latest}: {ray:?} {triangle:?} {interval:?}"
                    ));
                }
            }
            Ok(0.0)
        });
    }
    assert!(certain.into_inner() > 10_000, "the filter should be certain now and then");
}
