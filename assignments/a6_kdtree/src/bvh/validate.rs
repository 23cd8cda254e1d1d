//! The invariants of the tree, checked one by one.

use super::wide::{Bvh, Held, WIDTH, WideNode};
use common::math::{Bounds, Vec3};
use std::ops::Range;

impl Bvh<'_> {
    /// Every primitive is held once, every box holds what is below it, every node is reached
    /// once.
    pub(super) fn check(&self) -> Result<(), String> {
        let (numbers, triangles) = (self.geometry.triangle_numbers(), self.geometry.triangles());
        let solids = if self.balls.is_empty() { self.geometry.solids() } else { &[] };
        let solids: Vec<Bounds> = solids.iter().map(|s| s.bounds).collect();
        let place = |number: u32| numbers.partition_point(|n| *n < number);
        self.check_over(triangles.len(), &solids, |number| {
            let place = place(number);
            (place, triangles[place])
        })
    }

    /// The same of a tree over so many triangles, of which `placed` knows, by number, the place
    /// among them and the corners, and over these boxes of solids.
    pub(crate) fn check_over(
        &self,
        triangles: usize,
        boxes: &[Bounds],
        placed: impl Fn(u32) -> (usize, [Vec3; 3]),
    ) -> Result<(), String> {
        let mut triangles = vec![0u32; triangles];
        let mut solids = vec![0u32; boxes.len()];
        let mut reached = vec![0u32; self.nodes.len()];
        let mut waiting: Vec<(usize, Bounds)> = Vec::new();
        if !self.nodes.is_empty() {
            waiting.push((0, Bounds { min: Vec3::NEG_INFINITY, max: Vec3::INFINITY }));
        }
        while let Some((index, outer)) = waiting.pop() {
            reached[index] += 1;
            for (lane, inner) in self.nodes[index].used() {
                if !contains(&outer, &inner) {
                    return Err(format!("child {lane} of node {index} reaches out of its parent's box"));
                }
                match self.nodes[index].child[lane].held() {
                    Held::Node(below) => waiting.push((below, inner)),
                    Held::Block(index, len) => {
                        self.check_block(index, len, &inner, &placed, &mut triangles)?
                    }
                    Held::Solids(first, count) => {
                        self.check_solids(first..first + count, &inner, boxes, &mut solids)?
                    }
                }
            }
        }
        let once = |counts: &[u32]| counts.iter().all(|n| *n == 1);
        match (once(&triangles), once(&solids), once(&reached)) {
            (true, true, true) => Ok(()),
            (false, ..) => Err("a triangle is held never or twice".to_owned()),
            (_, false, _) => Err("a solid is held never or twice".to_owned()),
            _ => Err("a node is reached never or twice".to_owned()),
        }
    }

    fn check_block(
        &self,
        index: usize,
        len: usize,
        outer: &Bounds,
        placed: &impl Fn(u32) -> (usize, [Vec3; 3]),
        seen: &mut [u32],
    ) -> Result<(), String> {
        let block = &self.blocks[index];
        if block.len() != len {
            return Err(format!("block {index} holds {} triangles, not {len}", block.len()));
        }
        for lane in 0..len {
            let number = block.index[lane];
            let (place, vertices) = placed(number);
            if block.vertices(lane) != vertices || !contains(outer, &Bounds::of_points(vertices)) {
                return Err(format!("triangle {number} is not what, or not where, it should be"));
            }
            seen[place] += 1;
        }
        Ok(())
    }

    fn check_solids(
        &self,
        range: Range<usize>,
        outer: &Bounds,
        boxes: &[Bounds],
        seen: &mut [u32],
    ) -> Result<(), String> {
        for &i in &self.solids[range] {
            if !contains(outer, &boxes[i as usize]) {
                return Err(format!("solid {i} reaches out of its box"));
            }
            seen[i as usize] += 1;
        }
        Ok(())
    }
}

impl WideNode {
    /// The box in a lane.
    pub(crate) fn box_of(&self, lane: usize) -> Bounds {
        let corner = |end: usize| Vec3::from_array([0, 1, 2].map(|axis| self.side[axis][end][lane]));
        Bounds { min: corner(0), max: corner(1) }
    }

    /// The lanes in use, with their boxes.
    fn used(&self) -> impl Iterator<Item = (usize, Bounds)> + '_ {
        (0..WIDTH).map(|lane| (lane, self.box_of(lane))).filter(|(_, b)| !b.is_empty())
    }
}

/// Whether a box holds another.
pub(crate) fn contains(outer: &Bounds, inner: &Bounds) -> bool {
    outer.min.cmple(inner.min).all() && inner.max.cmple(outer.max).all()
}

impl Bvh<'_> {
    /// What the surface area heuristic expects a ray that meets the root's box to cost, where a
    /// node, a block and a solid cost 1 each.
    pub fn cost(&self) -> f64 {
        let area = |b: &Bounds| {
            let s = b.size().as_dvec3();
            s.x * s.y + s.y * s.z + s.z * s.x
        };
        let whole = area(&self.bounds).max(f64::MIN_POSITIVE);
        let below = self.nodes.iter().flat_map(|node| {
            node.used().map(|(lane, bounds)| match node.child[lane].held() {
                Held::Solids(_, count) => area(&bounds) * count as f64,
                _ => area(&bounds),
            })
        });
        if self.nodes.is_empty() { 0.0 } else { 1.0 + below.sum::<f64>() / whole }
    }

    /// All of the tree in text, to compare two builds.
    pub fn fingerprint(&self) -> String {
        format!("{:?} {:?} {:?}", self.nodes, self.blocks, self.solids)
    }
}
