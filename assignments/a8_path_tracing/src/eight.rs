//! What is done for eight paths side by side, with the bits that each would get alone.

use common::math::circle::sine_and_cosine;
use common::math::lanes::Vectors;
use common::simd::{Select, Simd, SimdFloat};
use std::f64::consts::FRAC_PI_4;

/// The squares' points become points of circles, as [`a7_sampling::aperture::disc`] takes them in
/// double and [`crate::bsdf`] in single precision. `terms` is how many of a sine's series that wants,
/// `of` makes the same number in all lanes.
#[inline(always)]
pub fn disc<S: Simd, V: SimdFloat<S>>([u, v]: [V; 2], terms: usize, of: impl Fn(f64) -> V) -> (V, V) {
    let (x, y) = (of(2.0) * u - of(1.0), of(2.0) * v - of(1.0));
    let is_wide = x.abs().simd_gt(y.abs());
    let (radius, aside) = (is_wide.select(x, y), is_wide.select(y, x));
    let angle = of(FRAC_PI_4) * (aside / radius);
    let (sine, cosine) = sine_and_cosine(angle, terms, &of);
    let (along, across) = (radius * cosine, radius * sine);
    let is_center = radius.simd_eq(of(0.0));
    let (x, y) = (is_wide.select(along, across), is_wide.select(across, along));
    (is_center.select(of(0.0), x), is_center.select(of(0.0), y))
}

/// Two unit vectors that are perpendicular to a third and to each other, as `glam` finds them (Duff
/// et al., "Building an orthonormal basis, revisited", 2017).
#[inline(always)]
pub fn orthonormal_pair<S: Simd, V: SimdFloat<S>>([x, y, z]: Vectors<V>, one: V) -> [Vectors<V>; 2] {
    let sign = one.copysign(z);
    let a = -one / (sign + z);
    let b = x * y * a;
    [[one + sign * x * x * a, sign * b, -sign * x], [b, sign + y * y * a, -y]]
}
