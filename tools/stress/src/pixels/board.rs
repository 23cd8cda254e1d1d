//! Property 15: how fast errors fall over a board that reaches to the horizon.
//!
//! A pattern of N strata knows a pixel's picture down to steps of 1/√N; the variance of k edges in
//! a pixel is about k·N^(−3/2) while k < √N, and 1/N when there are more. In perspective a row at
//! height v below the horizon has some 1/v² edges, so a share N^(−1/4) of the rows has more than
//! √N; each part of the picture then has a variance of about N^(−5/4), its error the slope −5/8.
//! Only the rows with few edges have the slope −3/4 of a pixel with one.

use crate::Stress;
use a7_sampling::Pattern;
use a7_sampling::sampler::{Sampler, pair};
use rayon::prelude::*;

/// Rows and columns of the picture, from the horizon down.
const SIZE: (u32, u32) = (16, 30);
/// Height of a row; as many below each other show 45° and more.
const ROW: f64 = 0.02;
const COUNTS: [u32; 4] = [16, 64, 256, 1024];
/// Pictures that stand for chance, each made twice.
const GROUPS: u64 = 8;

/// A board of unit squares one unit below the eye, seen straight ahead.
fn square(u: f64, v: f64) -> f64 {
    let (x, z) = (u / v, 1.0 / v);
    (x.floor() + z.floor()).rem_euclid(2.0)
}

/// The mean of a pixel as its samples have it.
fn mean(sampler: &dyn Sampler, samples: u32, (column, row): (u32, u32)) -> f64 {
    let sum: f64 = (0..samples)
        .map(|sample| {
            let [s, t] = sampler.pair((column, row), sample, pair::PIXEL);
            let middle = f64::from(SIZE.0) / 2.0 + 0.37;
            // Samples in [0, 1): the horizon itself is none of them.
            square((f64::from(column) + s - middle) * ROW, (f64::from(row) + 1.0 - t) * ROW)
        })
        .sum();
    sum / f64::from(samples)
}

/// Twice the variance of each row's pixels, from two pictures.
fn spread(pattern: Pattern, samples: u32, group: u64) -> Vec<f64> {
    let of = |seed| pattern.sampler(samples, 64, seed);
    let (one, other) = (of(2 * group), of(2 * group + 1));
    let pixel = |at| (mean(&*one, samples, at) - mean(&*other, samples, at)).powi(2);
    (0..SIZE.1).map(|row| (0..SIZE.0).map(|column| pixel((column, row))).sum()).collect()
}

/// Slope of log RMSE over log samples, and its standard error, for some runs of rows.
fn fitted(pattern: Pattern, runs: &[std::ops::Range<usize>]) -> Vec<(f64, f64)> {
    let middle = COUNTS.map(|n| f64::from(n).ln()).iter().sum::<f64>() / COUNTS.len() as f64;
    let lever = COUNTS.map(|n| f64::from(n).ln() - middle);
    let length: f64 = lever.iter().map(|x| x * x).sum();
    let slopes = |group| {
        let spreads = COUNTS.map(|samples| spread(pattern, samples, group));
        let slope = |rows: &std::ops::Range<usize>| {
            let logs = spreads.iter().map(|rows_of| rows_of[rows.clone()].iter().sum::<f64>().ln() / 2.0);
            logs.zip(lever).map(|(log, lever)| log * lever).sum::<f64>() / length
        };
        runs.iter().map(slope).collect::<Vec<_>>()
    };
    let groups: Vec<Vec<f64>> = (0..GROUPS).into_par_iter().map(slopes).collect();
    let n = GROUPS as f64;
    (0..runs.len())
        .map(|run| {
            let mean = groups.iter().map(|group| group[run]).sum::<f64>() / n;
            let variance = groups.iter().map(|group| (group[run] - mean).powi(2)).sum::<f64>() / (n - 1.0);
            (mean, (variance / n).sqrt())
        })
        .collect()
}

/// What strata can do on a board, and what they cannot: a slope counts with three standard errors
/// to its disadvantage.
pub fn board(stress: &Stress) {
    for pattern in [Pattern::Random, Pattern::Jittered] {
        stress.case(format!("p15 board to the horizon, {pattern:?}"), || {
            // All of it, the row at the horizon, and where a pixel has an edge or two at most.
            let found = fitted(pattern, &[0..30, 0..1, 10..30]);
            let text = format!("{pattern:?}: {found:.3?}");
            let near = |(slope, error): (f64, f64), truth: f64, room: f64| {
                (slope - truth).abs() <= room + 3.0 * error
            };
            let kept = match pattern {
                Pattern::Random => found.iter().all(|&slope| near(slope, -0.5, 0.02)),
                _ => {
                    let (slope, error) = found[2];
                    near(found[0], -0.625, 0.02) && near(found[1], -0.5, 0.05) && slope + 3.0 * error <= -0.7
                }
            };
            assert!(kept, "{text}");
            Ok(found[2].0.abs())
        });
    }
}
