//! The flags of assignment 8, on top of those of assignments 1 to 7.

use crate::film::{Aov, MAX_SAMPLES};
use crate::path::Integrator;
use a1_ray_casting::CastArgs;
use a7_sampling::SamplingArgs;
use clap::ValueEnum;
use common::cli::AppError;
use common::picture::Transfer;
use std::path::PathBuf;

/// Path tracing: all the light there is.
#[derive(clap::Parser)]
#[command(
    name = "a8_path_tracing",
    version,
    rename_all = "snake_case",
    after_help = "Examples:\n  a8_path_tracing -input scenes/scene8_01_cornell_box.txt -size 256 256 -output out.png -spp 64\n  a8_path_tracing -input scene.txt -output out.png -time 60 -checkpoint out.ckpt\n  a8_path_tracing -merge left.ckpt right.ckpt -output out.exr   (see a8_path_tracing -merge -help)"
)]
pub struct Program {
    /// All flags.
    #[command(flatten)]
    pub args: PathArgs,
}

/// Paths.
#[derive(Clone, Debug, clap::Args)]
#[command(rename_all = "snake_case")]
pub struct PathArgs {
    /// How far to go.
    #[command(flatten)]
    pub goal: GoalArgs,

    /// What paths do.
    #[command(flatten)]
    pub follow: FollowArgs,

    /// Which part to render.
    #[command(flatten)]
    pub part: PartArgs,

    /// Files besides the picture.
    #[command(flatten)]
    pub files: FileArgs,

    /// Flags of assignments 1 to 7.
    #[command(flatten)]
    pub sampling: SamplingArgs,
}

/// When a picture is done.
#[derive(Clone, Debug, Default, clap::Args)]
#[command(rename_all = "snake_case", next_help_heading = "Assignment 8: how long")]
pub struct GoalArgs {
    /// Paths per pixel; 64 if nothing else ends the rendering, at most 4096 with -error
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(MAX_SAMPLES / 2)))]
    pub spp: Option<u32>,

    /// End after so many seconds, counted from the first path on
    #[arg(long, value_name = "SECONDS")]
    pub time: Option<f64>,

    /// Leave pixels alone once their relative error is probably below E: squared error over
    /// squared brightness plus 0.01, looked at from 16 samples on whenever they have doubled
    #[arg(long, value_name = "E", conflicts_with_all = ["crop", "spp_range"])]
    pub error: Option<f64>,
}

/// What paths do.
#[derive(Clone, Debug, clap::Args)]
#[command(rename_all = "snake_case", next_help_heading = "Assignment 8: paths")]
pub struct FollowArgs {
    /// How light is looked for
    #[arg(long, value_name = "NAME", value_enum, default_value_t)]
    pub integrator: Integrator,

    /// Surfaces that a path meets before it may be ended at random
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub rr_depth: u32,
}

/// A part of a picture, for many machines or many nights.
#[derive(Clone, Debug, Default, clap::Args)]
#[command(rename_all = "snake_case", next_help_heading = "Assignment 8: parts of a picture")]
pub struct PartArgs {
    /// Only these pixels, counted from the lower left corner, X1 and Y1 excluded: the picture is
    /// that large, and its pixels are those of the whole
    #[arg(long, num_args = 4, value_names = ["X0", "Y0", "X1", "Y1"])]
    pub crop: Option<Vec<u32>>,

    /// Only samples A to B, B excluded
    #[arg(long, num_args = 2, value_names = ["A", "B"])]
    pub spp_range: Option<Vec<u32>>,

    /// Go on from a file that -checkpoint has written with the same scene and flags
    #[arg(long, value_name = "FILE")]
    pub resume: Option<PathBuf>,
}

/// Files besides the picture, and how they are coded.
#[derive(Clone, Debug, Default, clap::Args)]
#[command(rename_all = "snake_case", next_help_heading = "Assignment 8: files")]
pub struct FileArgs {
    /// Keep what is needed to go on (-resume) or to put parts together (-merge); written every
    /// ten seconds and at the end
    #[arg(long, value_name = "FILE")]
    pub checkpoint: Option<PathBuf>,

    /// Picture of what was met first: albedo, normal or depth; repeatable
    #[arg(long, num_args = 1..=2, value_names = ["KIND", "PICTURE"])]
    pub aov: Vec<String>,

    /// Write light to 8-bit pictures as it is, without the sRGB curve
    #[arg(long)]
    pub linear: bool,
}

impl FileArgs {
    /// The pictures of AOVs that are asked for.
    ///
    /// # Errors
    /// A kind without a file, or that is none.
    pub fn aovs(&self) -> Result<Vec<(Aov, PathBuf)>, AppError> {
        let pairs = self.aov.chunks(2).map(|pair| {
            let [kind, file] = pair else {
                return Err(AppError::Usage(
                    "-aov wants a kind and a picture, as in -aov albedo a.exr".to_owned(),
                ));
            };
            let kind = Aov::from_str(kind, false)
                .map_err(|_| AppError::Usage(format!("-aov: `{kind}` is none of albedo, normal, depth")))?;
            Ok((kind, PathBuf::from(file)))
        });
        pairs.collect()
    }

    /// How light is coded in 8-bit pictures.
    pub fn transfer(&self) -> Transfer {
        if self.linear { Transfer::Linear } else { Transfer::Srgb }
    }
}

impl PathArgs {
    /// Flags of assignment 1.
    pub fn cast(&self) -> &CastArgs {
        self.sampling.cast()
    }
}
