//! The flags of assignment 1; every later assignment flattens them into its own.

use crate::{Depth, Layer, Picture};
use common::cli::{AppError, GeneralArgs, Skip};
use common::picture::Size;
use std::path::{Path, PathBuf};

/// Ray casting: the nearest thing along one ray per pixel, in flat colour and as depth.
#[derive(clap::Parser)]
#[command(
    name = "a1_ray_casting",
    version,
    rename_all = "snake_case",
    after_help = "Example:\n  a1_ray_casting -input scenes/scene1_01.txt -size 200 200 -output out.tga -depth 9 10 depth.tga"
)]
pub struct Program {
    /// All flags.
    #[command(flatten)]
    pub args: CastArgs,
}

/// Scene in, pictures out.
#[derive(Clone, Debug, clap::Args)]
#[command(rename_all = "snake_case", next_help_heading = "Assignment 1: ray casting")]
pub struct CastArgs {
    /// Scene file to read
    #[arg(long, value_name = "SCENE")]
    pub input: PathBuf,

    /// Picture to write; the suffix says what kind: .tga .png .ppm .pfm .hdr .exr
    #[arg(long, value_name = "PICTURE")]
    pub output: Option<PathBuf>,

    /// Width and height of all pictures in pixels
    #[arg(long, num_args = 2, value_names = ["W", "H"], default_values = ["100", "100"])]
    pub size: Vec<i64>,

    /// Depth picture: grey, white at distance MIN along the ray, black at MAX
    #[arg(long, num_args = 3, value_names = ["MIN", "MAX", "PICTURE"])]
    pub depth: Option<Vec<String>>,

    /// Files that a later step writes from what the colour picture's rays count or meet; set by
    /// its program, not by a flag of this one.
    #[arg(skip)]
    pub further_outputs: Vec<PathBuf>,

    /// Files that a later step writes and that are no pictures; set by its program too.
    #[arg(skip)]
    pub further_files: Vec<PathBuf>,

    /// Flags of every program.
    #[command(flatten)]
    pub general: GeneralArgs,
}

impl CastArgs {
    /// The size asked for.
    ///
    /// # Errors
    /// If a side is below 1 or the picture is too large.
    pub fn size(&self) -> Result<Size, AppError> {
        Ok(Size::new(self.size[0], self.size[1])?)
    }

    /// The files this step writes.
    pub fn outputs(&self) -> Vec<&Path> {
        let depth = self.depth.iter().map(|d| Path::new(&d[2]));
        let further = self.further_outputs.iter().map(PathBuf::as_path);
        self.output.iter().map(PathBuf::as_path).chain(depth).chain(further).collect()
    }

    /// The colour picture, if there is a file for it, or its statistics are wanted, or the files
    /// of a later step follow from it.
    pub fn color_picture<'a>(&self, layer: impl Layer + 'a) -> Option<Picture<'a>> {
        let followed = !self.further_outputs.is_empty();
        let wanted = self.output.is_some() || self.general.program.stats || followed;
        wanted.then(|| Picture { path: self.output.clone(), layer: Box::new(layer) })
    }

    /// An error if there is nothing to do. Later steps give all their files, and the names of the
    /// flags that would have named one.
    ///
    /// # Errors
    /// If neither a picture nor the statistics are asked for.
    pub fn refuse_idleness(&self, outputs: &[&Path], flags: &str) -> Result<(), AppError> {
        if outputs.is_empty() && self.further_files.is_empty() && !self.general.program.stats {
            return Err(AppError::Usage(format!("nothing to do: give {flags} or -stats")));
        }
        Ok(())
    }

    /// The depth layer and its range.
    ///
    /// # Errors
    /// If the range is not two different finite numbers.
    pub fn depth_layer(&self) -> Result<Option<Depth>, AppError> {
        let Some(values) = &self.depth else { return Ok(None) };
        let number = |text: &str| {
            let parsed = text.parse::<f32>().ok().filter(|x| x.is_finite());
            parsed.ok_or_else(|| AppError::Usage(format!("-depth wants a number, not `{text}`")))
        };
        let (min, max) = (number(&values[0])?, number(&values[1])?);
        if min == max {
            return Err(AppError::Usage(format!("-depth: MIN and MAX are both {min}; they must differ")));
        }
        Ok(Some(Depth { min, max }))
    }

    /// The depth picture, if asked for, or if pictures that nobody asked for are not skipped. Its
    /// range has been checked by [`crate::Studio::open`].
    pub fn depth_picture(&self) -> Option<Picture<'static>> {
        let Some(layer) = self.depth_layer().ok().flatten() else {
            return self.unasked_picture(Depth { min: 0.0, max: 1.0 });
        };
        let path = Some(PathBuf::from(&self.depth.as_ref()?[2]));
        Some(Picture { path, layer: Box::new(layer) })
    }

    /// A picture that will not be written; none, unless such are not skipped.
    pub fn unasked_picture<'a>(&self, layer: impl Layer + 'a) -> Option<Picture<'a>> {
        let wanted = !self.general.skips(Skip::Pictures);
        wanted.then(|| Picture { path: None, layer: Box::new(layer) })
    }
}
