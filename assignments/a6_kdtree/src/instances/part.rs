//! The parts of a scene, and their trees, built when the first ray meets their box.

use super::Instances;
use super::placement::Placement;
use crate::bvh::Bvh;
use crate::bvh::build::roomy;
use crate::lazy::apart;
use common::geometry::Geometry;
use common::math::{Bounds, Vec3};
use common::mesh::Mesh;
use std::sync::{Arc, OnceLock};
use std::time::{Duration, Instant};

/// One use of a mesh, or everything that is no use of a large mesh.
pub struct Part {
    /// Its box in the world.
    pub bounds: Bounds,
    /// Index of its tree.
    pub tree: usize,
    /// How rays get into the tree's space, if that is not the world.
    pub placement: Option<Placement>,
}

/// What a tree is built over.
pub enum Source {
    /// All loose triangles, by their positions in the geometry, and all solids.
    Loose(Vec<u32>),
    /// The triangles of one use, by their positions in the geometry.
    Triangles(Vec<u32>),
    /// The triangles of a mesh in its own space.
    Mesh(Arc<Mesh>),
}

/// A tree, perhaps not built yet.
pub struct Tree<'g> {
    /// What is in it.
    pub source: Source,
    /// Uses of meshes that go through it; 0 for that of the loose primitives.
    pub uses: usize,
    built: OnceLock<(Bvh<'g>, Duration)>,
}

/// Fewer triangles are built by the thread that asks: no subtree would go to another one.
const WORTH_THREADS: usize = 8192;

impl<'g> Tree<'g> {
    /// Nothing yet, used by none.
    pub fn new(source: Source) -> Self {
        Self { source, uses: 0, built: OnceLock::new() }
    }

    /// The tree, built now if it is not there yet, away from the threads that render; see
    /// [`crate::Lazy`].
    #[inline]
    pub fn get(&self, geometry: &'g Geometry, threads: usize) -> &Bvh<'g> {
        &self.built.get_or_init(|| self.timed(geometry, threads)).0
    }

    #[cold]
    fn timed(&self, geometry: &'g Geometry, threads: usize) -> (Bvh<'g>, Duration) {
        let started = Instant::now();
        let count = match &self.source {
            Source::Loose(list) => list.len().max(geometry.solids().len()),
            Source::Triangles(list) => list.len(),
            Source::Mesh(mesh) => mesh.triangles.len(),
        };
        let tree = if count < WORTH_THREADS {
            self.source.build(geometry)
        } else {
            apart(threads, || self.source.build(geometry))
        };
        (tree, started.elapsed())
    }
}

impl Source {
    /// The tree over all of it; the same whatever the number of threads.
    fn build<'g>(&self, geometry: &'g Geometry) -> Bvh<'g> {
        let solids = || geometry.solids().iter().map(|s| roomy(&s.bounds)).collect();
        match self {
            Self::Loose(list) => over_triangles(geometry, list, solids()),
            Self::Triangles(list) => over_triangles(geometry, list, Vec::new()),
            Self::Mesh(mesh) => {
                let boxes = (0..mesh.triangles.len()).map(|i| Bounds::of_points(corners(mesh, i))).collect();
                Bvh::over(geometry, boxes, (Vec::new(), 2), |i| (i, corners(mesh, i as usize)))
            }
        }
    }
}

fn over_triangles<'g>(geometry: &'g Geometry, list: &[u32], solids: Vec<Bounds>) -> Bvh<'g> {
    let boxes = list.iter().map(|&i| Bounds::of_points(geometry.triangles()[i as usize])).collect();
    Bvh::over(geometry, boxes, (solids, 2), |i| {
        let place = list[i as usize] as usize;
        (geometry.triangle_numbers()[place], geometry.triangles()[place])
    })
}

/// The corners of one of a mesh's triangles, in its own space.
pub fn corners(mesh: &Mesh, triangle: usize) -> [Vec3; 3] {
    mesh.triangles[triangle].map(|i| mesh.positions[i as usize])
}

/// What has been built so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Summary {
    /// Uses of meshes that have a box of their own.
    pub uses: usize,
    /// Trees that there can be, that of the loose primitives included.
    pub trees: usize,
    /// Trees that are there.
    pub built: usize,
    /// Of the trees, those that several uses share …
    pub shared: usize,
    /// … and the uses that do.
    pub sharing: usize,
    /// Uses of meshes whose tree no ray has asked for.
    pub unreached: usize,
    /// Bytes of all that is there.
    pub bytes: usize,
    /// Time that building took, the tree at the top not included, by the clock.
    pub time: Duration,
}

impl Instances<'_> {
    /// What has been built so far.
    pub fn summary(&self) -> Summary {
        let mut s = Summary { trees: self.trees.len(), ..Summary::default() };
        s.bytes = self.top.bytes() + size_of_val(&*self.parts) + size_of_val(&*self.trees);
        for tree in &self.trees {
            let several = tree.uses > 1;
            s.uses += tree.uses;
            s.shared += usize::from(several);
            s.sharing += if several { tree.uses } else { 0 };
            if let Source::Loose(list) | Source::Triangles(list) = &tree.source {
                s.bytes += size_of_val(&**list);
            }
            match tree.built.get() {
                Some((bvh, time)) => {
                    s.built += 1;
                    s.bytes += bvh.bytes();
                    s.time += *time;
                }
                None => s.unreached += tree.uses,
            }
        }
        s
    }
}
