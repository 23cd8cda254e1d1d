//! All promises of accuracy, tried: a table of what was tried how often, and what did not hold.
//!
//! Each failure becomes a file from which `bench -- replay FILE` runs that very trial again.

mod replay;
mod reproducer;
mod single_ray;

pub use replay::{Replay, replay};

use crate::report::{Better, Cell, Section, Table};
use ::stress::{Row, Tier, is_chosen, properties, survey};
use common::cli::{AppError, note, say};
use reproducer::Reproducer;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// What to try.
#[derive(Clone, clap::Args)]
pub struct Options {
    /// Minutes instead of seconds: the numbers of the accuracy promises
    #[arg(long, conflicts_with = "long")]
    full: bool,
    /// Ten times as much as --full wherever chance plays a part
    #[arg(long)]
    long: bool,
    /// Other random numbers
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    /// Only these checks, by name or by its beginning (p01, p07_planes)
    #[arg(long, value_name = "NAME", num_args = 1.., value_delimiter = ',')]
    only: Vec<String>,
    /// Writes a line for each row
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Where reproducers of failures go
    #[arg(long, value_name = "FOLDER", default_value = "target/failures")]
    failures: PathBuf,
}

impl Default for Options {
    /// What the test command tries.
    fn default() -> Self {
        Self {
            full: false,
            long: false,
            seed: 0,
            only: Vec::new(),
            csv: None,
            failures: PathBuf::from("target/failures"),
        }
    }
}

impl Options {
    fn tier(&self) -> Tier {
        match (self.full, self.long) {
            (_, true) => Tier::Long,
            (true, _) => Tier::Full,
            _ => Tier::Quick,
        }
    }
}

/// Tries everything that is chosen; failures are in the table, and in files.
///
/// # Errors
/// If a name is unknown, or a file cannot be written.
pub fn measure(options: &Options) -> Result<Section, AppError> {
    Ok(section(options, &rows(options)?))
}

fn rows(options: &Options) -> Result<Vec<Row>, AppError> {
    // Checks of hostile input start this program again, which then serves as their worker.
    ::stress::input::call_worker_by(&["stress"]);
    for name in &options.only {
        if !properties().iter().any(|p| is_chosen(p, std::slice::from_ref(name))) {
            let names: Vec<&str> = properties().iter().map(|p| p.name).collect();
            return Err(AppError::Usage(format!("no check is called {name}; there are {}", names.join(" "))));
        }
    }
    let tier = options.tier();
    let rows = survey(tier, options.seed, &options.only, |row| {
        note(&format!(
            "{:<60} {:>12} trials {:>4} failures  worst {:<10.4} {:>8.2} s",
            row.name, row.trials, row.failures, row.worst, row.seconds
        ));
    });
    for row in &rows {
        if let Some(reproducer) = Reproducer::of(row, tier) {
            let file = reproducer.write(&options.failures)?;
            say(&format!("{}: `bench -- replay {}`\n{}", row.name, file.display(), reproducer.text));
        }
    }
    if let Some(file) = &options.csv {
        std::fs::write(file, csv(&rows))?;
    }
    Ok(rows)
}

fn csv(rows: &[Row]) -> String {
    let line = |row: &Row| {
        let Row { property, check, name, trials, failures, worst, seed, seconds, .. } = row;
        let name = name.replace('"', "'");
        format!("{property},{check},\"{name}\",{trials},{failures},{worst:e},{seed},{seconds:.3}\n")
    };
    "property,check,name,trials,failures,worst,seed,seconds\n".to_owned()
        + &rows.iter().map(line).collect::<String>()
}

fn section(options: &Options, rows: &[Row]) -> Section {
    let tier = options.tier().name();
    let seconds: f64 = rows.iter().map(|row| row.seconds).sum();
    let failed = rows.iter().filter(|row| row.failures > 0);
    Section {
        part: "stress",
        title: format!("The promises of accuracy, tried ({tier} numbers, seed {})", options.seed),
        remarks: vec![
            "worst: the largest value of any trial, mostly as a share of what is allowed".to_owned(),
            format!("{} rows, {seconds:.1} s", rows.len()),
        ],
        headline: vec![
            (
                "trials of the promises of accuracy".to_owned(),
                Cell::from(rows.iter().map(|r| r.trials).sum::<u64>()),
            ),
            ("of them failed".to_owned(), Cell::from(rows.iter().map(|r| r.failures).sum::<u64>())),
        ],
        tables: vec![by_property(rows), by_row(rows)],
        faults: failed
            .map(|row| format!("{}: {} of {} trials failed", row.name, row.failures, row.trials))
            .collect(),
        ..Section::default()
    }
}

/// A row for each promise.
fn by_property(rows: &[Row]) -> Table {
    let columns = [
        ("rows", Better::Neither),
        ("trials", Better::Neither),
        ("failures", Better::Less),
        ("seconds", Better::Neither),
    ];
    let mut table = Table::new("promises", "property", &columns);
    let mut sums: BTreeMap<u8, (u64, u64, u64, f64)> = BTreeMap::new();
    for row in rows {
        let sum = sums.entry(row.property).or_default();
        *sum = (sum.0 + 1, sum.1 + row.trials, sum.2 + row.failures, sum.3 + row.seconds);
    }
    for (property, (count, trials, failures, seconds)) in sums {
        let cells = [Cell::from(count), Cell::from(trials), Cell::from(failures), Cell::from(seconds)];
        table.row(property.to_string(), cells);
    }
    table
}

/// A row for each series of trials and each single check.
fn by_row(rows: &[Row]) -> Table {
    let columns = [
        ("check", Better::Neither),
        ("trials", Better::Neither),
        ("failures", Better::Less),
        ("worst", Better::Less),
        ("seed", Better::Neither),
        ("seconds", Better::Neither),
    ];
    let mut table = Table::new("checks", "name", &columns);
    for row in rows {
        let cells = [
            Cell::from(row.check),
            Cell::from(row.trials),
            Cell::from(row.failures),
            Cell::from(row.worst),
            Cell::from(row.seed),
            Cell::from(row.seconds),
        ];
        table.row(row.name.clone(), cells);
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_survey_makes_tables_and_unknown_names_are_refused() {
        let only = |name: &str| Options { only: vec![name.to_owned()], ..Options::default() };
        let section = measure(&only("p05_singular")).unwrap_or_else(|error| panic!("{}", error.report()));
        assert_eq!(section.tables[0].rows.len(), 1);
        assert_eq!(section.tables[1].rows[0].cells[2], Cell::Count(0));
        assert!(matches!(measure(&only("p99")), Err(AppError::Usage(_))));
    }
}
