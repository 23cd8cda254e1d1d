//! What the figures were measured on and with.

use crate::report::{Cell, Table};
use std::fs;
use std::process::Command;
use std::time::{SystemTime, UNIX_EPOCH};

/// Instruction sets that matter here, as the kernel names them.
const SETS: [&str; 8] = ["sse4_2", "avx", "avx2", "fma", "bmi2", "avx512f", "neon", "asimd"];

/// Words about the machine and the program; what cannot be found out is left out.
pub fn table(command: &str) -> Table {
    let cpu = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let cores = std::thread::available_parallelism().map_or(String::new(), |n| n.to_string());
    let facts = [
        ("command", command.to_owned()),
        ("date", date(SystemTime::now())),
        ("processor", field(&cpu, "model name")),
        ("instruction sets", sets(&field(&cpu, "flags"))),
        ("cores to be used", cores),
        ("memory", memory()),
        ("system", system()),
        ("compiler", env!("BENCH_RUSTC").to_owned()),
        ("target", env!("BENCH_TARGET").to_owned()),
        ("profile", env!("BENCH_PROFILE").to_owned()),
        ("peers", if cfg!(feature = "peers") { "yes" } else { "no" }.to_owned()),
        ("commit", commit().unwrap_or_default()),
    ];
    let mut table = Table::new("machine", "", &[("", crate::report::Better::Neither)]);
    for (name, fact) in facts.into_iter().filter(|(_, fact)| !fact.is_empty()) {
        table.row(name, [Cell::Text(fact)]);
    }
    table
}

/// The value of the first `name : value`.
fn field(text: &str, name: &str) -> String {
    let value = |line: &str| {
        let (key, value) = line.split_once(':')?;
        (key.trim() == name).then(|| value.trim().to_owned())
    };
    text.lines().find_map(value).unwrap_or_default()
}

fn sets(flags: &str) -> String {
    let has = |set: &&str| flags.split(' ').any(|flag| flag == *set);
    SETS.into_iter().filter(has).collect::<Vec<_>>().join(" ")
}

fn memory() -> String {
    let text = fs::read_to_string("/proc/meminfo").unwrap_or_default();
    let kibibytes = field(&text, "MemTotal").trim_end_matches(" kB").parse::<f64>();
    kibibytes.map_or(String::new(), |k| format!("{:.1} GiB", k / f64::from(1 << 20)))
}

fn system() -> String {
    let release = fs::read_to_string("/proc/sys/kernel/osrelease").unwrap_or_default();
    format!("{} {}", std::env::consts::OS, release.trim()).trim_end().to_owned()
}

/// The commit of the working tree, if git is there to tell.
fn commit() -> Option<String> {
    let git = |words: &[&str]| {
        let output = Command::new("git").args(words).output().ok().filter(|o| o.status.success())?;
        Some(String::from_utf8_lossy(&output.stdout).trim().to_owned())
    };
    let commit = git(&["rev-parse", "--short=12", "HEAD"])?;
    let changed = git(&["status", "--porcelain", "--untracked-files=no"]).is_some_and(|s| !s.is_empty());
    Some(commit + if changed { ", with changes" } else { "" })
}

/// A moment as year-month-day hour:minute, UTC.
fn date(moment: SystemTime) -> String {
    let seconds = moment.duration_since(UNIX_EPOCH).map_or(0, |d| d.as_secs());
    let (mut days, minutes) = (seconds / 86_400, seconds / 60 % 1_440);
    let leap = |y: u64| y.is_multiple_of(4) && (!y.is_multiple_of(100) || y.is_multiple_of(400));
    let mut year = 1970;
    while days >= 365 + u64::from(leap(year)) {
        days -= 365 + u64::from(leap(year));
        year += 1;
    }
    let months = [31, 28 + u64::from(leap(year)), 31, 30, 31, 30, 31, 31, 30, 31, 30, 31];
    let mut month = 0;
    while days >= months[month] {
        days -= months[month];
        month += 1;
    }
    let (month, day, hour, minute) = (month + 1, days + 1, minutes / 60, minutes % 60);
    format!("{year}-{month:02}-{day:02} {hour:02}:{minute:02} UTC")
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn dates_are_those_of_the_calendar() {
        let at = |seconds| date(UNIX_EPOCH + Duration::from_secs(seconds));
        assert_eq!(at(0), "1970-01-01 00:00 UTC");
        assert_eq!(at(951_868_799), "2000-02-29 23:59 UTC");
        assert_eq!(at(951_868_800), "2000-03-01 00:00 UTC");
        assert_eq!(at(1_795_380_120), "2026-11-22 20:42 UTC");
    }

    #[test]
    fn fields_are_found_and_sets_are_whole_words() {
        let text = "processor\t: 0\nmodel name\t: A: B\nflags\t\t: sse4_2 avx512f\nmodel name : C\n";
        assert_eq!(field(text, "model name"), "A: B");
        assert_eq!(sets(&field(text, "flags")), "sse4_2 avx512f");
        assert_eq!(field(text, "bugs"), "");
        let table = table("bench all");
        assert_eq!(table.rows[0].cells, [Cell::from("bench all")]);
        assert!(table.rows.iter().any(|row| row.label == "compiler"));
    }
}
