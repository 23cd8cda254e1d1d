//! Which face of a surface is nearest? Faces in cubic cells, looked through shell by shell.

use crate::collapse::locate::nearest;
use crate::collapse::surface::Surface;
use common::math::DVec3;

/// Cells for each face.
const CELLS: f64 = 2.0;
/// Thinnest box, in terms of its longest side.
const THINNEST: f64 = 1e-3;

/// The faces of a surface by the cells that their boxes meet.
pub(super) struct Cells<'a> {
    surface: &'a Surface,
    min: DVec3,
    /// Cells for each unit of length.
    fineness: f64,
    count: [usize; 3],
    /// The faces of cell i are `faces[first[i]..first[i + 1]]`.
    first: Vec<u32>,
    faces: Vec<u32>,
}

impl<'a> Cells<'a> {
    /// Sorts the faces of a surface.
    pub(super) fn new(surface: &'a Surface) -> Self {
        let corners = surface.faces.iter().flat_map(|face| face.corners()).map(|p| surface.at(p));
        let empty = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (min, max) = corners.fold(empty, |(min, max), p| (min.min(p), max.max(p)));
        let longest = (max - min).max_element();
        let size = (max - min).max(DVec3::splat(longest * THINNEST + f64::MIN_POSITIVE));
        let fineness =
            (CELLS * surface.faces.len() as f64 / (size / longest).element_product()).cbrt() / longest;
        let count = size.to_array().map(|side| (side * fineness) as usize + 1);
        let first = vec![0; count.iter().product::<usize>() + 1];
        let mut cells = Self { surface, min, fineness, count, first, faces: Vec::new() };
        cells.sort();
        cells
    }

    fn sort(&mut self) {
        let mut counts = std::mem::take(&mut self.first);
        self.for_each_cell(|cell, _| counts[cell + 1] += 1);
        for i in 1..counts.len() {
            counts[i] += counts[i - 1];
        }
        let mut free = counts.clone();
        let mut faces = vec![0; *counts.last().unwrap_or(&0) as usize];
        self.for_each_cell(|cell, face| {
            faces[free[cell] as usize] = face;
            free[cell] += 1;
        });
        (self.first, self.faces) = (counts, faces);
    }

    fn for_each_cell(&self, mut what: impl FnMut(usize, u32)) {
        for (i, face) in self.surface.faces.iter().enumerate() {
            let [a, b, c] = face.corners().map(|p| self.surface.at(p));
            let (low, high) = (self.cell(a.min(b).min(c)), self.cell(a.max(b).max(c)));
            for z in low[2]..=high[2] {
                for y in low[1]..=high[1] {
                    (low[0]..=high[0]).for_each(|x| what(self.number([x, y, z]), i as u32));
                }
            }
        }
    }

    fn cell(&self, p: DVec3) -> [usize; 3] {
        let cell = ((p - self.min) * self.fineness).to_array();
        // What is outside belongs to the nearest cell; the cast takes what is below to 0.
        std::array::from_fn(|axis| (cell[axis] as usize).min(self.count[axis] - 1))
    }

    fn number(&self, [x, y, z]: [usize; 3]) -> usize {
        (z * self.count[1] + y) * self.count[0] + x
    }

    /// Squared distance to the nearest face, and the face; of a surface with faces.
    pub(super) fn nearest(&self, p: DVec3) -> (f64, u32) {
        let centre = self.cell(p);
        let mut best = (f64::MAX, 0);
        let farthest = self.count.into_iter().max().unwrap_or(0);
        for shell in 0..=farthest {
            self.look_through(p, centre, shell, &mut best);
            let beyond = self.to_rim(p, centre, shell);
            if best.0 <= beyond * beyond {
                break;
            }
        }
        best
    }

    /// How far p is at least from what is in none of the shells so far.
    fn to_rim(&self, p: DVec3, centre: [usize; 3], shell: usize) -> f64 {
        let p = ((p - self.min) * self.fineness).to_array();
        let side = |axis: usize| {
            let (low, high) = (centre[axis] as f64 - shell as f64, centre[axis] as f64 + 1.0 + shell as f64);
            (p[axis] - low).min(high - p[axis])
        };
        side(0).min(side(1)).min(side(2)).max(0.0) / self.fineness
    }

    fn look_through(&self, p: DVec3, centre: [usize; 3], shell: usize, best: &mut (f64, u32)) {
        let range = |axis: usize| {
            centre[axis].saturating_sub(shell)..=(centre[axis] + shell).min(self.count[axis] - 1)
        };
        let on_rim = |axis: usize, i: usize| i.abs_diff(centre[axis]) == shell;
        for z in range(2) {
            for y in range(1) {
                let whole = on_rim(2, z) || on_rim(1, y);
                for x in range(0).filter(|&x| whole || on_rim(0, x)) {
                    self.look_into(self.number([x, y, z]), p, best);
                }
            }
        }
    }

    fn look_into(&self, cell: usize, p: DVec3, best: &mut (f64, u32)) {
        for &face in &self.faces[self.first[cell] as usize..self.first[cell + 1] as usize] {
            let [a, b, c] = self.surface.faces[face as usize].corners().map(|i| self.surface.at(i));
            let [u, v, w] = nearest(p, a, b, c);
            let square = (a * u + b * v + c * w - p).length_squared();
            if square < best.0 {
                *best = (square, face);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collapse::scattered::{random, scattered};
    use common::math::Vec3;

    #[test]
    fn finds_what_looking_at_every_face_finds() {
        let mut random = random();
        let surface = scattered(300, &mut random);
        let cells = Cells::new(&surface);
        for _ in 0..300 {
            let at = Vec3::new(random(), random(), random()) * 4.0;
            let p = (at.as_dvec3() - DVec3::ONE) * surface.scale;
            let each = surface.faces.iter().map(|face| {
                let [a, b, c] = face.corners().map(|i| surface.at(i));
                let [u, v, w] = nearest(p, a, b, c);
                (a * u + b * v + c * w - p).length_squared()
            });
            assert_eq!(cells.nearest(p).0, each.fold(f64::MAX, f64::min));
        }
    }
}
