//! The flags of assignment 4, on top of those of assignments 1 to 3.

use crate::{RayTree, Rules, Whitted};
use a1_ray_casting::{CastArgs, Report, Sight, Studio, World};
use a3_phong::{Phong, PhongArgs};
use common::accel::Accel;
use common::camera::screen_position;
use common::cli::{self, AppError, Skip};
use std::path::Path;

/// Whitted ray tracing: shadows, reflection, refraction.
#[derive(clap::Parser)]
#[command(
    name = "a4_whitted",
    version,
    rename_all = "snake_case",
    after_help = "Example:\n  a4_whitted -input scenes/scene4_04_reflective_sphere.txt -size 200 200 -output out.tga -shadows -bounces 3 -weight 0.01"
)]
pub struct Program {
    /// All flags.
    #[command(flatten)]
    pub args: WhittedArgs,
}

/// Shadows and secondary rays.
#[derive(Clone, Debug, clap::Args)]
#[command(rename_all = "snake_case", next_help_heading = "Assignment 4: shadows, mirrors, glass")]
pub struct WhittedArgs {
    /// Cast shadow rays
    #[arg(long)]
    pub shadows: bool,

    /// How many times a ray may be mirrored or refracted; 0 if not given
    #[arg(long, value_name = "N")]
    pub bounces: Option<u32>,

    /// Drop mirrored and refracted rays whose weight falls below this
    #[arg(long, value_name = "W")]
    pub weight: Option<f32>,

    /// Shadow rays pass transparent surfaces and take their colour; else every surface blocks
    #[arg(long)]
    pub transparent_shadows: bool,

    /// Share light between mirrored and refracted ray by Fresnel's equations
    #[arg(long)]
    pub fresnel: bool,

    /// Print the tree of rays of one pixel, counted from the lower left corner
    #[arg(long, num_args = 2, value_names = ["X", "Y"])]
    pub trace: Option<Vec<u32>>,

    /// Flags of assignments 1 to 3.
    #[command(flatten)]
    pub phong: PhongArgs,
}

impl WhittedArgs {
    /// Flags of assignment 1.
    pub fn cast(&self) -> &CastArgs {
        self.phong.cast()
    }

    /// The files that this step and those before write.
    pub fn outputs(&self) -> Vec<&Path> {
        self.phong.outputs()
    }

    /// Refuses impossible and empty tasks, warns of flags without effect.
    ///
    /// # Errors
    /// A cut-off weight that is no number, a pixel outside the picture, nothing to do.
    pub fn check(&self) -> Result<(), AppError> {
        if self.weight.is_some_and(|w| !w.is_finite() || w < 0.0) {
            return Err(AppError::Usage("-weight wants a number of at least 0".to_owned()));
        }
        let without = |flag: bool, name: &str, other: &str| {
            if flag {
                cli::warn(&format!("{name} has no effect without {other}"));
            }
        };
        // `-bounces 0 -weight 0.01` stands in the course's own command lines, so only a missing
        // `-bounces` is worth a word.
        without(self.weight.is_some() && self.bounces.is_none(), "-weight", "-bounces");
        without(self.fresnel && self.bounces.is_none(), "-fresnel", "-bounces");
        without(self.transparent_shadows && !self.shadows, "-transparent_shadows", "-shadows");
        self.check_pixel()?;
        if self.trace.is_some() { Ok(()) } else { self.phong.check() }
    }

    fn check_pixel(&self) -> Result<(), AppError> {
        let (Some(pixel), size) = (&self.trace, self.cast().size()?) else { return Ok(()) };
        if pixel[0] >= size.width() || pixel[1] >= size.height() {
            let what = format!("-trace: pixel {} {} is outside the picture of {size}", pixel[0], pixel[1]);
            return Err(AppError::Usage(what));
        }
        Ok(())
    }

    /// The tracer that these flags describe.
    pub fn whitted<'a>(&self, scene: &'a dyn World, accel: &'a dyn Accel) -> Whitted<'a> {
        let skips = |kind| self.cast().general.skips(kind);
        Whitted {
            scene,
            accel,
            light: self.phong.diffuse.local_light(scene.as_scene()),
            phong: Phong { specular: self.phong.specular },
            rules: Rules {
                shadows: self.shadows,
                transparent_shadows: self.transparent_shadows,
                bounces: self.bounces.unwrap_or(0),
                min_weight: self.weight.unwrap_or(0.0),
                fresnel: self.fresnel,
                skip_behind: skips(Skip::Behind),
                skip_dark: skips(Skip::Dark),
                skip_inside: skips(Skip::Inside),
                skip_black: skips(Skip::Black),
                skip_known: skips(Skip::Known),
                skip_surface: skips(Skip::Surface),
            },
        }
    }

    /// Prints the ray tree of the pixel that `-trace` names.
    ///
    /// # Errors
    /// None today; kept for symmetry with the other outputs.
    pub fn print_ray_tree(
        &self,
        studio: &Studio,
        whitted: &Whitted,
        report: &mut Report,
    ) -> Result<(), AppError> {
        let Some(pixel) = &self.trace else { return Ok(()) };
        let (x, y) = (f64::from(pixel[0]) + 0.5, f64::from(pixel[1]) + 0.5);
        let ray = studio.camera.ray(screen_position(studio.size, x, y));
        let mut tree = RayTree::default();
        // Who asks for the tree wants to see all of it.
        let whitted = &Whitted { rules: Rules { skip_known: false, ..whitted.rules }, ..*whitted };
        let counters = &mut report.counters;
        counters.rays += 1;
        let hit = whitted.accel.nearest(&ray, studio.camera.interval, counters);
        let color = whitted.radiance(&Sight::new(&studio.geometry, ray, hit), counters, &mut tree);
        cli::say(&format!(
            "pixel {} {}: {:.6} {:.6} {:.6}\n{tree}",
            pixel[0], pixel[1], color.x, color.y, color.z
        ));
        Ok(())
    }
}
