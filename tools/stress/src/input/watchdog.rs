//! The parent's side: starts workers under a limit of memory, and looks at the clock.

use super::changes::{Case, Cases};
use super::worker::{Task, VARIABLE};
use super::{FAMILIES, serve};
use crate::Stress;
use crate::row::Outcome;
use std::env::current_exe;
use std::io::{BufRead, BufReader, Read};
use std::process::{Child, Command, Stdio};
use std::sync::OnceLock;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

/// Memory that a reader may take, in KiB; it is address space that is limited, which is more.
const MEMORY: u32 = 512 << 10;

/// Time that one input may take.
const PATIENCE: Duration = Duration::from_secs(10);

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
        outcome.worst = outcome.worst.max(end.longest.as_secs_f64());
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
    /// Longest time for one input.
    longest: Duration,
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
    let mut child = command(stress, task)?.spawn()?;
    let complaints = tail_of_stderr(&mut child);
    let (send, receive) = channel();
    let output = child.stdout.take().expect("it is piped");
    thread::spawn(move || {
        // Ends with the child, or with the watchdog.
        for line in BufReader::new(output).split(b'\n').map_while(Result::ok) {
            if send.send(String::from_utf8_lossy(&line).into_owned()).is_err() {
                break;
            }
        }
    });
    let mut end = End { faults: Vec::new(), death: None, longest: Duration::ZERO };
    let (mut at, mut since) = (task.from, Instant::now());
    loop {
        // The first line takes as long as the samples take to be made.
        let line = receive.recv_timeout(if at == task.from { 6 * PATIENCE } else { PATIENCE });
        match line {
            Ok(line) => {
                if line.starts_with(['@', '=']) {
                    end.longest =
                        end.longest.max(if at == task.from { Duration::ZERO } else { since.elapsed() });
                    since = Instant::now();
                }
                match (line.chars().next(), line.get(1..).unwrap_or_default()) {
                    (Some('@'), number) => at = number.parse().unwrap_or(at),
                    (Some('!'), text) => {
                        end.faults.push((at, text.split_once(' ').map_or("", |t| t.1).to_owned()));
                    }
                    (Some('='), "") => {
                        child.wait()?;
                        return Ok(end);
                    }
                    _ => {}
                }
            }
            Err(RecvTimeoutError::Timeout) => {
                child.kill()?;
                child.wait()?;
                end.death = Some((at, format!("not done after {} s", PATIENCE.as_secs())));
                return Ok(end);
            }
            Err(RecvTimeoutError::Disconnected) => {
                let status = child.wait()?;
                let words = complaints.join().unwrap_or_default();
                end.death = Some((at, format!("the reader died ({status}): {}", words.trim())));
                return Ok(end);
            }
        }
    }
}

/// The last words of a child, once it has ended.
fn tail_of_stderr(child: &mut Child) -> thread::JoinHandle<String> {
    let mut errors = child.stderr.take().expect("it is piped");
    thread::spawn(move || {
        let (mut last, mut buffer) = (Vec::new(), [0; 4096]);
        while let Ok(count @ 1..) = errors.read(&mut buffer) {
            last.extend_from_slice(&buffer[..count]);
            let surplus = last.len().saturating_sub(500);
            last.drain(..surplus);
        }
        String::from_utf8_lossy(&last).into_owned()
    })
}
