//! Writes the meshes and the sky of `scenes/meshes`, or checks that the files there are what it would write.

use modeller::{catalogue, sky};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

const HELP: &str = "\
Makes the meshes and the sky of scenes/meshes from formulas; of the rabbit the fine mesh from which
a9_simplification makes those that are there.

Usage: modeller [--check] [FOLDER]
       modeller --rabbit FILE

  FOLDER    where they are (default: scenes/meshes of this workspace)
  --check   write nothing; exit with 1 unless every file is exactly what would be written
  --rabbit  write the fine rabbit, and nothing else
  --help    this text

Exit code: 0 done, 1 a check failed, 2 bad usage or a file that cannot be written.";

/// What to do.
enum Task {
    /// Make all meshes of a folder, or see whether they are what would be made.
    Folder { check: bool, folder: PathBuf },
    /// Write the fine rabbit.
    Rabbit(PathBuf),
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if arguments.iter().any(|a| a == "--help" || a == "-h") {
        println!("{HELP}");
        return ExitCode::SUCCESS;
    }
    match parse(&arguments) {
        Ok(Task::Folder { check, folder }) => run(check, &folder),
        Ok(Task::Rabbit(file)) => rabbit(&file),
        Err(message) => fail(2, &format!("{message}\n\n{HELP}")),
    }
}

fn parse(arguments: &[String]) -> Result<Task, String> {
    let (flags, files): (Vec<&String>, Vec<&String>) = arguments.iter().partition(|a| a.starts_with('-'));
    let known = ["--check", "--rabbit"];
    if let Some(unknown) = flags.iter().find(|f| !known.contains(&f.as_str())) {
        return Err(format!("unknown option {unknown}"));
    }
    match (&flags[..], &files[..]) {
        ([flag], [file]) if *flag == "--rabbit" => Ok(Task::Rabbit(file.into())),
        (flags, _) if flags.iter().any(|f| *f == "--rabbit") => Err("--rabbit wants one file".into()),
        (_, [_, _, ..]) => Err("more than one folder".into()),
        (flags, folder) => {
            let usual = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/meshes");
            let folder = folder.first().map_or(usual, PathBuf::from);
            Ok(Task::Folder { check: !flags.is_empty(), folder })
        }
    }
}

fn run(check: bool, folder: &Path) -> ExitCode {
    let models = catalogue::all();
    if let Some(fault) = models.iter().find_map(|m| m.check().err()) {
        return fail(1, &fault);
    }
    let step = if check { compare } else { write };
    let meshes = models.iter().map(|m| (m.name, m.text().into_bytes()));
    for (name, bytes) in meshes.chain([(sky::NAME, sky::bytes())]) {
        if let Err((code, message)) = step(&folder.join(name), &bytes) {
            return fail(code, &message);
        }
    }
    ExitCode::SUCCESS
}

fn rabbit(file: &Path) -> ExitCode {
    let model = catalogue::fine_rabbit();
    let written =
        model.check().map_err(|fault| (1, fault)).and_then(|()| write(file, model.text().as_bytes()));
    written.map_or_else(|(code, message)| fail(code, &message), |()| ExitCode::SUCCESS)
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
