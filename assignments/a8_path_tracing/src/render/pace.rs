//! How often to do what costs time but makes no picture better.

use std::time::{Duration, Instant};

/// The share of time that it may take.
const SHARE: u32 = 40;

/// Lets something happen now and then.
#[derive(Clone, Copy, Debug)]
pub struct Pace {
    /// Least time between the end of one and the beginning of the next.
    least: Duration,
    last: Instant,
    cost: Duration,
}

impl Pace {
    /// From now on, with at least so much time between.
    pub fn new(least: Duration) -> Self {
        Self { least, last: Instant::now(), cost: Duration::ZERO }
    }

    /// Whether it is time.
    pub fn is_due(&self) -> bool {
        self.last.elapsed() >= self.least.max(self.cost * SHARE)
    }

    /// Does it if it is time, and remembers how long it took.
    pub fn when_due(&mut self, work: impl FnOnce()) {
        if self.is_due() {
            let started = Instant::now();
            work();
            (self.cost, self.last) = (started.elapsed(), Instant::now());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::thread::sleep;

    #[test]
    fn what_takes_long_is_done_seldom() {
        let mut pace = Pace::new(Duration::ZERO);
        let mut times = 0;
        let mut once = |pace: &mut Pace| {
            pace.when_due(|| {
                times += 1;
                sleep(Duration::from_millis(5));
            });
            times
        };
        assert_eq!(once(&mut pace), 1);
        assert_eq!(once(&mut pace), 1, "it has just been done");
        sleep(Duration::from_millis(2));
        assert!(!pace.is_due(), "40 times 5 ms are not over");
    }
}
