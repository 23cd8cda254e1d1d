//! Ray against triangle in exact arithmetic.

use super::Dyadic;
use common::math::Vec3;
use common::ray::Ray;

/// What exact arithmetic says of a line that passes a triangle.
#[derive(Clone, Copy, Debug)]
pub struct ExactTriangle {
    /// Ray parameter of the crossing with the triangle's plane.
    pub t: f64,
    /// Weight of the second corner.
    pub u: f64,
    /// Weight of the third corner.
    pub v: f64,
}

fn exact(v: Vec3) -> [Dyadic; 3] {
    v.to_array().map(|x| Dyadic::new(f64::from(x)))
}

fn minus(a: &[Dyadic; 3], b: &[Dyadic; 3]) -> [Dyadic; 3] {
    std::array::from_fn(|i| &a[i] - &b[i])
}

/// d · ((a − o) × (b − o)) for the line that starts at `o`.
fn side(o: &[Dyadic; 3], d: &[Dyadic; 3], a: &[Dyadic; 3], b: &[Dyadic; 3]) -> Dyadic {
    Dyadic::determinant(d, &minus(a, o), &minus(b, o))
}

/// The sign of `side` at o + (ε, ε², ε³) for an infinitesimal ε > 0: `side` is linear in `o`,
/// so the first difference that is not zero decides.
fn perturbed_sign(o: &[Dyadic; 3], d: &[Dyadic; 3], a: &[Dyadic; 3], b: &[Dyadic; 3]) -> i32 {
    let value = side(o, d, a, b);
    let moved = |axis: usize| {
        let mut from = o.clone();
        from[axis] = &from[axis] + &Dyadic::new(1.0);
        (&side(&from, d, a, b) - &value).sign()
    };
    [value.sign()].into_iter().chain((0..3).map(moved)).find(|&s| s != 0).unwrap_or(0)
}

/// Whether the line of the ray, moved sideways by an infinitesimal, passes the triangle, and
/// where the line itself meets the plane. `None` if it passes beside or the plane is edge-on.
pub fn exact_triangle(ray: &Ray, vertices: &[Vec3; 3]) -> Option<ExactTriangle> {
    let (o, d) = (exact(ray.origin), exact(ray.direction));
    let [a, b, c] = vertices.map(exact);
    let signs = [(&b, &c), (&c, &a), (&a, &b)].map(|(p, q)| perturbed_sign(&o, &d, p, q));
    if signs != [1; 3] && signs != [-1; 3] {
        return None;
    }
    let (e1, e2, to_a) = (minus(&b, &a), minus(&c, &a), minus(&a, &o));
    let approach = Dyadic::determinant(&d, &e1, &e2);
    let total = &(&side(&o, &d, &b, &c) + &side(&o, &d, &c, &a)) + &side(&o, &d, &a, &b);
    Some(ExactTriangle {
        t: Dyadic::determinant(&to_a, &e1, &e2).over(&approach),
        u: side(&o, &d, &c, &a).over(&total),
        v: side(&o, &d, &a, &b).over(&total),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn middle_outside_and_shared_edge() {
        let [a, b, c, d] = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(1.0, 1.0, 0.0)];
        let down = |x: f32, y: f32| Ray::new(Vec3::new(x, y, 2.0), Vec3::new(0.0, 0.0, -4.0));
        let hit = exact_triangle(&down(0.25, 0.5), &[a, b, c]).expect("inside");
        assert_eq!((hit.t, hit.u, hit.v), (0.5, 0.25, 0.5));
        assert!(exact_triangle(&down(0.75, 0.5), &[a, b, c]).is_none());
        let on_edge = down(0.5, 0.5);
        let hits = [[a, b, c], [b, d, c]].iter().filter(|t| exact_triangle(&on_edge, t).is_some()).count();
        assert_eq!(hits, 1);
    }
}
