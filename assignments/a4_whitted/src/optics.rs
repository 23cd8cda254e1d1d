//! A4T2, A4T3: where light goes at a smooth surface.

use common::math::DVec3;

/// The mirrored direction I − 2(I·N)N; the same on both sides.
#[inline]
pub fn mirror(incoming: DVec3, normal: DVec3) -> DVec3 {
    (incoming - normal * (2.0 * incoming.dot(normal))).normalize()
}

/// What happens to light that meets the surface of a transparent body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Unit direction of the refracted ray; `None` if all light is mirrored.
    pub refracted: Option<DVec3>,
    /// Share of unpolarised light that is mirrored, by Fresnel's equations; 1 if all is.
    pub reflectance: f64,
}

/// Snell's law and Fresnel's equations for a body of index `ior` in vacuum. `incoming` and
/// `normal` are unit, the normal points out of the body: I·N > 0 means that the light leaves.
#[inline(always)]
pub fn refract(incoming: DVec3, normal: DVec3, ior: f64) -> Crossing {
    let leaves = incoming.dot(normal) > 0.0;
    let (eta, against) = if leaves { (ior, -normal) } else { (1.0 / ior, normal) };
    let cos_in = -incoming.dot(against);
    let cos_out_squared = 1.0 - eta * eta * (1.0 - cos_in * cos_in);
    if cos_out_squared < 0.0 {
        return Crossing { refracted: None, reflectance: 1.0 };
    }
    let cos_out = cos_out_squared.sqrt();
    let direction = incoming * eta + against * (eta * cos_in - cos_out);
    // eta is n_in / n_out.
    let across = (eta * cos_in - cos_out) / (eta * cos_in + cos_out);
    let within = (cos_in - eta * cos_out) / (cos_in + eta * cos_out);
    let reflectance = (across * across + within * within) / 2.0;
    Crossing {
        refracted: Some(direction.normalize()),
        reflectance: if reflectance.is_nan() { 1.0 } else { reflectance },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tilted(degrees: f64) -> DVec3 {
        let (s, c) = degrees.to_radians().sin_cos();
        DVec3::new(s, -c, 0.0)
    }

    #[test]
    fn a4t2_mirror_keeps_the_angle_on_both_sides() {
        let out = mirror(tilted(30.0), DVec3::Y);
        assert!((out - DVec3::new(0.5, 0.75f64.sqrt(), 0.0)).length() < 1e-15);
        assert_eq!(out, mirror(tilted(30.0), -DVec3::Y));
    }

    #[test]
    fn a4t3_snell() {
        for (degrees, ior) in [(10.0, 1.5), (45.0, 2.4), (80.0, 1.1), (60.0, 0.9)] {
            let inside = refract(tilted(degrees), DVec3::Y, ior).refracted.unwrap();
            assert!((inside.x * ior - f64::to_radians(degrees).sin()).abs() < 1e-14);
            let back = refract(inside, -DVec3::Y, ior).refracted.unwrap();
            assert!((back - tilted(degrees)).length() < 1e-14, "light can go back the way it came");
        }
    }

    #[test]
    fn a4t3_total_internal_reflection_starts_at_the_critical_angle() {
        let critical = (1.0f64 / 1.5).asin().to_degrees();
        let leave = |degrees| refract(tilted(degrees), -DVec3::Y, 1.5).refracted;
        assert!(leave(critical - 0.01).is_some() && leave(critical + 0.01).is_none());
    }

    #[test]
    fn a4t3_fresnel_at_normal_brewster_and_grazing_incidence() {
        let r = |degrees| refract(tilted(degrees), DVec3::Y, 1.5).reflectance;
        assert!((r(0.0) - 0.04).abs() < 1e-12);
        // At Brewster's angle only one polarisation is mirrored: ((n²−1)/(n²+1))²/2.
        assert!((r(1.5f64.atan().to_degrees()) - (1.25f64 / 3.25).powi(2) / 2.0).abs() < 1e-12);
        assert!(r(89.9999) > 0.999);
    }
}
