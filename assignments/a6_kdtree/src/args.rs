//! The flags of assignment 6, on top of those of assignments 1 to 5.

use crate::instances::Instances;
use crate::kdtree::{MAX_DEPTH, Options, Rule};
use crate::picture::Heat;
use crate::tracer::{Tracer, finite};
use a1_ray_casting::{CastArgs, Picture, Report, Studio};
use a5_grid::{Cells, GridArgs, Structure};
use common::accel::{Accel, List};
use common::cli::{self, AppError, Skip};
use common::geometry::Geometry;
use std::path::PathBuf;

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

    /// Show the box of the first leaf along every ray that holds anything, instead of the scene;
    /// colours as for -visualize_grid
    #[arg(long)]
    pub visualize_kdtree: bool,

    /// Picture of the steps and primitive tests that each pixel costs, from black over red and
    /// yellow to white for HOTTEST and more (the dearest pixel if not given)
    #[arg(long, num_args = 1..=2, value_names = ["PICTURE", "HOTTEST"])]
    pub heat: Option<Vec<String>>,

    /// Whether `auto` may take what is faster than the grid though `-grid` is given; set by the
    /// programs of later steps, whose pictures do not show the grid at work.
    #[arg(skip)]
    pub fastest: bool,

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
    /// The hierarchy in two levels: copies of a mesh share a tree, and what no ray reaches has none
    Instances,
}

impl AccelArgs {
    /// Flags of assignment 1.
    pub fn cast(&self) -> &CastArgs {
        self.grid.cast()
    }

    /// The same flags with the picture of `-heat` among the files that are written.
    #[must_use]
    pub fn with_outputs(&self) -> Self {
        let mut all = self.clone();
        let heat = self.heat.iter().map(|values| PathBuf::from(&values[0]));
        all.grid.whitted.phong.diffuse.cast.further_outputs.extend(heat);
        all
    }

    /// Refuses impossible and empty tasks, warns of flags without effect.
    ///
    /// # Errors
    /// Those of assignment 5; a grid that is chosen but not given; two structures to show; a
    /// hottest colour that stands for no work.
    pub fn check(&self) -> Result<(), AppError> {
        self.heat_layer()?;
        let usage = |text: &str| Err(AppError::Usage(text.to_owned()));
        if self.visualize_kdtree && self.grid.shows_cells() {
            return usage("-visualize_grid and -visualize_kdtree both want -output; give one of them");
        }
        if self.accel == Choice::Grid && self.grid.grid.is_none() {
            return usage("-accel grid needs -grid NX NY NZ");
        }
        self.warn_of_structures();
        let whitted = &self.grid.whitted;
        let followed = whitted.shadows || whitted.bounces.is_some() || whitted.trace.is_some();
        if self.visualize_kdtree && followed {
            cli::warn("-shadows, -bounces and -trace have no effect with -visualize_kdtree");
        }
        self.grid.check()
    }

    /// Warns of structures that are described but not used.
    fn warn_of_structures(&self) {
        if self.grid.shows_cells() {
            return;
        }
        let takes_tree = self.takes_tree();
        let takes_grid = !takes_tree && matches!(self.accel, Choice::Auto | Choice::Grid);
        if self.grid.grid.is_some() && !takes_grid {
            cli::warn("-grid has no effect with this -accel or with a kd-tree");
        }
        if self.visualize_kdtree && !matches!(self.accel, Choice::Auto | Choice::Kdtree) {
            cli::warn("-accel has no effect with -visualize_kdtree");
        }
        if self.kdtree.is_some() && !takes_tree {
            cli::warn("-kdtree has no effect with this -accel");
        }
        if (self.kd_max_depth.is_some() || self.kd_leaf.is_some()) && !takes_tree {
            cli::warn("-kd_max_depth and -kd_leaf have no effect without a kd-tree");
        }
    }

    /// Whether these flags ask for a kd-tree.
    fn takes_tree(&self) -> bool {
        match self.accel {
            _ if self.visualize_kdtree => true,
            Choice::Kdtree => true,
            Choice::Auto => self.kdtree.is_some(),
            _ => false,
        }
    }

    /// How the kd-tree is to be built.
    pub fn options(&self) -> Options {
        Options { rule: self.kdtree.unwrap_or_default(), max_depth: self.kd_max_depth, leaf: self.kd_leaf }
    }

    /// The heat layer, if its picture is asked for.
    ///
    /// # Errors
    /// If the hottest colour is not to stand for a whole number of at least 1.
    pub fn heat_layer(&self) -> Result<Option<Heat>, AppError> {
        let Some(values) = &self.heat else { return Ok(None) };
        let Some(text) = values.get(1) else { return Ok(Some(Heat::default())) };
        let hottest = text.parse().ok().filter(|n| *n > 0);
        let wrong =
            || AppError::Usage(format!("-heat: HOTTEST must be a whole number above 0, not `{text}`"));
        Ok(Some(Heat { hottest: Some(hottest.ok_or_else(wrong)?) }))
    }

    /// The heat picture, if asked for. Its scale has been checked by [`AccelArgs::check`].
    pub fn heat_picture(&self) -> Option<Picture<'static>> {
        let layer = self.heat_layer().ok().flatten()?;
        let path = Some(PathBuf::from(&self.heat.as_ref()?[0]));
        Some(Picture { path, layer: Box::new(layer) })
    }

    /// Draws and writes the pictures of depth, normals and heat, as far as they are asked for: what
    /// is left to do for steps that draw the colour picture themselves.
    ///
    /// # Errors
    /// A picture that cannot be written.
    pub fn expose_side_pictures(
        &self,
        studio: &Studio,
        accel: &dyn Accel,
        report: &mut Report,
    ) -> Result<(), AppError> {
        let mut side = self.grid.whitted.phong.diffuse.side_pictures();
        side.extend(self.heat_picture());
        if side.is_empty() { Ok(()) } else { studio.expose(self.cast(), accel, &side, report) }
    }

    /// The structure that finds hits; trees are built when the first ray asks.
    ///
    /// # Errors
    /// If a grid would hold too many references.
    pub fn structure<'g>(
        &self,
        geometry: &'g Geometry,
        cells: Option<Cells>,
    ) -> Result<Tracer<'g>, AppError> {
        let skips = |kind| self.cast().general.skips(kind);
        let choice = match (self.accel, &cells) {
            _ if self.takes_tree() => Choice::Kdtree,
            (Choice::Auto, Some(_)) if !self.fastest => Choice::Grid,
            (Choice::Auto, _) if finite(geometry) < WORTH_A_TREE && skips(Skip::Handful) => Choice::List,
            (Choice::Auto, _) if Instances::pay(geometry) => Choice::Instances,
            (Choice::Auto, _) => Choice::Bvh,
            (choice, _) => choice,
        };
        let tracer = match choice {
            Choice::Kdtree => Tracer::with_kd_tree(geometry, self.threads(), self.options()),
            Choice::Bvh => Tracer::with_bvh(geometry, self.threads()),
            Choice::Instances => Tracer::with_instances(geometry, self.threads()),
            Choice::Grid => Tracer::Lower(self.grid.structure(geometry, cells)?),
            _ => Tracer::Lower(Structure::List(List::new(geometry))),
        };
        if !skips(Skip::Lazy) {
            tracer.build();
        }
        Ok(tracer)
    }

    /// Threads that build a large tree.
    fn threads(&self) -> usize {
        let asked = self.cast().general.program.threads;
        asked.map_or_else(rayon::current_num_threads, |n| n as usize)
    }
}
