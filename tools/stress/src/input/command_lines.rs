//! Command lines, a word a line: parsed only.

use super::family::{Sample, refusal};
use clap::Parser;
use common::cli::try_parse_from;
use tests::CommandLine;

/// Of the programs that the course has no lines for.
const OTHERS: [&str; 4] = [
    "a8_path_tracing -input scene8_01.txt -size 100 100 -output a.tga -spp 64 -sampler sobol -integrator mis -rr_depth 3 -crop 0 0 9 9 -checkpoint a.ckpt -aov albedo b.exr -spp_range 0 8 -seed 4",
    "a8_path_tracing -input scene8_01.txt -output a.exr -time 10 -error 0.01 -resume a.ckpt -linear -stats -threads 2",
    "a8_path_tracing -merge a.ckpt b.ckpt -output a.exr",
    "a9_simplification -input bunny.obj -ratio 0.1 -output small.ply -method memoryless -stats",
];

/// The course's lines and others.
pub fn samples() -> Vec<Sample> {
    let course = (0..=7).flat_map(CommandLine::of_assignment).map(|line| line.words);
    let others = OTHERS.map(|line| line.split(' ').map(str::to_owned).collect::<Vec<String>>());
    let sample = |words: Vec<String>| Sample { name: words[0].clone(), bytes: words.join("\n").into_bytes() };
    course.chain(others).map(sample).collect()
}

/// Options, a help text, or a usage error.
fn parsed<P: Parser>(words: &[&str]) -> Result<(), String> {
    match try_parse_from::<P>(words) {
        Ok(_) => Ok(()),
        Err(stop) if !matches!(stop.code, 0 | 2) => Err(format!("exit code {}: {}", stop.code, stop.text)),
        // The help of some programs is long.
        Err(stop) if stop.code == 0 => Ok(()),
        Err(stop) => refusal(&stop.text),
    }
}

/// By the program of that name; the course's name stands for all of its ray tracers.
pub fn read(name: &str, bytes: &[u8]) -> Result<(), String> {
    let text = String::from_utf8_lossy(bytes);
    let words: Vec<&str> = text.split('\n').collect();
    match name {
        "ifs" => parsed::<a0_ifs::Options>(&words),
        "a9_simplification" => parsed::<a9_simplification::Program>(&words),
        "a8_path_tracing" if text.contains("-merge") => parsed::<a8_path_tracing::merge::Program>(&words),
        "a8_path_tracing" => parsed::<a8_path_tracing::Program>(&words),
        // Each step knows the flags of those before it.
        _ if bytes.len().is_multiple_of(4) => parsed::<a1_ray_casting::Program>(&words),
        _ => parsed::<a7_sampling::Program>(&words),
    }
}
