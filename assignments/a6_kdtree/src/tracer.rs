//! What the program traces through, and what `-stats` says of it.

use crate::bvh::Bvh;
use crate::instances::Instances;
use crate::kdtree::{KdTree, Options};
use crate::{Lazy, figures};
use a5_grid::Structure;
use common::accel::Accel;
use common::counters::Counters;
use common::geometry::Geometry;
use std::time::Duration;

/// Trees over fewer primitives are built by one thread: waking another costs as much.
const WORTH_THREADS: usize = 2048;

/// Primitives that a tree can hold: all but planes and discs.
pub fn finite(geometry: &Geometry) -> usize {
    geometry.triangles().len() + geometry.solids().len()
}

/// How many of the threads to build with.
fn builders(geometry: &Geometry, threads: usize) -> usize {
    if finite(geometry) < WORTH_THREADS { 1 } else { threads }
}

type Build<'g, A> = Box<dyn Fn(&'g Geometry) -> A + Send + Sync + 'g>;

/// A kd-tree that is built when the first ray asks.
pub type LazyTree<'g> = Lazy<'g, KdTree<'g>, Build<'g, KdTree<'g>>>;
/// The same of the hierarchy.
pub type LazyBvh<'g> = Lazy<'g, Bvh<'g>, Build<'g, Bvh<'g>>>;
/// The same of the hierarchy in two levels, whose lower trees wait for rays of their own.
pub type LazyInstances<'g> = Lazy<'g, Instances<'g>, Build<'g, Instances<'g>>>;

/// What the rays are traced through.
pub enum Tracer<'g> {
    /// A structure of assignment 5, which is there from the start.
    Lower(Structure<'g>),
    /// A kd-tree.
    KdTree(Box<LazyTree<'g>>, Options),
    /// The hierarchy.
    Bvh(Box<LazyBvh<'g>>),
    /// The hierarchy in two levels.
    Instances(Box<LazyInstances<'g>>),
}

impl<'g> Tracer<'g> {
    /// A kd-tree, built by that many threads if it is large.
    pub fn with_kd_tree(geometry: &'g Geometry, threads: usize, options: Options) -> Self {
        let build: Build<'g, KdTree<'g>> = Box::new(move |geometry| KdTree::new(geometry, options));
        Self::KdTree(Box::new(Lazy::new(geometry, builders(geometry, threads), build)), options)
    }

    /// The hierarchy, built by that many threads if it is large.
    pub fn with_bvh(geometry: &'g Geometry, threads: usize) -> Self {
        let build: Build<'g, Bvh<'g>> = Box::new(Bvh::new);
        Self::Bvh(Box::new(Lazy::new(geometry, builders(geometry, threads), build)))
    }

    /// The hierarchy in two levels, whose trees are built by that many threads if they are large.
    pub fn with_instances(geometry: &'g Geometry, threads: usize) -> Self {
        let build: Build<'g, Instances<'g>> = Box::new(move |geometry| Instances::new(geometry, threads));
        Self::Instances(Box::new(Lazy::new(geometry, 1, build)))
    }

    /// The structure behind the common seam.
    pub fn as_accel(&self) -> &dyn Accel {
        match self {
            Self::Lower(lower) => lower.as_accel(),
            Self::KdTree(tree, _) => &**tree,
            Self::Bvh(bvh) => &**bvh,
            Self::Instances(levels) => &**levels,
        }
    }

    /// The kd-tree, perhaps not built yet, if that is what rays are traced through.
    pub fn kd_tree(&self) -> Option<&LazyTree<'g>> {
        match self {
            Self::KdTree(tree, _) => Some(tree),
            _ => None,
        }
    }

    /// Builds all that waits for a ray, and in two levels what waits below.
    pub fn build(&self) {
        match self {
            Self::Lower(_) => {}
            Self::KdTree(tree, _) => {
                tree.get();
            }
            Self::Bvh(bvh) => {
                bvh.get();
            }
            Self::Instances(levels) => levels.get().build_all(),
        }
    }

    /// Structures built, and structures not built because no ray asked or because the scene is
    /// too small.
    pub fn count(&self, counters: &mut Counters) {
        let (built, waiting) = match self {
            Self::Lower(Structure::List(_)) => (0, 1),
            Self::Lower(grid) => (grid.built(), 0),
            Self::KdTree(tree, _) => (u64::from(tree.built().is_some()), u64::from(tree.built().is_none())),
            Self::Bvh(bvh) => (u64::from(bvh.built().is_some()), u64::from(bvh.built().is_none())),
            Self::Instances(levels) => match levels.built() {
                None => (0, 1),
                Some((levels, _)) => {
                    let s = levels.summary();
                    // The one at the top, too.
                    (s.built as u64 + 1, (s.trees - s.built) as u64)
                }
            },
        };
        counters.structures += built;
        counters.skipped_structure += waiting;
    }

    /// Cells along each axis if it is a grid.
    pub fn cells(&self) -> Option<[u32; 3]> {
        match self {
            Self::Lower(Structure::Grid(grid)) => Some(grid.cells().count.map(|n| n as u32)),
            _ => None,
        }
    }

    /// How long building took, if a ray has asked for a structure that waits for one.
    pub fn build_time(&self) -> Option<Duration> {
        match self {
            Self::Lower(_) => None,
            Self::KdTree(tree, _) => tree.built().map(|(_, time)| time),
            Self::Bvh(bvh) => bvh.built().map(|(_, time)| time),
            Self::Instances(levels) => levels.built().map(|(levels, time)| time + levels.summary().time),
        }
    }

    /// What was built and what it is like, or why nothing was; then what the counted rays cost.
    pub fn figures(&self, counters: &Counters) -> Vec<String> {
        let geometry = self.as_accel().geometry();
        let mut lines = match self {
            Self::Lower(Structure::List(_)) => figures::of_list(geometry),
            Self::Lower(Structure::Grid(grid)) => figures::of_grid(grid),
            Self::KdTree(tree, options) => match tree.built() {
                Some((tree, _)) => figures::of_tree(tree),
                None => figures::not_built(&figures::tree_name(options)),
            },
            Self::Bvh(bvh) => match bvh.built() {
                Some((bvh, _)) => figures::of_bvh(bvh),
                None => figures::not_built("hierarchy"),
            },
            Self::Instances(levels) => match levels.built() {
                Some((levels, _)) => figures::of_instances(levels),
                None => figures::not_built("hierarchy in two levels"),
            },
        };
        lines.extend(figures::per_ray(counters));
        lines
    }
}
