//! What each pattern promises.

use super::*;
use clap::ValueEnum;
use std::collections::HashSet;

fn points(sampler: &dyn Sampler, pixel: Pixel, samples: u32, pair: u32) -> Vec<[f64; 2]> {
    (0..samples).map(|sample| sampler.pair(pixel, sample, pair)).collect()
}

/// How many cells of a grid the points leave empty.
fn empty_cells(points: &[[f64; 2]], columns: u32, rows: u32) -> usize {
    let cell = |[x, y]: &[f64; 2]| ((x * f64::from(columns)) as u32, (y * f64::from(rows)) as u32);
    (columns * rows) as usize - points.iter().map(cell).collect::<HashSet<_>>().len()
}

const PIXELS: [Pixel; 4] = [(0, 0), (1, 0), (17, 200), (4095, 4095)];
const PAIRS: [u32; 4] = [0, 1, 2, 19];

fn everywhere(mut check: impl FnMut(Pixel, u32)) {
    PIXELS.into_iter().for_each(|pixel| PAIRS.into_iter().for_each(|pair| check(pixel, pair)));
}

#[test]
fn a7t1_all_stay_in_the_unit_square_and_repeat_themselves() {
    for pattern in Pattern::value_variants() {
        let make = |seed| pattern.sampler(25, 4096, seed);
        everywhere(|pixel, pair| {
            let all = points(&*make(3), pixel, 25, pair);
            assert!(all.iter().flatten().all(|x| (0.0..1.0).contains(x)), "{pattern:?} {all:?}");
            assert_eq!(all, points(&*make(3), pixel, 25, pair), "{pattern:?}");
            let fixed = *pattern == Pattern::Uniform && pair == pair::PIXEL;
            assert!(fixed || all != points(&*make(4), pixel, 25, pair), "{pattern:?}: the seed does nothing");
        });
    }
}

/// Cells of a 16 × 16 grid over many pixels: χ² of 255 degrees of freedom.
#[test]
fn a7t1_all_are_uniform_over_many_pixels() {
    for pattern in Pattern::value_variants().iter().filter(|p| **p != Pattern::Uniform) {
        let sampler = pattern.sampler(16, 64, 9);
        for pair in PAIRS {
            let mut counts = [0u32; 256];
            for pixel in (0..64).flat_map(|y| (0..64).map(move |x| (x, y))) {
                for [x, y] in points(&*sampler, pixel, 16, pair) {
                    counts[(x * 16.0) as usize + 16 * (y * 16.0) as usize] += 1;
                }
            }
            let chi: f64 = counts.iter().map(|n| (f64::from(*n) - 256.0).powi(2) / 256.0).sum();
            // Mean 255, standard deviation 22.6; stratified patterns stay far below. The 16 samples
            // of R2 move together, which makes the deviation up to four times as large.
            let deviation = if *pattern == Pattern::R2 { 4.0 * 22.6 } else { 22.6 };
            assert!(chi < 255.0 + 4.0 * deviation, "{pattern:?} pair {pair}: {chi}");
        }
    }
}

#[test]
fn a7t1_uniform_takes_centres_row_by_row() {
    let four = points(&Uniform::new(4, 0), (5, 6), 4, pair::PIXEL);
    assert_eq!(four, [[0.25, 0.25], [0.75, 0.25], [0.25, 0.75], [0.75, 0.75]]);
    everywhere(|pixel, pair| {
        let all = points(&Uniform::new(36, 1), pixel, 36, pair);
        assert_eq!(empty_cells(&all, 6, 6), 0);
    });
}

#[test]
fn a7t1_jittered_has_one_sample_in_each_cell() {
    everywhere(|pixel, pair| {
        assert_eq!(empty_cells(&points(&Jittered::new(36, 1), pixel, 36, pair), 6, 6), 0);
        assert_eq!(empty_cells(&points(&Jittered::new(12, 1), pixel, 12, pair), 4, 3), 0);
    });
}

#[test]
fn a7t1_multi_jittered_has_one_sample_in_each_cell_row_and_column() {
    everywhere(|pixel, pair| {
        let all = points(&MultiJittered::new(12, 1), pixel, 12, pair);
        for (columns, rows) in [(4, 3), (12, 1), (1, 12)] {
            assert_eq!(empty_cells(&all, columns, rows), 0, "{columns} × {rows}");
        }
    });
}

/// Every 2ᵏ samples from a multiple of 2ᵏ on fill all elementary intervals, also of later pairs.
#[test]
fn a7t1_sobol_fills_elementary_intervals() {
    everywhere(|pixel, pair| {
        let all = points(&Sobol { seed: 5 }, pixel, 256, pair);
        for k in 0..=6 {
            for block in all.chunks(1 << k).take(4) {
                (0..=k).for_each(|i| assert_eq!(empty_cells(block, 1 << i, 1 << (k - i)), 0, "2^{k}: {i}"));
            }
        }
    });
}

#[test]
fn a7t1_halton_fills_the_cells_of_its_bases() {
    for pixel in PIXELS {
        let all = points(&Halton::new(5), pixel, 36, pair::PIXEL);
        for (columns, rows, count) in [(2, 3, 6), (4, 9, 36), (4, 3, 12), (2, 9, 18)] {
            assert_eq!(empty_cells(&all[..count], columns, rows), 0, "{columns} × {rows}");
        }
    }
}

/// A pixel's samples are a net, and so are those of a block of four pixels together.
#[test]
fn a7t1_blue_noise_fills_intervals_of_pixels_and_of_blocks() {
    let sampler = BlueNoise::new(16, 512, 5);
    for pair in PAIRS {
        for (x, y) in [(0, 0), (10, 4), (510, 510)] {
            let block: Vec<_> = [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)]
                .into_iter()
                .map(|pixel| points(&sampler, pixel, 16, pair))
                .collect();
            for i in 0..=4 {
                block.iter().for_each(|all| assert_eq!(empty_cells(all, 1 << i, 16 >> i), 0));
            }
            (0..=6).for_each(|i| assert_eq!(empty_cells(&block.concat(), 1 << i, 64 >> i), 0));
        }
    }
}

/// Coordinates of different pairs have nothing to do with each other: correlation of all four
/// combinations over many pixels.
#[test]
fn a7t1_pairs_are_independent() {
    for pattern in Pattern::value_variants() {
        let sampler = pattern.sampler(16, 64, 2);
        for (first, second) in [(0, 1), (1, 2), (2, 3), (0, 16)] {
            let mut sums = [[0.0; 2]; 2];
            let mut count = 0.0;
            for (pixel, sample) in
                (0..64).flat_map(|y| (0..64).map(move |x| (x, y))).flat_map(|p| (0..16).map(move |s| (p, s)))
            {
                let (a, b) = (sampler.pair(pixel, sample, first), sampler.pair(pixel, sample, second));
                (0..4).for_each(|i| sums[i / 2][i % 2] += (a[i / 2] - 0.5) * (b[i % 2] - 0.5));
                count += 1.0;
            }
            // Of independent samples: 0 ± 1/(12·√65536).
            for sum in sums.as_flattened() {
                let correlation: f64 = 12.0 * sum / count;
                assert!(correlation.abs() < 5.0 / 256.0, "{pattern:?} {first} {second}: {correlation}");
            }
        }
    }
}
