//! What moved between two runs: as a section, so that the terminal and the page can show it.

mod rule;

use crate::report::csv::{self, Record};
use crate::report::{Better, Cell, Section, Table};
use common::cli::{self, AppError};
use rule::{Difference, Place, differ};
use std::path::PathBuf;

/// The part under which a run describes itself.
pub const RUN: &str = "run";

/// Two runs.
#[derive(clap::Args)]
pub struct Options {
    /// results.csv of the older run
    old: PathBuf,
    /// results.csv of the newer one
    new: PathBuf,
}

/// Prints what moved.
///
/// # Errors
/// If a file cannot be read.
pub fn run(options: &Options) -> Result<(), AppError> {
    let (old, new) = (csv::load(&options.old)?, csv::load(&options.new)?);
    let section = section(&options.old.display().to_string(), &old, &new);
    cli::say(section.to_string().trim_end());
    Ok(())
}

/// What moved from one run, which has a name, to another.
pub fn section(name: &str, old: &[Record], new: &[Record]) -> Section {
    let found = differ(old, new);
    let mut remarks = vec![
        format!(
            "all timings together cost {:.3} times as much processor time as in {name}, and {:.3} times as much on the wall clock: the drift of the machine, which is divided out",
            found.drift[0], found.drift[1]
        ),
        "moved: quartiles do not overlap, and the ratio is beyond 5 %, twice the quartiles' half-widths, and what noise makes of so many timings"
            .to_owned(),
        format!("{} figures were there before only, {} are new", found.alone[0], found.alone[1]),
    ];
    remarks.extend(circumstances(old, new));
    let tables = vec![parts(&found), moves(&found), changes(&found)];
    let title = format!("What moved since {name}");
    Section { part: "compared", title, remarks, tables, ..Section::default() }
}

/// Other words about machine and program, but for the date.
fn circumstances(old: &[Record], new: &[Record]) -> Vec<String> {
    let told = |cell: &Cell| matches!(cell, Cell::Text(_));
    let about = |r: &&Record| r.place[0] == RUN && r.place[2] != "date" && told(&r.cell);
    let other = |n: &Record| {
        let o = old.iter().find(|o| o.place == n.place)?;
        let what = [n.place[2].as_str(), n.place[3].as_str()].join(" ");
        (o.cell != n.cell).then(|| format!("{}: {} -> {}", what.trim_end(), o.cell, n.cell))
    };
    new.iter().filter(about).filter_map(other).collect()
}

fn parts(found: &Difference) -> Table {
    let columns =
        [("timings", Better::Neither), ("as a whole, ratio", Better::Less), ("scatter, %", Better::Neither)];
    let mut table = Table::new("parts, drift removed", "part, clock", &columns);
    for whole in &found.parts {
        let numbers = [whole.ratio, whole.scatter.exp_m1() * 100.0].map(Cell::derived);
        let clock = if whole.wall { "wall clock" } else { "processor" };
        table.row(
            format!("{}, {clock}", whole.part),
            std::iter::once(Cell::from(whole.timings)).chain(numbers),
        );
    }
    table
}

fn moves(found: &Difference) -> Table {
    let columns = [
        ("", Better::Neither),
        ("before", Better::Neither),
        ("after", Better::Neither),
        ("cost ratio, drift removed", Better::Less),
        ("limit", Better::Neither),
    ];
    let mut table = Table::new(format!("moved beyond the noise: {}", found.moves.len()), "timing", &columns);
    for m in &found.moves {
        let [old, new] = m.cells.clone();
        let numbers = [m.ratio, m.limit].map(Cell::derived);
        let word = Cell::from(if m.ratio > 1.0 { "worse" } else { "better" });
        table.row(label(&m.place), [word, old, new].into_iter().chain(numbers));
    }
    table
}

fn changes(found: &Difference) -> Table {
    let columns = ["", "before", "after"].map(|name| (name, Better::Neither));
    let mut table = Table::new(format!("figures that changed: {}", found.changes.len()), "figure", &columns);
    for c in &found.changes {
        let [old, new] = c.cells.clone();
        let word = match c.better {
            Some(true) => "better",
            Some(false) => "worse",
            None => "changed",
        };
        table.row(label(&c.place), [Cell::from(word), old, new]);
    }
    table
}

fn label(place: &Place) -> String {
    place.join(" / ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample::Sample;

    fn run(ms: f64, wrong: u64, machine: &str) -> Vec<Record> {
        let mut table = Table::new("t", "", &[("ms", Better::Less), ("wrong", Better::Less)]);
        for i in 0..12 {
            let time = if i == 3 { ms } else { 10.0 };
            let sample: Sample = [0.99, 1.0, 1.01].map(|f| f * time).into_iter().collect();
            table.row(i.to_string(), [Cell::from(&sample), Cell::Count(wrong)]);
        }
        let mut about = Table::new("machine", "", &[("", Better::Neither)]);
        about.row("processor", [Cell::from(machine)]);
        about.row("date", [Cell::from(machine)]);
        let sections = [("rays", table), (RUN, about)];
        let section = |(part, table)| Section { part, tables: vec![table], ..Section::default() };
        sections.into_iter().map(section).flat_map(|s| csv::records(&s)).collect()
    }

    #[test]
    fn what_moved_is_told_with_its_place() {
        let text = section("old.csv", &run(10.0, 0, "A"), &run(13.0, 0, "B")).to_string();
        for part in ["moved beyond the noise: 1", "rays / t / 3 / ms", "worse", "1.30", "processor: A -> B"] {
            assert!(text.contains(part), "{part} is not in\n{text}");
        }
        assert!(!text.contains("date:") && text.contains("figures that changed: 0"), "{text}");
        let text = section("old.csv", &run(13.0, 0, "A"), &run(10.0, 1, "A")).to_string();
        assert!(text.contains("better") && text.contains("figures that changed: 12"), "{text}");
    }
}
