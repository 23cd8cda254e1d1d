//! From process start to the first pixel: every program, and meshes of growing size.

use crate::child::{self, PROGRAMS};
use crate::fit::power;
use crate::pictures::at_home;
use crate::report::{Better, Cell, Curve, Figure, Section, Table};
use crate::sample::Sample;
use common::cli::AppError;
use std::path::Path;

/// What to measure.
#[derive(clap::Args)]
pub struct Options {
    /// Rounds; every round starts every program once
    #[arg(long, default_value_t = 31)]
    rounds: usize,
}

/// One sphere: nothing but the start takes time.
const SPHERE: &str = "-input scenes/scene1_01.txt -size 1 1";
/// A scene of a Cornell box for the program that needs light with an extent.
const BOX: &str = "-input scenes/scene8_01_cornell_box.txt -size 1 1 -spp 1";
/// One mesh, cut ever finer: triangles and scene.
const MESHES: [(u32, &str); 4] = [
    (200, "scenes/scene6_04_bunny_mesh_200.txt"),
    (1_000, "scenes/scene6_05_bunny_mesh_1k.txt"),
    (5_000, "scenes/scene6_06_bunny_mesh_5k.txt"),
    (40_000, "scenes/scene6_07_bunny_mesh_40k.txt"),
];

/// A process that is started once a round, with wall-clock and processor time in milliseconds.
struct Case {
    label: String,
    line: String,
    draws: bool,
    wall: Sample,
    cpu: Sample,
}

impl Case {
    fn new(label: String, line: String, draws: bool) -> Self {
        Self { label, line, draws, wall: Sample::default(), cpu: Sample::default() }
    }

    fn start(&mut self, picture: &Path, counted: bool) -> Result<(), AppError> {
        let words: Vec<&str> = self.line.split(' ').collect();
        let span = child::time(&words, self.draws.then_some(picture))?;
        if counted {
            self.wall.add(span.wall);
            self.cpu.add(span.cpu);
        }
        Ok(())
    }
}

/// Starts everything `rounds` times, in turn.
///
/// # Errors
/// If a program fails, or this one is not started from the repository's root.
pub fn measure(options: &Options) -> Result<Section, AppError> {
    at_home()?;
    let helps = PROGRAMS.map(|p| Case::new(p.to_owned(), format!("{p} -help"), false));
    let pixel = |p: &str| if p == "a8_path_tracing" { BOX } else { SPHERE };
    let pixels = PROGRAMS.map(|p| Case::new(p.to_owned(), format!("{p} {}", pixel(p)), true));
    let mesh =
        |(n, file): (u32, &str)| Case::new(n.to_string(), format!("a6_kdtree -input {file} -size 1 1"), true);
    let mut cases: Vec<Case> = helps.into_iter().chain(pixels).chain(MESHES.map(mesh)).collect();
    child::in_folder(|folder| {
        // The first round warms the file cache and is not counted.
        for round in 0..=options.rounds.max(1) {
            cases.iter_mut().try_for_each(|case| case.start(&folder.join("out.tga"), round > 0))?;
        }
        Ok(())
    })?;
    Ok(section(&cases))
}

fn section(cases: &[Case]) -> Section {
    let (helps, rest) = cases.split_at(PROGRAMS.len());
    let (pixels, meshes) = rest.split_at(PROGRAMS.len());
    let columns =
        ["help, wall ms", "help, processor ms", "1x1 picture, wall ms", "1x1 picture, processor ms"];
    let mut programs = Table::new("programs", "", &columns.map(|name| (name, Better::Less)));
    for (help, pixel) in helps.iter().zip(pixels) {
        programs.row(&help.label, [&help.wall, &help.cpu, &pixel.wall, &pixel.cpu].map(Cell::from));
    }
    let columns = ["1x1 picture, wall ms", "1x1 picture, processor ms"];
    let mut sizes =
        Table::new("first pixel of a mesh", "triangles", &columns.map(|name| (name, Better::Less)));
    meshes.iter().for_each(|case| sizes.row(&case.label, [&case.wall, &case.cpu].map(Cell::from)));
    let (figure, growth) = figure(meshes);
    Section {
        part: "startup",
        title: "From process start to the first pixel".to_owned(),
        remarks: vec![
            "median (quartiles); all programs are in one executable here, so each starts as this one does"
                .to_owned(),
            format!(
                "reading, preparing and building what one ray needs grows as triangles^{growth:.2} (processor time without that of the smallest mesh)"
            ),
        ],
        headline: vec![("first pixel of a sphere, wall ms".to_owned(), Cell::from(&pixels[0].wall))],
        tables: vec![programs, sizes],
        figures: vec![figure],
        ..Section::default()
    }
}

/// Time against triangles, and the exponent of what is beyond the smallest mesh.
fn figure(meshes: &[Case]) -> (Figure, f64) {
    let curve = |name: &str, of: fn(&Case) -> &Sample| {
        Curve::new(name, meshes.iter().zip(MESHES).map(|(case, (n, _))| (f64::from(n), of(case).median())))
    };
    let cpu = curve("processor", |case| &case.cpu);
    let least = cpu.points[0].1;
    let beyond: Vec<(f64, f64)> =
        cpu.points[1..].iter().map(|(n, ms)| (*n, ms - least)).filter(|(_, ms)| *ms > 0.0).collect();
    let curves = vec![curve("wall clock", |case| &case.wall), cpu];
    (Figure::new("First pixel of a mesh", "triangles", "ms", curves), power(&beyond).b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn growth_is_that_beyond_the_start() {
        let mut cases: Vec<Case> =
            MESHES.iter().map(|(n, _)| Case::new(n.to_string(), String::new(), true)).collect();
        for (case, (n, _)) in cases.iter_mut().zip(MESHES) {
            case.wall.add(9.0);
            case.cpu.add(3.0 + f64::from(n - 200) / 1e3);
        }
        let (figure, growth) = figure(&cases);
        assert!((0.9..1.15).contains(&growth), "{growth}");
        assert_eq!(figure.curves[1].points[0], (200.0, 3.0));
    }
}
