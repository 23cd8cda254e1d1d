//! The chaos game (A0T2): start anywhere, apply maps chosen at random, see where it ends.

use crate::{Affine2, AliasTable, Dots, Ifs, Point2};
use common::picture::Size;
use common::tiles::{TileOptions, for_each_job};
use rand_core::Rng;
use rand_pcg::Pcg64Mcg;

/// Points that one job plays: long enough to be worth handing out, short enough to share.
const POINTS_PER_JOB: u64 = 1024;

/// Most maps that a table of several steps may hold, so that it stays in the first-level cache.
const MOST_COMPOUNDS: usize = 256;

/// The game for one system and one number of iterations.
///
/// Applying a map costs little; choosing it at random costs more. So the game draws several maps
/// at once from the table of all their combinations, which is the same experiment: thirty
/// iterations of the fern are seven draws of four maps and two of one.
#[derive(Clone, Debug)]
pub struct ChaosGame {
    /// Draws of several maps at once, then of the single maps that are left.
    rounds: [Round; 2],
    seed: u64,
}

/// A number of draws from one table.
#[derive(Clone, Debug)]
struct Round {
    draws: u32,
    choice: AliasTable,
    maps: Vec<Affine2>,
}

impl ChaosGame {
    /// Prepares the game of `iterations` maps per point. Each point has a random stream of its
    /// own, made from `seed` and the point's number.
    pub fn new(ifs: &Ifs, iterations: u32, seed: u64) -> Self {
        let steps = steps_at_once(ifs.maps().len(), iterations);
        Self {
            rounds: [
                Round::new(&ifs.compounded(steps), iterations / steps),
                Round::new(ifs, iterations % steps),
            ],
            seed,
        }
    }

    /// How many random maps are drawn per point, at most one per iteration.
    pub fn draws(&self) -> u32 {
        self.rounds.iter().map(|round| round.draws).sum()
    }

    /// Where point number `index` ends up. It starts uniformly distributed in [0, 1)².
    pub fn point(&self, index: u64) -> Point2 {
        let mut random = stream(self.seed, index);
        let start = Point2 { x: unit(random.next_u64()), y: unit(random.next_u64()) };
        self.carry(start, &mut random)
    }

    /// Where `start` ends up under maps chosen by `random`.
    fn carry(&self, start: Point2, random: &mut Pcg64Mcg) -> Point2 {
        let mut p = start;
        for round in &self.rounds {
            for _ in 0..round.draws {
                p = round.maps[round.choice.choose(random.next_u64())].apply(p);
            }
        }
        p
    }
}

impl Round {
    fn new(ifs: &Ifs, draws: u32) -> Self {
        Self {
            draws,
            choice: AliasTable::new(ifs.maps().iter().map(|entry| entry.probability)),
            maps: ifs.maps().iter().map(|entry| entry.map).collect(),
        }
    }
}

/// How many maps to draw at once: as many as give a small table, and no more than are needed.
fn steps_at_once(maps: usize, iterations: u32) -> u32 {
    const LONGEST: u32 = 8;
    (1..=LONGEST.min(iterations.max(1)))
        .take_while(|&steps| maps.pow(steps) <= MOST_COMPOUNDS)
        .last()
        .unwrap_or(1)
}

/// Plays the game for points number 0 to `points` (excluded) and plots where they end.
/// The picture does not depend on the number of threads.
pub fn play(game: &ChaosGame, points: u64, size: Size, options: &TileOptions) -> Dots {
    let dots = Dots::new(size);
    let jobs = points.div_ceil(POINTS_PER_JOB) as usize;
    for_each_job(
        jobs,
        options,
        || (),
        |(), job| {
            let first = job as u64 * POINTS_PER_JOB;
            let last = first.saturating_add(POINTS_PER_JOB).min(points);
            (first..last).for_each(|index| dots.plot(game.point(index)));
        },
    );
    dots
}

/// The random stream of one point: a generator whose 128-bit state is a hash of both numbers, so
/// that neighbouring points have nothing in common.
fn stream(seed: u64, index: u64) -> Pcg64Mcg {
    let low = mixed(index ^ mixed(seed));
    let high = mixed(low ^ seed.rotate_left(32));
    Pcg64Mcg::new(u128::from(high) << 64 | u128::from(low))
}

/// The SplitMix64 finaliser (Steele, Lea and Flood, "Fast splittable pseudorandom number
/// generators", 2014): every input bit changes half of the output bits.
fn mixed(value: u64) -> u64 {
    let mut z = value.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ z >> 31
}

/// A number in [0, 1), a multiple of 2⁻⁵³.
fn unit(random: u64) -> f64 {
    (random >> 11) as f64 / (1_u64 << 53) as f64
}

#[cfg(test)]
mod tests;
