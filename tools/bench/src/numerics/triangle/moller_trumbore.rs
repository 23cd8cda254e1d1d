//! Möller & Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection" (1997), edges included,
//! both sides, in either precision.

use super::kernel::Kernel;
use crate::numerics::real::{Real, Triple, cross, dot, minus, triple};
use common::math::Vec3;
use common::ray::Ray;
use std::marker::PhantomData;

/// In single or double precision.
pub struct MollerTrumbore<T>(PhantomData<T>);

/// A corner and the two edges there.
#[inline(always)]
fn edges<T: Real>(corners: &[Vec3; 3]) -> [Triple<T>; 3] {
    let [a, b, c] = corners.map(triple::<T>);
    [a, minus(b, a), minus(c, a)]
}

/// Solves origin + t·direction = a + u·e + v·f by Cramer's rule.
#[inline(always)]
fn solve<T: Real>([origin, direction]: &[Triple<T>; 2], [a, e, f]: &[Triple<T>; 3]) -> Option<f64> {
    let (zero, one) = (T::from(0.0), T::from(1.0));
    let p = cross(*direction, *f);
    let determinant = dot(*e, p);
    if determinant == zero {
        return None;
    }
    let inverse = one / determinant;
    let from_corner = minus(*origin, *a);
    let u = dot(from_corner, p) * inverse;
    if u < zero || u > one {
        return None;
    }
    let q = cross(from_corner, *e);
    let v = dot(*direction, q) * inverse;
    if v < zero || u + v > one {
        return None;
    }
    Some((dot(*f, q) * inverse).into())
}

macro_rules! precision {
    ($type:ty, $name:literal) => {
        impl Kernel for MollerTrumbore<$type> {
            const NAME: &'static str = $name;
            type Ray = [Triple<$type>; 2];
            type Triangle = [Triple<$type>; 3];

            fn ray(ray: &Ray) -> Self::Ray {
                [triple(ray.origin), triple(ray.direction)]
            }

            fn triangle(corners: &[Vec3; 3]) -> Self::Triangle {
                edges(corners)
            }

            #[inline(always)]
            fn hit(ray: &Self::Ray, triangle: &Self::Triangle) -> Option<f64> {
                solve(ray, triangle)
            }
        }
    };
}

precision!(f32, "Möller–Trumbore, f32");
precision!(f64, "Möller–Trumbore, f64");
