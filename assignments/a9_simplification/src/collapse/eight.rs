//! Eight faces of a surface side by side: their normals, the balls around them, and the cells that they meet.

use crate::collapse::lattice::{Lattice, Met};
use crate::collapse::packed::{Packed, Scale};
use crate::collapse::surface::Surface;
use common::math::Vec3;
use common::math::lanes::{LANES, Vectors, add, dot, narrow, scale, subtract, turn, widen};
use common::simd::{Simd, SimdBase, SimdFloat, f32x4, f32x8, f64x8, i32x8};

/// Eight numbers from one on, below a limit: where that comes too soon, the last one again and again.
#[inline(always)]
pub(super) fn eight_from(first: u32, limit: u32) -> [u32; LANES] {
    std::array::from_fn(|lane| (first + lane as u32).min(limit - 1))
}

/// Where places are seen from, and in what unit.
#[derive(Clone, Copy)]
pub(super) struct Frame {
    pub origin: Vec3,
    pub unit: f32,
}

impl Frame {
    /// Eight places as they are seen.
    #[inline(always)]
    fn seen<S: Simd>(&self, simd: S, places: Vectors<f32x8<S>>) -> Vectors<f32x8<S>> {
        let of = |x: f32| f32x8::splat(simd, x);
        let origin = [of(self.origin.x), of(self.origin.y), of(self.origin.z)];
        scale(subtract(places, origin), of(self.unit))
    }
}

/// What is known of eight faces.
pub(super) struct Eight {
    pub balls: Packed,
    pub cells: Met,
}

impl Eight {
    #[inline(always)]
    pub(super) fn new<S: Simd>(
        simd: S,
        surface: &Surface,
        faces: &[u32; LANES],
        (frame, units, lattice): (Frame, Scale, Lattice),
    ) -> Self {
        let [a, b, c] = corners(simd, surface, faces);
        let [a, b, c] = [frame.seen(simd, a), frame.seen(simd, b), frame.seen(simd, c)];
        let middle = scale(add(add(a, b), c), f32x8::splat(simd, 1.0 / 3.0));
        let (a_away, b_away, c_away) = (subtract(a, middle), subtract(b, middle), subtract(c, middle));
        let reach = dot(a_away, a_away).max(dot(b_away, b_away)).max(dot(c_away, c_away)).sqrt();
        let low = [a[0].min(b[0]).min(c[0]), a[1].min(b[1]).min(c[1]), a[2].min(b[2]).min(c[2])];
        let high = [a[0].max(b[0]).max(c[0]), a[1].max(b[1]).max(c[1]), a[2].max(b[2]).max(c[2])];
        let (low, high) = narrowed(simd, (low, high), lattice.spread());
        Self { balls: units.balls(simd, middle, reach), cells: lattice.met(simd, low, high) }
    }

    /// Whether one of them is too large for cells.
    #[inline(always)]
    pub(super) fn is_large(&self, lane: usize) -> bool {
        (self.balls.too_large | self.cells.many) >> lane & 1 != 0
    }
}

/// Boxes that are smaller by so much on every side, but no less than their middles.
#[inline(always)]
fn narrowed<S: Simd>(
    simd: S,
    (low, high): (Vectors<f32x8<S>>, Vectors<f32x8<S>>),
    by: f32,
) -> (Vectors<f32x8<S>>, Vectors<f32x8<S>>) {
    let (zero, half, by) = (f32x8::splat(simd, 0.0), f32x8::splat(simd, 0.5), f32x8::splat(simd, by));
    let middle = scale(add(low, high), half);
    let [x, y, z] = subtract(scale(subtract(high, low), half), [by; 3]);
    let left = [x.max(zero), y.max(zero), z.max(zero)];
    (subtract(middle, left), add(middle, left))
}

/// Normals of eight faces, as long as twice the area, with the bits of [`Surface::normal`].
#[inline(always)]
pub(super) fn normals<S: Simd>(simd: S, surface: &Surface, faces: &[u32; LANES]) -> Vectors<f64x8<S>> {
    normals_of(corners_at(simd, surface, faces))
}

/// The same by corners.
#[inline(always)]
pub(super) fn normals_of<S: Simd>([a, b, c]: [Vectors<f64x8<S>>; 3]) -> Vectors<f64x8<S>> {
    let (u, v) = (subtract(b, a), subtract(c, a));
    [u[1] * v[2] - v[1] * u[2], u[2] * v[0] - v[2] * u[0], u[0] * v[1] - v[0] * u[1]]
}

/// The corners of eight faces, with the bits of [`Surface::places`].
#[inline(always)]
pub(super) fn corners_at<S: Simd>(
    simd: S,
    surface: &Surface,
    faces: &[u32; LANES],
) -> [Vectors<f64x8<S>>; 3] {
    let unit = f64x8::splat(simd, surface.scale);
    let [a, b, c] = corners(simd, surface, faces);
    [scale(wide(simd, a), unit), scale(wide(simd, b), unit), scale(wide(simd, c), unit)]
}

/// Eight points, with the bits of [`Surface::at`].
#[inline(always)]
pub(super) fn points_at<S: Simd>(simd: S, surface: &Surface, points: &[u32; LANES]) -> Vectors<f64x8<S>> {
    scale(wide(simd, places(simd, surface, points)), f64x8::splat(simd, surface.scale))
}

/// In double precision. Not by a closure, which would be a call of its own.
#[inline(always)]
fn wide<S: Simd>(simd: S, v: Vectors<f32x8<S>>) -> Vectors<f64x8<S>> {
    [widen(simd, v[0]), widen(simd, v[1]), widen(simd, v[2])]
}

/// In terms of the largest component.
#[inline(always)]
pub(super) fn by_largest<S: Simd>([x, y, z]: Vectors<f64x8<S>>) -> Vectors<f64x8<S>> {
    let largest = x.abs().max(y.abs().max(z.abs()));
    [x / largest, y / largest, z / largest]
}

/// Eight directions, each in units of 1/511 of its largest component, ten bits for each. Of a normal without length all
/// are zero, along which every direction looks.
#[inline(always)]
pub(super) fn looks<S: Simd>(simd: S, normal: Vectors<f64x8<S>>) -> [i32; LANES] {
    let [x, y, z] = by_largest(normal);
    let (x, y, z) = (ten_bits(simd, x), ten_bits(simd, y), ten_bits(simd, z));
    let mut looks = [0; LANES];
    (x | (y << 10) | (z << 20)).store_slice(&mut looks);
    looks
}

/// Numbers from −1 to 1 in units of 1/511, with ten bits; 0 for what is no number.
#[inline(always)]
fn ten_bits<S: Simd>(simd: S, x: f64x8<S>) -> i32x8<S> {
    let x = x * f64x8::splat(simd, 511.0);
    let rounded = (x + f64x8::splat(simd, 0.5).copysign(x)).trunc();
    simd.cvt_i32_f32x8(narrow(simd, rounded)) & i32x8::splat(simd, 1023)
}

/// The corners of eight faces, in the unit of the mesh.
#[inline(always)]
fn corners<S: Simd>(simd: S, surface: &Surface, faces: &[u32; LANES]) -> [Vectors<f32x8<S>>; 3] {
    let mut points = [[0; LANES]; 3];
    for lane in 0..LANES {
        [points[0][lane], points[1][lane], points[2][lane]] = surface.faces[faces[lane] as usize].corners();
    }
    let [a, b, c] = &points;
    [places(simd, surface, a), places(simd, surface, b), places(simd, surface, c)]
}

/// Where eight points are.
#[inline(always)]
fn places<S: Simd>(simd: S, surface: &Surface, [a, b, c, d, e, f, g, h]: &[u32; LANES]) -> Vectors<f32x8<S>> {
    let [x, y, z, _] = turn(
        simd,
        [row(simd, surface, *a), row(simd, surface, *b), row(simd, surface, *c), row(simd, surface, *d)],
    );
    let [u, v, w, _] = turn(
        simd,
        [row(simd, surface, *e), row(simd, surface, *f), row(simd, surface, *g), row(simd, surface, *h)],
    );
    [simd.combine_f32x4(x, u), simd.combine_f32x4(y, v), simd.combine_f32x4(z, w)]
}

#[inline(always)]
fn row<S: Simd>(simd: S, surface: &Surface, point: u32) -> f32x4<S> {
    f32x4::from_slice(simd, &surface.points[point as usize].row())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collapse::build::build;
    use crate::collapse::scattered::{random, scattered};
    use common::math::DVec3;
    use common::math::lanes::store_wide;
    use common::simd::{self, dispatch};

    /// Normals of the faces from one on, and what faces with such normals remember.
    #[inline(always)]
    fn of_eight<S: Simd>(simd: S, surface: &Surface, first: u32) -> ([DVec3; LANES], [i32; LANES]) {
        let faces = std::array::from_fn(|lane| first + lane as u32);
        let normals = normals(simd, surface, &faces);
        let [x, y, z] = store_wide(normals);
        (std::array::from_fn(|lane| DVec3::new(x[lane], y[lane], z[lane])), looks(simd, normals))
    }

    #[test]
    fn eight_normals_are_those_of_each() {
        let surface = scattered(400, &mut random());
        for first in (0..400).step_by(LANES) {
            let (normals, _) = dispatch!(simd::level(), s => of_eight(s, &surface, first));
            for (lane, normal) in normals.into_iter().enumerate() {
                assert_eq!(normal, surface.normal(first as usize + lane));
            }
        }
    }

    #[test]
    fn a_face_remembers_where_to_it_looked_and_nothing_if_it_looked_nowhere() {
        let mut surface = scattered(400, &mut random());
        for first in (0..400).step_by(LANES) {
            let (normals, looks) = dispatch!(simd::level(), s => of_eight(s, &surface, first));
            for (lane, normal) in normals.into_iter().enumerate() {
                let face = &mut surface.faces[first as usize + lane];
                face.remember(looks[lane] as u32);
                let look = DVec3::from_array(face.look().map(f64::from));
                let scaled = normal / normal.abs().max_element() * 511.0;
                assert!((look - scaled).abs().max_element() <= 0.5, "{look} for {scaled}");
                assert_eq!(look.abs().max_element(), 511.0);
            }
        }
        let line: Vec<Vec3> = (0..24).map(|i| Vec3::splat(i as f32)).collect();
        let flat = build(&line, (0..8).map(|i| [3 * i, 3 * i + 1, 3 * i + 2])).surface;
        assert!(flat.faces.iter().all(|face| face.look() == [0; 3]));
    }
}
