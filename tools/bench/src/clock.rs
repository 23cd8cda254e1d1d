//! Wall-clock and processor time.
//!
//! On a machine shared with others only processor time tells what work costs; it comes from the
//! kernel's scheduler, in nanoseconds.

use std::time::Instant;

/// How long something took.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Span {
    /// Milliseconds by the clock on the wall.
    pub wall: f64,
    /// Milliseconds of processor time.
    pub cpu: f64,
}

/// Nanoseconds that all threads of this process have run.
///
/// # Errors
/// If the system has no `/proc`.
pub fn process_time() -> std::io::Result<u64> {
    refresh();
    let mut total = 0;
    for task in std::fs::read_dir("/proc/self/task")? {
        // A thread may end between being listed and being read.
        total +=
            std::fs::read_to_string(task?.path().join("schedstat")).map_or(0, |text| first_number(&text));
    }
    Ok(total)
}

/// Nanoseconds that all threads of this process have run, those that have ended included. Of the
/// latter the kernel keeps no more than hundredths of a second.
///
/// # Errors
/// If the system has no `/proc`.
pub fn whole_process_time() -> std::io::Result<u64> {
    let living = process_time()?;
    let mut ticks_of_living = 0;
    for task in std::fs::read_dir("/proc/self/task")? {
        // A thread may end between being listed and being read.
        ticks_of_living += std::fs::read_to_string(task?.path().join("stat")).map_or(0, |text| ticks(&text));
    }
    let all = ticks(&std::fs::read_to_string("/proc/self/stat")?);
    Ok(living + all.saturating_sub(ticks_of_living) * TICK)
}

/// A hundredth of a second, the unit of times in `/proc` on every Linux.
const TICK: u64 = 10_000_000;

/// User and system time in a `stat` file. The program's name stands in parentheses and may hold
/// blanks; the times are the 12th and 13th fields behind it.
fn ticks(stat: &str) -> u64 {
    let fields = stat.rsplit(')').next().unwrap_or_default().split_whitespace().skip(11).take(2);
    fields.filter_map(|ticks| ticks.parse::<u64>().ok()).sum()
}

/// Nanoseconds that this thread has run; 0 if the system has no `/proc`.
pub fn thread_time() -> u64 {
    refresh();
    std::fs::read_to_string("/proc/thread-self/schedstat").map_or(0, |text| first_number(&text))
}

/// Runs `work` and times it; the processor time is that of all threads which outlive it.
///
/// # Errors
/// If the system has no `/proc`.
pub fn time<T>(work: impl FnOnce() -> T) -> std::io::Result<(T, Span)> {
    let (started, before) = (Instant::now(), process_time()?);
    let result = work();
    let cpu = process_time()?.saturating_sub(before) as f64 / 1e6;
    Ok((result, Span { wall: started.elapsed().as_secs_f64() * 1e3, cpu }))
}

/// Gives the processor up for a moment: the kernel brings a running thread's account up to date
/// when it is switched, else only at its ticks, milliseconds apart.
fn refresh() {
    std::thread::yield_now();
}

fn first_number(text: &str) -> u64 {
    text.split(' ').next().and_then(|n| n.parse().ok()).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn threads_that_have_ended_count() {
        let before = whole_process_time().unwrap();
        let started = Instant::now();
        while whole_process_time().unwrap() < before + 20_000_000 {
            assert!(started.elapsed() < Duration::from_secs(60), "processor time does not pass");
            let work = || (0..1_000_000u64).fold(0, |a, b| std::hint::black_box(a ^ b));
            std::thread::spawn(work).join().unwrap();
        }
    }

    #[test]
    fn sleep_takes_wall_time_and_work_takes_both() {
        let ((), asleep) = time(|| std::thread::sleep(Duration::from_millis(30))).unwrap();
        assert!(asleep.wall >= 30.0);
        let before = thread_time();
        let started = Instant::now();
        let mut sum = 0u64;
        while thread_time() < before + 20_000_000 {
            assert!(started.elapsed() < Duration::from_secs(60), "processor time does not pass");
            sum = (0..100_000).fold(sum, |s, i| std::hint::black_box(s ^ i));
        }
        assert!(started.elapsed() >= Duration::from_millis(19), "{sum}");
    }
}
