//! One trial, or one ray, once more.

use super::reproducer::Reproducer;
use super::single_ray::{self, answers};
use ::stress::{again, properties};
use common::cli::{AppError, say};
use std::path::PathBuf;

/// What to run again.
#[derive(clap::Args)]
pub struct Replay {
    /// A file that a failure of `stress` was written to
    #[arg(required_unless_present = "mesh", conflicts_with = "mesh")]
    file: Option<PathBuf>,
    /// A mesh for a ray of your own
    #[arg(long, value_name = "FILE.obj", requires = "ray")]
    mesh: Option<PathBuf>,
    /// Origin and direction; decimals, or the bits of a float such as 0x3f800000
    #[arg(long, num_args = 6, value_names = ["OX", "OY", "OZ", "DX", "DY", "DZ"])]
    #[arg(requires = "mesh", allow_negative_numbers = true, value_parser = single_ray::number)]
    ray: Vec<f32>,
}

/// Runs it and says what comes of it.
///
/// # Errors
/// If a file cannot be read, the trial still fails, or the structures disagree.
pub fn replay(options: &Replay) -> Result<(), AppError> {
    match (&options.mesh, &options.file) {
        (Some(mesh), _) => answers(mesh, &options.ray),
        (None, Some(file)) => trial(&Reproducer::read(file)?),
        (None, None) => Err(AppError::Usage("a file, or --mesh and --ray, should be given".to_owned())),
    }
}

fn trial(failure: &Reproducer) -> Result<(), AppError> {
    ::stress::input::call_worker_by(&["stress"]);
    let Reproducer { check, row, tier, seed, trial, .. } = failure;
    let property = properties().iter().find(|p| p.name == check);
    let property = property.ok_or_else(|| AppError::Usage(format!("there is no check {check} any more")))?;
    let found = again(property, *tier, *seed, row, *trial);
    let found = found.ok_or_else(|| AppError::Usage(format!("{check} has no row '{row}' any more")))?;
    match found.first {
        None => {
            say(&format!("{row}: it holds now (worst {:.4})", found.worst));
            Ok(())
        }
        Some(first) => Err(AppError::CheckFailed(format!("{row}: it still fails\n{}", first.text))),
    }
}
