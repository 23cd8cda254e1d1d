//! The command line.

use common::cli::{AppError, GeneralArgs};
use common::picture::Size;
use oracle::{CellPicture, Filter, GridFit, Model, Options, Specular};
use std::path::PathBuf;

/// The flags of assignments 1 to 7, but for patterns of samples with chance in them. Those of the window and the preview are accepted and have
/// no effect, so that every command line of the course can be given as it is.
#[derive(Clone, Debug, clap::Args)]
#[command(rename_all = "snake_case", next_help_heading = "Pictures")]
pub struct Args {
    /// Scene file to read
    #[arg(long, value_name = "SCENE")]
    pub input: PathBuf,

    /// Picture to write; the suffix says what kind: .tga .png .ppm .pfm .hdr .exr
    #[arg(long, value_name = "PICTURE")]
    pub output: Option<PathBuf>,

    /// Width and height of all pictures in pixels
    #[arg(long, num_args = 2, value_names = ["W", "H"], default_values = ["100", "100"])]
    pub size: Vec<i64>,

    /// Depth picture: grey, white at distance MIN, black at MAX
    #[arg(long, num_args = 3, value_names = ["MIN", "MAX", "PICTURE"])]
    pub depth: Option<Vec<String>>,

    /// Picture of the surface normals: |x|, |y|, |z| as red, green, blue
    #[arg(long, value_name = "PICTURE")]
    pub normals: Option<PathBuf>,

    /// Lighting model of assignment 1, 2, 3, or 4 to 7
    #[arg(long, value_enum, default_value_t)]
    model: ModelName,

    /// Light surfaces seen from behind too
    #[arg(long)]
    shade_back: bool,

    /// Form of the highlight: half vector or mirrored light direction
    #[arg(long, value_name = "FORM", value_enum, default_value_t)]
    specular: SpecularName,

    /// Cast shadow rays
    #[arg(long)]
    shadows: bool,

    /// How many times a ray may be mirrored or refracted
    #[arg(long, value_name = "N", default_value_t = 0)]
    bounces: u32,

    /// Drop mirrored and refracted rays whose weight falls below this
    #[arg(long, value_name = "W", default_value_t = 0.0)]
    weight: f64,

    /// Shadow rays pass transparent surfaces and take their colour
    #[arg(long)]
    transparent_shadows: bool,

    /// Share light between mirrored and refracted ray by Fresnel's equations
    #[arg(long)]
    fresnel: bool,

    /// Cells along x, y and z; matters with -visualize_grid only
    #[arg(long, num_args = 3, value_names = ["NX", "NY", "NZ"])]
    grid: Option<Vec<u32>>,

    /// Draw the occupied cells of the grid in place of the scene
    #[arg(long, visible_alias = "visualize_grid_count", requires = "grid")]
    visualize_grid: bool,

    /// Which cells an object fills
    #[arg(long, value_name = "RULE", value_enum, default_value_t)]
    grid_fit: FitName,

    /// Samples per pixel at the centres of a grid's cells; N a square
    #[arg(long, value_name = "N", default_value_t = 1)]
    uniform_samples: u32,

    /// Weight samples alike in a square of this half side, in pixels
    #[arg(long, value_name = "R", group = "filter")]
    box_filter: Option<f64>,

    /// Weight samples by a cone of this radius, in pixels
    #[arg(long, value_name = "R", group = "filter")]
    tent_filter: Option<f64>,

    /// Weight samples by a bell of this σ, in pixels
    #[arg(long, value_name = "SIGMA", group = "filter")]
    gaussian_filter: Option<f64>,

    /// Picture of the samples, enlarged ZOOM times
    #[arg(long, num_args = 2, value_names = ["PICTURE", "ZOOM"])]
    render_samples: Option<Vec<String>>,

    /// Picture of the filter, enlarged ZOOM times
    #[arg(long, num_args = 2, value_names = ["PICTURE", "ZOOM"], requires = "filter")]
    render_filter: Option<Vec<String>>,

    /// Rays through the lens for each sample; N a square
    #[arg(long, value_name = "N", default_value_t = 256)]
    lens_samples: u32,

    /// Pieces of each light that has an extent; N a square
    #[arg(long, value_name = "N", default_value_t = 256)]
    light_samples: u32,

    /// Lights with an extent shine from their centres, emissive surfaces do not light others
    #[arg(long)]
    hard_lights: bool,

    /// No effect: the oracle has no window
    #[arg(long)]
    gui: bool,

    /// No effect: the oracle has no preview
    #[arg(long, num_args = 2, value_names = ["THETA", "PHI"])]
    tessellation: Option<Vec<u32>>,

    /// No effect: the oracle has no preview
    #[arg(long)]
    gouraud: bool,

    /// Flags of every program; only -threads, -stats, -verbose and -quiet matter here.
    #[command(flatten)]
    pub general: GeneralArgs,
}

#[derive(Clone, Copy, Debug, Default, clap::ValueEnum)]
enum ModelName {
    /// Assignment 1
    Flat,
    /// Assignment 2
    Diffuse,
    /// Assignment 3
    Phong,
    /// Assignments 4 to 7
    #[default]
    Whitted,
}

#[derive(Clone, Copy, Debug, Default, clap::ValueEnum)]
enum SpecularName {
    /// Half vector
    #[default]
    Blinn,
    /// Mirrored light direction
    Phong,
}

#[derive(Clone, Copy, Debug, Default, clap::ValueEnum)]
enum FitName {
    /// The course's conservative rule
    #[default]
    Bounds,
    /// Exact overlap
    Exact,
}

/// What `-depth` says.
pub struct Depth {
    pub range: (f64, f64),
    pub file: PathBuf,
}

/// What `-render_samples` and `-render_filter` say.
pub struct Enlarged {
    pub file: PathBuf,
    pub zoom: u32,
}

/// The side of a square number of samples.
fn side(flag: &str, samples: u32) -> Result<u32, AppError> {
    let side = samples.isqrt();
    let wrong = || AppError::Usage(format!("-{flag} wants a square number above 0, not {samples}"));
    (samples > 0 && side * side == samples).then_some(side).ok_or_else(wrong)
}

fn enlarged(flag: &str, words: Option<&[String]>) -> Result<Option<Enlarged>, AppError> {
    let Some([file, zoom]) = words else { return Ok(None) };
    let wrong = |_| AppError::Usage(format!("-{flag} wants a whole number to enlarge by, not `{zoom}`"));
    Ok(Some(Enlarged { file: PathBuf::from(file), zoom: zoom.parse().map_err(wrong)? }))
}

impl Args {
    /// The picture of samples, if asked for.
    pub fn samples_picture(&self) -> Result<Option<Enlarged>, AppError> {
        enlarged("render_samples", self.render_samples.as_deref())
    }

    /// The picture of the filter, if asked for.
    pub fn filter_picture(&self) -> Result<Option<Enlarged>, AppError> {
        enlarged("render_filter", self.render_filter.as_deref())
    }

    fn filter(&self) -> Option<Filter> {
        let r#box = self.box_filter.map(Filter::Box);
        r#box.or(self.tent_filter.map(Filter::Tent)).or(self.gaussian_filter.map(Filter::Gaussian))
    }

    /// The depth picture, if asked for.
    pub fn depth(&self) -> Result<Option<Depth>, AppError> {
        let Some([min, max, file]) = self.depth.as_deref() else { return Ok(None) };
        let number = |text: &str| {
            let wrong = || AppError::Usage(format!("-depth wants a number, not `{text}`"));
            text.parse::<f64>().map_err(|_| wrong())
        };
        let range = (number(min)?, number(max)?);
        Ok(Some(Depth { range, file: PathBuf::from(file) }))
    }

    /// What to draw.
    pub fn options(&self, size: Size, depth: Option<(f64, f64)>) -> Result<Options, AppError> {
        Ok(Options {
            width: size.width(),
            height: size.height(),
            model: match self.model {
                ModelName::Flat => Model::Flat,
                ModelName::Diffuse => Model::Diffuse,
                ModelName::Phong => Model::Phong,
                ModelName::Whitted => Model::Whitted,
            },
            shade_back: self.shade_back,
            specular: match self.specular {
                SpecularName::Blinn => Specular::Blinn,
                SpecularName::Phong => Specular::Phong,
            },
            shadows: self.shadows,
            bounces: self.bounces,
            weight: self.weight,
            transparent_shadows: self.transparent_shadows,
            fresnel: self.fresnel,
            depth,
            normals: self.normals.is_some(),
            grid: self.cell_picture(),
            pixel_side: side("uniform_samples", self.uniform_samples)?,
            filter: self.filter(),
            lens_side: side("lens_samples", self.lens_samples)?,
            light_side: if self.hard_lights { 1 } else { side("light_samples", self.light_samples)? },
        })
    }

    fn cell_picture(&self) -> Option<CellPicture> {
        let [x, y, z] = *self.grid.as_deref()? else { return None };
        let fit = match self.grid_fit {
            FitName::Bounds => GridFit::Bounds,
            FitName::Exact => GridFit::Exact,
        };
        self.visualize_grid.then_some(CellPicture { cells: [x, y, z], fit })
    }

    /// Runs `work` with as many threads as `-threads` asks for.
    pub fn in_threads<T: Send>(&self, work: impl FnOnce() -> T + Send) -> Result<T, AppError> {
        let threads = self.general.program.threads.unwrap_or(0) as usize;
        Ok(rayon::ThreadPoolBuilder::new().num_threads(threads).build()?.install(work))
    }
}
