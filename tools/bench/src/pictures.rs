//! Whole command lines: process start, reading, building, rendering, writing.

use crate::sample::Sample;
use common::cli::{AppError, say};
use std::path::Path;
use std::process::Command;
use std::time::Instant;

/// A name and a command line of assignment 5.
const CASES: [(&str, &str); 5] = [
    ("start: one sphere, 1x1", "-input scenes/scene1_01.txt -size 1 1"),
    (
        "main job: 40k triangles, picture of cells",
        "-input scenes/scene5_09_bunny_mesh_40k.txt -size 200 200 -grid 40 40 33 -visualize_grid",
    ),
    (
        "40k triangles, shadows, grid",
        "-input scenes/scene5_09_bunny_mesh_40k.txt -size 200 200 -grid 40 40 33 -shadows",
    ),
    ("1k triangles, shadows, list", "-input scenes/scene5_07_bunny_mesh_1k.txt -size 200 200 -shadows"),
    (
        "gem, 5 bounces, list",
        "-input scenes/scene4_14_faceted_gem.txt -size 200 200 -shadows -shade_back -bounces 5 -weight 0.01",
    ),
];

/// Times every case `rounds` times, in turn.
///
/// # Errors
/// If a command line fails, or is not started from the repository's root.
pub fn run(rounds: usize) -> Result<(), AppError> {
    if !Path::new("scenes").is_dir() {
        return Err(AppError::Usage("run this from the repository's root, where scenes/ is".to_owned()));
    }
    let folder = std::env::temp_dir().join(format!("raysteps-bench-{}", std::process::id()));
    std::fs::create_dir_all(&folder)?;
    let measured = measure(rounds, &folder);
    std::fs::remove_dir_all(&folder)?;
    let measured = measured?;
    say(&format!("{:<44} {:>8} {:>8} {:>8} {:>9}", "milliseconds", "median", "25 %", "75 %", "processor"));
    for ((name, _), (wall, cpu)) in CASES.iter().zip(&measured) {
        let (m, a, b) = (wall.median(), wall.quantile(0.25), wall.quantile(0.75));
        say(&format!("{name:<44} {m:>8.1} {a:>8.1} {b:>8.1} {:>9.1}", cpu.median()));
    }
    Ok(())
}

fn measure(rounds: usize, folder: &Path) -> Result<Vec<(Sample, Sample)>, AppError> {
    let mut samples = vec![(Sample::default(), Sample::default()); CASES.len()];
    // The first round warms the file cache and is not counted.
    for round in 0..=rounds {
        for ((_, line), (wall, cpu)) in CASES.iter().zip(&mut samples) {
            let (w, c) = once(line, folder)?;
            if round > 0 {
                wall.add(w);
                cpu.add(c);
            }
        }
    }
    Ok(samples)
}

/// Wall-clock and processor time of one run, in milliseconds.
fn once(line: &str, folder: &Path) -> Result<(f64, f64), AppError> {
    let mut command = Command::new(std::env::current_exe()?);
    command.arg("child").args(line.split(' ')).arg("-output").arg(folder.join("out.tga"));
    let started = Instant::now();
    let output = command.output()?;
    let wall = started.elapsed().as_secs_f64() * 1e3;
    let text = String::from_utf8_lossy(&output.stdout);
    let cpu = text.lines().find_map(|l| l.strip_prefix("cpu_ns ")?.parse::<f64>().ok());
    match cpu {
        Some(ns) if output.status.success() => Ok((wall, ns / 1e6)),
        _ => Err(AppError::Usage(format!("`{line}` failed:\n{}", String::from_utf8_lossy(&output.stderr)))),
    }
}
