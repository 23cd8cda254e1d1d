//! The number of the course as solid characters with rounded edges.

use crate::circle;
use crate::glyphs::{self, Glyph};
use crate::mesh::{Bounds, Mesh};
use crate::outline::{Ring, Sampling, area, parallel, sampled};
use crate::triangulate::triangulate;
use glam::{DVec2, dvec3};

/// The characters in a row.
const TEXT: [Glyph; 5] = [glyphs::SIX, glyphs::POINT, glyphs::EIGHT, glyphs::THREE, glyphs::SEVEN];

/// Units between a character and the next.
const GAP: f64 = 73.0;

/// From the front to the back in units.
const DEPTH: f64 = 150.0;

/// Radius of the rounded edges in units.
const ROUNDING: f64 = 22.0;

/// Spaced so that the logo has about 13,850 triangles; twice the rounding from sharp corners.
const SAMPLING: Sampling = Sampling { spacing: 20.0, clearance: 2.0 * ROUNDING };

/// The box that the scenes' cameras are made for.
pub const BOX: Bounds = Bounds { min: dvec3(-1.334, -0.275, 0.0), max: dvec3(1.363, 0.575, 0.15) };

/// The logo: its front looks along +z, up is y.
pub fn logo() -> Mesh {
    let mut mesh = Mesh::default();
    let mut pen = 0.0;
    for glyph in TEXT {
        let rings = rings(glyph);
        let left = rings[0].iter().fold(f64::INFINITY, |least, p| least.min(p.x));
        let right = rings[0].iter().fold(f64::NEG_INFINITY, |most, p| most.max(p.x));
        add_solid(&mut mesh, &rings, pen - left);
        pen += right - left + GAP;
    }
    mesh.fit(BOX);
    mesh.order_spatially();
    mesh
}

/// The outlines of a character, the solid part on their left.
fn rings(glyph: Glyph) -> Vec<Ring> {
    let turned = |(i, contour)| {
        let mut ring = sampled(contour, SAMPLING);
        if (area(&ring) > 0.0) != (i == 0) {
            ring.reverse();
        }
        ring
    };
    glyph.iter().enumerate().map(turned).collect()
}

/// Distance inside the outline and height of the levels of a solid, front to back: a quarter of
/// a circle, the side, and another quarter.
fn levels() -> Vec<(f64, f64)> {
    let quarter = circle::points(circle::sixteenth_turn(), 5);
    let front = quarter.iter().map(|c| (ROUNDING * (1.0 - c.y), DEPTH - ROUNDING * (1.0 - c.x)));
    let back = quarter.iter().rev().map(|c| (ROUNDING * (1.0 - c.y), ROUNDING * (1.0 - c.x)));
    front.chain(back).collect()
}

/// Adds a character, moved to the right by `shift`.
fn add_solid(mesh: &mut Mesh, rings: &[Ring], shift: f64) {
    let first = mesh.positions.len() as u32;
    let corners = rings.iter().map(Vec::len).sum::<usize>() as u32;
    let levels = levels();
    for &(inside, height) in &levels {
        let lift = |p: DVec2| dvec3(p.x + shift, p.y, height);
        mesh.positions.extend(rings.iter().flat_map(|ring| parallel(ring, inside)).map(lift));
    }
    let last = first + (levels.len() as u32 - 1) * corners;
    let front: Vec<Ring> = rings.iter().map(|ring| parallel(ring, levels[0].0)).collect();
    for [a, b, c] in triangulate(&front) {
        mesh.triangles.push([first + a, first + b, first + c]);
        mesh.triangles.push([last + c, last + b, last + a]);
    }
    for upper in (first..last).step_by(corners as usize) {
        add_band(mesh, rings, upper, corners);
    }
}

/// Joins the level whose corners start at `upper` to the one behind it.
fn add_band(mesh: &mut Mesh, rings: &[Ring], upper: u32, corners: u32) {
    let mut start = upper;
    for ring in rings {
        let n = ring.len() as u32;
        for i in 0..n {
            let (here, next) = (start + i, start + (i + 1) % n);
            let (below, below_next) = (here + corners, next + corners);
            mesh.triangles.extend([[below, below_next, next], [below, next, here]]);
        }
        start += n;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Insetting an outline must not fold it: triangles of the front stay left-handed in the
    /// plane after the coordinates are rounded, and no edge of the rounding turns inwards.
    #[test]
    fn rounded_edges_do_not_fold() {
        for glyph in TEXT {
            for ring in rings(glyph) {
                let inside = parallel(&ring, ROUNDING);
                for i in 0..ring.len() {
                    let j = (i + 1) % ring.len();
                    let (edge, inset) = (ring[j] - ring[i], inside[j] - inside[i]);
                    assert!(edge.dot(inset) > 0.05 * edge.length_squared(), "{} {inset}", ring[i]);
                }
            }
        }
    }
}
