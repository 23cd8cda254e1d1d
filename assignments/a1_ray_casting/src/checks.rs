//! What can be known to fail is found before anything is read or traced.

use crate::CastArgs;
use clap::ValueEnum;
use common::atomic::{self, place};
use common::cli::{AppError, SimdChoice};
use common::picture::{Size, check_output};
use common::scene::{Material, Scene};
use common::simd;
use std::path::{Path, PathBuf};

/// Restricts vector code to the instructions that the command line names.
///
/// # Errors
/// If this processor has them not.
pub fn choose_instructions(args: &CastArgs) -> Result<(), AppError> {
    let choice = args.general.simd;
    if choice == SimdChoice::Auto {
        return Ok(());
    }
    let value = choice.to_possible_value();
    let name = value.as_ref().map_or("auto", |v| v.get_name());
    simd::restrict(name).map_err(|why| AppError::Usage(format!("-simd {name}: {why}")))
}

/// Whether all files can be written, each to a place of its own, and none over the scene.
///
/// # Errors
/// If not.
pub fn check_outputs(args: &CastArgs, outputs: &[&Path], size: Size) -> Result<(), AppError> {
    let scene = place(&args.input);
    let files = args.further_files.iter().map(PathBuf::as_path);
    let all: Vec<&Path> = outputs.iter().copied().chain(files).collect();
    let places: Vec<PathBuf> = all.iter().map(|path| place(path)).collect();
    for (i, path) in all.iter().enumerate() {
        let is_picture = i < outputs.len();
        if places[..i].contains(&places[i]) {
            let what = if is_picture { "pictures" } else { "files" };
            return Err(AppError::Usage(format!("two {what} would be written to {}", path.display())));
        }
        if places[i] == scene {
            return Err(AppError::Usage(format!(
                "{} is the scene; a picture would destroy it",
                path.display()
            )));
        }
        if is_picture {
            check_output(path, size)?;
        } else {
            atomic::check(path)?;
        }
    }
    Ok(())
}

/// Textures are drawn from assignment 6 on; a wrong picture would be worse than none.
///
/// # Errors
/// If the scene has any.
pub fn refuse_textures(scene: &Scene) -> Result<(), AppError> {
    let textured = |m: &Material| match m {
        Material::Solid(_) => true,
        Material::Phong(p) => p.image.is_some(),
    };
    if scene.materials.iter().any(textured) {
        return Err(AppError::Usage("this scene has textures, which assignment 6 draws".to_owned()));
    }
    Ok(())
}
