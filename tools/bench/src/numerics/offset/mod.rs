//! Where rays start that leave a surface: how often they hit it again, how often they begin
//! beyond what covers it closely, and what finding the start costs.

mod method;
mod stage;

use super::Effort;
use super::draw::Draw;
use super::timing::{Work, interleave};
use crate::report::{Better, Cell, Table};
use crate::sample::Sample;
use common::cli::AppError;
use method::{Landing, METHODS};
use stage::{Body, KINDS, SIZES};
use std::hint::black_box;

/// Landings on one body; placing it costs more than landing on it.
const LANDINGS: usize = 64;

/// What went wrong with one way of starting.
#[derive(Clone, Copy, Debug, Default)]
struct Verdict {
    /// The body that was left is hit again.
    again: u64,
    /// What covers it is missed.
    lost: u64,
}

/// All ways over `count` landings on bodies of one kind and size.
fn judge(kind: usize, size: f64, count: usize) -> Result<[Verdict; METHODS.len()], AppError> {
    let mut draw = Draw::new(64);
    let mut verdicts = [Verdict::default(); METHODS.len()];
    let mut landed = 0;
    while landed < count {
        let body = Body::new(kind, size, &mut draw)?;
        for _ in 0..LANDINGS {
            let Some(landing) = body.land(&mut draw) else { continue };
            landed += 1;
            for (method, verdict) in METHODS.iter().zip(&mut verdicts) {
                let start = (method.start)(&landing);
                verdict.again += u64::from(body.is_hit_again(start, landing.direction));
                verdict.lost += u64::from(body.loses_cover(&landing, start));
            }
            if landed == count {
                break;
            }
        }
    }
    Ok(verdicts)
}

/// Judges all kinds of body at all sizes; times on spheres and triangles of size 1.
///
/// # Errors
/// Never.
pub fn measure(effort: &Effort) -> Result<Vec<Table>, AppError> {
    let names: Vec<String> = ["hit again", "lost"]
        .iter()
        .flat_map(|what| SIZES.iter().map(move |size| format!("{what}: size {size}")))
        .collect();
    let columns: Vec<(&str, Better)> = names.iter().map(|name| (name.as_str(), Better::Less)).collect();
    let mut tables = Vec::new();
    for (kind, name) in KINDS.iter().enumerate() {
        let mut table =
            Table::new(format!("offsets, {name}: of {} landings", effort.trials), "start", &columns);
        let sizes =
            SIZES.iter().map(|size| judge(kind, *size, effort.trials)).collect::<Result<Vec<_>, _>>()?;
        for (m, method) in METHODS.iter().enumerate() {
            let again = sizes.iter().map(|verdicts| Cell::from(verdicts[m].again));
            let lost = sizes.iter().map(|verdicts| Cell::from(verdicts[m].lost));
            table.row(method.name, again.chain(lost));
        }
        tables.push(table);
    }
    tables.push(costs(effort.rounds)?);
    Ok(tables)
}

fn costs(rounds: usize) -> Result<Table, AppError> {
    let mut draw = Draw::new(65);
    let bodies = [Body::new(0, 1.0, &mut draw)?, Body::new(1, 1.0, &mut draw)?];
    let sets: Vec<Vec<Landing>> =
        bodies.iter().map(|body| (0..8192).filter_map(|_| body.land(&mut draw)).collect()).collect();
    let mut samples: Vec<Vec<Sample>> = Vec::new();
    for set in &sets {
        let run = |method: &'static method::Method| Work {
            units: set.len() as f64,
            run: Box::new(move || {
                for landing in set {
                    black_box((method.start)(landing));
                }
            }),
        };
        samples.push(interleave(rounds, &mut METHODS.iter().map(run).collect::<Vec<Work>>()));
    }
    let columns = [("ns on spheres", Better::Less), ("ns on triangles", Better::Less)];
    let mut table = Table::new("offsets: cost from hit to start", "start", &columns);
    for (m, method) in METHODS.iter().enumerate() {
        table.row(method.name, [Cell::from(&samples[0][m]), Cell::from(&samples[1][m])]);
    }
    Ok(table)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(name: &str, verdicts: &[Verdict; METHODS.len()]) -> Verdict {
        verdicts[METHODS.iter().position(|m| m.name == name).expect("a known name")]
    }

    #[test]
    fn fixed_distances_fit_one_size_only_and_ours_fits_all() {
        for (kind, name) in KINDS.iter().enumerate() {
            let sizes = SIZES.map(|size| judge(kind, size, 2000).unwrap());
            for verdicts in &sizes {
                let v = of("ours", verdicts);
                assert_eq!((v.again, v.lost), (0, 0), "{name}");
                // Its bounds are right; on spheres the rounded normal may take the other side.
                let v = of("pbrt error bounds", verdicts);
                assert!(v.lost == 0 && v.again <= if kind == 0 { 60 } else { 0 }, "{name}");
                assert!(of("Wächter–Binder", verdicts).lost > 200, "{name}");
            }
            assert!(of("tmin 1e-4", &sizes[3]).again > 50, "{name}");
            assert!(of("tmin 1e-3", &sizes[0]).lost > 1000, "{name}");
        }
    }

    #[test]
    fn costs_are_those_of_every_way() {
        assert_eq!(costs(1).unwrap().rows.len(), METHODS.len());
    }
}
