//! Who used the processors while something was measured.

use std::fs;
use std::time::Instant;

/// Processor time until now, in the kernel's ticks.
#[derive(Clone, Copy, Default)]
struct Ticks {
    /// Of all processors, idle or not.
    all: f64,
    /// In which they worked.
    busy: f64,
    /// In which they worked for us, or for a process that we started and that has ended.
    ours: f64,
}

/// A measurement of the load that has begun.
pub struct Watch {
    started: Instant,
    before: Ticks,
}

/// What was going on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Load {
    /// Seconds by the clock.
    pub seconds: f64,
    /// Share of the processors that we had; NaN if the system does not tell.
    pub ours: f64,
    /// Share that others had.
    pub others: f64,
}

impl Watch {
    /// Begins.
    pub fn start() -> Self {
        Self { started: Instant::now(), before: now() }
    }

    /// Ends.
    pub fn stop(&self) -> Load {
        load(self.started.elapsed().as_secs_f64(), self.before, now())
    }
}

fn load(seconds: f64, before: Ticks, after: Ticks) -> Load {
    let all = after.all - before.all;
    let ours = (after.ours - before.ours) / all;
    let others = ((after.busy - before.busy) / all - ours).max(0.0);
    if all > 0.0 {
        Load { seconds, ours, others }
    } else {
        Load { seconds, ours: f64::NAN, others: f64::NAN }
    }
}

fn now() -> Ticks {
    let read = |file| fs::read_to_string(file).unwrap_or_default();
    ticks(&read("/proc/stat"), &read("/proc/self/stat")).unwrap_or_default()
}

/// From the first line of `/proc/stat` (user, nice, system, idle, waiting for disks, ...) and from
/// `/proc/self/stat`, whose 14th to 17th fields are our time and that of our children.
fn ticks(machine: &str, own: &str) -> Option<Ticks> {
    let numbers =
        |text: &str| text.split_whitespace().map(|n| n.parse().unwrap_or(0.0)).collect::<Vec<f64>>();
    let times = numbers(machine.lines().next()?.strip_prefix("cpu ")?);
    // Fields 9 and 10 are guests, who are in the first two already.
    let all: f64 = times.iter().take(8).sum();
    let idle = times.get(3)? + times.get(4)?;
    // The second field is the program's name in brackets, which may hold anything.
    let after_name = numbers(own.rsplit_once(')')?.1);
    Some(Ticks { all, busy: all - idle, ours: after_name.get(11..15)?.iter().sum() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_read_and_become_shares() {
        let own = |n: u32| format!("7 (a) b) R 1 2 3 4 5 6 7 8 9 10 {n} 1 2 3 20 0 1");
        let before = ticks("cpu  10 0 10 70 10 0 0 0 5 5\ncpu0 1 2 3", &own(4)).unwrap();
        let after = ticks("cpu  60 0 20 90 30 0 0 0 9 9\ncpu0 1 2 3", &own(44)).unwrap();
        assert_eq!((before.all, before.busy, before.ours), (100.0, 20.0, 10.0));
        let load_of = load(3.0, before, after);
        assert_eq!((load_of.seconds, load_of.ours), (3.0, 0.4));
        assert!((load_of.others - 0.2).abs() < 1e-12, "{load_of:?}");
        assert!(load(0.0, before, before).ours.is_nan());
        assert!(ticks("", "").is_none() && ticks("cpu  1", &own(1)).is_none());
    }
}
