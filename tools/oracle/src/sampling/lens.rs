//! Places on a lens.

use super::grid;
use common::math::DVec3;
use common::scene::Lens;
use std::f64::consts::TAU;

/// About `side`² places, spread evenly over the opening, (right, up, 0) from its middle in
/// units of its radius. One is the middle.
pub(crate) fn lens_places(lens: &Lens, side: u32) -> Vec<DVec3> {
    if side == 1 {
        return vec![DVec3::ZERO];
    }
    match lens.blades {
        // Areas grow with the square of the radius.
        None => grid(side).map(|[u, v]| u.sqrt() * at_turn(v)).collect(),
        Some(blades) => polygon(blades, side),
    }
}

/// Each of the triangles between the middle and two corners in turn.
fn polygon(blades: u32, side: u32) -> Vec<DVec3> {
    let corner = |i: u32| at_turn(f64::from(i) / f64::from(blades));
    let per_blade = side.div_ceil(blades).max(2);
    let mut places = Vec::new();
    for blade in 0..blades {
        for row in 0..side {
            let outward = ((f64::from(row) + 0.5) / f64::from(side)).sqrt();
            let along = (0..per_blade).map(|i| (f64::from(i) + 0.5) / f64::from(per_blade));
            places.extend(along.map(|part| outward * corner(blade).lerp(corner(blade + 1), part)));
        }
    }
    places
}

/// The place on the rim at a part of a full turn, clockwise from the top.
fn at_turn(part: f64) -> DVec3 {
    let (sin, cos) = (TAU * part).sin_cos();
    DVec3::new(sin, cos, 0.0)
}
