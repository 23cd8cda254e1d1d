//! The flags of assignment 7, on top of those of assignments 1 to 6.

use crate::motion::MotionArgs;
use crate::plan::{FilterArgs, PatternArgs};
use a1_ray_casting::CastArgs;
use a6_kdtree::AccelArgs;
use common::cli::AppError;
use common::scene::{CameraSpec, Lens};
use std::path::PathBuf;

/// Many rays for a pixel: sampling patterns and filters, soft shadows, depth of field, curved
/// screens.
#[derive(clap::Parser)]
#[command(
    name = "a7_sampling",
    version,
    rename_all = "snake_case",
    after_help = "Example:\n  a7_sampling -input scenes/scene7_04_6.837_logo.txt -size 400 200 -output out.tga -shadows -shade_back -bounces 5 -weight 0.01 -jittered_samples 9 -gaussian_filter 0.4"
)]
pub struct Program {
    /// All flags.
    #[command(flatten)]
    pub args: SamplingArgs,
}

/// Samples, filters, lens and lights.
#[derive(Clone, Debug, clap::Args)]
#[command(rename_all = "snake_case")]
pub struct SamplingArgs {
    /// Where samples lie.
    #[command(flatten)]
    pub pattern: PatternArgs,

    /// How they add up.
    #[command(flatten)]
    pub filter: FilterArgs,

    /// What is made of them.
    #[command(flatten)]
    pub effects: EffectArgs,

    /// Where the camera goes.
    #[command(flatten)]
    pub motion: MotionArgs,

    /// Flags of assignments 1 to 6.
    #[command(flatten)]
    pub accel: AccelArgs,
}

/// Lens, lights, and smoothing for comparison.
#[derive(Clone, Debug, Default, clap::Args)]
#[command(rename_all = "snake_case", next_help_heading = "Assignment 7: lens and lights")]
pub struct EffectArgs {
    /// Diameter of the lens, in place of the scene's; 0 for a pinhole
    #[arg(long, value_name = "D")]
    pub aperture: Option<f64>,

    /// Distance from the eye to what is in focus, in place of the scene's
    #[arg(long, value_name = "D")]
    pub focal_distance: Option<f64>,

    /// Corners of the lens's opening, in place of the scene's; a disc if neither gives any
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(3..=100))]
    pub blades: Option<u32>,

    /// Points of each extended light that a surface point is shown, for every sample; if not given
    /// as many as make 16 for a pixel
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=4096))]
    pub light_samples: Option<u32>,

    /// Light spheres are points and shining things light nothing, as in the steps below
    #[arg(long, conflicts_with = "light_samples")]
    pub hard_lights: bool,

    /// Smooth the finished picture with weights 1 2 1, 2 4 2, 1 2 1: for comparison, it blurs
    /// edges as well as steps
    #[arg(long)]
    pub smooth: bool,

    /// The same only where a pixel differs from a neighbour by more than T
    #[arg(long, value_name = "T", conflicts_with = "smooth")]
    pub smooth_edges: Option<f32>,
}

impl SamplingArgs {
    /// Flags of assignment 1.
    pub fn cast(&self) -> &CastArgs {
        self.accel.cast()
    }

    /// The flags of assignments 1 to 6 with the files of this one among those that are written,
    /// and leave to trace through something faster than `-grid`.
    ///
    /// # Errors
    /// A number that cannot be one.
    pub fn with_outputs(&self) -> Result<AccelArgs, AppError> {
        let mut all = self.accel.clone();
        let files = [self.pattern.picture()?, self.filter.picture()?].into_iter().flatten();
        let files = files.map(|(file, _)| file).chain(self.pattern.samples_image.clone());
        all.grid.whitted.phong.diffuse.cast.further_outputs.extend(files);
        // The picture is the same to the last bit; only the statistics tell of cells.
        all.fastest = !self.cast().general.program.stats;
        Ok(all)
    }

    /// Refuses impossible tasks, warns of flags without effect.
    ///
    /// # Errors
    /// More than one pattern or filter, numbers out of range.
    pub fn check(&self) -> Result<(), AppError> {
        self.pattern.check()?;
        self.filter.kernel()?;
        self.effects.check()?;
        self.motion.fault().map_or(Ok(()), |fault| Err(AppError::Usage(fault)))
    }
}

impl EffectArgs {
    fn check(&self) -> Result<(), AppError> {
        // Written so that NaN is refused.
        let within = |value: Option<f64>, least: f64| value.is_none_or(|x| x >= least && x.is_finite());
        let usage = |text: &str| Err(AppError::Usage(text.to_owned()));
        if !within(self.aperture, 0.0) {
            return usage("-aperture wants a number of at least 0");
        }
        if !within(self.focal_distance, f64::MIN_POSITIVE) {
            return usage("-focal_distance wants a number above 0");
        }
        if !self.smooth_edges.is_none_or(|t| t >= 0.0) {
            return usage("-smooth_edges wants a number of at least 0");
        }
        Ok(())
    }

    /// The lens: the scene's, as far as flags say nothing else; none if its diameter is 0.
    ///
    /// # Errors
    /// If flags describe half a lens and the scene has none.
    pub fn lens(&self, camera: &CameraSpec) -> Result<Option<Lens>, AppError> {
        let of_scene = camera.lens;
        let aperture = self.aperture.or(of_scene.map(|l| l.aperture));
        let focal_distance = self.focal_distance.or(of_scene.map(|l| l.focal_distance));
        let blades = self.blades.or(of_scene.and_then(|l| l.blades));
        match (aperture, focal_distance) {
            (Some(0.0), _) | (None, None) if blades.is_none() || aperture.is_some() => Ok(None),
            (Some(aperture), Some(focal_distance)) => Ok(Some(Lens { aperture, focal_distance, blades })),
            (None, _) => Err(AppError::Usage("this scene has no lens: give -aperture too".to_owned())),
            (_, None) => Err(AppError::Usage("this scene has no lens: give -focal_distance too".to_owned())),
        }
    }
}

/// A file and a zoom of at least 1, as `-render_samples` and `-render_filter` take them.
///
/// # Errors
/// If the zoom is no such number.
pub fn zoomed_file(flag: &str, values: Option<&Vec<String>>) -> Result<Option<(PathBuf, u32)>, AppError> {
    let Some(values) = values else { return Ok(None) };
    let zoom = values[1].parse().ok().filter(|zoom| (1..=4096).contains(zoom));
    let wrong = || {
        AppError::Usage(format!("{flag}: ZOOM must be a whole number from 1 to 4096, not `{}`", values[1]))
    };
    Ok(Some((PathBuf::from(&values[0]), zoom.ok_or_else(wrong)?)))
}
