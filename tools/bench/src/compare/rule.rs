//! What moved between two runs, and what is only noise.
//!
//! Every timing gives one ratio, new cost over old cost (rates are turned over). The median of all
//! ratios is the *drift*: the machine was quicker or slower as a whole, by its clock or by the load
//! of others; it is divided out. The wall clock has a drift of its own, since it goes on while
//! others work: timings of columns whose name says `wall` are held to that.
//!
//! What is left scatters. The scatter of a part, for each clock, is robustly estimated by the median
//! of the logarithms' sizes (times 1.4826, which makes it the deviation of a normal distribution); a
//! part with few timings has the scatter of all. A timing has moved if
//!
//! 1. its quartiles do not overlap those of the old one, drift removed, and
//! 2. its ratio is beyond 5 %, and beyond twice the quartiles' half-widths of both runs together,
//!    and beyond √(2 ln n) + 1.5 deviations: the largest of n normal ones is about √(2 ln n).
//!
//! A part that moved as a whole raises its own scatter, so that its rows are not all listed; that
//! it moved is told by its median.

use crate::report::csv::Record;
use crate::report::{Better, Cell, Measured};
use crate::sample::Sample;
use std::collections::BTreeMap;

/// No smaller ratio is worth a line.
const LEAST: f64 = 1.05;
/// Timings from which on a part has a scatter of its own.
const ENOUGH: usize = 10;
/// Deviations that a timing must be beyond what the largest of all is expected to be.
const BEYOND: f64 = 1.5;
/// Turns the median of sizes into the deviation of a normal distribution.
const NORMAL: f64 = 1.4826;

/// Where a cell stands: part, table, row, column.
pub type Place = [String; 4];

/// A timing that moved.
#[derive(Clone, Debug)]
pub struct Move {
    /// Where it stands.
    pub place: Place,
    /// Before and after.
    pub cells: [Cell; 2],
    /// New cost over old cost, drift removed: above 1 is worse.
    pub ratio: f64,
    /// The least ratio, above 1, that counts as moved; also its reciprocal.
    pub limit: f64,
}

/// A figure that is the same in every run of the same program, and is not.
#[derive(Clone, Debug)]
pub struct Change {
    /// Where it stands.
    pub place: Place,
    /// Before and after.
    pub cells: [Cell; 2],
    /// Whether that is progress, if it is clear.
    pub better: Option<bool>,
}

/// How the timings of one part by one clock moved.
#[derive(Clone, Debug)]
pub struct Whole {
    /// The part.
    pub part: String,
    /// Whether it is about the clock on the wall.
    pub wall: bool,
    /// Its timings in both runs.
    pub timings: usize,
    /// The median of their ratios, drift removed.
    pub ratio: f64,
    /// The deviation that its timings are held to, in logarithms.
    pub scatter: f64,
}

/// All differences of two runs.
#[derive(Clone, Debug, Default)]
pub struct Difference {
    /// The median ratios, which are divided out: of processor time, of the wall clock; NaN if there
    /// are no such timings.
    pub drift: [f64; 2],
    /// In the order of their names.
    pub parts: Vec<Whole>,
    /// The largest first.
    pub moves: Vec<Move>,
    /// In the order of the new run.
    pub changes: Vec<Change>,
    /// Figures that only one of the runs has: before, after.
    pub alone: [usize; 2],
}

/// A timing in both runs.
struct Pair<'a> {
    place: &'a Place,
    better: Better,
    old: Measured,
    new: Measured,
    /// Logarithm of new cost over old.
    log: f64,
    /// The same of the drift of the clock that it was measured by.
    drift: f64,
}

impl<'a> Pair<'a> {
    fn new(old: &Record, new: &'a Record) -> Option<Self> {
        let (Cell::Measured(o), Cell::Measured(n)) = (&old.cell, &new.cell) else { return None };
        let ratio = match new.better {
            Better::Less => n.median / o.median,
            Better::More => o.median / n.median,
            Better::Neither => return None,
        };
        let log = ratio.ln();
        let (place, better) = (&new.place, new.better);
        log.is_finite().then_some(Self { place, better, old: *o, new: *n, log, drift: 0.0 })
    }

    /// Whether it was measured by the clock on the wall.
    fn is_wall(&self) -> bool {
        self.place[3].contains("wall")
    }

    /// Logarithm of the ratio, drift removed.
    fn moved(&self) -> f64 {
        self.log - self.drift
    }

    /// Whether the quartiles have something in common when the old ones have drifted.
    fn overlaps(&self) -> bool {
        let factor = if self.better == Better::More { (-self.drift).exp() } else { self.drift.exp() };
        self.new.low <= self.old.high * factor && self.old.low * factor <= self.new.high
    }

    /// Half the widths of the quartiles of both, as of independent errors, in logarithms.
    fn spread(&self) -> f64 {
        let half = |m: &Measured| ((m.high / m.low).ln() / 2.0).abs();
        let spread = half(&self.old).hypot(half(&self.new));
        // A time of 0, which a coarse clock may say, has no logarithm.
        if spread.is_finite() { spread } else { f64::INFINITY }
    }
}

/// Compares two runs. Figures made of others are left out, and what describes the run itself.
pub fn differ(old: &[Record], new: &[Record]) -> Difference {
    let before: BTreeMap<&Place, &Record> = old.iter().map(|r| (&r.place, r)).collect();
    let after: BTreeMap<&Place, &Record> = new.iter().map(|r| (&r.place, r)).collect();
    let both: Vec<(&Record, &Record)> =
        new.iter().filter_map(|r| Some((*before.get(&r.place)?, r))).collect();
    let mut pairs: Vec<Pair> = both.iter().filter_map(|(o, n)| Pair::new(o, n)).collect();
    let drift = [false, true].map(|wall| median(pairs.iter().filter(|p| p.is_wall() == wall).map(|p| p.log)));
    pairs.iter_mut().for_each(|p| p.drift = drift[usize::from(p.is_wall())]);
    let parts = wholes(&pairs);
    Difference {
        drift: drift.map(f64::exp),
        moves: moves(&pairs, &parts),
        parts,
        changes: both.into_iter().filter_map(|(o, n)| change(o, n)).collect(),
        alone: [
            before.keys().filter(|place| !after.contains_key(*place)).count(),
            after.keys().filter(|place| !before.contains_key(*place)).count(),
        ],
    }
}

fn median(values: impl Iterator<Item = f64>) -> f64 {
    values.collect::<Sample>().median()
}

fn wholes(pairs: &[Pair]) -> Vec<Whole> {
    let scatter = |of: &[&Pair]| NORMAL * median(of.iter().map(|p| p.moved().abs()));
    let all =
        [false, true].map(|wall| scatter(&pairs.iter().filter(|p| p.is_wall() == wall).collect::<Vec<_>>()));
    let mut parts: BTreeMap<(&String, bool), Vec<&Pair>> = BTreeMap::new();
    pairs.iter().for_each(|p| parts.entry((&p.place[0], p.is_wall())).or_default().push(p));
    let whole = |((part, wall), of): ((&String, bool), Vec<&Pair>)| Whole {
        part: part.clone(),
        wall,
        timings: of.len(),
        ratio: median(of.iter().map(|p| p.moved())).exp(),
        scatter: if of.len() < ENOUGH { all[usize::from(wall)] } else { scatter(&of) },
    };
    parts.into_iter().map(whole).collect()
}

fn moves(pairs: &[Pair], parts: &[Whole]) -> Vec<Move> {
    let deviations = (2.0 * (pairs.len() as f64).ln()).max(0.0).sqrt() + BEYOND;
    let moved = |pair: &Pair| {
        let scatter = parts.iter().find(|w| w.part == pair.place[0] && w.wall == pair.is_wall());
        let scatter = scatter.map_or(0.0, |w| w.scatter);
        let limit = LEAST.ln().max(deviations * scatter).max(2.0 * pair.spread());
        let log = pair.moved();
        (log.abs() > limit && !pair.overlaps()).then(|| Move {
            place: pair.place.clone(),
            cells: [Cell::Measured(pair.old), Cell::Measured(pair.new)],
            ratio: log.exp(),
            limit: limit.exp(),
        })
    };
    let mut moves: Vec<Move> = pairs.iter().filter_map(moved).collect();
    moves.sort_by(|a, b| b.ratio.ln().abs().total_cmp(&a.ratio.ln().abs()));
    moves
}

fn change(old: &Record, new: &Record) -> Option<Change> {
    let timing = |cell: &Cell| matches!(cell, Cell::Measured(_) | Cell::Derived(_));
    if (timing(&old.cell) && timing(&new.cell)) || new.place[0] == super::RUN || alike(&old.cell, &new.cell) {
        return None;
    }
    let values = (old.cell.value(), new.cell.value());
    let better = match (values, new.better) {
        ((Some(old), Some(new)), Better::Less) => Some(new < old),
        ((Some(old), Some(new)), Better::More) => Some(new > old),
        _ => None,
    };
    Some(Change { place: new.place.clone(), cells: [old.cell.clone(), new.cell.clone()], better })
}

/// Equal, but for what another order of sums in another build may do.
fn alike(a: &Cell, b: &Cell) -> bool {
    let near = |a: f64, b: f64| (a - b).abs() <= 1e-9 * a.abs().max(b.abs());
    match (a, b) {
        (Cell::Exact(a), Cell::Exact(b)) => near(*a, *b),
        (Cell::Estimate(a), Cell::Estimate(b)) => near(a.median, b.median),
        _ => a == b,
    }
}

#[cfg(test)]
#[path = "rule_tests.rs"]
mod tests;
