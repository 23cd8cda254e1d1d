//! The house's own structures.

use super::contender::{Answer, Contender, Structure};
use crate::world::World;
use a5_grid::{Cells, Fit, Grid};
use a6_kdtree::bvh::Bvh;
use a6_kdtree::kdtree::{KdTree, Options, Rule};
use common::accel::{Accel, List};
use common::cli::AppError;
use common::counters::Counters;
use common::geometry::Hit;
use common::math::{Bounds, Interval};
use common::ray::Ray;
use common::shape::triangle_block::{LANES, TriangleBlock};
use std::cell::RefCell;

/// Triangle tests that the list may do for one timing: about a fifth of a second.
const LIST_TESTS: usize = 200_000_000;
/// Cells of the grid for each triangle.
const CELLS_PER_TRIANGLE: f64 = 5.0;

/// The hierarchy asked one ray at a time, as a renderer's later rays do.
struct Alone<'w>(Bvh<'w>);

impl Contender for Alone<'_> {
    fn nearest(&self, ray: &Ray, reach: f32) -> Answer {
        let hit = self.0.nearest(ray, Interval::up_to(reach), &mut Counters::default());
        hit.map_or(Answer::MISS, |hit| Answer { t: hit.t, primitive: hit.primitive })
    }

    fn any(&self, ray: &Ray, reach: f32) -> bool {
        self.0.any(ray, Interval::up_to(reach), &mut Counters::default())
    }

    fn bytes(&self) -> Option<usize> {
        Some(self.0.bytes())
    }
}

thread_local! {
    /// Kept from one question to the next, as a renderer would.
    static HITS: RefCell<Vec<Option<Hit>>> = const { RefCell::new(Vec::new()) };
}

/// Anything behind the house's seam. Its one mesh is numbered like its triangles.
struct Ours<A> {
    accel: A,
    bytes: usize,
    affordable: usize,
}

impl<A: Accel> Contender for Ours<A> {
    fn nearest(&self, ray: &Ray, reach: f32) -> Answer {
        let hit = self.accel.nearest(ray, Interval::up_to(reach), &mut Counters::default());
        hit.map_or(Answer::MISS, |hit| Answer { t: hit.t, primitive: hit.primitive })
    }

    fn any(&self, ray: &Ray, reach: f32) -> bool {
        self.accel.any(ray, Interval::up_to(reach), &mut Counters::default())
    }

    fn nearest_batch(&self, rays: &[Ray], reach: f32, answers: &mut [Answer]) {
        self.nearest_timed(rays, reach, answers);
        HITS.with_borrow(|hits| {
            for (hit, answer) in hits.iter().zip(answers) {
                *answer = hit.map_or(Answer::MISS, |hit| Answer { t: hit.t, primitive: hit.primitive });
            }
        });
    }

    fn nearest_timed(&self, rays: &[Ray], reach: f32, _: &mut [Answer]) {
        HITS.with_borrow_mut(|hits| {
            hits.resize(rays.len(), None);
            self.accel.nearest_many(rays, Interval::up_to(reach), hits, &mut Counters::default());
            std::hint::black_box(&hits);
        });
    }

    fn any_batch(&self, rays: &[Ray], reach: f32, answers: &mut [bool]) {
        self.accel.any_many(rays, Interval::up_to(reach), answers, &mut Counters::default());
    }

    fn bytes(&self) -> Option<usize> {
        Some(self.bytes)
    }

    fn affordable(&self) -> usize {
        self.affordable
    }
}

fn boxed<'w, A: Accel + 'w>(accel: A, bytes: usize) -> Box<dyn Contender + 'w> {
    Box::new(Ours { accel, bytes, affordable: usize::MAX })
}

fn kd<'w>(world: &'w World, rule: Rule) -> Box<dyn Contender + 'w> {
    let tree = KdTree::new(&world.geometry, Options { rule, ..Options::default() });
    let bytes = tree.bytes();
    boxed(tree, bytes)
}

/// Our structures.
pub fn all() -> Vec<Structure> {
    vec![
        Structure { name: "list", build: |world| Ok(list(world)) },
        Structure { name: "grid", build: grid },
        Structure { name: "kd-textbook", build: |world| Ok(kd(world, Rule::Textbook)) },
        Structure { name: "kd-median", build: |world| Ok(kd(world, Rule::Median)) },
        Structure { name: "kd-objects", build: |world| Ok(kd(world, Rule::Objects)) },
        Structure { name: "kd-sah", build: |world| Ok(kd(world, Rule::Sah)) },
        Structure {
            name: "bvh",
            build: |world| {
                let bvh = Bvh::new(&world.geometry);
                let bytes = bvh.bytes();
                Ok(boxed(bvh, bytes))
            },
        },
        Structure { name: "bvh-alone", build: |world| Ok(Box::new(Alone(Bvh::new(&world.geometry)))) },
    ]
}

fn list(world: &World) -> Box<dyn Contender + '_> {
    let bytes = world.triangles().div_ceil(LANES) * size_of::<TriangleBlock>();
    let affordable = (LIST_TESTS / world.triangles()).clamp(16, 1 << 16);
    Box::new(Ours { accel: List::new(&world.geometry), bytes, affordable })
}

fn grid(world: &World) -> Result<Box<dyn Contender + '_>, AppError> {
    let bounds = world.bounds();
    let cells = Cells::new(resolution(&bounds, world.triangles()), &bounds);
    let grid = Grid::new(&world.geometry, cells, Fit::Exact).map_err(AppError::Usage)?;
    let bytes = grid.bytes();
    Ok(boxed(grid, bytes))
}

/// Cells as near to cubes as can be, so many that there are [`CELLS_PER_TRIANGLE`].
fn resolution(bounds: &Bounds, triangles: usize) -> [u32; 3] {
    let size = bounds.size().as_dvec3();
    // A flat box counts as a hundredth as thick as wide.
    let size = size.max(size.max_element() * common::math::DVec3::splat(0.01));
    let volume = size.x * size.y * size.z;
    let side = (volume / (CELLS_PER_TRIANGLE * triangles as f64)).cbrt();
    (size / side).to_array().map(|n| n.round().max(1.0) as u32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_nearly_cubes_and_as_many_as_wanted() {
        let bounds = World::named("terrain20k").unwrap().bounds();
        let count = resolution(&bounds, 20_000);
        let all: f64 = count.iter().map(|n| f64::from(*n)).product();
        assert!((all / 100_000.0 - 1.0).abs() < 0.1, "{count:?}");
        let sides = bounds.size().as_dvec3() / common::math::DVec3::from_array(count.map(f64::from));
        assert!(sides.max_element() / sides.min_element() < 1.2, "{sides:?}");
    }
}
