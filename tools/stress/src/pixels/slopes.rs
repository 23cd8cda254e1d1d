//! Property 15: how fast errors fall.

use super::CHANCES;
use crate::Stress;
use crate::kit::Draw;
use a7_sampling::Pattern;
use a7_sampling::sampler::pair;
use rayon::prelude::*;
use std::f64::consts::PI;

/// A picture inside one pixel, with its mean.
struct Inside {
    edge: (f64, f64),
    disc: ([f64; 2], f64),
    waves: [f64; 2],
}

impl Inside {
    fn drawn(draw: &mut Draw) -> Self {
        let steep = draw.between(-1.3, 1.3).tan();
        // An edge through some point of the middle.
        let (x, y) = (draw.between(0.2, 0.8), draw.between(0.2, 0.8));
        let center = [draw.between(0.35, 0.65), draw.between(0.35, 0.65)];
        let disc = (center, draw.between(0.15, 0.34));
        Self { edge: (steep, y - steep * x), disc, waves: [draw.between(0.0, 6.0), draw.between(0.0, 6.0)] }
    }

    fn at(&self, [x, y]: [f64; 2]) -> [f64; 3] {
        let edge = y < self.edge.1 + self.edge.0 * x;
        let ([cx, cy], radius) = self.disc;
        let disc = (x - cx).hypot(y - cy) < radius;
        let smooth = (self.waves[0] + 2.0 * x).sin() * (self.waves[1] + 3.0 * y).cos();
        [f64::from(u8::from(edge)), f64::from(u8::from(disc)), smooth]
    }

    fn means(&self) -> [f64; 3] {
        let (slope, offset) = self.edge;
        // ∫ of what lies below the edge, cut off at 0 and 1.
        let below = |t: f64| {
            if t < 0.0 {
                0.0
            } else if t < 1.0 {
                t * t / 2.0
            } else {
                t - 0.5
            }
        };
        let [a, b] = self.waves;
        let along_x = (a.cos() - (a + 2.0).cos()) / 2.0;
        let along_y = ((b + 3.0).sin() - b.sin()) / 3.0;
        [(below(offset + slope) - below(offset)) / slope, PI * self.disc.1.powi(2), along_x * along_y]
    }
}

/// The slope of log RMSE over log samples for edge, disc and smooth picture, each with its
/// standard error.
fn fitted(pattern: Pattern) -> [(f64, f64); 3] {
    const SEEDS: u64 = 1500;
    const COUNTS: [u32; 4] = [16, 64, 256, 1024];
    let points: Vec<[(f64, f64); 3]> = COUNTS.iter().map(|n| log_errors(pattern, *n, SEEDS)).collect();
    let logs = COUNTS.map(|n| f64::from(n).ln());
    let middle = logs.iter().sum::<f64>() / logs.len() as f64;
    let spread: f64 = logs.iter().map(|x| (x - middle).powi(2)).sum();
    std::array::from_fn(|picture| {
        let lever = |i: usize| (logs[i] - middle) / spread;
        let slope = (0..logs.len()).map(|i| lever(i) * points[i][picture].0).sum();
        let variance: f64 = (0..logs.len()).map(|i| (lever(i) * points[i][picture].1).powi(2)).sum();
        (slope, variance.sqrt())
    })
}

/// ln RMSE over many pictures, and its standard error, for each kind of picture.
fn log_errors(pattern: Pattern, samples: u32, seeds: u64) -> [(f64, f64); 3] {
    let squares: Vec<[f64; 3]> = (0..seeds)
        .into_par_iter()
        .map(|seed| {
            let (picture, sampler) =
                (Inside::drawn(&mut Draw::new(seed)), pattern.sampler(samples, 64, seed));
            let place = ((seed % 61) as u32, (seed % 53) as u32);
            let mut sums = [0.0; 3];
            for sample in 0..samples {
                let values = picture.at(sampler.pair(place, sample, pair::PIXEL));
                (0..3).for_each(|k| sums[k] += values[k]);
            }
            let means = picture.means();
            std::array::from_fn(|k| (sums[k] / f64::from(samples) - means[k]).powi(2))
        })
        .collect();
    std::array::from_fn(|k| {
        let n = seeds as f64;
        let mean = squares.iter().map(|s| s[k]).sum::<f64>() / n;
        let variance = squares.iter().map(|s| (s[k] - mean).powi(2)).sum::<f64>() / (n - 1.0);
        // ln √m has the derivative 1/2m.
        (mean.ln() / 2.0, (variance / n).sqrt() / (2.0 * mean))
    })
}

/// How fast errors fall. A slope counts with three standard errors to its disadvantage.
pub fn slopes(stress: &Stress) {
    for pattern in CHANCES {
        stress.case(format!("p15 slopes of {pattern:?}"), || {
            let slopes = fitted(pattern);
            let text = slopes.map(|(slope, error)| format!("{slope:.3} ± {error:.3}")).join(", ");
            let steepest = slopes.iter().map(|(slope, _)| *slope).fold(f64::NEG_INFINITY, f64::max);
            for (picture, (slope, error)) in slopes.into_iter().enumerate() {
                let worst = slope + 3.0 * error;
                let kept = match pattern {
                    Pattern::Random => (slope + 0.5).abs() + 3.0 * error <= 0.05,
                    Pattern::Sobol if picture == 2 => worst <= -0.9,
                    Pattern::Jittered | Pattern::Sobol => worst <= -0.7,
                    // No promise, but better than chance.
                    _ => worst < -0.55,
                };
                assert!(kept, "{pattern:?}: {text}");
            }
            Ok(steepest.abs())
        });
    }
}
