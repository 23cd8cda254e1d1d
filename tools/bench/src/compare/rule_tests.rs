//! Made-up runs whose differences are known.

use super::*;
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Timings of a made-up run.
const ROWS: usize = 120;
/// Rounds of each.
const ROUNDS: usize = 9;
/// The relative deviation of one round.
const NOISE: f64 = 0.05;

/// Nearly normal, deviation 1: the sum of twelve even ones (Irwin & Hall).
fn normal(random: &mut Pcg64Mcg) -> f64 {
    let even = |_| (random.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
    (0..12).map(even).sum::<f64>() - 6.0
}

fn record(part: &str, row: usize, better: Better, cell: Cell) -> Record {
    Record { place: [part.to_owned(), "t".to_owned(), row.to_string(), "ms".to_owned()], better, cell }
}

/// A run: every other row is a rate, all costs are `factor(row)` times what they should be.
fn made_up(seed: u64, factor: impl Fn(usize) -> f64) -> Vec<Record> {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let timing = |row: usize| {
        let better = if row.is_multiple_of(2) { Better::Less } else { Better::More };
        let cost = (row + 1) as f64 * factor(row);
        let mut round = || cost * (1.0 + NOISE * normal(&mut random));
        let sample: Sample = (0..ROUNDS).map(|_| round()).collect();
        let shown = if better == Better::More { sample.map(|cost| 1.0 / cost) } else { sample };
        record(["rays", "path"][row % 3 % 2], row, better, Cell::from(&shown))
    };
    (0..ROWS).map(timing).collect()
}

#[test]
fn a_planted_slowdown_is_found_amid_drift_and_noise_and_nothing_else_is() {
    for seed in 0..20 {
        for row in [40, 41] {
            let old = made_up(seed, |_| 1.0);
            let new = made_up(seed + 1000, |r| if r == row { 1.1 * 1.3 } else { 1.1 });
            let found = differ(&old, &new);
            assert!((found.drift[0] - 1.1).abs() < 0.02, "{:?}", found.drift);
            let places: Vec<_> = found.moves.iter().map(|m| m.place[2].clone()).collect();
            assert_eq!(places, [row.to_string()], "seed {seed}");
            assert!((1.15..1.45).contains(&found.moves[0].ratio), "{:?}", found.moves[0]);
        }
    }
}

#[test]
fn there_is_no_false_alarm_without_it() {
    let alarms: usize = (0..100)
        .map(|seed| differ(&made_up(seed, |_| 1.0), &made_up(seed + 1000, |_| 1.1)).moves.len())
        .sum();
    assert_eq!(alarms, 0);
}

#[test]
fn progress_is_below_one_also_for_rates_and_the_largest_move_comes_first() {
    let factor = |row: usize| match row {
        10 => 0.5,
        11 => 0.25,
        12 => 3.0,
        _ => 1.0,
    };
    let found = differ(&made_up(1, |_| 1.0), &made_up(2, factor));
    let rows: Vec<&str> = found.moves.iter().map(|m| m.place[2].as_str()).collect();
    assert_eq!(rows, ["11", "12", "10"]);
    assert!(found.moves[0].ratio < 0.3 && found.moves[1].ratio > 2.5 && found.moves[2].ratio < 0.6);
}

#[test]
fn the_wall_clock_drifts_by_itself() {
    let walls = |mut records: Vec<Record>| {
        records
            .iter_mut()
            .filter(|r| r.place[2].ends_with('7'))
            .for_each(|r| r.place[3] = "wall ms".to_owned());
        records
    };
    let slow = |row: usize| if row % 10 == 7 { if row == 57 { 3.2 } else { 2.0 } } else { 0.9 };
    let found = differ(&walls(made_up(1, |_| 1.0)), &walls(made_up(2, slow)));
    assert!((found.drift[0] - 0.9).abs() < 0.02 && (found.drift[1] - 2.0).abs() < 0.1, "{:?}", found.drift);
    let rows: Vec<&str> = found.moves.iter().map(|m| m.place[2].as_str()).collect();
    assert_eq!(rows, ["57"]);
}

#[test]
fn a_part_that_moved_as_a_whole_is_one_line() {
    let found = differ(&made_up(1, |_| 1.0), &made_up(2, |row| if row % 3 % 2 == 1 { 1.5 } else { 1.0 }));
    let path = found.parts.iter().find(|w| w.part == "path").unwrap();
    assert!((path.ratio - 1.5).abs() < 0.1, "{path:?}");
    assert!(found.moves.is_empty(), "{:?}", found.moves);
}

#[test]
fn figures_that_cannot_move_are_listed_as_soon_as_they_do() {
    let cells = |count: u64, error: f64, word: &str| {
        vec![
            record("rays", 0, Better::Less, Cell::Count(count)),
            record("rays", 1, Better::Less, Cell::estimate(error, 0.5)),
            record("rays", 2, Better::More, Cell::Exact(error)),
            record("rays", 3, Better::Neither, Cell::from(word)),
            record("rays", 4, Better::Less, Cell::derived(error)),
            record(crate::compare::RUN, 5, Better::Neither, Cell::from(word)),
        ]
    };
    let found = differ(&cells(0, 1.0, "a"), &cells(3, 0.9, "b"));
    let told: Vec<_> = found.changes.iter().map(|c| (c.place[2].as_str(), c.better)).collect();
    assert_eq!(told, [("0", Some(false)), ("1", Some(true)), ("2", Some(false)), ("3", None)]);
    assert!(differ(&cells(3, 0.9, "b"), &cells(3, 0.9 * (1.0 + 1e-12), "b")).changes.is_empty());
    let mut more = cells(0, 1.0, "a");
    more.push(record("rays", 9, Better::Less, Cell::Count(1)));
    assert_eq!(differ(&cells(0, 1.0, "a"), &more).alone, [0, 1]);
    assert!(differ(&[], &[]).drift[0].is_nan());
}
