//! The flags that all programs, or all ray tracers, share.

use crate::tiles::TileOptions;

/// Where these flags stand in the help text.
pub(super) const HEADING: &str = "General";

/// Threads, and what is printed: the flags that every program understands. Flatten it into the
/// options of a program that traces no rays; the others want [`GeneralArgs`].
#[derive(Clone, Debug, Default, clap::Args)]
#[command(rename_all = "snake_case")]
pub struct ProgramArgs {
    /// Number of threads; all cores if not given. Never changes a picture
    #[arg(long, help_heading = HEADING, value_name = "N")]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub threads: Option<u32>,

    /// Print what was counted, and the times
    #[arg(long, help_heading = HEADING)]
    pub stats: bool,

    /// Print the options in force, defaults included
    #[arg(long, help_heading = HEADING)]
    pub verbose: bool,

    /// No warnings and no progress bar
    #[arg(long, help_heading = HEADING, conflicts_with = "verbose")]
    pub quiet: bool,
}

impl ProgramArgs {
    /// The options of a parallel loop; `label` names the work in the progress bar.
    pub fn loop_options<'a>(&self, label: &'a str) -> TileOptions<'a> {
        TileOptions {
            threads: self.threads.map(|n| n as usize),
            label: Some(label),
            ..TileOptions::default()
        }
    }
}

/// The flags that every ray tracer understands. Flatten it into a program's options.
#[derive(Clone, Debug, Default, clap::Args)]
#[command(rename_all = "snake_case")]
pub struct GeneralArgs {
    /// Side of the square tiles that threads work on, in pixels. Never changes a picture
    #[arg(long, help_heading = HEADING, value_name = "N")]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=65_536))]
    pub tile: Option<u32>,

    /// Instruction set of the intersection kernels. Never changes a picture
    #[arg(long, help_heading = HEADING, value_name = "SET", value_enum, default_value_t)]
    pub simd: SimdChoice,

    /// Do a kind of work that is normally skipped as needless; repeatable. Never changes a picture
    #[arg(long, help_heading = HEADING, value_name = "NAME", value_enum)]
    pub noskip: Vec<Skip>,

    /// Threads, and what is printed.
    #[command(flatten)]
    pub program: ProgramArgs,
}

impl GeneralArgs {
    /// The tile loop's options; `label` names the work in the progress bar.
    pub fn tile_options<'a>(&self, label: &'a str) -> TileOptions<'a> {
        TileOptions { tile: self.tile, ..self.program.loop_options(label) }
    }

    /// Whether this kind of needless work is to be skipped, as it is unless switched off.
    pub fn skips(&self, skip: Skip) -> bool {
        !self.noskip.contains(&skip)
    }
}

/// The instruction set asked for; what the machine lacks is an error of the program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum SimdChoice {
    /// The best that the machine has.
    #[default]
    Auto,
    /// What every machine of this kind has.
    Baseline,
    /// 128 bits.
    Sse4,
    /// 256 bits.
    Avx2,
    /// 512 bits.
    Avx512,
}

/// Kinds of needless work that are skipped.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Skip {
    /// Camera rays of tiles that cannot see any object
    Tile,
    /// Shadow rays towards lights behind the surface
    Behind,
    /// Shadow rays towards lights that give nothing there
    Dark,
    /// Shadow rays from inside a closed convex body towards lights outside
    Inside,
    /// Mirrored and refracted rays of black weight
    Black,
    /// Last rays inside a closed body that is empty and dark, whose colour is known
    Known,
    /// Lights chosen for mirrors and glass, which send nothing on between two given directions
    Specular,
    /// Points and normals of hits of which no more than distance or material is wanted
    Surface,
    /// Pictures of depth and of normals that nobody asked for
    Pictures,
    /// Mesh files that were read already, and trees over them that are there
    Shared,
    /// Structures that no ray asks for
    Lazy,
    /// A tree over a handful of primitives
    Handful,
    /// Samples of pixels that are good enough (-adaptive, -error)
    Converged,
}
