//! Mirrors and glass: directions and fractions of light at a smooth surface.
//!
//! Source: Born and Wolf, Principles of Optics, §1.5 (Snell's law, Fresnel's formulae).

use common::math::DVec3;

/// The mirrored direction I − 2(I·N)N, for `normal` of unit length on either side.
pub fn mirror(incoming: DVec3, normal: DVec3) -> DVec3 {
    incoming - 2.0 * incoming.dot(normal) * normal
}

/// Relative index n₁/n₂ at a surface of an object with `index` inside and 1 outside. I·N > 0
/// for the outward normal means leaving.
fn relative_index(incoming: DVec3, normal: DVec3, index: f64) -> f64 {
    if incoming.dot(normal) > 0.0 { index } else { 1.0 / index }
}

/// The refracted unit direction by Snell's law, or `None` at total internal reflection.
/// `incoming` and the outward `normal` have unit length.
pub fn refract(incoming: DVec3, normal: DVec3, index: f64) -> Option<DVec3> {
    let eta = relative_index(incoming, normal, index);
    let facing = if incoming.dot(normal) > 0.0 { -normal } else { normal };
    let cos_in = -incoming.dot(facing);
    let cos_out_squared = 1.0 - eta * eta * (1.0 - cos_in * cos_in);
    (cos_out_squared >= 0.0)
        .then(|| (eta * incoming + (eta * cos_in - cos_out_squared.sqrt()) * facing).normalize())
}

/// The fraction in [0, 1] of unpolarised light that the surface of a dielectric reflects: the
/// mean of Fresnel's two polarisations; 1 at total internal reflection.
pub fn fresnel_reflectance(incoming: DVec3, normal: DVec3, index: f64) -> f64 {
    let Some(refracted) = refract(incoming, normal, index) else {
        return 1.0;
    };
    let eta = relative_index(incoming, normal, index);
    let (cos_in, cos_out) = (incoming.dot(normal).abs(), refracted.dot(normal).abs());
    let across = (eta * cos_in - cos_out) / (eta * cos_in + cos_out);
    let along = (cos_in - eta * cos_out) / (cos_in + eta * cos_out);
    (across * across + along * along) / 2.0
}

/// What is left of light after `distance` inside: exp(−absorption·distance). Without
/// absorption nothing is lost, even on an infinite way.
pub(crate) fn transmittance(absorption: DVec3, distance: f64) -> DVec3 {
    absorption.map(|a| if a == 0.0 { 1.0 } else { (-a * distance).exp() })
}
