//! Building and asking, timed in turn: every round asks everybody, so that a busy moment of the
//! machine hits all alike.

use super::contender::{Answer, Contender, Structure};
use super::sets::RaySet;
use crate::clock::{self, Span};
use crate::sample::Sample;
use crate::world::World;
use common::cli::AppError;
use common::ray::Ray;
use std::hint::black_box;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};

/// Most rays that one thread takes at a time, and asks together: streams of rays want many.
const MOST_TOGETHER: usize = 1 << 18;
/// Builds that are shorter than this many milliseconds are repeated within a round.
const LONG_ENOUGH: f64 = 50.0;
/// Most builds within a round.
const MOST_BUILDS: usize = 10;

/// What a structure cost to build.
#[derive(Clone, Debug, Default)]
pub struct Build {
    /// Milliseconds by the clock.
    pub wall: Sample,
    /// Milliseconds of processor time.
    pub cpu: Sample,
}

/// A structure that was built, and what that cost.
type Built<'w> = (Box<dyn Contender + 'w>, Build);

/// Builds all structures `rounds` times, in turn; returns the last of each.
///
/// # Errors
/// If one cannot be built.
pub fn build<'w>(
    world: &'w World,
    structures: &[Structure],
    rounds: usize,
) -> Result<Vec<Built<'w>>, AppError> {
    let mut built: Vec<(Option<Box<dyn Contender + 'w>>, Build)> = Vec::new();
    built.resize_with(structures.len(), || (None, Build::default()));
    for _ in 0..rounds.max(1) {
        for (structure, (kept, cost)) in structures.iter().zip(&mut built) {
            // Freed first: a large one and its successor may not fit beside each other.
            kept.take();
            let (contender, span) = build_once(structure, world)?;
            cost.wall.add(span.wall);
            cost.cpu.add(span.cpu);
            *kept = Some(contender);
        }
    }
    Ok(built.into_iter().map(|(kept, cost)| (kept.expect("built in the first round"), cost)).collect())
}

/// Builds one, short ones several times; the time is that of one build.
fn build_once<'w>(
    structure: &Structure,
    world: &'w World,
) -> Result<(Box<dyn Contender + 'w>, Span), AppError> {
    let (first, span) = clock::time(|| (structure.build)(world))?;
    let again = ((LONG_ENOUGH / span.wall.max(0.1)) as usize).min(MOST_BUILDS);
    if again < 2 {
        return Ok((first?, span));
    }
    let repeat = || (0..again).try_for_each(|_| (structure.build)(world).map(|built| drop(black_box(built))));
    let (done, all) = clock::time(repeat)?;
    done?;
    Ok((first?, Span { wall: all.wall / again as f64, cpu: all.cpu / again as f64 }))
}

/// Which question is asked of how many threads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Question {
    /// Any hit instead of the nearest.
    pub any: bool,
    /// Threads that share the rays.
    pub threads: usize,
}

/// What asking cost: million rays per second of all threads together, by processor time.
#[derive(Clone, Debug, Default)]
pub struct Rate {
    /// One figure per round.
    pub mrays: Sample,
    /// How many rays were asked in each round.
    pub rays: usize,
}

/// Asks all contenders all questions about a set, `rounds` times after a first round that only
/// warms up. The result is by contender, then by question.
pub fn ask(
    contenders: &[&dyn Contender],
    set: &RaySet,
    questions: &[Question],
    (timed, rounds): (usize, usize),
) -> Vec<Vec<Rate>> {
    let rays: Vec<Vec<Ray>> =
        contenders.iter().map(|c| sample(&set.rays, timed.min(c.affordable()))).collect();
    let mut rates = vec![vec![Rate::default(); questions.len()]; contenders.len()];
    for round in 0..=rounds {
        for (q, question) in questions.iter().enumerate() {
            for ((contender, rays), rates) in contenders.iter().zip(&rays).zip(&mut rates) {
                let seconds = ask_once(*contender, rays, set.reach, *question);
                if round > 0 {
                    rates[q].mrays.add(rays.len() as f64 / seconds / 1e6);
                    rates[q].rays = rays.len();
                }
            }
        }
    }
    rates
}

/// About `count` rays of a set: runs of up to 1024 neighbours, which keeps what coherence there
/// is, spread evenly over the set.
pub fn sample(rays: &[Ray], count: usize) -> Vec<Ray> {
    if rays.len() <= count {
        return rays.to_vec();
    }
    let run = (count / 16).clamp(1, 1024);
    let runs = count / run;
    // Whole runs of the set: those of a camera are its rows then.
    let start = |i: usize| i * rays.len() / runs / run * run;
    (0..runs).flat_map(|i| rays[start(i)..][..run].iter().copied()).collect()
}

/// Processor seconds per thread. This thread is one of them: what a contender keeps for it from
/// question to question need not be fetched from the system while the clock runs.
fn ask_once(contender: &dyn Contender, rays: &[Ray], reach: f32, question: Question) -> f64 {
    let threads = question.threads.max(1);
    let together = rays.len().div_ceil(threads).clamp(1, MOST_TOGETHER);
    let (next, total) = (AtomicUsize::new(0), AtomicU64::new(0));
    let work = || {
        let mut nearest = vec![Answer::MISS; together];
        let mut any = vec![false; together];
        let before = clock::thread_time();
        loop {
            let from = next.fetch_add(together, Ordering::Relaxed);
            let Some(rest) = rays.get(from..).filter(|rest| !rest.is_empty()) else { break };
            let share = &rest[..rest.len().min(together)];
            if question.any {
                contender.any_batch(share, reach, &mut any[..share.len()]);
            } else {
                contender.nearest_timed(share, reach, &mut nearest[..share.len()]);
            }
            black_box((&nearest, &any));
        }
        total.fetch_add(clock::thread_time() - before, Ordering::Relaxed);
    };
    std::thread::scope(|scope| {
        for _ in 1..threads {
            scope.spawn(work);
        }
        work();
    });
    total.into_inner() as f64 / 1e9 / threads as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use common::math::Vec3;

    #[test]
    fn samples_are_runs_spread_over_the_set() {
        let rays: Vec<Ray> = (0..10_000).map(|i| Ray::new(Vec3::splat(i as f32), Vec3::X)).collect();
        let place = |r: &Ray| r.origin.x as usize;
        for (count, made) in [(10, 10), (1_000, 992), (9_000, 8_992), (10_000, 10_000), (20_000, 10_000)] {
            let some: Vec<usize> = sample(&rays, count).iter().map(place).collect();
            assert_eq!(some.len(), made);
            assert!(some.windows(2).all(|w| w[0] < w[1]), "{count}");
            assert!(some[0] == 0 && *some.last().unwrap() >= 8_000);
        }
    }
}
