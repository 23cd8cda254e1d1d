//! A quadric about a point in one cache line, and the planes of eight faces as what is added to such lines.

use crate::collapse::quadric::Symmetric;
use crate::collapse::rows::turned;
use common::math::lanes::{LANES, Vectors, dot, narrow, scale};
use common::math::{DVec3, Vec3};
use common::simd::{Select, Simd, SimdBase, SimdFloat, f32x8, f64x8};

/// yᵀ·A·y + 2·b·y + c for y relative to the point: the entries of A as in [`Symmetric`], those of b, and c. In single
/// precision, whose rounding is far below what the length of an edge counts, so that less memory is moved. Then where the
/// point is, so that all that an edge needs of it lies in one cache line.
#[derive(Clone, Copy, Default)]
#[repr(align(64))]
pub(super) struct Quadric(pub [f32; 16]);

impl Quadric {
    #[inline(always)]
    pub(super) fn new(Symmetric(a): Symmetric, b: DVec3, c: f64) -> Self {
        let [xx, xy, xz, yy, yz, zz] = a.map(|entry| entry as f32);
        let [x, y, z] = b.as_vec3().to_array();
        Self([xx, xy, xz, yy, yz, zz, x, y, z, c as f32, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    }

    /// The same for a point that is there.
    #[inline(always)]
    pub(super) fn at(mut self, place: Vec3) -> Self {
        [self.0[10], self.0[11], self.0[12]] = place.to_array();
        self
    }

    #[inline(always)]
    pub(super) fn a(&self) -> Symmetric {
        let [xx, xy, xz, yy, yz, zz, ..] = self.0;
        Symmetric([xx, xy, xz, yy, yz, zz].map(f64::from))
    }

    #[inline(always)]
    pub(super) fn b(&self) -> DVec3 {
        let [_, _, _, _, _, _, x, y, z, ..] = self.0;
        DVec3::new(x.into(), y.into(), z.into())
    }

    #[inline(always)]
    pub(super) fn c(&self) -> f64 {
        self.0[9].into()
    }

    /// Where the point is, in the unit of the mesh.
    #[inline(always)]
    pub(super) fn place(&self) -> DVec3 {
        Vec3::new(self.0[10], self.0[11], self.0[12]).as_dvec3()
    }

    #[inline(always)]
    pub(super) fn plus(&self, other: &Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] + other.0[i]))
    }

    /// Adds to A, and to b.x and b.y.
    #[inline(always)]
    pub(super) fn add_row<S: Simd>(&mut self, simd: S, row: f32x8<S>) {
        (f32x8::from_slice(simd, &self.0[..LANES]) + row).store_slice(&mut self.0[..LANES]);
    }

    /// Adds to A.
    #[inline(always)]
    pub(super) fn add(&mut self, plane_or_line: &[f32; 6]) {
        self.0.iter_mut().zip(plane_or_line).for_each(|(sum, entry)| *sum += entry);
    }

    /// The same about a point that is `step` away.
    #[inline(always)]
    pub(super) fn moved(&self, step: DVec3) -> Self {
        let (a, b) = (self.a(), self.b());
        let across = a.times(step);
        // Not below zero but for rounding.
        Self::new(a, b + across, (step.dot(across + b * 2.0) + self.c()).max(0.0))
    }
}

/// Entries of A for the planes of eight faces, by their normals; see [`plane`](crate::collapse::memoryless::plane).
#[inline(always)]
pub(super) fn planes<S: Simd>(simd: S, normal: Vectors<f64x8<S>>) -> [f32x8<S>; LANES] {
    let zero = f64x8::splat(simd, 0.0);
    let length2 = dot(normal, normal);
    let root = length2.sqrt().sqrt();
    let weight = length2.simd_gt(zero).select(f64x8::splat(simd, 1.0) / (root * root * root), zero);
    let [x, y, z] = scale(normal, weight);
    let none = f32x8::splat(simd, 0.0);
    let entries = [
        narrow(simd, x * normal[0]),
        narrow(simd, x * normal[1]),
        narrow(simd, x * normal[2]),
        narrow(simd, y * normal[1]),
        narrow(simd, y * normal[2]),
        narrow(simd, z * normal[2]),
        none,
        none,
    ];
    turned(simd, entries)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collapse::eight::normals;
    use crate::collapse::memoryless::plane;
    use crate::collapse::scattered::{random, scattered};
    use crate::collapse::surface::Surface;
    use common::simd::{self, dispatch};

    #[inline(always)]
    fn rows<S: Simd>(simd: S, surface: &Surface, faces: &[u32; LANES]) -> [[f32; LANES]; LANES] {
        let mut rows = [[0.0; LANES]; LANES];
        for (row, plane) in rows.iter_mut().zip(planes(simd, normals(simd, surface, faces))) {
            plane.store_slice(row);
        }
        rows
    }

    #[test]
    fn planes_of_eight_faces_are_those_of_each() {
        let mut surface = scattered(400, &mut random());
        // One without area.
        let [a, _, c] = surface.faces[7].corners().map(|point| point as usize);
        surface.points[c].at = surface.points[a].at;
        for first in (0..400).step_by(LANES) {
            let faces = std::array::from_fn(|lane| first + lane as u32);
            let rows = dispatch!(simd::level(), s => rows(s, &surface, &faces));
            for (face, row) in faces.into_iter().zip(rows) {
                let [xx, xy, xz, yy, yz, zz] = plane(surface.normal(face as usize)).single();
                assert_eq!(row, [xx, xy, xz, yy, yz, zz, 0.0, 0.0]);
            }
        }
    }
}
