//! Every file of `tests/corpus`: what must come of it stands in the table of its README.

use a5_grid::Fit;
use common::accel::{Accel, List};
use common::cli::try_parse_from;
use common::counters::Counters;
use common::geometry::Geometry;
use common::math::{Interval, Vec3};
use common::mesh::read_obj;
use common::picture::Transfer;
use common::ray::Ray;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use stress::kit::{Named, exact_triangle, geometry_of, repository, structures};

fn folder() -> PathBuf {
    repository().join("tests/corpus")
}

/// Files and outcomes of the table.
fn table() -> Vec<(String, String)> {
    let text = fs::read_to_string(folder().join("README.md")).expect("the table of the corpus");
    let row = |line: &str| {
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        let file = cells.get(1)?.strip_prefix('`')?.strip_suffix('`')?;
        Some((file.to_owned(), cells.get(2)?.to_string()))
    };
    text.lines().filter_map(row).collect()
}

fn text<T>(result: Result<T, impl ToString>) -> Result<(), String> {
    result.map(drop).map_err(|error| error.to_string())
}

/// What the reader of a folder makes of a file.
fn outcome(kind: &str, path: &Path) -> Result<(), String> {
    match kind {
        "scenes" => {
            let scene = common::scene::load(path).map_err(|error| error.to_string())?;
            text(Geometry::build(&scene))
        }
        "meshes" => text(a9_simplification::files::read(path)),
        "ifs" => text(a0_ifs::load(path)),
        "pictures" => common::picture::read(path, Transfer::Linear).map(drop).map_err(|e| in_full(&e)),
        "checkpoints" => text(a8_path_tracing::film::checkpoint::read(path)),
        "command_lines" => command_line(path),
        "rays" => ray(path),
        other => panic!("{other} has no reader"),
    }
}

/// An error with its causes.
fn in_full(error: &dyn std::error::Error) -> String {
    let causes = std::iter::successors(Some(error), |error| error.source());
    causes.map(ToString::to_string).collect::<Vec<_>>().join(": ")
}

fn command_line(path: &Path) -> Result<(), String> {
    let line = fs::read_to_string(path).expect("a file of the corpus");
    try_parse_from::<a5_grid::Program>(line.split_whitespace()).map(drop).map_err(|stop| stop.text)
}

/// A number in decimal or in bits.
fn number(word: &str) -> f32 {
    match word.strip_prefix("0x") {
        Some(digits) => f32::from_bits(u32::from_str_radix(digits, 16).expect("eight digits")),
        None => word.parse().expect("a number"),
    }
}

/// Whether everybody agrees on what a ray hits.
fn ray(path: &Path) -> Result<(), String> {
    let content = fs::read_to_string(path).expect("a file of the corpus");
    let said =
        |key: &str| content.lines().find_map(|line| line.strip_prefix(key)).expect("it stands in a comment");
    let numbers: Vec<f32> = said("# ray ").split(' ').map(number).collect();
    let ray = Ray::new(Vec3::from_slice(&numbers[..3]), Vec3::from_slice(&numbers[3..]));
    let expected: Option<u32> = said("# hit ").parse().ok();
    let mesh = read_obj(path).map_err(|error| error.to_string())?;
    let corners = |t: &[u32; 3]| t.map(|i| mesh.positions[i as usize]);
    let triangles: Vec<[Vec3; 3]> = mesh.triangles.iter().map(corners).collect();
    let geometry = geometry_of(&triangles);
    let list = List::new(&geometry);
    let others = structures(&geometry, &[([3, 4, 5], Fit::Exact), ([1, 1, 1], Fit::Bounds)]);
    let all = others.iter().map(|Named { name, accel }| (name.as_str(), &**accel as &dyn Accel));
    for (name, accel) in all.chain([("list", &list as &dyn Accel)]) {
        let hit = accel.nearest(&ray, Interval::FORWARD, &mut Counters::default()).map(|hit| hit.primitive);
        if hit != expected {
            return Err(format!("{name}: {hit:?}, not {expected:?}"));
        }
    }
    let usable = ray.is_usable();
    let exact = expected.is_none_or(|i| exact_triangle(&ray, &triangles[i as usize]).is_some());
    let missed = expected.is_some() || !usable || triangles.iter().all(|t| exact_triangle(&ray, t).is_none());
    if exact && missed { Ok(()) } else { Err(format!("exact arithmetic says it is not {expected:?}")) }
}

#[test]
fn corpus_files_have_the_outcome_of_the_table() {
    let mut wrong = Vec::new();
    for (file, expected) in table() {
        let kind = file.split('/').next().expect("a folder");
        let found = outcome(kind, &folder().join(&file));
        let right = match &found {
            Ok(()) => expected == "ok",
            Err(error) => expected != "ok" && error.contains(&expected),
        };
        if !right {
            wrong.push(format!("{file}: want {expected}, got {found:?}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn corpus_files_are_all_in_the_table() {
    let listed: BTreeSet<String> = table().into_iter().map(|(file, _)| file).collect();
    let folders = fs::read_dir(folder()).expect("the corpus").map(|entry| entry.expect("an entry").path());
    let files = folders.filter(|path| path.is_dir()).flat_map(|path| {
        let kind = path.file_name().expect("a name").to_string_lossy().into_owned();
        let names = fs::read_dir(path).expect("a folder").map(|entry| entry.expect("an entry").file_name());
        names.map(|name| format!("{kind}/{}", name.to_string_lossy())).collect::<Vec<_>>()
    });
    assert_eq!(files.collect::<BTreeSet<String>>(), listed);
    assert!(listed.len() > 40);
}
