//! The flags of assignment 2, on top of those of assignment 1.

use crate::{LocalLight, Normals};
use a1_ray_casting::{CastArgs, Picture, picture};
use common::cli::AppError;
use common::scene::Scene;
use std::path::{Path, PathBuf};

/// Diffuse light on spheres, planes, triangles and meshes under transforms; normals as colours.
#[derive(clap::Parser)]
#[command(
    name = "a2_transforms",
    version,
    rename_all = "snake_case",
    after_help = "Example:\n  a2_transforms -input scenes/scene2_03_colored_lights.txt -size 200 200 -output out.tga -normals normals.tga"
)]
pub struct Program {
    /// All flags.
    #[command(flatten)]
    pub args: DiffuseArgs,
}

/// Normals and two-sided light.
#[derive(Clone, Debug, clap::Args)]
#[command(rename_all = "snake_case", next_help_heading = "Assignment 2: transforms and diffuse light")]
pub struct DiffuseArgs {
    /// Picture of the surface normals: |x|, |y|, |z| as red, green, blue
    #[arg(long, value_name = "PICTURE")]
    pub normals: Option<PathBuf>,

    /// Light surfaces seen from behind too, as if their normal pointed here; else they stay black
    #[arg(long)]
    pub shade_back: bool,

    /// Flags of assignment 1.
    #[command(flatten)]
    pub cast: CastArgs,
}

impl DiffuseArgs {
    /// The files this step and the one before write.
    pub fn outputs(&self) -> Vec<&Path> {
        let mut files = self.cast.outputs();
        files.extend(self.normals.as_deref());
        files
    }

    /// All pictures but the colour picture.
    pub fn side_pictures(&self) -> Vec<Picture<'static>> {
        let normals = picture(&self.normals, Normals).or_else(|| self.cast.unasked_picture(Normals));
        self.cast.depth_picture().into_iter().chain(normals).collect()
    }

    /// The lights of a scene, seen with these flags.
    pub fn local_light<'a>(&self, scene: &'a Scene) -> LocalLight<'a> {
        LocalLight { scene, shade_back: self.shade_back }
    }

    /// An error if there is nothing to do.
    ///
    /// # Errors
    /// If neither a picture nor the statistics are asked for.
    pub fn refuse_idleness(&self) -> Result<(), AppError> {
        self.cast.refuse_idleness(&self.outputs(), "-output, -depth, -normals")
    }
}
