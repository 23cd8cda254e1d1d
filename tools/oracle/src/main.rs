//! The oracle as a program: the flags of assignments 1 to 7, the pictures in double precision.

mod args;

use args::Args;
use common::cli::{self, AppError};
use common::picture::{Film, Size, Transfer, check_output, write};
use oracle::{Raster, filter_picture, render, samples, samples_picture};
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

/// The independent reference renderer: double precision, brute force, slow.
#[derive(clap::Parser)]
#[command(
    name = "oracle",
    version,
    rename_all = "snake_case",
    after_help = "Example:\n  oracle -input scenes/scene4_04_reflective_sphere.txt -size 200 200 -output out.tga -shadows -bounces 3 -weight 0.01"
)]
struct Program {
    #[command(flatten)]
    args: Args,
}

fn main() -> ExitCode {
    let program: Program = cli::parse();
    cli::run(|| run(&program.args))
}

fn run(args: &Args) -> Result<(), AppError> {
    let size = Size::new(args.size[0], args.size[1])?;
    let depth = args.depth()?;
    let (of_samples, of_filter) = (args.samples_picture()?, args.filter_picture()?);
    let options = args.options(size, depth.as_ref().map(|d| d.range))?;
    let depth_file = depth.as_ref().map(|d| d.file.as_path());
    let files = [args.output.as_deref(), depth_file, args.normals.as_deref()];
    if files.iter().all(Option::is_none) && of_samples.is_none() && of_filter.is_none() {
        let flags = "-output, -depth, -normals, -render_samples or -render_filter";
        return Err(AppError::Usage(format!("nothing to do: give {flags}")));
    }
    for file in files.into_iter().flatten() {
        check_output(file, size)?;
    }
    let scene = common::scene::load(&args.input)?;
    let start = Instant::now();
    if let Some(picture) = of_filter {
        save(&picture.file, &filter_picture(&options, picture.zoom)?)?;
    }
    if let Some(picture) = of_samples {
        let samples = args.in_threads(|| samples(&scene, &options))??;
        save(&picture.file, &samples_picture(&samples, picture.zoom)?)?;
    }
    if files.iter().any(Option::is_some) {
        let pictures = args.in_threads(|| render(&scene, &options))??;
        let rasters = [Some(&pictures.colour), pictures.depth.as_ref(), pictures.normals.as_ref()];
        for (file, raster) in files.into_iter().zip(rasters) {
            if let (Some(file), Some(raster)) = (file, raster) {
                save(file, raster)?;
            }
        }
    }
    if args.general.program.stats {
        cli::say(&format!("rendered in {:.3} s", start.elapsed().as_secs_f64()));
    }
    Ok(())
}

/// Writes a picture; float formats keep single precision.
fn save(file: &Path, raster: &Raster) -> Result<(), AppError> {
    let size = Size::new(raster.width.into(), raster.height.into())?;
    check_output(file, size)?;
    let film = Film::from_fn(size, |x, y| raster.pixel(x, y).as_vec3());
    Ok(write(file, &film, Transfer::Linear)?)
}
