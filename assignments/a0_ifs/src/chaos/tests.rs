//! A0T2: where the points end up. Statistical tests use fixed seeds, several of them, and bounds
//! of seven standard deviations or more, so that they say something about the method and not
//! about one seed.

use super::*;
use crate::WeightedMap;
use proptest::prelude::*;

const SEEDS: [u64; 4] = [0, 1, 2, 0xffff_ffff_ffff_ffff];

fn ifs(maps: &[(f64, [[f64; 3]; 2])]) -> Ifs {
    let entry = |&(probability, rows)| WeightedMap { probability, map: Affine2 { rows } };
    Ifs::new(maps.iter().map(entry).collect()).unwrap()
}

fn half_towards(x: f64, y: f64) -> [[f64; 3]; 2] {
    [[0.5, 0.0, x / 2.0], [0.0, 0.5, y / 2.0]]
}

fn sierpinski() -> Ifs {
    ifs(&[(0.33, half_towards(0.0, 0.0)), (0.33, half_towards(1.0, 0.0)), (0.34, half_towards(0.0, 1.0))])
}

fn fern() -> Ifs {
    ifs(&[
        (0.03, [[0.0, 0.0, 0.5], [0.0, 0.2, 0.0]]),
        (0.71, [[0.82, 0.07, 0.09], [-0.07, 0.82, 0.23]]),
        (0.13, [[0.11, -0.37, 0.45], [0.28, 0.14, -0.06]]),
        (0.13, [[-0.08, 0.39, 0.54], [0.29, 0.11, -0.005]]),
    ])
}

/// Σ (observed − expected)² / expected.
fn chi_square(observed: &[u64], expected: impl Fn(usize) -> f64) -> f64 {
    let term = |(i, &n): (usize, &u64)| (n as f64 - expected(i)).powi(2) / expected(i);
    observed.iter().enumerate().map(term).sum()
}

/// Seven standard deviations above the mean of χ² with this many degrees of freedom.
fn chi_square_bound(freedom: f64) -> f64 {
    freedom + 7.0 * (2.0 * freedom).sqrt()
}

/// The first `k` binary digits after the point.
fn digits(value: f64, k: u32) -> u64 {
    (value * (1_u64 << k) as f64) as u64
}

/// After k iterations the first k digits of x and y say which corners were chosen: x has a one
/// for the right corner, y for the upper one, and no corner has both.
#[test]
fn a0t2_sierpinski_points_lie_in_the_closed_form_set() {
    for seed in SEEDS {
        for k in [1, 2, 3, 4, 5, 9, 20] {
            let game = ChaosGame::new(&sierpinski(), k, seed);
            for index in 0..2_000 {
                let p = game.point(index);
                assert_eq!(digits(p.x, k) & digits(p.y, k), 0, "{k} {p:?}");
            }
        }
    }
}

/// A picture as fine as the set shows all of its 3ᵏ cells, and no other.
#[test]
fn a0t2_sierpinski_fills_three_quarters_to_the_k() {
    for k in 1..=4 {
        let size = Size::new(1 << k, 1 << k).unwrap();
        let game = ChaosGame::new(&sierpinski(), k, 7);
        let dots = play(&game, 10_000, size, &TileOptions::default());
        assert_eq!(dots.count(), 3_u64.pow(k));
        for (x, y) in (0..1 << k).flat_map(|y| (0..1 << k).map(move |x| (x, y))) {
            assert_eq!(dots.get(x, y), x & y == 0, "{k}: {x} {y}");
        }
    }
}

#[test]
fn a0t2_without_iterations_points_are_uniform() {
    const POINTS: u64 = 64_000;
    for seed in SEEDS {
        let game = ChaosGame::new(&fern(), 0, seed);
        assert_eq!(game.draws(), 0);
        let mut cells = [0; 64];
        for index in 0..POINTS {
            let p = game.point(index);
            cells[(digits(p.y, 3) * 8 + digits(p.x, 3)) as usize] += 1;
        }
        let chi = chi_square(&cells, |_| POINTS as f64 / 64.0);
        assert!(chi < chi_square_bound(63.0), "seed {seed}: {chi}");
        // Neither may it be more even than chance allows.
        assert!(chi > 63.0 - 4.5 * 126.0_f64.sqrt(), "seed {seed}: {chi}");
    }
}

/// With four maps onto the quarters of the x axis, the digits of the end point in base 4 are the
/// maps chosen, the last one first: all sequences must come with the product of probabilities.
#[test]
fn a0t2_sequences_of_maps_have_their_probabilities() {
    const POINTS: u64 = 200_000;
    let probabilities = [0.1, 0.2, 0.3, 0.4];
    let maps: Vec<_> =
        (0..4).map(|i| (probabilities[i], [[0.25, 0.0, i as f64 / 4.0], [0.0, 0.5, 0.0]])).collect();
    for seed in SEEDS {
        for k in [1, 3, 5] {
            let game = ChaosGame::new(&ifs(&maps), k, seed);
            let mut observed = [0; 64];
            let shown = k.min(3);
            for index in 0..POINTS {
                observed[digits(game.point(index).x, 2 * shown) as usize] += 1;
            }
            let sequences = 1 << (2 * shown);
            let expected = |i: usize| {
                let chosen = (0..shown).map(|place| probabilities[i >> (2 * place) & 3]);
                chosen.product::<f64>() * POINTS as f64
            };
            let chi = chi_square(&observed[..sequences], expected);
            assert!(chi < chi_square_bound(sequences as f64 - 1.0), "{seed} {k}: {chi}");
        }
    }
}

/// The mean of the invariant distribution solves m = Σ pᵢ (Aᵢ m + bᵢ), whatever the fern's shape.
#[test]
fn a0t2_the_fern_has_the_mean_that_its_maps_demand() {
    const POINTS: u64 = 50_000;
    let mut mean = Point2 { x: 0.5, y: 0.5 };
    for _ in 0..500 {
        let system = fern();
        let images: Vec<_> =
            system.maps().iter().map(|entry| (entry.probability, entry.map.apply(mean))).collect();
        mean = Point2 {
            x: images.iter().map(|(p, image)| p * image.x).sum(),
            y: images.iter().map(|(p, image)| p * image.y).sum(),
        };
    }
    for seed in SEEDS {
        let game = ChaosGame::new(&fern(), 100, seed);
        let points: Vec<_> = (0..POINTS).map(|index| game.point(index)).collect();
        let average = |of: fn(&Point2) -> f64| points.iter().map(of).sum::<f64>() / POINTS as f64;
        // Coordinates lie within a unit square, so a deviation is at most 1/2.
        let bound = 7.0 * 0.5 / (POINTS as f64).sqrt();
        assert!((average(|p| p.x) - mean.x).abs() < bound, "seed {seed}");
        assert!((average(|p| p.y) - mean.y).abs() < bound, "seed {seed}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// The same choices bring any two points together, at least as fast as the slowest map.
    #[test]
    fn a0t2_starts_are_forgotten(
        maps in prop::collection::vec((0.1..0.9_f64, 0.0..6.3_f64, -1.0..1.0_f64), 1..7),
        iterations in 0..40_u32,
        seed in any::<u64>(),
    ) {
        let share = 1.0 / maps.len() as f64;
        let rows = |&(scale, angle, shift): &(f64, f64, f64)| {
            let (s, c) = angle.sin_cos();
            (share, [[scale * c, -scale * s, shift], [scale * s, scale * c, -shift]])
        };
        let system = ifs(&maps.iter().map(rows).collect::<Vec<_>>());
        let slowest = maps.iter().map(|map| map.0).fold(0.0, f64::max);
        let game = ChaosGame::new(&system, iterations, seed);
        let end = |x, y| game.carry(Point2 { x, y }, &mut stream(seed, 1));
        let (a, b) = (end(0.0, 0.0), end(1.0, 1.0));
        let distance = (a.x - b.x).hypot(a.y - b.y);
        let bound = 2.0_f64.sqrt() * slowest.powi(iterations as i32);
        prop_assert!(distance <= bound * (1.0 + 1e-9) + 1e-12, "{} {}", distance, bound);
    }
}

#[test]
fn a0t2_every_iteration_is_made_whatever_is_drawn_at_once() {
    // One map that halves: after k iterations x is start / 2^k exactly.
    let halving = ifs(&[(1.0, half_towards(0.0, 0.0))]);
    for k in [0, 1, 2, 7, 8, 9, 30, 100] {
        let start = ChaosGame::new(&halving, 0, 3).point(5);
        let end = ChaosGame::new(&halving, k, 3).point(5);
        assert_eq!(end.x, start.x * 0.5_f64.powi(k as i32), "{k}");
    }
    assert_eq!(ChaosGame::new(&fern(), 30, 0).draws(), 9);
    assert_eq!(ChaosGame::new(&fern(), 3, 0).draws(), 1);
    let many = ifs(&vec![(1.0 / 300.0, half_towards(0.0, 0.0)); 300]);
    assert_eq!(ChaosGame::new(&many, 30, 0).draws(), 30);
}

#[test]
fn a0t2_the_picture_depends_on_the_seed_and_on_nothing_else() {
    let size = Size::new(64, 64).unwrap();
    let picture = |seed, threads| {
        let options = TileOptions { threads, ..TileOptions::default() };
        let game = ChaosGame::new(&fern(), 30, seed);
        play(&game, 30_000, size, &options).film()
    };
    let reference = picture(5, Some(1));
    for threads in [Some(2), Some(3), Some(7), Some(16), None] {
        assert_eq!(picture(5, threads), reference, "{threads:?}");
    }
    assert_ne!(picture(6, None), reference);
}

#[test]
fn a0t2_points_are_counted_exactly() {
    let size = Size::new(4096, 4096).unwrap();
    for points in [0, 1, 1023, 1024, 1025, 5000] {
        let game = ChaosGame::new(&sierpinski(), 0, 9);
        let dots = play(&game, points, size, &TileOptions::default());
        // In so fine a picture few share a pixel: n²/2 pairs over 2²⁴ pixels.
        let shared = points - dots.count();
        assert!(shared <= 8, "{points}: {shared}");
    }
}
