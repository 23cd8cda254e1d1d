//! The corners around each point, and who is whose neighbour there: eight corners are asked side by side.

use crate::collapse::counted::{begin, begin_again};
use crate::collapse::surface::{Face, NONE, Surface, previous};
use common::math::lanes::LANES;
use common::simd::{Simd, SimdBase, SimdMask, i32x8};

/// Half-edges by the points that they leave: those of point p are `leaves[first[p]..first[p + 1]]`.
pub(super) struct Around {
    first: Vec<u32>,
    leaves: Vec<u32>,
}

impl Around {
    /// Of a surface; `first` tells how many half-edges leave each point, and 0.
    pub(super) fn new(surface: &Surface, mut first: Vec<u32>) -> Self {
        let mut leaves = vec![0; begin(&mut first) as usize];
        for (face, corners) in (0..).zip(surface.faces.iter().map(Face::corners)) {
            for (h, point) in (4 * face..).zip(corners) {
                let free = &mut first[point as usize];
                leaves[*free as usize] = h;
                *free += 1;
            }
        }
        begin_again(&mut first);
        Self { first, leaves }
    }

    /// The half-edges that leave a point.
    #[inline(always)]
    pub(super) fn of(&self, point: u32) -> &[u32] {
        let point = point as usize;
        &self.leaves[self.first[point] as usize..self.first[point + 1] as usize]
    }
}

impl Surface {
    /// Pairs what leaves a point with what comes back. Whether that leads once through all of them, and they are not more
    /// than eight: then no two share a side in the same direction.
    #[inline(always)]
    pub(super) fn join_circle<S: Simd>(&mut self, simd: S, leaves: &[u32]) -> bool {
        if leaves.len() > LANES {
            return false;
        }
        let (mut ends, mut starts, mut to) = ([NONE as i32; LANES], [0; LANES], [0; LANES]);
        for (lane, &h) in leaves.iter().enumerate() {
            ends[lane] = self.end(h) as i32;
            starts[lane] = self.start(previous(h)) as i32;
        }
        let ends = i32x8::from_slice(simd, &ends);
        for (lane, &h) in leaves.iter().enumerate() {
            let found = ends.simd_eq(i32x8::splat(simd, starts[lane])).to_bitmask();
            if !found.is_power_of_two() {
                return false;
            }
            to[lane] = found.trailing_zeros() as usize;
            self.set_twin(leaves[to[lane]], previous(h));
        }
        let (mut lane, mut steps) = (to[0], 1);
        while lane != 0 && steps < leaves.len() {
            (lane, steps) = (to[lane & (LANES - 1)], steps + 1);
        }
        lane == 0 && steps == leaves.len()
    }
}

#[cfg(test)]
mod tests {
    use crate::collapse::build::build;
    use crate::collapse::surface::NONE;
    use common::math::Vec3;

    #[test]
    fn twins_are_those_that_run_the_other_way_however_many_meet() {
        for sides in [3, 7, 8, 9, 14] {
            // Two tips over a ring; of the last side only one face, so that there is a boundary.
            let ring = |i: u32| 2 + i % sides;
            let upper = (0..sides).map(|i| [0, ring(i), ring(i + 1)]);
            let lower = (0..sides - 1).map(|i| [1, ring(i + 1), ring(i)]);
            let places: Vec<Vec3> =
                (0..sides + 2).map(|i| Vec3::new(i as f32, (i * i) as f32, 1.0)).collect();
            let built = build(&places, upper.chain(lower));
            let (surface, cut) = (built.surface, built.cut);
            assert!(!cut.contains(&true) && surface.points.len() == places.len());
            let half_edges = || (0..surface.faces.len() as u32).flat_map(|face| 4 * face..4 * face + 3);
            for h in half_edges() {
                let runs_back =
                    |t: &u32| surface.start(*t) == surface.end(h) && surface.end(*t) == surface.start(h);
                assert_eq!(surface.twin(h), half_edges().find(runs_back).unwrap_or(NONE));
            }
            assert_eq!(surface.fan(0).count(), sides as usize);
            assert_eq!(surface.fan(1).count(), sides as usize - 1);
        }
    }
}
