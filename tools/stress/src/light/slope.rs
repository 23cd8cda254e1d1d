//! Property 14: how fast the error falls.

use super::stage::{Stage, scene};
use crate::Stress;
use common::picture::Film;

/// Numbers of samples, each twice the one before.
const SAMPLES: std::ops::RangeInclusive<u32> = 2..=8;

const SEEDS: u64 = 12;

/// A floor and a wall under a square lamp: no edge is in sight.
fn stage(flags: &str) -> Stage {
    let camera = "PerspectiveCamera { center 0 1 3  direction 0 -0.6 -1  up 0 1 0  angle 20 }";
    let objects = "MaterialIndex 0 Plane { normal 0 1 0 offset 0 }\n\
        MaterialIndex 1 Triangle { vertex0 -1 2 -1 vertex1 1 2 -1 vertex2 1 2 1 }\n\
        Triangle { vertex0 -1 2 -1 vertex1 1 2 1 vertex2 -1 2 1 }";
    let lamp = "diffuseColor 0 0 0 emissiveColor 3 3 3";
    let text = scene(camera, "0.2 0.3 0.4", &[], &["diffuseColor 0.8 0.7 0.6", lamp], objects);
    Stage::new(&text, &[], &format!("-size 6 6 {flags}"))
}

fn mean_square(film: &Film, truth: &Film) -> f64 {
    let squares =
        film.pixels().iter().zip(truth.pixels()).map(|(a, b)| (*a - *b).as_dvec3().length_squared());
    squares.sum::<f64>() / (3.0 * film.pixels().len() as f64)
}

/// Exponent of the RMSE as a power of the number of samples: least squares of its logarithms.
fn slope(sampler: &str, truth: &Film) -> f64 {
    let points: Vec<(f64, f64)> = SAMPLES
        .map(|log| {
            let stage = stage(&format!("-sampler {sampler} -spp {}", 1 << log));
            let squares: f64 = (0..SEEDS).map(|seed| mean_square(&stage.film(seed), truth)).sum();
            (f64::from(log), (squares / SEEDS as f64).sqrt().log2())
        })
        .collect();
    let n = points.len() as f64;
    let (x, y) = (points.iter().map(|p| p.0).sum::<f64>() / n, points.iter().map(|p| p.1).sum::<f64>() / n);
    points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum::<f64>()
        / points.iter().map(|p| (p.0 - x).powi(2)).sum::<f64>()
}

/// Errors fall with the root of the samples, or faster.
pub fn slopes(stress: &Stress) {
    if stress.is_single() {
        return;
    }
    let truth = stage("-spp 16384").film(99);
    let random = slope("random", &truth);
    stress.expect("p14 slope of random numbers", random, |slope| (-0.55..=-0.45).contains(&slope));
    for sampler in ["sobol", "halton", "multi_jittered"] {
        let better = slope(sampler, &truth);
        stress.expect(&format!("p14 slope of {sampler}"), better, |slope| slope < -0.6);
    }
}
