//! A binary tree of boxes, cut at the median of the longest side, without pointers.

use super::triangle::Line;
use super::{MISS, Truth};
use common::math::{DVec3, Vec3};
use common::mesh::Mesh;
use common::ray::Ray;
use rayon::prelude::*;

/// Most triangles of a leaf.
const LEAF: usize = 4;
/// Nodes with fewer triangles are cut by one thread.
const WORTH_A_THREAD: usize = 4096;
/// Boxes are widened by this share of the largest coordinate. A slab test is off by a few 2⁻⁵³
/// of the distance, so origins may be a thousand times as far away as the mesh is large.
const PAD: f64 = 1e-12;

/// A box in double precision.
#[derive(Clone, Copy, Debug)]
struct Cell {
    min: DVec3,
    max: DVec3,
}

const NOTHING: Cell = Cell { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };

impl Cell {
    fn union(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// Where the line enters, if it does so before `last`; written so that a NaN, which a line
    /// in the plane of a side gives, counts as met.
    fn entered(&self, line: &Line, inverse: DVec3, last: f64) -> Option<f64> {
        let (mut enter, mut exit) = (0.0, last);
        for axis in 0..3 {
            let a = (self.min[axis] - line.origin[axis]) * inverse[axis];
            let b = (self.max[axis] - line.origin[axis]) * inverse[axis];
            let (near, far) = if a > b { (b, a) } else { (a, b) };
            if near > enter {
                enter = near;
            }
            if far < exit {
                exit = far;
            }
        }
        (enter <= exit).then_some(enter)
    }
}

/// The tree over a mesh. Node i has the children 2i + 1 and 2i + 2 and holds half of its
/// parent's triangles, so that a node's place says which ones.
pub struct Tree<'m> {
    mesh: &'m Mesh,
    order: Vec<u32>,
    cells: Vec<Cell>,
    depth: u32,
}

impl<'m> Tree<'m> {
    /// Builds the tree with all threads.
    pub fn new(mesh: &'m Mesh) -> Self {
        let centers: Vec<Vec3> = mesh.triangles.iter().map(|t| middle(corners(mesh, t))).collect();
        let mut order: Vec<u32> = (0..mesh.triangles.len() as u32).collect();
        let depth = mesh.triangles.len().div_ceil(LEAF).max(1).next_power_of_two().ilog2();
        divide(&mut order, &centers, depth);
        let mut tree = Self { mesh, order, cells: Vec::new(), depth };
        tree.cells = tree.boxes();
        tree
    }

    /// How many triangles it holds.
    pub fn triangles(&self) -> usize {
        self.order.len()
    }

    /// The nearest hit with 0 < t < `reach`.
    pub fn nearest(&self, ray: &Ray, reach: f64) -> Truth {
        let line = Line::new(ray);
        let inverse = line.direction.recip();
        let mut best = Truth { t: f64::INFINITY, primitive: MISS };
        let mut waiting = vec![(0usize, 0..self.order.len(), 0.0)];
        while let Some((node, range, entered)) = waiting.pop() {
            let last = best.t.min(reach);
            if entered > last {
                continue;
            }
            if node + 1 >= 1 << self.depth {
                self.ask(&self.order[range], &line, reach, &mut best);
                continue;
            }
            let middle = range.start + range.len() / 2;
            let halves = [(2 * node + 1, range.start..middle), (2 * node + 2, middle..range.end)];
            let met = halves
                .map(|(child, range)| Some((child, range, self.cells[child].entered(&line, inverse, last)?)));
            let first = match &met {
                [Some(lower), Some(upper)] => usize::from(upper.2 < lower.2),
                _ => 0,
            };
            let [lower, upper] = met;
            let (near, far) = if first == 0 { (lower, upper) } else { (upper, lower) };
            waiting.extend(far);
            waiting.extend(near);
        }
        best
    }

    /// The nearest hits of many rays, by all threads.
    pub fn trace(&self, rays: &[Ray], reach: f64) -> Vec<Truth> {
        rays.par_iter().with_min_len(256).map(|ray| self.nearest(ray, reach)).collect()
    }

    fn ask(&self, triangles: &[u32], line: &Line, reach: f64, best: &mut Truth) {
        for &primitive in triangles {
            let met = line.meets(corners(self.mesh, &self.mesh.triangles[primitive as usize]));
            let Some(t) = met.filter(|t| *t > 0.0 && *t < reach) else { continue };
            if t < best.t || (t == best.t && primitive < best.primitive) {
                *best = Truth { t, primitive };
            }
        }
    }

    /// The boxes of all nodes, widened: leaves first, parents from their children.
    fn boxes(&self) -> Vec<Cell> {
        let leaves = 1usize << self.depth;
        let mut cells = vec![NOTHING; 2 * leaves - 1];
        let mut ranges: Vec<_> = std::iter::once(0..self.order.len()).collect();
        for _ in 0..self.depth {
            let halves = |r: std::ops::Range<usize>| {
                let middle = r.start + r.len() / 2;
                [r.start..middle, middle..r.end]
            };
            ranges = ranges.into_iter().flat_map(halves).collect();
        }
        let leaf = |range: &std::ops::Range<usize>| {
            let held = self.order[range.clone()].iter();
            let points = held.flat_map(|&t| corners(self.mesh, &self.mesh.triangles[t as usize]));
            points.map(|p| p.as_dvec3()).fold(NOTHING, |b, p| b.union(Cell { min: p, max: p }))
        };
        cells[leaves - 1..].par_iter_mut().zip(&ranges).for_each(|(cell, range)| *cell = leaf(range));
        for node in (0..leaves - 1).rev() {
            cells[node] = cells[2 * node + 1].union(cells[2 * node + 2]);
        }
        let size = cells[0].min.abs().max(cells[0].max.abs()).max_element();
        let pad = DVec3::splat(PAD * size);
        cells.par_iter_mut().for_each(|c| *c = Cell { min: c.min - pad, max: c.max + pad });
        cells
    }
}

fn corners(mesh: &Mesh, triangle: &[u32; 3]) -> [Vec3; 3] {
    triangle.map(|v| mesh.positions[v as usize])
}

/// The centre of a triangle's box.
fn middle([a, b, c]: [Vec3; 3]) -> Vec3 {
    (a.min(b).min(c) + a.max(b).max(c)) / 2.0
}

/// Orders triangles so that each half of the slice lies on one side of a plane, `depth` times.
fn divide(order: &mut [u32], centers: &[Vec3], depth: u32) {
    if depth == 0 || order.len() < 2 {
        return;
    }
    let at = |t: u32| centers[t as usize];
    let (min, max) = order
        .iter()
        .fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(lo, hi), t| (lo.min(at(*t)), hi.max(at(*t))));
    let size = max - min;
    let axis = (0..3).fold(0, |best, a| if size[a] > size[best] { a } else { best });
    let middle = order.len() / 2;
    order.select_nth_unstable_by(middle, |a, b| at(*a)[axis].total_cmp(&at(*b)[axis]).then(a.cmp(b)));
    let (lower, upper) = order.split_at_mut(middle);
    if lower.len() < WORTH_A_THREAD {
        divide(lower, centers, depth - 1);
        divide(upper, centers, depth - 1);
    } else {
        rayon::join(|| divide(lower, centers, depth - 1), || divide(upper, centers, depth - 1));
    }
}

#[cfg(test)]
mod tests;
