//! The flags of assignment 6, on top of those of assignments 1 to 5.

use crate::bvh::Bvh;
use crate::kdtree::{KdTree, MAX_DEPTH, Options, Rule};
use a1_ray_casting::CastArgs;
use a5_grid::{Cells, GridArgs, Structure};
use common::accel::{Accel, List};
use common::cli::AppError;
use common::geometry::Geometry;

/// From this many finite primitives on, a hierarchy beats asking all of them: one node's eight
/// boxes cost about as much as one block of eight triangles.
const WORTH_A_TREE: usize = 16;

/// Ray tracing through kd-trees, a bounding volume hierarchy, or any structure of the steps below;
/// textures: checkerboard, noise, marble, wood, pictures.
#[derive(clap::Parser)]
#[command(
    name = "a6_kdtree",
    version,
    rename_all = "snake_case",
    after_help = "Example:\n  a6_kdtree -input scenes/scene5_09_bunny_mesh_40k.txt -size 200 200 -output out.tga -shadows -stats"
)]
pub struct Program {
    /// All flags.
    #[command(flatten)]
    pub args: AccelArgs,
}

/// The choice of structure.
#[derive(Clone, Debug, clap::Args)]
#[command(rename_all = "snake_case", next_help_heading = "Assignment 6: trees")]
pub struct AccelArgs {
    /// What finds hits; never changes a picture. Auto takes the kd-tree if -kdtree is given, the
    /// grid if -grid is, the list for a handful of primitives, else the hierarchy
    #[arg(long, value_name = "STRUCTURE", value_enum, default_value_t)]
    pub accel: Choice,

    /// Send every ray through a kd-tree whose nodes are cut by this rule; sah if none is named
    #[arg(long, value_name = "RULE", value_enum, num_args = 0..=1, default_missing_value = "sah")]
    pub kdtree: Option<Rule>,

    /// Most planes between the kd-tree's root and a leaf, up to 60
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=i64::from(MAX_DEPTH)))]
    pub kd_max_depth: Option<u32>,

    /// Never cut a node of the kd-tree that holds at most this many primitives
    #[arg(long, value_name = "N")]
    pub kd_leaf: Option<u32>,

    /// Flags of assignments 1 to 5.
    #[command(flatten)]
    pub grid: GridArgs,
}

/// The structures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Choice {
    /// What should be fastest
    #[default]
    Auto,
    /// Every primitive is asked
    List,
    /// The uniform grid of assignment 5; needs -grid NX NY NZ
    Grid,
    /// The kd-tree, by the surface area heuristic unless -kdtree names another rule
    Kdtree,
    /// The bounding volume hierarchy
    Bvh,
}

/// What the rays are traced through.
pub enum Tracer<'g> {
    /// A structure of assignment 5.
    Lower(Structure<'g>),
    /// A kd-tree.
    KdTree(Box<KdTree<'g>>),
    /// The hierarchy.
    Bvh(Box<Bvh<'g>>),
}

impl Tracer<'_> {
    /// The structure behind the common seam.
    pub fn as_accel(&self) -> &dyn Accel {
        match self {
            Self::Lower(lower) => lower.as_accel(),
            Self::KdTree(tree) => &**tree,
            Self::Bvh(bvh) => &**bvh,
        }
    }

    /// What was built, for `-stats`.
    pub fn describe(&self) -> String {
        match self {
            Self::Lower(lower) => lower.describe(),
            Self::KdTree(tree) => tree.describe(),
            Self::Bvh(bvh) => {
                let (nodes, blocks, depth) = bvh.counts();
                let kib = bvh.bytes().div_ceil(1024);
                format!("structure: hierarchy, {nodes} nodes, {blocks} blocks, depth {depth}, {kib} KiB")
            }
        }
    }
}

impl AccelArgs {
    /// Flags of assignment 1.
    pub fn cast(&self) -> &CastArgs {
        self.grid.cast()
    }

    /// Refuses impossible and empty tasks, warns of flags without effect.
    ///
    /// # Errors
    /// Those of assignment 5; a grid that is chosen but not given.
    pub fn check(&self) -> Result<(), AppError> {
        if self.accel == Choice::Grid && self.grid.grid.is_none() {
            return Err(AppError::Usage("-accel grid needs -grid NX NY NZ".to_owned()));
        }
        let takes_tree = self.takes_tree();
        let takes_grid = !takes_tree && matches!(self.accel, Choice::Auto | Choice::Grid);
        if self.grid.grid.is_some() && !takes_grid {
            common::cli::warn("-grid has no effect with this -accel or with -kdtree");
        }
        if self.kdtree.is_some() && !takes_tree {
            common::cli::warn("-kdtree has no effect with this -accel");
        }
        if (self.kd_max_depth.is_some() || self.kd_leaf.is_some()) && !takes_tree {
            common::cli::warn("-kd_max_depth and -kd_leaf have no effect without a kd-tree");
        }
        self.grid.check()
    }

    /// Whether these flags ask for a kd-tree.
    fn takes_tree(&self) -> bool {
        self.accel == Choice::Kdtree || self.accel == Choice::Auto && self.kdtree.is_some()
    }

    /// How the kd-tree is to be built.
    fn options(&self) -> Options {
        Options { rule: self.kdtree.unwrap_or_default(), max_depth: self.kd_max_depth, leaf: self.kd_leaf }
    }

    /// The structure that finds hits.
    ///
    /// # Errors
    /// If a grid would hold too many references.
    pub fn structure<'g>(
        &self,
        geometry: &'g Geometry,
        cells: Option<Cells>,
    ) -> Result<Tracer<'g>, AppError> {
        let finite = geometry.triangles().len() + geometry.solids().len();
        let choice = match (self.accel, &cells) {
            (Choice::Auto, _) if self.takes_tree() => Choice::Kdtree,
            (Choice::Auto, Some(_)) => Choice::Grid,
            (Choice::Auto, None) if finite < WORTH_A_TREE => Choice::List,
            (Choice::Auto, None) => Choice::Bvh,
            (choice, _) => choice,
        };
        Ok(match choice {
            Choice::Kdtree => Tracer::KdTree(Box::new(KdTree::new(geometry, self.options()))),
            Choice::Bvh => Tracer::Bvh(Box::new(Bvh::new(geometry))),
            Choice::Grid => Tracer::Lower(self.grid.structure(geometry, cells)?),
            _ => Tracer::Lower(Structure::List(List::new(geometry))),
        })
    }
}
