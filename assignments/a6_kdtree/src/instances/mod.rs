//! Two levels: a tree over the meshes of a scene, and a tree in each.
//!
//! [`crate::bvh::Bvh`] holds every triangle of every copy of a mesh. Here each use of a mesh is
//! one box of a small tree at the top, and what is in the box gets its own tree when the first ray
//! meets it (`part`). Copies of one mesh share one tree, in the mesh's own space: a ray is taken
//! there with bounds of all that is rounded on the way (`object_ray`), and the tree only says
//! which triangles it may hit. Those are decided in the world, corner for corner as the list does
//! it, so the answer is the list's to the last bit.

mod object_ray;
mod part;
mod placement;
mod search;
mod validate;

pub use part::Summary;

use crate::bvh::Bvh;
use crate::bvh::build::roomy;
use common::accel::Accel;
use common::counters::Counters;
use common::geometry::{Geometry, Hit, PlacedMesh};
use common::math::{Bounds, Interval};
use common::mesh::Mesh;
use common::ray::Ray;
use part::{Part, Source, Tree};
use placement::Placement;
use std::collections::{HashMap, HashSet};
use std::sync::Arc;

/// What gets a box of its own, and what shares a tree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Meshes of fewer triangles go into the tree of the loose ones, copy by copy.
    pub least: usize,
    /// A copy shares its mesh's tree if its corners' rounding, taken back to the mesh's space, is
    /// at most this part of the size of a triangle there. Coarser ones would be asked for too
    /// many triangles that they miss.
    pub coarsest: f64,
}

impl Default for Options {
    fn default() -> Self {
        Self { least: 256, coarsest: 1.0 / 64.0 }
    }
}

/// Triangles in repeated uses of large meshes, from which on two levels are taken. Measured with
/// `examples/instances.rs`: a flat tree takes one thread 1 µs for each of them, one that is shared
/// next to none; a ray of a coherent bundle takes 0.1 to 0.7 µs longer through two levels, others
/// go 0.6 to 1.3 times as fast. So what is saved here is lost again after some 200,000 camera
/// rays, and from a million triangles on after millions.
const WORTH_TWO_LEVELS: usize = 100_000;

/// The structure.
pub struct Instances<'g> {
    geometry: &'g Geometry,
    threads: usize,
    /// Over the boxes of `parts`, which are its solids.
    top: Bvh<'g>,
    parts: Vec<Part>,
    trees: Vec<Tree<'g>>,
}

impl<'g> Instances<'g> {
    /// Builds the tree at the top and none of those below, which will be built by that many
    /// threads if they are large.
    pub fn new(geometry: &'g Geometry, threads: usize) -> Self {
        Self::with(geometry, threads, Options::default())
    }

    /// The same with other limits.
    pub fn with(geometry: &'g Geometry, threads: usize, options: Options) -> Self {
        let mut sorter = Sorter { options, parts: Vec::new(), trees: Vec::new(), shared: HashMap::new() };
        let uses: Vec<&PlacedMesh> =
            geometry.placed_meshes().filter(|p| p.mesh.triangles.len() >= options.least.max(1)).collect();
        for placed in &uses {
            *sorter.shared.entry(Arc::as_ptr(&placed.mesh)).or_default() += 1;
        }
        let mut trees_of = HashMap::new();
        for placed in &uses {
            sorter.add(placed, geometry, &mut trees_of);
        }
        sorter.add_loose(geometry, &uses);
        let boxes = sorter.parts.iter().map(|part| part.bounds).collect();
        let top = Bvh::over(geometry, Vec::new(), (boxes, 1), |_| unreachable!("no triangles at the top"));
        Self { geometry, threads, top, parts: sorter.parts, trees: sorter.trees }
    }

    /// Whether two levels should do better than one flat tree: copies beyond the first of meshes
    /// that are large by the default [`Options`] have 100,000 triangles together.
    pub fn pay(geometry: &Geometry) -> bool {
        let mut seen = HashSet::new();
        let copies = geometry.placed_meshes().filter(|p| !seen.insert(Arc::as_ptr(&p.mesh)));
        let triangles = copies.map(|p| p.mesh.triangles.len()).filter(|n| *n >= Options::default().least);
        triangles.sum::<usize>() >= WORTH_TWO_LEVELS
    }

    /// Builds every tree that is not there yet.
    pub fn build_all(&self) {
        (0..self.trees.len()).for_each(|index| {
            self.tree(index);
        });
    }

    /// The tree of one part, built now if it is not there yet.
    fn tree(&self, index: usize) -> &Bvh<'g> {
        self.trees[index].get(self.geometry, self.threads)
    }
}

/// Sorts the scene into parts.
struct Sorter<'g> {
    options: Options,
    parts: Vec<Part>,
    trees: Vec<Tree<'g>>,
    /// How often each mesh is used.
    shared: HashMap<*const Mesh, usize>,
}

impl Sorter<'_> {
    /// One use of a mesh, with the tree of the uses before it or a new one.
    fn add(&mut self, placed: &PlacedMesh, geometry: &Geometry, trees_of: &mut HashMap<*const Mesh, usize>) {
        let range = placed.triangles();
        let bounds = Bounds::of_points(geometry.triangles()[range.clone()].iter().flatten().copied());
        let key = Arc::as_ptr(&placed.mesh);
        let placement = Placement::new(placed, &bounds)
            .filter(|p| self.shared[&key] > 1 && p.is_fine(placed, self.options.coarsest));
        let tree = match placement {
            Some(_) => *trees_of.entry(key).or_insert_with(|| {
                self.trees.push(Tree::new(Source::Mesh(Arc::clone(&placed.mesh))));
                self.trees.len() - 1
            }),
            None => {
                self.trees.push(Tree::new(Source::Triangles(range.map(|i| i as u32).collect())));
                self.trees.len() - 1
            }
        };
        self.trees[tree].uses += 1;
        self.parts.push(Part { bounds, tree, placement });
    }

    /// Everything that is in no part yet, as the last part.
    fn add_loose(&mut self, geometry: &Geometry, uses: &[&PlacedMesh]) {
        let mut loose = Vec::new();
        let mut next = 0;
        for range in uses.iter().map(|placed| placed.triangles()) {
            loose.extend((next..range.start).map(|i| i as u32));
            next = range.end;
        }
        loose.extend((next..geometry.triangles().len()).map(|i| i as u32));
        if loose.is_empty() && geometry.solids().is_empty() {
            return;
        }
        let corners = loose.iter().flat_map(|&i| geometry.triangles()[i as usize]);
        let bounds =
            geometry.solids().iter().fold(Bounds::of_points(corners), |b, s| b.union(&roomy(&s.bounds)));
        self.trees.push(Tree::new(Source::Loose(loose)));
        self.parts.push(Part { bounds, tree: self.trees.len() - 1, placement: None });
    }
}

impl Accel for Instances<'_> {
    fn nearest(&self, ray: &Ray, interval: Interval, counters: &mut Counters) -> Option<Hit> {
        if !ray.is_usable() {
            return None;
        }
        let best = self.geometry.nearest_sheet(ray, interval, counters);
        self.search_nearest(ray, interval, best, counters)
    }

    fn any(&self, ray: &Ray, interval: Interval, counters: &mut Counters) -> bool {
        if !ray.is_usable() {
            return false;
        }
        if self.geometry.any_sheet(ray, interval, counters) {
            return true;
        }
        self.search_any(ray, interval, counters)
    }

    fn geometry(&self) -> &Geometry {
        self.geometry
    }

    /// Builds every tree that is not there yet, to check it too.
    fn validate(&self) -> Result<(), String> {
        self.check()
    }
}
