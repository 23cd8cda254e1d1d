//! accuracy.md, property 4: spheres and planes at every size and distance.

use crate::Stress;
use crate::kit::{Dyadic, ray_bits};
use common::math::{DVec3, Vec3};
use common::ray::Ray;
use common::shape::sphere::{self, Sphere};
use common::shape::{ExactRay, plane};

/// 2⁻²³.
const EPS: f64 = 1.0 / (1u64 << 23) as f64;

/// The sign of |o + t·d − c|² − r², exactly.
fn outside(ray: &Ray, s: &Sphere, t: f64) -> i32 {
    let t = Dyadic::new(t);
    let (o, d) = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
    let from_center: [Dyadic; 3] = std::array::from_fn(|i| {
        let p = &Dyadic::new(o[i]) + &(&Dyadic::new(d[i]) * &t);
        &p - &Dyadic::new(s.center[i])
    });
    let radius = Dyadic::new(s.radius);
    (&Dyadic::dot(&from_center, &from_center) - &(&radius * &radius)).sign()
}

/// Both roots are bracketed by t ± 4 eps·|t|: exact arithmetic sees the sphere's equation change
/// its sign between, or the two roots are closer than that.
pub fn spheres(stress: &Stress) {
    stress.run("p04 sphere", 401, 200_000, |draw| {
        let radius = draw.magnitude(-6.0, 9.0);
        let center = draw.cube() * draw.pick(&[0.0, 1.0, 1000.0]) * radius;
        let distance = radius * draw.magnitude(0.302, 9.0).min((1e9 / radius).max(2.0));
        let sphere = Sphere { center, radius };
        let origin = (center + draw.direction() * distance).as_vec3();
        let aim = center + draw.direction() * radius * draw.pick(&[0.0, 0.5, 0.9, 0.999]);
        let ray = Ray::new(origin, (aim - origin.as_dvec3()).normalize().as_vec3());
        let Some([near, far]) = sphere::intersect(&ExactRay::new(&ray), &sphere) else {
            let closest = -(origin.as_dvec3() - center).dot(ray.direction.as_dvec3())
                / ray.direction.as_dvec3().length_squared();
            let missed = outside(&ray, &sphere, closest) >= 0;
            return if missed { Ok(0.0) } else { Err(format!("missed {sphere:?}\n{}", ray_bits(&ray))) };
        };
        let slack = |t: f64| 4.0 * EPS * t.abs();
        let (n, f) = (f64::from(near as f32), f64::from(far as f32));
        let close = far - near <= slack(near) + slack(far);
        let ordered = near <= far;
        let bracketed =
            outside(&ray, &sphere, n - slack(n)) >= 0 && outside(&ray, &sphere, f + slack(f)) >= 0;
        let between =
            close || outside(&ray, &sphere, n + slack(n)) <= 0 && outside(&ray, &sphere, f - slack(f)) <= 0;
        match ordered && bracketed && between {
            true => Ok(0.0),
            false => Err(format!("{near} {far} of {sphere:?}\n{}", ray_bits(&ray))),
        }
    });
}

/// Grazing, from inside and from the surface: ordered numbers.
pub fn special_spheres(stress: &Stress) {
    stress.run("p04 sphere, special", 402, 200_000, |draw| {
        let radius = draw.magnitude(-6.0, 9.0);
        let center = draw.cube() * radius;
        let side = draw.direction();
        let from = match draw.below(3) {
            0 => side * draw.unit(),
            1 => side,
            _ => side + side.any_orthonormal_vector() * draw.between(-3.0, 3.0),
        };
        let direction = if draw.chance(0.5) { side.any_orthonormal_vector() } else { draw.direction() };
        let ray = Ray::new((center + from * radius).as_vec3(), direction.as_vec3());
        match sphere::intersect(&ExactRay::new(&ray), &Sphere { center, radius }) {
            Some([near, far]) => {
                // False for NaN.
                let ordered = near <= far;
                if ordered { Ok(0.0) } else { Err(format!("{near} {far}\n{}", ray_bits(&ray))) }
            }
            None => Ok(0.0),
        }
    });
}

/// Planes have no threshold for "parallel".
pub fn planes(stress: &Stress) {
    stress.run("p04 plane, relative error / 4 eps", 403, 200_000, |draw| {
        let normal = draw.direction();
        let offset = draw.cube().x * draw.magnitude(-6.0, 6.0);
        let plane = plane::Plane { normal, offset, disc: None };
        // Almost along the plane: down to 10⁻³⁰ in a tilted plane's f64, exactly so on an axis.
        let tilt = draw.magnitude(-7.0, 0.0);
        let direction = normal.any_orthonormal_vector() + normal * tilt;
        let ray = Ray::new((draw.cube() * 10.0).as_vec3(), direction.as_vec3());
        let exact = |v: DVec3| v.to_array().map(Dyadic::new);
        let (o, d, n) = (exact(ray.origin.as_dvec3()), exact(ray.direction.as_dvec3()), exact(normal));
        let way = &Dyadic::new(offset) - &Dyadic::dot(&n, &o);
        let truth = way.over(&Dyadic::dot(&n, &d));
        let t = plane::intersect(&ExactRay::new(&ray), &plane).ok_or_else(|| ray_bits(&ray))?;
        // The start of the ray may lie in the plane: what cancels there is of size |o| in f64.
        let scale = (ray.origin.as_dvec3().length() + offset.abs()) * 2f64.powi(-50) / tilt;
        let error = (f64::from(t as f32) - truth).abs() / (4.0 * EPS * truth.abs() + scale);
        if error <= 1.0 { Ok(error) } else { Err(format!("{t} for {truth}\n{plane:?}\n{}", ray_bits(&ray))) }
    });
    let floor = plane::Plane { normal: DVec3::Y, offset: 0.0, disc: None };
    stress.count("p04 plane, all but parallel", || {
        let tilts = [1e-10f32, 1e-30, 1e-38, f32::from_bits(1)];
        for tilt in tilts {
            let ray = Ray::new(Vec3::Y * -tilt, Vec3::new(1.0, tilt, 0.0));
            assert_eq!(plane::intersect(&ExactRay::new(&ray), &floor), Some(1.0), "{tilt:e}");
        }
        Ok(tilts.len() as u64)
    });
}
