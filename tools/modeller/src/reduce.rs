//! Fewer triangles: edges are drawn together to a point, those that change the shape least first.
//!
//! What "least" means is told by [`Quadric`]; whether a step is allowed at all, here.

use crate::mesh::Mesh;
use crate::quadric::Quadric;
use glam::DVec3;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// A triangle's normal may turn by at most 60° in one step.
const LEAST_COSINE: f64 = 0.5;
/// Least shape that a step may leave, from 0 for a needle to 1 for an equilateral triangle.
const LEAST_SHAPE: f64 = 0.12;

/// The closed manifold `mesh` with `target` triangles (or one more, if the parities differ).
///
/// # Panics
/// If no edge can be drawn together any more before the target is reached.
pub fn reduce(mesh: &Mesh, target: usize) -> Mesh {
    let mut work = Work::new(mesh);
    while work.count > target {
        let before = work.count;
        work.pass(target);
        assert!(work.count < before, "stuck at {before} triangles on the way to {target}");
    }
    work.finish()
}

/// An edge in the queue. Ordered by cost, then by name, so that equal costs are always taken in the
/// same order.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct Candidate {
    /// Bits of the cost: for numbers that are not negative they sort as the numbers do.
    cost: u64,
    edge: [u32; 2],
    /// States of the two vertices when the cost was computed; it is out of date if they have
    /// changed.
    states: [u32; 2],
}

struct Work {
    positions: Vec<DVec3>,
    quadrics: Vec<Quadric>,
    states: Vec<u32>,
    /// Triangles round each vertex.
    fans: Vec<Vec<u32>>,
    triangles: Vec<[u32; 3]>,
    alive: Vec<bool>,
    count: usize,
}

impl Work {
    fn new(mesh: &Mesh) -> Self {
        let n = mesh.positions.len();
        let mut work = Work {
            positions: mesh.positions.clone(),
            quadrics: vec![Quadric::ZERO; n],
            states: vec![0; n],
            fans: vec![Vec::new(); n],
            triangles: mesh.triangles.clone(),
            alive: vec![true; mesh.triangles.len()],
            count: mesh.triangles.len(),
        };
        for (t, corners) in mesh.triangles.iter().enumerate() {
            let [a, b, c] = mesh.corners(t);
            let normal = (b - a).cross(c - a);
            for &v in corners {
                let p = mesh.positions[v as usize];
                let quadric = Quadric::new(p, normal.normalize_or_zero(), normal.length());
                work.quadrics[v as usize] = work.quadrics[v as usize].plus(&quadric);
                work.fans[v as usize].push(t as u32);
            }
        }
        work
    }

    /// Draws edges together, cheapest first, until `target` triangles are left or every edge has
    /// been tried.
    fn pass(&mut self, target: usize) {
        let mut queue = BinaryHeap::new();
        for t in (0..self.triangles.len()).filter(|&t| self.alive[t]) {
            let [a, b, c] = self.triangles[t];
            // Each edge belongs to two triangles, which name it in opposite directions.
            let edges = [[a, b], [b, c], [c, a]];
            queue
                .extend(edges.into_iter().filter(|[v, w]| v < w).map(|[v, w]| Reverse(self.candidate(v, w))));
        }
        while self.count > target {
            let Some(Reverse(candidate)) = queue.pop() else {
                return;
            };
            let [v, w] = candidate.edge;
            if candidate.states == [self.states[v as usize], self.states[w as usize]] && self.collapse(v, w) {
                queue.extend(
                    self.neighbours(v).into_iter().map(|n| Reverse(self.candidate(v.min(n), v.max(n)))),
                );
            }
        }
    }

    fn candidate(&self, v: u32, w: u32) -> Candidate {
        let (_, cost) = self.quadrics[v as usize].plus(&self.quadrics[w as usize]).least();
        Candidate {
            cost: cost.to_bits(),
            edge: [v, w],
            states: [self.states[v as usize], self.states[w as usize]],
        }
    }

    /// The vertices joined to `v` by an edge, in ascending order.
    fn neighbours(&self, v: u32) -> Vec<u32> {
        let corners = self.fans[v as usize].iter().flat_map(|&t| self.triangles[t as usize]);
        let mut around: Vec<u32> = corners.filter(|&n| n != v).collect();
        around.sort_unstable();
        around.dedup();
        around
    }

    /// Draws `w` into `v`, unless that would pinch the surface, fold it or leave a needle. Tells
    /// whether it was done.
    fn collapse(&mut self, v: u32, w: u32) -> bool {
        let quadric = self.quadrics[v as usize].plus(&self.quadrics[w as usize]);
        let (p, _) = quadric.least();
        if !self.keeps_manifold(v, w) || !self.keeps_shape(v, w, p) || !self.keeps_shape(w, v, p) {
            return false;
        }
        for t in std::mem::take(&mut self.fans[w as usize]) {
            let corners = &mut self.triangles[t as usize];
            if corners.contains(&v) {
                self.alive[t as usize] = false;
                self.count -= 1;
                for &corner in self.triangles[t as usize].iter().filter(|&&c| c != w) {
                    self.fans[corner as usize].retain(|&other| other != t);
                }
            } else {
                *corners = corners.map(|c| if c == w { v } else { c });
                self.fans[v as usize].push(t);
            }
        }
        self.positions[v as usize] = p;
        self.quadrics[v as usize] = quadric;
        self.states[v as usize] += 1;
        self.states[w as usize] += 1;
        true
    }

    /// The link condition (Dey et al. 1999): the ends of the edge may only share the two vertices
    /// opposite to it.
    fn keeps_manifold(&self, v: u32, w: u32) -> bool {
        let (a, b) = (self.neighbours(v), self.neighbours(w));
        self.count > 4 && a.iter().filter(|n| b.binary_search(n).is_ok()).count() == 2
    }

    /// Whether the triangles round `moved` that do not hold `other` stay upright and well shaped
    /// when it moves to `p`.
    fn keeps_shape(&self, moved: u32, other: u32, p: DVec3) -> bool {
        self.fans[moved as usize]
            .iter()
            .map(|&t| self.triangles[t as usize])
            .filter(|c| !c.contains(&other))
            .all(|corners| {
                let old = corners.map(|c| self.positions[c as usize]);
                let new = corners.map(|c| if c == moved { p } else { self.positions[c as usize] });
                let (before, after) = (normal(old), normal(new));
                let upright = before.dot(after) > LEAST_COSINE * before.length() * after.length();
                // What is a needle already may stay one as long as it gets no worse.
                upright && shape(new) > LEAST_SHAPE.min(shape(old))
            })
    }

    fn finish(self) -> Mesh {
        let kept = self.triangles.into_iter().zip(self.alive).filter(|(_, alive)| *alive).map(|(t, _)| t);
        Mesh { positions: self.positions, triangles: kept.collect() }.numbered_by_first_use()
    }
}

/// Normal of twice the triangle's area.
fn normal([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a)
}

/// 1 for an equilateral triangle, towards 0 for a needle: area over summed squared edges, scaled.
fn shape([a, b, c]: [DVec3; 3]) -> f64 {
    let edges = a.distance_squared(b) + b.distance_squared(c) + c.distance_squared(a);
    2.0 * 3.0_f64.sqrt() * normal([a, b, c]).length() / edges
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check;
    use crate::mesh::Bounds;
    use crate::polygonise::polygonise;

    #[test]
    fn a_ball_stays_a_ball_down_to_few_triangles() {
        let bounds = Bounds { min: DVec3::splat(-1.2), max: DVec3::splat(1.2) };
        let fine = polygonise(|p| p.length() - 1.0, bounds, 0.1);
        for (target, most) in [(1000, 0.03), (200, 0.15), (50, 0.35)] {
            let coarse = reduce(&fine, target);
            assert_eq!(coarse.triangles.len(), target);
            check::closed_manifold(&coarse).unwrap();
            assert_eq!(check::euler_characteristic(&coarse), 2);
            let off = coarse.positions.iter().map(|p| (p.length() - 1.0).abs()).fold(0.0, f64::max);
            assert!(off < most, "{target} triangles: a vertex is {off} away from the ball");
        }
    }

    #[test]
    fn a_flat_face_costs_nothing_so_a_box_keeps_its_corners() {
        let bounds = Bounds { min: DVec3::splat(-1.35), max: DVec3::splat(1.35) };
        let fine = polygonise(|p| p.abs().max_element() - 1.0, bounds, 0.1);
        let coarse = reduce(&fine, 300);
        check::closed_manifold(&coarse).unwrap();
        assert!((check::volume(&coarse) - check::volume(&fine)).abs() < 0.02);
    }
}
