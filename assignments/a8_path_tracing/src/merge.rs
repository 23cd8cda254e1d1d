//! `-merge`: one picture from what several runs have rendered.

use crate::args::FileArgs;
use crate::film::checkpoint;
use crate::film::join::{Part, join};
use crate::outputs::Outputs;
use common::atomic::{self, place};
use common::cli::{AppError, ProgramArgs, say};
use common::picture::check_output;
use std::ffi::OsString;
use std::path::PathBuf;

/// Put together what several runs have kept with -checkpoint: sample ranges that join, crops that
/// make a picture. The outcome is that of one run, to the bit.
#[derive(clap::Parser)]
#[command(
    name = "a8_path_tracing -merge",
    version,
    rename_all = "snake_case",
    after_help = "Example:\n  a8_path_tracing -input s.txt -spp_range 0 64 -checkpoint a.ckpt\n  a8_path_tracing -input s.txt -spp_range 64 128 -checkpoint b.ckpt\n  a8_path_tracing -merge a.ckpt b.ckpt -output out.exr"
)]
pub struct Program {
    /// All flags.
    #[command(flatten)]
    pub args: MergeArgs,
}

/// What to merge, and where to write it.
#[derive(Clone, Debug, clap::Args)]
#[command(rename_all = "snake_case", next_help_heading = "Merging")]
pub struct MergeArgs {
    /// The checkpoints
    #[arg(long, value_name = "FILE", num_args = 0..)]
    pub merge: Vec<PathBuf>,

    /// Picture to write; the suffix says what kind: .tga .png .ppm .pfm .hdr .exr
    #[arg(long, value_name = "PICTURE")]
    pub output: Option<PathBuf>,

    /// Other files to write.
    #[command(flatten)]
    pub files: FileArgs,

    /// Flags of every program.
    #[command(flatten)]
    pub program: ProgramArgs,
}

/// Whether a command line, the program's name first, asks for merging.
pub fn is_wanted(args: impl IntoIterator<Item = OsString>) -> bool {
    let is_flag =
        |word: &str| word.strip_prefix('-').is_some_and(|w| w.strip_prefix('-').unwrap_or(w) == "merge");
    args.into_iter().skip(1).any(|word| word.to_str().is_some_and(is_flag))
}

/// The whole of merging.
///
/// # Errors
/// Bad usage, files that are no checkpoints or do not belong together, an unwritable file.
pub fn run(args: &MergeArgs) -> Result<(), AppError> {
    let outputs = Outputs::new(args.output.as_ref(), &args.files)?;
    args.check(&outputs)?;
    let read = |path: &PathBuf| {
        Ok::<_, AppError>(Part { name: path.display().to_string(), checkpoint: checkpoint::read(path)? })
    };
    let merged = join(args.merge.iter().map(read).collect::<Result<_, _>>()?)?;
    let sums = &merged.sums;
    for (aov, path) in &outputs.aovs {
        if !sums.layout.has(*aov) {
            let what = format!("-aov {} was not kept, so there is none for {}", aov.name(), path.display());
            return Err(AppError::Usage(what));
        }
    }
    let size = sums.frame.crop_size();
    outputs
        .picture
        .iter()
        .chain(outputs.aovs.iter().map(|(_, path)| path))
        .try_for_each(|path| check_output(path, size))?;
    if sums.done() == 0 {
        return Err(AppError::Usage("there are no samples in these files".to_owned()));
    }
    outputs.write(&merged.identity, sums)?;
    if args.program.stats {
        let (files, samples) = (args.merge.len(), &sums.samples);
        say(&format!(
            "{files} files, {size} pixels, samples {} to {} (excluded)",
            samples.start, samples.end
        ));
    }
    Ok(())
}

impl MergeArgs {
    /// Refuses what can be known to fail before anything is read.
    fn check(&self, outputs: &Outputs) -> Result<(), AppError> {
        let usage = |text: String| Err(AppError::Usage(text));
        if self.merge.is_empty() {
            return usage("-merge wants the files to put together".to_owned());
        }
        if !outputs.any() && !self.program.stats {
            return usage("nothing to do: give -output, -aov, -checkpoint or -stats".to_owned());
        }
        if let Some(path) = &outputs.checkpoint {
            atomic::check(path)?;
        }
        let pictures = outputs.picture.iter().chain(outputs.aovs.iter().map(|(_, path)| path));
        let mut places: Vec<PathBuf> = self.merge.iter().map(|path| place(path)).collect();
        for path in pictures.chain(&outputs.checkpoint) {
            let there = place(path);
            if places.contains(&there) {
                return usage(format!("{} would be written over something else", path.display()));
            }
            places.push(there);
        }
        Ok(())
    }
}
