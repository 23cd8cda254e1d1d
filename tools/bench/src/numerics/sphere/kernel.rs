//! Tests of ray against sphere in either precision.
//!
//! All solve |origin + t·direction − centre|² = radius²; they differ in which numbers they
//! subtract from each other.

use crate::numerics::real::{Real, Triple, along, dot, minus, triple};
use common::math::Vec3;
use common::ray::Ray;
use common::shape::ExactRay;
use common::shape::sphere::{self, Sphere};

/// The nearer of the two t, or `None` if the line passes the sphere by.
pub type Test = fn(&Ray, &Ball) -> Option<f64>;

/// A sphere whose numbers single precision holds.
#[derive(Clone, Copy, Debug)]
pub struct Ball {
    /// Centre.
    pub center: Vec3,
    /// Radius.
    pub radius: f32,
}

/// What is compared.
pub struct Kernel {
    /// What it is called in tables.
    pub name: &'static str,
    /// Half the distance between 1 and the next number of the precision it works in, twice.
    pub eps: f64,
    /// The test.
    pub test: Test,
}

const SINGLE: f64 = f32::EPSILON as f64;

/// All tests.
pub const KERNELS: [Kernel; 7] = [
    Kernel { name: "b² − 4ac, f32", eps: SINGLE, test: textbook::<f32> },
    Kernel {
        name: "b² − 4ac, q instead of −b ± √, f32", eps: SINGLE, test: without_cancellation::<f32>
    },
    Kernel { name: "Hearn–Baker, f32", eps: SINGLE, test: hearn_baker::<f32> },
    Kernel { name: "recentred, f32", eps: SINGLE, test: recentred },
    Kernel { name: "b² − 4ac, f64", eps: f64::EPSILON, test: textbook::<f64> },
    Kernel { name: "Hearn–Baker, f64", eps: f64::EPSILON, test: hearn_baker::<f64> },
    Kernel { name: "ours", eps: f64::EPSILON, test: ours },
];

#[inline(always)]
fn prepare<T: Real>(ray: &Ray, ball: &Ball) -> (Triple<T>, Triple<T>, T) {
    (minus(triple(ray.origin), triple(ball.center)), triple(ray.direction), T::from(ball.radius))
}

/// The quadratic as it stands in every school book.
#[inline(always)]
fn textbook<T: Real>(ray: &Ray, ball: &Ball) -> Option<f64> {
    let (from_center, d, radius) = prepare::<T>(ray, ball);
    let (two, four) = (T::from(2.0), T::from(4.0));
    let (a, b) = (dot(d, d), two * dot(from_center, d));
    let c = dot(from_center, from_center) - radius * radius;
    let discriminant = b * b - four * a * c;
    (discriminant >= T::from(0.0)).then(|| ((-b - discriminant.root()) / (two * a)).into())
}

/// The same, but of the two roots the one is computed that adds, the other from their product:
/// heals the roots, not the discriminant.
#[inline(always)]
fn without_cancellation<T: Real>(ray: &Ray, ball: &Ball) -> Option<f64> {
    let (from_center, d, radius) = prepare::<T>(ray, ball);
    let (a, b) = (dot(d, d), -dot(from_center, d));
    let c = dot(from_center, from_center) - radius * radius;
    let discriminant = b * b - a * c;
    (discriminant >= T::from(0.0)).then(|| larger_root_first(a, b, c, discriminant.root()))
}

/// The discriminant as radius² less the squared distance of the line from the centre (Hearn &
/// Baker, "Computer Graphics with OpenGL"; Haines et al., Ray Tracing Gems, chapter 7).
#[inline(always)]
fn hearn_baker<T: Real>(ray: &Ray, ball: &Ball) -> Option<f64> {
    let (from_center, d, radius) = prepare::<T>(ray, ball);
    let (a, b) = (dot(d, d), -dot(from_center, d));
    let closest = along(from_center, d, b / a);
    let inside = radius * radius - dot(closest, closest);
    let c = dot(from_center, from_center) - radius * radius;
    (inside >= T::from(0.0)).then(|| larger_root_first(a, b, c, (a * inside).root()))
}

/// The lesser root of a·t² − 2b·t + c, given √(b² − ac).
#[inline(always)]
fn larger_root_first<T: Real>(a: T, b: T, c: T, root: T) -> f64 {
    let q = if b < T::from(0.0) { b - root } else { b + root };
    let (t, other) = (c / q, q / a);
    if t < other { t.into() } else { other.into() }
}

/// The ray's origin is first moved to the point nearest to the centre; all that follows is of the
/// size of the sphere.
#[inline(always)]
fn recentred(ray: &Ray, ball: &Ball) -> Option<f64> {
    let length = ray.direction.length();
    let d = ray.direction / length;
    let way = (ball.center - ray.origin).dot(d);
    let beside = ray.origin + d * way - ball.center;
    let inside = ball.radius * ball.radius - beside.dot(beside);
    (inside >= 0.0).then(|| f64::from((way - inside.sqrt()) / length))
}

#[inline(always)]
fn ours(ray: &Ray, ball: &Ball) -> Option<f64> {
    let sphere = Sphere { center: ball.center.as_dvec3(), radius: f64::from(ball.radius) };
    sphere::intersect(&ExactRay::new(ray), &sphere).map(|[near, _]| near)
}
