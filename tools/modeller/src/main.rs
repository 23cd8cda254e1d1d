//! Writes the meshes and the sky of `scenes/meshes`, or checks that the files there are what it would write.

use modeller::{catalogue, sky};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

const HELP: &str = "\
Makes the meshes and the sky of scenes/meshes from formulas.

Usage: modeller [--check] [FOLDER]

  FOLDER    where they are (default: scenes/meshes of this workspace)
  --check   write nothing; exit with 1 unless every file is exactly what would be written
  --help    this text

Exit code: 0 done, 1 a check failed, 2 bad usage or a file that cannot be written.";

struct Options {
    check: bool,
    folder: PathBuf,
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if arguments.iter().any(|a| a == "--help" || a == "-h") {
        println!("{HELP}");
        return ExitCode::SUCCESS;
    }
    match parse(&arguments) {
        Ok(options) => run(&options),
        Err(message) => fail(2, &format!("{message}\n\n{HELP}")),
    }
}

fn parse(arguments: &[String]) -> Result<Options, String> {
    let (flags, folders): (Vec<&String>, Vec<&String>) = arguments.iter().partition(|a| a.starts_with('-'));
    if let Some(unknown) = flags.iter().find(|f| f.as_str() != "--check") {
        return Err(format!("unknown option {unknown}"));
    }
    let folder = match folders[..] {
        [] => Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/meshes"),
        [folder] => folder.into(),
        _ => return Err("more than one folder".into()),
    };
    Ok(Options { check: !flags.is_empty(), folder })
}

fn run(options: &Options) -> ExitCode {
    let models = catalogue::all();
    if let Some(fault) = models.iter().find_map(|m| m.check().err()) {
        return fail(1, &fault);
    }
    let step = if options.check { compare } else { write };
    let meshes = models.iter().map(|m| (m.name, m.text().into_bytes()));
    for (name, bytes) in meshes.chain([(sky::NAME, sky::bytes())]) {
        if let Err((code, message)) = step(&options.folder.join(name), &bytes) {
            return fail(code, &message);
        }
    }
    ExitCode::SUCCESS
}

fn compare(path: &Path, bytes: &[u8]) -> Result<(), (u8, String)> {
    match fs::read(path) {
        Ok(there) if there == bytes => Ok(()),
        Ok(_) => Err((1, format!("{} differs from what the modeller makes", path.display()))),
        Err(error) => Err((1, format!("{}: {error}", path.display()))),
    }
}

/// Writes under a temporary name and renames, so that a failure leaves the old file whole.
fn write(path: &Path, bytes: &[u8]) -> Result<(), (u8, String)> {
    let temporary = path.with_extension("part");
    fs::write(&temporary, bytes)
        .and_then(|()| fs::rename(&temporary, path))
        .map_err(|error| (2, format!("{}: {error}", path.display())))?;
    println!("{:14} {:8} bytes", path.file_name().unwrap_or_default().display(), bytes.len());
    Ok(())
}

fn fail(code: u8, message: &str) -> ExitCode {
    eprintln!("modeller: {message}");
    ExitCode::from(code)
}
