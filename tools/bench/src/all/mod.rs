//! Every part, one after the other, into a folder: `results.csv`, figures, and `index.html`, which
//! holds all and needs nothing else.
//!
//! What was measured is written after each part, so that a failure loses nothing. A part that fails
//! or finds a wrong result is shown as such, the rest still runs, and the program ends with code 1.

mod list;
mod load;
mod machine;

use crate::compare;
use crate::page::{self, Chapter};
use crate::report::csv::{self, Record};
use crate::report::{Better, Cell, Section, Table};
use ::stress::panic_words;
use common::atomic::replace;
use common::cli::{AppError, note, say, set_quiet};
use list::Entry;
use load::{Load, Watch};
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

/// What to measure, and where to put it.
#[derive(clap::Args)]
pub struct Options {
    /// Small meshes and few rounds: a look in less than two minutes; without it, some hours
    #[arg(long)]
    quick: bool,
    /// The folder for results.csv, figures and index.html
    #[arg(long, value_name = "FOLDER", default_value = "target/bench")]
    out: PathBuf,
    /// The results.csv of another run: the page says what moved
    #[arg(long, value_name = "FILE.csv")]
    compare: Option<PathBuf>,
    /// Results of other programs, in the form of results.csv, to be shown beside ours
    #[arg(long, value_name = "FILE.csv")]
    external: Option<PathBuf>,
    /// Only these parts
    #[arg(long, value_delimiter = ',')]
    parts: Vec<String>,
}

/// All that a run has found up to now.
struct Run<'a> {
    options: &'a Options,
    machine: Table,
    chapters: Vec<Chapter>,
    /// Of each part: its flags, and what it took.
    loads: Vec<(Entry, Load)>,
    /// The other run, and whatever was measured by others.
    old: Vec<Record>,
    external: Vec<Record>,
}

/// Measures all chosen parts.
///
/// # Errors
/// If a part is unknown, a file cannot be read or written, or, in the end, if a part failed.
pub fn run(options: &Options) -> Result<(), AppError> {
    perform(options, &list::chosen(options.quick, &options.parts)?)
}

fn perform(options: &Options, entries: &[Entry]) -> Result<(), AppError> {
    let read = |file: &Option<PathBuf>| file.as_ref().map_or(Ok(Vec::new()), |file| csv::load(file));
    let command = format!("bench all{}", if options.quick { " --quick" } else { "" });
    let mut run = Run {
        options,
        machine: machine::table(&command),
        chapters: Vec::new(),
        loads: Vec::new(),
        old: read(&options.compare)?,
        external: read(&options.external)?,
    };
    fs::create_dir_all(&options.out)?;
    keep_previous(&options.out)?;
    for entry in entries {
        note(&format!("{} ...", entry.name));
        let watch = Watch::start();
        let outcome = measured(entry);
        let load = watch.stop();
        // Some parts silence what they call.
        set_quiet(false);
        let chapter = Chapter { name: entry.name, command: entry.command(), outcome };
        tell(&chapter, &load);
        run.loads.push((entry.clone(), load));
        run.chapters.push(chapter);
        run.write()?;
    }
    run.tell();
    run.verdict()
}

/// Results of an earlier run stay, as `previous.csv`, when those of this one take their place.
fn keep_previous(out: &Path) -> Result<(), AppError> {
    let old = out.join("results.csv");
    if old.is_file() {
        replace(&out.join("previous.csv"), &fs::read(old)?)?;
    }
    Ok(())
}

/// What a part found; an error or a panic as text.
fn measured(entry: &Entry) -> Result<Section, String> {
    let work = || entry.part()?.measure();
    match catch_unwind(AssertUnwindSafe(work)) {
        Ok(result) => result.map_err(|error| error.report()),
        Err(panic) => Err(format!("error: the part panicked: {}", panic_words(&*panic))),
    }
}

/// A line about a part that has ended.
fn tell(chapter: &Chapter, load: &Load) {
    let state = if chapter.failed() { "FAILED" } else { "done" };
    let others = format!(", others had {:.0} % of the processors", load.others * 100.0);
    // What is over within a tick of the kernel's clock has no shares.
    let others = if load.others.is_nan() { "" } else { &others };
    note(&format!("{} {state}: {:.1} s{others}", chapter.name, load.seconds));
}

impl Run<'_> {
    /// Everything as records, the description of the run first.
    fn records(&self) -> Vec<Record> {
        let about =
            Section { part: "run", tables: vec![self.machine.clone(), self.log()], ..Section::default() };
        let sections = self.chapters.iter().filter_map(|c| c.outcome.as_ref().ok());
        std::iter::once(&about).chain(sections).flat_map(csv::records).collect()
    }

    fn comparison(&self) -> Option<Section> {
        let file = self.options.compare.as_ref()?;
        Some(compare::section(&file.display().to_string(), &self.old, &self.records()))
    }

    fn write(&self) -> Result<(), AppError> {
        let out = &self.options.out;
        replace(&out.join("results.csv"), csv::write(&self.records()).as_bytes())?;
        let last = self.chapters.last();
        let figures = last.iter().filter_map(|c| c.outcome.as_ref().ok()).flat_map(|s| &s.figures);
        for (i, figure) in figures.enumerate() {
            let name = format!("{}-{}.svg", last.map_or("", |c| c.name), i + 1);
            // The page says which figures are empty.
            if let Ok(svg) = figure.svg() {
                replace(&out.join(name), svg.as_bytes())?;
            }
        }
        let mut chapters = self.chapters.clone();
        let more = [("compared", self.comparison()), ("external", self.elsewhere())];
        for (name, section) in more {
            chapters.extend(section.map(|s| Chapter { name, command: String::new(), outcome: Ok(s) }));
        }
        let page = page::html(&[self.headline(), self.machine.clone(), self.log()], &chapters);
        Ok(replace(&out.join("index.html"), page.as_bytes())?)
    }

    /// The few figures that sum it up.
    fn headline(&self) -> Table {
        let mut table = Table::new("headline", "", &[("", Better::Neither)]);
        for chapter in &self.chapters {
            let lines = chapter.outcome.iter().flat_map(|section| &section.headline);
            lines.for_each(|(what, cell)| table.row(format!("{}: {what}", chapter.name), [cell.clone()]));
        }
        table.row("wrong results and failed parts", [Cell::from(self.wrong())]);
        table
    }

    fn wrong(&self) -> usize {
        self.chapters.iter().map(|c| c.outcome.as_ref().map_or(1, |s| s.faults.len())).sum()
    }

    /// How long each part took, and who else used the machine.
    fn log(&self) -> Table {
        let columns = ["seconds", "processors, ours %", "processors, others %", "flags"];
        let mut table = Table::new("parts", "", &columns.map(|name| (name, Better::Neither)));
        for (entry, load) in &self.loads {
            let [ours, others] = [load.ours, load.others].map(|share| Cell::derived(share * 100.0));
            let flags = Cell::from(entry.flags.as_str());
            table.row(entry.name, [Cell::derived(load.seconds), ours, others, flags]);
        }
        table
    }

    /// What others measured, as it came.
    fn elsewhere(&self) -> Option<Section> {
        let file = self.options.external.as_ref()?;
        let mut section =
            Section { part: "external", title: "Results of other programs".to_owned(), ..Section::default() };
        section.remarks.push(format!("from {}", file.display()));
        section.tables = csv::tables(&self.external);
        Some(section)
    }

    /// On the terminal: the headline, what moved, where the page is.
    fn tell(&self) {
        say(self.headline().to_string().trim_end());
        self.comparison().iter().for_each(|section| say(&format!("\n{section}")));
        note(&format!("page: {}", self.options.out.join("index.html").display()));
    }

    fn verdict(&self) -> Result<(), AppError> {
        let bad = self.chapters.iter().filter(|c| c.failed());
        let line = |c: &Chapter| match &c.outcome {
            Ok(section) => format!("{}: {}", c.name, section.faults.join("; ")),
            Err(text) => format!("{}: {}", c.name, text.trim_end()),
        };
        let lines: Vec<String> = bad.map(line).collect();
        if lines.is_empty() { Ok(()) } else { Err(AppError::CheckFailed(lines.join("\n"))) }
    }
}

#[cfg(test)]
mod tests;
