//! How many samples a pass has.

use std::time::Duration;

/// Longest time that a pass of more than one sample should take: what Ctrl-C may cost.
const LONGEST: Duration = Duration::from_secs(1);

/// Most samples of a pass.
const MOST: u32 = 1024;

/// When a rendering is over: whatever comes first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Goal {
    /// One past the last sample.
    pub end: u32,
    /// Time from the first ray on.
    pub time: Option<Duration>,
    /// Pixels whose relative error is probably below this get no more samples.
    pub error: Option<f64>,
}

impl Goal {
    /// Samples of the next pass if pixels have `done` and are to have `left` more; `None` if the
    /// time is over. `each` is how long one sample of every pixel probably takes, if that is
    /// known; `spent` is the time that has gone by.
    ///
    /// Passes begin at multiples of their size, a power of two, so that each takes a whole piece
    /// of a low-discrepancy sequence, and so none passes over a power of two.
    pub fn next_pass(&self, done: u32, left: u32, each: Option<Duration>, spent: Duration) -> Option<u32> {
        let Some(each) = each else { return Some(1.min(left)) };
        let time = self.time.map(|time| time.saturating_sub(spent));
        // As likely too early as too late.
        if time.is_some_and(|time| time < each / 2) {
            return None;
        }
        let longest = LONGEST.min(time.unwrap_or(LONGEST));
        let mut count = if done == 0 { 1 } else { (1 << done.trailing_zeros()).min(MOST) };
        while count > 1 && (count > left || each * count > longest) {
            count /= 2;
        }
        Some(count.min(left))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOAL: Goal = Goal { end: 100, time: None, error: None };

    fn passes(goal: &Goal, each: Duration) -> Vec<u32> {
        let (mut done, mut passes) = (0, Vec::new());
        while done < goal.end {
            let known = (done > 0).then_some(each);
            let Some(count) = goal.next_pass(done, goal.end - done, known, each * done) else { break };
            assert!(count > 0 && done % count == 0);
            passes.push(count);
            done += count;
        }
        passes
    }

    #[test]
    fn passes_grow_and_end_where_they_should() {
        assert_eq!(passes(&GOAL, Duration::from_micros(1)), [1, 1, 2, 4, 8, 16, 32, 32, 4]);
        assert_eq!(passes(&GOAL, Duration::from_millis(120))[..8], [1, 1, 2, 4, 8, 8, 8, 8]);
        assert_eq!(passes(&GOAL, Duration::from_secs(9)), [1; 100]);
    }

    #[test]
    fn the_time_is_kept() {
        let goal =
            |seconds| Goal { end: u32::MAX / 2, time: Some(Duration::from_secs(seconds)), error: None };
        for seconds in [1, 2, 3, 7, 10] {
            let each = Duration::from_millis(100);
            assert_eq!(passes(&goal(seconds), each).iter().sum::<u32>(), 10 * seconds as u32);
        }
        assert_eq!(passes(&goal(1), Duration::from_secs(5)), [1], "one sample in any case");
        assert_eq!(passes(&goal(10), Duration::from_secs(4)), [1, 1, 1], "12 s are nearer than 8");
    }
}
