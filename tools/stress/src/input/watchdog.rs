//! The parent's side: starts workers under a limit of memory, and looks at the clock.

use super::changes::{Case, Cases};
use super::worker::{PROGRESS, Task, VARIABLE};
use super::{FAMILIES, serve};
use crate::Stress;
use crate::row::Outcome;
use std::env::current_exe;
use std::io::Read;
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::OnceLock;
use std::thread;
use std::time::{Duration, Instant};

/// Memory that a reader may take, in KiB; it is address space that is limited, which is more.
const MEMORY: u32 = 512 << 10;

/// Time that one input may take.
const PATIENCE: Duration = Duration::from_secs(10);

/// How often the watchdog looks.
const LOOK: Duration = Duration::from_millis(20);

/// Deaths of workers after which a family is given up.
const MOST_DEATHS: u64 = 20;

static ARGUMENTS: OnceLock<Vec<String>> = OnceLock::new();

/// Says with which arguments this program calls [`serve`] first. If nothing is said it is the
/// program of `tests/quick`, which is called with the name of a test.
pub fn call_worker_by(arguments: &[&str]) {
    // Whoever comes first is right: there is one program only.
    let _ = ARGUMENTS.set(arguments.iter().map(|&a| a.to_owned()).collect());
}

/// Has every case of a family read, or the single one that is wanted.
pub fn watch(stress: &Stress, family: usize) {
    serve();
    let row = format!("p18 {}", FAMILIES[family].name);
    let cases = Cases::new(&FAMILIES[family], stress.tier(), stress.seed());
    let range = match stress.single() {
        Some(single) if single.row == row => single.trial as usize..single.trial as usize + 1,
        Some(_) => return,
        None => 0..cases.len(),
    };
    let started = Instant::now();
    let task = Task { family, tier: stress.tier(), seed: stress.seed(), from: range.start, to: range.end };
    stress.record(row, all(stress, task, &cases), started);
}

/// Workers until all is read; after each that died another for what is left.
fn all(stress: &Stress, mut task: Task, cases: &Cases) -> Outcome {
    let mut outcome = Outcome { trials: task.to as u64 - task.from as u64, ..Outcome::default() };
    let note = |outcome: Outcome, number: usize, why: &str| {
        let trials = outcome.trials;
        let noted = outcome.note(Some(number as u64), Err(explained(&cases.case(number), why)));
        Outcome { trials, ..noted }
    };
    for _ in 0..MOST_DEATHS {
        let end = match one(stress, task) {
            Ok(end) => end,
            Err(error) => return note(outcome, task.from, &format!("no worker could be started: {error}")),
        };
        for (number, why) in &end.faults {
            outcome = note(outcome, *number, why);
        }
        outcome.worst = outcome.worst.max(end.slowest.as_secs_f64());
        match end.death {
            None => return outcome,
            Some((number, why)) => {
                outcome = note(outcome, number, &why);
                task.from = number + 1;
            }
        }
    }
    outcome
}

fn explained(case: &Case, why: &str) -> String {
    let text: String = String::from_utf8_lossy(&case.bytes).chars().take(4000).collect();
    format!("{} {}: {why}\n{} bytes: {text:?}", case.name, case.change, case.bytes.len())
}

/// How a worker ended.
struct End {
    /// What was neither read nor refused.
    faults: Vec<(usize, String)>,
    /// The case that it died of, and how; `None` if it did not.
    death: Option<(usize, String)>,
    /// Longest time for one input, if it was said.
    slowest: Duration,
}

/// Linux has a limit of address space that a shell can set; on other systems the limit may be
/// refused, so that only the time is watched there.
fn command(stress: &Stress, task: Task) -> std::io::Result<Command> {
    let program = current_exe()?;
    let usual = || vec![stress.check().to_owned(), "--exact".to_owned(), "--nocapture".to_owned()];
    let mut command = if cfg!(target_os = "linux") {
        let mut shell = Command::new("sh");
        shell.args(["-c", &format!("ulimit -v {MEMORY} && exec \"$0\" \"$@\"")]).arg(program);
        shell
    } else {
        Command::new(program)
    };
    command.args(ARGUMENTS.get_or_init(usual)).env(VARIABLE, task.to_string());
    // Each arena and each thread sets address space aside that it does not use.
    command.env("MALLOC_ARENA_MAX", "1").env("RAYON_NUM_THREADS", "1").env("RUST_BACKTRACE", "0");
    command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    Ok(command)
}

/// Runs a worker to its end, or for as long as it makes progress.
fn one(stress: &Stress, task: Task) -> std::io::Result<End> {
    let folder = tempfile::tempdir()?;
    let progress = folder.path().join("progress");
    let mut child = command(stress, task)?.env(PROGRESS, &progress).spawn()?;
    let words = all_of(child.stdout.take().expect("it is piped"), usize::MAX);
    let complaints = all_of(child.stderr.take().expect("it is piped"), 500);
    let status = patient(&mut child, &progress)?;
    let words = words.join().unwrap_or_default();
    let faults = words.lines().filter_map(|line| line.strip_prefix('!')?.split_once(' '));
    let faults = faults.filter_map(|(number, why)| Some((number.parse().ok()?, why.to_owned()))).collect();
    // The harness of tests prints before, on the same line perhaps.
    let slowest = words.lines().find_map(|line| line.rsplit_once('=')?.1.parse().ok());
    let death = match (status, slowest) {
        (Some(status), Some(_)) if status.success() => None,
        (None, _) => Some(format!("not done after {} s", PATIENCE.as_secs())),
        (Some(status), _) => {
            let complaint = complaints.join().unwrap_or_default();
            Some(format!("the reader died ({status}): {}", complaint.trim()))
        }
    };
    let death = death.map(|why| (reached(&progress).unwrap_or(task.from), why));
    Ok(End { faults, death, slowest: Duration::from_millis(slowest.unwrap_or(0)) })
}

/// The case that a worker is at, once it has begun.
fn reached(progress: &Path) -> Option<usize> {
    let bytes = std::fs::read(progress).ok()?;
    Some(u64::from_le_bytes(bytes.try_into().ok()?) as usize)
}

/// Waits for the end of a worker; `None` if it made no progress and was ended.
fn patient(child: &mut Child, progress: &Path) -> std::io::Result<Option<ExitStatus>> {
    let (mut last, mut since) = (None, Instant::now());
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(Some(status));
        }
        let now = reached(progress);
        if now != last {
            (last, since) = (now, Instant::now());
        }
        // Making the samples takes time, too.
        if since.elapsed() > if last.is_some() { PATIENCE } else { 6 * PATIENCE } {
            child.kill()?;
            child.wait()?;
            return Ok(None);
        }
        thread::sleep(LOOK);
    }
}

/// All that comes out of a pipe until it is closed, or the last bytes of it.
fn all_of(mut pipe: impl Read + Send + 'static, most: usize) -> thread::JoinHandle<String> {
    thread::spawn(move || {
        let (mut last, mut buffer) = (Vec::new(), [0; 4096]);
        while let Ok(count @ 1..) = pipe.read(&mut buffer) {
            last.extend_from_slice(&buffer[..count]);
            let surplus = last.len().saturating_sub(most);
            last.drain(..surplus);
        }
        String::from_utf8_lossy(&last).into_owned()
    })
}
