//! The flags of assignment 3, on top of those of assignments 1 and 2.

use crate::{Canvas, Phong, PhongColor, Preview, Resolution, Shading, Tessellation, Tessellator};
use a1_ray_casting::{CastArgs, Report, Studio, World};
use a2_transforms::DiffuseArgs;
use common::cli::{self, AppError};
use common::geometry::Surface;
use common::math::Vec3;
use common::picture::{Film, Transfer, write};
use std::path::{Path, PathBuf};

/// Most polygons of a preview: about 3 GiB with all that belongs to them.
const MOST_FACES: u64 = 1 << 24;

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

    /// Polygons that the preview makes of a sphere: around its axis, and from pole to pole; 10 5 if not given
    #[arg(long, num_args = 2, value_names = ["THETA", "PHI"], value_parser = clap::value_parser!(u32).range(2..=4096))]
    pub tessellation: Option<Vec<u32>>,

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

    /// The colours of a scene, seen with these flags.
    pub fn color<'a>(&self, scene: &'a dyn World) -> PhongColor<'a> {
        let phong = Phong { specular: self.specular };
        PhongColor { scene, light: self.diffuse.local_light(scene.as_scene()), phong }
    }

    /// Refuses an empty task and warns of flags without effect.
    ///
    /// # Errors
    /// If there is nothing to do, or a sphere would have too few polygons to be closed.
    pub fn check(&self) -> Result<(), AppError> {
        self.resolution()?;
        let previews = self.gui || self.preview.is_some();
        for (given, flag) in [(self.gouraud, "-gouraud"), (self.tessellation.is_some(), "-tessellation")] {
            if given && !previews {
                cli::warn(&format!("{flag} has no effect without -preview or -gui"));
            }
        }
        if self.gui {
            cli::note("note: there is no interactive window yet; -gui writes the pictures and ends");
        }
        if previews { Ok(()) } else { self.diffuse.refuse_idleness() }
    }

    /// How finely the preview cuts spheres.
    ///
    /// # Errors
    /// If a sphere would have fewer than three sides around its axis.
    pub fn resolution(&self) -> Result<Resolution, AppError> {
        match self.tessellation.as_deref() {
            None => Ok(Resolution::default()),
            Some(&[theta, phi]) if theta >= 3 => Ok(Resolution { theta, phi }),
            _ => Err(AppError::Usage("-tessellation: a sphere needs at least 3 polygons around".to_owned())),
        }
    }

    /// The scene as polygons.
    ///
    /// # Errors
    /// If `-tessellation` asks for less than a closed sphere, or for more than memory can hold.
    pub fn tessellate(&self, studio: &Studio) -> Result<Tessellation, AppError> {
        let resolution = self.resolution()?;
        let (geometry, viewpoint) = (&studio.geometry, studio.scene.camera.center);
        let tessellator = Tessellator { geometry, resolution, smooth: self.gouraud, viewpoint };
        match tessellator.most_faces() {
            0..=MOST_FACES => Ok(tessellator.run()),
            n => Err(AppError::Usage(format!(
                "-tessellation: {n} polygons are too many, at most {MOST_FACES}"
            ))),
        }
    }

    /// Draws and writes the preview of the studio's scene, if asked for. [`Studio::open`] has
    /// checked its file. `scene` tells what surfaces are made of.
    ///
    /// # Errors
    /// If the picture cannot be written.
    pub fn draw_preview(
        &self,
        studio: &Studio,
        scene: &dyn World,
        report: &mut Report,
    ) -> Result<(), AppError> {
        let Some(path) = &self.preview else { return Ok(()) };
        let tessellation = report.time("tessellate", || self.tessellate(studio))?;
        let film = report.time("preview", || self.preview_film(studio, scene, &tessellation));
        let (faces, corners) = (tessellation.faces.len(), tessellation.vertices.len());
        report.notes.push(format!("preview: {faces} polygons with {corners} corners"));
        Ok(report.time("write", || write(path, &film, Transfer::Linear))?)
    }

    /// The preview of polygons made with [`PhongArgs::tessellate`]; `scene` is the studio's, and
    /// tells what its surfaces are made of.
    pub fn preview_film(&self, studio: &Studio, scene: &dyn World, tessellation: &Tessellation) -> Film {
        let color = self.color(scene);
        let shading = if self.gouraud { Shading::Gouraud } else { Shading::Flat };
        let light = |surface: &Surface, view: Vec3| color.shade(surface, view);
        let canvas = Canvas {
            size: studio.size,
            background: studio.scene.background.color,
            nearest: f64::from(studio.camera.interval.min),
            options: self.cast().general.tile_options("preview"),
        };
        Preview { tessellation, camera: &studio.camera, shading, light }.draw(&canvas)
    }
}
