//! How often a line passes a closed mesh: every passage counted, by every kernel.

use super::{explain, from_inside};
use crate::Stress;
use crate::kit::{Placement, fan, file_mesh, lattice_sphere, lumpy_sphere, placed, simd_levels};
use common::accel::Job;
use common::counters::Counters;
use common::geometry::Hit;
use common::math::{Bounds, DVec3, Interval, Vec3};
use common::ray::Ray;
use common::shape::filter::Filter;
use common::shape::triangle_block::{LANES, TriangleBlock};
use common::shape::{ExactRay, triangle};
use common::simd::{Level, Simd, dispatch};

/// Triangles in blocks with what the filter needs.
pub(super) struct Blocks {
    triangles: Vec<[Vec3; 3]>,
    blocks: Vec<TriangleBlock>,
    bounds: Bounds,
}

impl Blocks {
    /// Eight to a block.
    pub fn new(triangles: &[[Vec3; 3]]) -> Self {
        let numbered: Vec<_> = (0u32..).zip(triangles.iter().copied()).collect();
        Self {
            triangles: triangles.to_vec(),
            blocks: numbered.chunks(LANES).map(|c| TriangleBlock::pack(c.iter().copied())).collect(),
            bounds: Bounds::of_points(triangles.iter().flatten().copied()),
        }
    }

    /// How often the line of the ray passes the mesh behind and before its origin.
    pub fn passages(&self, level: Option<Level>, ray: &Ray) -> [u32; 2] {
        let exact = ExactRay::new(ray);
        let mut passages = [0; 2];
        let mut count = |t: f32| passages[usize::from(t > 0.0)] += 1;
        let Some(level) = level else {
            let hits = self.triangles.iter().filter_map(|t| triangle::intersect(&exact, t));
            hits.for_each(|h| count(h.t));
            return passages;
        };
        let filter = Filter::new(ray, &self.bounds);
        for block in &self.blocks {
            let lanes = dispatch!(level, s => candidates(s, block, &filter));
            let kept = (0..LANES).filter(|lane| lanes >> lane & 1 == 1);
            kept.filter_map(|lane| triangle::intersect(&exact, &block.vertices(lane)))
                .for_each(|h| count(h.t));
        }
        passages
    }

    /// The nearest hit in front.
    pub fn nearest(&self, level: Level, ray: &Ray) -> Option<Hit> {
        let filter = Filter::new(ray, &self.bounds);
        let job = Job { filter: &filter, ray, interval: Interval::FORWARD };
        dispatch!(level, s => job.nearest(s, &self.blocks, None, &mut Counters::default()))
    }
}

#[inline(always)]
fn candidates<S: Simd>(simd: S, block: &TriangleBlock, filter: &Filter) -> u32 {
    block.judge(simd, filter, Interval::ALL).possible
}

/// The scalar kernel and every instruction set.
fn kernels() -> Vec<Option<Level>> {
    simd_levels().into_iter().map(|(_, level)| Some(level)).chain([None]).collect()
}

/// Property 1, along the whole line: it passes the mesh an odd number of times each way.
pub fn parity(stress: &Stress) {
    let small = [
        ("cube", file_mesh("cube.obj")),
        ("diamond", file_mesh("diamond.obj")),
        ("bunny_200", file_mesh("bunny_200.obj")),
        ("lumpy sphere", lumpy_sphere(2, 4)),
        ("lattice sphere", lattice_sphere(2, 2)),
        ("split square fans", fan(32, 3)),
    ];
    let share = 1_000_000u64.div_ceil(small.len() as u64);
    for (name, mesh) in &small {
        odd_passages(stress, &format!("p01 parity, {name}"), &placed(mesh, 1.0, DVec3::ZERO, 64), share);
    }
}

/// Counts the passages of rays from inside, by all kernels in turn.
pub(super) fn odd_passages(stress: &Stress, name: &str, place: &Placement, trials: u64) {
    let (blocks, kernels) = (Blocks::new(&place.triangles), kernels());
    stress.run(name, 103, trials, |draw| {
        let ray = from_inside(draw, &place.triangles, &place.inside);
        let passages = blocks.passages(draw.pick(&kernels), &ray);
        match passages.iter().all(|n| n % 2 == 1) {
            true => Ok(f64::from(passages[1])),
            false => Err(format!("{passages:?} passages\n{}", explain(&place.triangles, &ray))),
        }
    });
}
