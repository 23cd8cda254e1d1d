//! The files that a run writes: what they are called, and that they can be written.

use crate::args::SimplifyArgs;
use crate::files;
use common::atomic::{self, Unwritable, place};
use common::cli::AppError;
use common::picture::{self, Size};
use std::path::{Path, PathBuf};

/// Files of one level.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outputs {
    /// The mesh.
    pub mesh: Option<PathBuf>,
    /// The picture of `-render`.
    pub picture: Option<PathBuf>,
}

impl Outputs {
    /// For each level of a mesh its files: the names given, with the level in them if there are
    /// several.
    ///
    /// # Errors
    /// If HOTTEST of `-render` is no distance.
    pub fn of_mesh(args: &SimplifyArgs, count: usize) -> Result<Vec<Self>, AppError> {
        let picture = args.picture()?.map(|(path, _)| path.to_owned());
        let given = Self { mesh: args.cast().output.clone(), picture };
        let levels = args.goals.levels();
        if levels.is_empty() {
            return Ok(vec![given; count]);
        }
        let with = |path: &Option<PathBuf>, level: f64| path.as_ref().map(|path| named(path, level));
        let named =
            |level: &f64| Self { mesh: with(&given.mesh, *level), picture: with(&given.picture, *level) };
        Ok(levels.iter().map(named).collect())
    }

    /// Makes sure that all files can be written, that no two are one, and none is read.
    ///
    /// # Errors
    /// The first that cannot.
    pub fn check(all: &[Self], report: Option<&Path>, inputs: &[&Path], size: Size) -> Result<(), AppError> {
        for outputs in all {
            outputs.mesh.as_deref().map_or(Ok(()), files::check_output)?;
            outputs.picture.as_deref().map_or(Ok(()), |path| picture::check_output(path, size))?;
        }
        report.map_or(Ok(()), atomic::check)?;
        let paths = all.iter().flat_map(|o| o.mesh.iter().chain(&o.picture)).map(PathBuf::as_path);
        refuse_collisions(&paths.chain(report).collect::<Vec<_>>(), inputs)
    }
}

/// # Errors
/// If two of the outputs are one file, or one of them is an input.
pub fn refuse_collisions(outputs: &[&Path], inputs: &[&Path]) -> Result<(), AppError> {
    let places: Vec<PathBuf> = outputs.iter().map(|path| place(path)).collect();
    for (i, path) in outputs.iter().enumerate() {
        if inputs.iter().any(|input| place(input) == places[i]) {
            let text = format!("{} is read; writing it would destroy it", path.display());
            return Err(AppError::Usage(text));
        }
        if places[..i].contains(&places[i]) {
            let text = format!("two files would be written to {}", path.display());
            return Err(AppError::Usage(text));
        }
    }
    Ok(())
}

/// Writes a report as what its suffix says, JSON or else text.
///
/// # Errors
/// If it cannot be written.
pub fn write_report(path: &Path, text: &str, json: &str) -> Result<(), AppError> {
    let is_json = path.extension().is_some_and(|suffix| suffix.eq_ignore_ascii_case("json"));
    let bytes = format!("{}\n", if is_json { json } else { text });
    Ok(atomic::replace(path, bytes.as_bytes()).map_err(|source| Unwritable::refused(path, source))?)
}

/// `out.obj` for level 0.5 is `out_0.5.obj`.
fn named(path: &Path, level: f64) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let suffix = path.extension().map(|s| format!(".{}", s.to_string_lossy())).unwrap_or_default();
    path.with_file_name(format!("{stem}_{level}{suffix}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a9t7_levels_stand_before_the_suffix() {
        for (path, level, name) in [
            ("out.obj", 0.5, "out_0.5.obj"),
            ("a.b/out.v2.ply", 0.01, "a.b/out.v2_0.01.ply"),
            ("out", 1.0, "out_1"),
        ] {
            assert_eq!(named(Path::new(path), level), Path::new(name));
        }
    }
}
