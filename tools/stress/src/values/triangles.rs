//! Property 3: triangles against exact arithmetic.

use super::{EPS, any_ray, any_triangle, reproducer};
use crate::Stress;
use crate::kit::{Draw, Dyadic, exact_triangle};
use common::math::{DVec3, Vec3};
use common::ray::Ray;
use common::shape::{ExactRay, triangle};

/// A triangle is hit exactly when exact arithmetic says so.
pub fn decisions(stress: &Stress) {
    let hits = stress.run("p03 decisions", 301, 150_000, |draw| {
        let t = any_triangle(draw);
        let ray = any_ray(draw, &t);
        let truth = exact_triangle(&ray, &t);
        match triangle::intersect(&ExactRay::new(&ray), &t).is_some() == truth.is_some() {
            true => Ok(f64::from(u8::from(truth.is_some()))),
            false => Err(format!("exact: {truth:?}\n{}", reproducer(&ray, &t))),
        }
    });
    stress.expect("p03 some rays hit", hits, |hits| hits == 1.0);
}

/// t within 16 eps·S/cos; u and v as lengths over the triangle within the same.
pub fn values(stress: &Stress) {
    stress.run("p03 t, share of the bound 16 eps·S/cos", 302, 100_000, |draw| triangle_value(draw, |v| v.t));
    stress.run("p03 u v, share of the bound 16 eps·S/cos", 303, 100_000, |draw| {
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

/// Triangles and rays of any bits give no NaN.
pub fn any_bits(stress: &Stress) {
    stress.run("p03 any bits", 304, 300_000, |draw| {
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
