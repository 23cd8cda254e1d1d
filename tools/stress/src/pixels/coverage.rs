//! Property 15: how much of a pixel something covers.

use super::CHANCES;
use crate::Stress;
use crate::kit::{Region, coverage};
use a7_sampling::sampler::pair;
use a7_sampling::{Kernel, Negative, Pattern, Sampler, Shares};
use common::math::Vec3;
use common::picture::Size;
use rayon::prelude::*;

const KERNELS: [fn(f64) -> Kernel; 6] =
    [Kernel::Box, Kernel::Tent, Kernel::Gaussian, Kernel::Mitchell, Kernel::Lanczos, Kernel::BlackmanHarris];

const RADII: [f64; 4] = [0.5, 1.0, 1.7, 3.0];

fn kernels() -> impl Iterator<Item = Kernel> {
    KERNELS.into_iter().flat_map(|kernel| RADII.map(kernel))
}

/// Edges from flat to steep, and a disc, that cut the filter of a radius.
fn regions(radius: f64) -> [[Region; 3]; 2] {
    let below = |slope: f64, part: f64| Region::Below { slope, offset: part * radius * slope.hypot(1.0) };
    let disc =
        |x: f64, y: f64, part: f64| Region::Disc { center: [x * radius, y * radius], radius: part * radius };
    [
        [below(0.07, 0.2), below(1.0, -0.1), disc(0.2, -0.1, 0.6)],
        [below(-2.3, 0.3), below(15.0, 0.05), disc(-0.5, 0.4, 0.9)],
    ]
}

/// A pixel of a picture just large enough for a kernel, with `samples` in each: its colour where
/// three regions are the three channels, and the sum of its weights.
fn pixel(kernel: Kernel, sampler: &dyn Sampler, samples: u32, regions: &[Region; 3]) -> (Vec3, f64) {
    let (support, mut shares) = (kernel.support() as u32, Shares::new(Some(kernel)));
    let side = 2 * support + 1;
    let size = Size::new(i64::from(side), i64::from(side)).expect("a small picture");
    let mut negative = Negative::new(size, Some(kernel));
    negative.extend_to(side);
    let (middle, mut weights) = (f64::from(support) + 0.5, 0.0);
    for (i, j) in (0..side).flat_map(|j| (0..side).map(move |i| (i, j))) {
        shares.clear();
        for sample in 0..samples {
            let at = sampler.pair((i, j), sample, pair::PIXEL);
            let (x, y) = (f64::from(i) + at[0] - middle, f64::from(j) + at[1] - middle);
            let covered = regions.map(|region| f32::from(u8::from(region.contains(x, y))));
            shares.add(at, Vec3::from_array(covered));
        }
        // Where pixel (i, j) sees the middle one in its square.
        let (right, up) = (side - 1 - i, side - 1 - j);
        weights += shares.sums()[(1 + up * side + right) as usize].w;
        negative.add(i, j, shares.sums());
    }
    (negative.pixel(support, support), weights)
}

/// Mean over seeds of a ratio of sums, and the standard error of that mean. Each pixel counts as
/// much as its weights: that leaves no bias but one in proportion to 1/seeds.
fn mean_over_seeds(found: &[(Vec3, f64)], channel: usize) -> (f64, f64) {
    let whole: f64 = found.iter().map(|(_, w)| w).sum();
    let mean = found.iter().map(|(c, w)| f64::from(c[channel]) * w).sum::<f64>() / whole;
    let squares = found.iter().map(|(c, w)| (w * (f64::from(c[channel]) - mean)).powi(2)).sum::<f64>();
    let n = found.len() as f64;
    (mean, (squares * n / (n - 1.0)).sqrt() / whole)
}

/// By how many standard errors the mean over seeds is off, for every pattern and region.
fn scores(kernel: Kernel, regions: &[Region; 3], seeds: u64) -> Vec<(f64, String)> {
    let exact = regions.map(|region| coverage(kernel, region));
    let of_pattern = |pattern: Pattern| {
        let of_seed = |seed| pixel(kernel, &*pattern.sampler(9, 16, seed), 9, regions);
        let found: Vec<_> = (0..seeds).map(of_seed).collect();
        (0..3).map(move |channel| {
            let (mean, error) = mean_over_seeds(&found, channel);
            // Films are single precision.
            let off = ((mean - exact[channel]).abs() - 1e-6).max(0.0);
            let text =
                format!("{kernel:?} {pattern:?} {:?}: {mean} for {}", regions[channel], exact[channel]);
            (if off == 0.0 { 0.0 } else { off / error }, text)
        })
    };
    CHANCES.into_iter().flat_map(of_pattern).collect()
}

/// Every kernel, radius, pattern and region: by how many standard errors the mean is off.
///
/// Of so many trials some exceed 3σ by right, one in 370. So: not many more of them do, none
/// exceeds 5σ, and the spread of all is that of a normal distribution.
pub fn analytic(stress: &Stress) {
    let cases: Vec<_> = KERNELS.into_iter().flat_map(|k| RADII.map(|r| (k(r), regions(r)))).collect();
    let cases: Vec<_> =
        cases.iter().flat_map(|(kernel, both)| both.iter().map(move |r| (*kernel, r))).collect();
    let seeds = if stress.tier().is_thorough() { 120 } else { 40 };
    let scores: Vec<_> =
        cases.par_iter().flat_map_iter(|(kernel, three)| scores(*kernel, three, seeds)).collect();
    let beyond: Vec<_> = scores.iter().filter(|(score, _)| *score > 3.0).collect();
    let spread = (scores.iter().map(|(s, _)| s * s).sum::<f64>() / scores.len() as f64).sqrt();
    let worst = scores.iter().max_by(|a, b| a.0.total_cmp(&b.0)).expect("there are cases");
    stress.case("p15 worst of all means, in σ", || {
        if worst.0 < 5.0 { Ok(worst.0) } else { Err(format!("{worst:?}")) }
    });
    // 1008 cases: 2.7 expected, more than 12 in one of 10⁵ runs.
    stress.case("p15 means beyond 3σ, of 1008", || {
        if beyond.len() <= 12 { Ok(beyond.len() as f64) } else { Err(format!("{beyond:#?}")) }
    });
    stress.expect("p15 spread of all means, in σ", spread, |spread| (0.85..1.15).contains(&spread));
}

/// The uniform pattern has no chance in it: an edge is out of place by half a cell's diagonal at
/// most, and no filter weighs a line through its middle much more than 1/radius (Lanczos': ½).
pub fn uniform(stress: &Stress) {
    let side: u32 = if stress.tier().is_thorough() { 24 } else { 12 };
    stress.case("p15 uniform pattern", || {
        let mut worst: f64 = 0.0;
        for (kernel, radius) in KERNELS.into_iter().flat_map(|k| RADII.map(|r| (k(r), r))) {
            let sampler = Pattern::Uniform.sampler(side * side, 16, 0);
            for three in regions(radius) {
                let (found, _) = pixel(kernel, &*sampler, side * side, &three);
                for (channel, region) in three.into_iter().enumerate() {
                    let off = (f64::from(found[channel]) - coverage(kernel, region)).abs();
                    let most = (1.0 / radius).max(0.5) * 0.5f64.sqrt() / f64::from(side);
                    assert!(off < most, "{kernel:?} {region:?}: off by {off}");
                    worst = worst.max(off / most);
                }
            }
        }
        Ok(worst)
    });
}

/// A picture of one colour stays that colour, at its borders too.
pub fn weights(stress: &Stress) {
    stress.case("p15 weights sum to one", || {
        let mut worst = 0.0f32;
        let size = Size::new(6, 5).expect("a small picture");
        let color = Vec3::new(1.0, 0.3, 1000.0);
        for kernel in kernels().map(Some).chain([None]) {
            for pattern in CHANCES.into_iter().chain([Pattern::Uniform]) {
                let (sampler, mut shares) = (pattern.sampler(16, 16, 1), Shares::new(kernel));
                let mut negative = Negative::new(size, kernel);
                negative.extend_to(5);
                let pixels = || (0..5).flat_map(|y| (0..6).map(move |x| (x, y)));
                for (x, y) in pixels() {
                    shares.clear();
                    (0..16).for_each(|sample| shares.add(sampler.pair((x, y), sample, pair::PIXEL), color));
                    negative.add(x, y, shares.sums());
                }
                for (x, y) in pixels() {
                    let off = (negative.pixel(x, y) / color - Vec3::ONE).abs().max_element();
                    worst = worst.max(off);
                    assert!(off <= 1e-6, "{kernel:?} {pattern:?} ({x}, {y}): off by {off:e}");
                }
            }
        }
        Ok(f64::from(worst))
    });
}
