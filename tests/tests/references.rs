//! Every picture of the course's command lines against its reference.
//!
//! `cargo test -p tests --test references -- --nocapture` prints a table of all differences.
//! `RAYSTEPS_BLESS=1` draws all references anew with the oracle, `RAYSTEPS_BLESS=A7` those of one
//! assignment, and fails all the same: look at the changed files, then run again without it.

use common::picture::{Comparison, Film, Transfer, compare, triptych, write};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use tests::{CommandLine, Picture, cost, program, reference};

/// Levels by which a pixel may differ without counting. Means over samples round less than single
/// rays do, and are held to one.
fn tolerance(line: &CommandLine) -> u8 {
    if line.assignment >= 7 { 1 } else { 2 }
}

/// Part of a picture's pixels that may differ by more: silhouettes, where one of two equally
/// near pixels is as right as the other.
const MOST_DIFFERING: f64 = 0.001;

/// Part of a picture's pixels that may differ at all: those whose colour lies on the edge of a
/// level. Rounding where the course truncates, or a light a little too bright, moves far more.
const MOST_UNEQUAL: f64 = 0.01;

/// The same of pictures of cells, whose faces have one colour all over: where it lies on that edge,
/// the whole face does.
const MOST_UNEQUAL_OF_CELLS: f64 = 0.02;

fn most_unequal(line: &CommandLine) -> f64 {
    let cells = line.words.iter().any(|word| word.starts_with("-visualize_grid"));
    if cells { MOST_UNEQUAL_OF_CELLS } else { MOST_UNEQUAL }
}

/// Whether references are to be drawn anew, and whose.
fn blessing() -> Option<String> {
    std::env::var("RAYSTEPS_BLESS").ok().filter(|value| !value.is_empty() && value != "0")
}

#[test]
fn every_picture_is_its_reference() {
    if let Some(whose) = blessing() {
        bless(&whose);
        panic!("references drawn anew: look at what changed, then run again without RAYSTEPS_BLESS");
    }
    let mut failures = Vec::new();
    println!("{:<20} {:>6} {:>6} {:>6} {:>9}  worst pixel", "picture", ">0", ">1", ">2", "rmse");
    for line in CommandLine::with_references() {
        for (picture, actual) in program::pictures(&line) {
            if let Err(why) = check(&line, &picture, &actual) {
                failures.push(why);
            }
        }
    }
    assert!(failures.is_empty(), "{} pictures differ\n{}", failures.len(), failures.join("\n"));
}

/// Compares one picture, prints a line of the table, and shows what differs too much.
fn check(line: &CommandLine, picture: &Picture, actual: &Film) -> Result<(), String> {
    let expected = reference::kept(picture).map_err(|error| format!("{line}\n  {error}"))?;
    let at = |tolerance| compare(&expected, actual, Transfer::Linear, tolerance);
    let tolerance = tolerance(line);
    let result = at(tolerance).map_err(|error| format!("{line}\n  {error}"))?;
    let [any, one, two] = [0, 1, 2].map(|tolerance| at(tolerance).map_or(0, |r| r.differing));
    let (stem, differing, rmse) = (picture.stem(), result.differing, result.rmse);
    println!("{stem:<20} {any:>6} {one:>6} {two:>6} {rmse:>9.5}  {}", worst(&result));
    if result.share() <= MOST_DIFFERING && any as f64 <= most_unequal(line) * result.pixels as f64 {
        return Ok(());
    }
    let shown = show(picture, &expected, actual);
    Err(format!(
        "{line}\n  of {} pixels {any} differ, {differing} by more than {tolerance}; worst {}\n  \
         expected | difference | actual: {}",
        result.pixels,
        worst(&result),
        shown.display()
    ))
}

fn worst(result: &Comparison) -> String {
    result.worst.map_or_else(
        || "none".to_owned(),
        |p| format!("({}, {}): {:?} expected, {:?} found", p.x, p.y, p.expected, p.actual),
    )
}

/// Writes reference, difference and picture side by side, and says where.
fn show(picture: &Picture, expected: &Film, actual: &Film) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("references");
    let path = folder.join(format!("{}.png", picture.stem()));
    fs::create_dir_all(&folder).expect("the target folder can be written to");
    let film = triptych(expected, actual, Transfer::Linear).expect("the sizes were compared");
    write(&path, &film, Transfer::Linear).expect("the target folder can be written to");
    path
}

/// Draws references, of all assignments or of `A7` alone. Command lines that share one must agree
/// on it.
fn bless(whose: &str) {
    let mut drawn: BTreeMap<String, Film> = BTreeMap::new();
    let wanted = |line: &CommandLine| whose == "1" || whose == format!("A{}", line.assignment);
    for line in CommandLine::with_references().into_iter().filter(wanted) {
        for (picture, film) in reference::drawn(&line) {
            let same = drawn.get(picture.stem()).is_none_or(|other| *other == film);
            assert!(same, "{line}\n  draws {} differently than a line before", picture.stem());
            reference::keep(&picture, &film).expect("the references can be written");
            drawn.insert(picture.stem().to_owned(), film);
        }
    }
}

/// The oracle's arithmetic may round differently on other machines, by a level and no more.
#[test]
fn small_references_are_what_the_oracle_draws() {
    let mut seen = BTreeSet::new();
    for line in CommandLine::with_references().iter().filter(|line| cost::is_small(line)) {
        if !line.pictures().iter().all(|picture| seen.insert(picture.file.clone())) {
            continue;
        }
        for (picture, film) in reference::drawn(line) {
            let kept = reference::kept(&picture).unwrap_or_else(|error| panic!("{line}\n  {error}"));
            let result = compare(&kept, &film, Transfer::Linear, 1)
                .unwrap_or_else(|error| panic!("{line}\n  {error}"));
            assert_eq!(result.differing, 0, "{line}\n  {}: worst {}", picture.file, worst(&result));
        }
    }
    assert!(seen.len() > 40, "only {} references are small enough", seen.len());
}

#[test]
fn no_reference_is_left_over() {
    let lines = CommandLine::with_references();
    let wanted: BTreeSet<PathBuf> =
        lines.iter().flat_map(CommandLine::pictures).map(|p| reference::path(&p)).collect();
    let kept: BTreeSet<PathBuf> = fs::read_dir(reference::folder())
        .expect("there is a folder of references")
        .map(|entry| entry.expect("it can be listed").path())
        .collect();
    assert_eq!(kept, wanted, "files on the left, pictures of command lines on the right");
}
