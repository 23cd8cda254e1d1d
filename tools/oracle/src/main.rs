//! The oracle as a program: the flags of assignments 1 to 6, the pictures in double precision.

mod args;

use args::Args;
use common::cli::{self, AppError};
use common::picture::{Film, Size, Transfer, check_output, write};
use oracle::{Raster, render};
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
    let options = args.options(size, depth.as_ref().map(|d| d.range));
    let depth_file = depth.as_ref().map(|d| d.file.as_path());
    let files = [args.output.as_deref(), depth_file, args.normals.as_deref()];
    if files.iter().all(Option::is_none) {
        return Err(AppError::Usage("nothing to do: give -output, -depth or -normals".to_owned()));
    }
    for file in files.into_iter().flatten() {
        check_output(file, size)?;
    }
    let scene = common::scene::load(&args.input)?;
    let start = Instant::now();
    let pictures = args.in_threads(|| render(&scene, &options))??;
    if args.general.program.stats {
        cli::say(&format!("rendered in {:.3} s", start.elapsed().as_secs_f64()));
    }
    let rasters = [Some(&pictures.colour), pictures.depth.as_ref(), pictures.normals.as_ref()];
    for (file, raster) in files.into_iter().zip(rasters) {
        if let (Some(file), Some(raster)) = (file, raster) {
            save(file, size, raster)?;
        }
    }
    Ok(())
}

/// Writes a picture; float formats keep single precision.
fn save(file: &Path, size: Size, raster: &Raster) -> Result<(), AppError> {
    let film = Film::from_fn(size, |x, y| raster.pixel(x, y).as_vec3());
    Ok(write(file, &film, Transfer::Linear)?)
}
