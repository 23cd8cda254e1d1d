//! Command lines of assignment 7 whose samples are left to chance: their pictures have no
//! references, but a distribution.

use common::math::{DVec3, Vec3};
use common::picture::Film;
use common::scene;
use oracle::{Options, Samples, samples};
use std::collections::BTreeMap;
use tests::chance::{Expected, expected};
use tests::{CommandLine, Picture, PictureKind, program, reference};

/// Samples along each side of a pixel that stand for the truth.
const FINE: u32 = 24;

/// Command lines with chance in them that write a kind of picture of a scene of few primitives.
fn lines(kind: PictureKind) -> impl Iterator<Item = CommandLine> {
    let simple = |line: &CommandLine| {
        ["scene7_01", "scene7_02", "scene7_05"].iter().any(|name| line.scene().contains(name))
    };
    let writes = move |line: &CommandLine| line.pictures().iter().any(|picture| picture.kind == kind);
    CommandLine::of_assignment(7)
        .into_iter()
        .filter(|line| line.leaves_to_chance())
        .filter(simple)
        .filter(writes)
}

/// The line with a picture that is quick to draw often, and how often to draw it.
fn quick(line: &CommandLine) -> (CommandLine, u32) {
    match line.numbers("-size") {
        Some([12u32, 12u32]) => (line.clone(), 100),
        _ if line.scene().contains("7_05") => (line.with("-size", &["36", "36"]), 4),
        _ => (line.with("-size", &["48", "48"]), 8),
    }
}

/// The oracle's fine samples of a line's picture, each drawn once.
#[derive(Default)]
struct Truth(BTreeMap<(String, u32), Samples>);

impl Truth {
    fn of(&mut self, line: &CommandLine) -> &Samples {
        let wanted = Options { pixel_side: FINE, ..reference::options(line) };
        let draw = || {
            let scene = scene::load(&line.scene_file()).unwrap_or_else(|error| panic!("{line}\n{error}"));
            samples(&scene, &wanted).unwrap_or_else(|error| panic!("{line}\n{error}"))
        };
        self.0.entry((line.scene().to_owned(), wanted.width)).or_insert_with(draw)
    }
}

/// The picture of a kind that a line writes, other samples for each seed.
fn drawn(line: &CommandLine, kind: PictureKind, seed: u32) -> Film {
    let line = line.with("-seed", &[&seed.to_string()]);
    let found = program::pictures(&line).into_iter().find(|(picture, _): &(Picture, _)| picture.kind == kind);
    found.unwrap_or_else(|| panic!("{line}\n  writes no such picture")).1
}

fn count(line: &CommandLine) -> u32 {
    let [n] = line.numbers("-random_samples").or(line.numbers("-jittered_samples")).expect("a pattern");
    n
}

/// How far pictures are from what was expected.
struct Deviation {
    /// Sum of squared deviations in parts of the expected one, and its standard error.
    ratio: (f64, f64),
    /// Sum of deviations, in standard errors.
    bias: f64,
    /// The worst pixel, in parts of what happens once in 10⁹ pixels.
    worst: f64,
}

/// What independent samples exceed once in 10⁹ times, for a sum of this variance whose summands
/// are at most `step`: Bernstein's inequality. Single precision is allowed for.
fn rarely_exceeded(variance: f64, step: f64) -> f64 {
    const LOG: f64 = 21.4;
    let single = step * LOG / 3.0;
    single + (single * single + 2.0 * variance * LOG).sqrt() + 1e-5
}

/// `together`: how many pixels share samples with one, which makes their deviations alike.
fn deviation(films: &[Film], expected: &[Expected], together: f64) -> Deviation {
    let (mut squares, mut variances, mut spread, mut sum, mut worst) = (0.0, 0.0, 0.0, 0.0, 0.0f64);
    for film in films {
        for (color, wanted) in film.pixels().iter().zip(expected) {
            let off = color.as_dvec3() - wanted.mean;
            for channel in 0..3 {
                let (off, variance) = (off[channel], wanted.variance[channel]);
                squares += off * off;
                variances += variance;
                spread += (off * off - variance).powi(2);
                sum += off;
                worst = worst.max(
                    off.abs() / rarely_exceeded(variance + wanted.unseen[channel], wanted.step[channel]),
                );
            }
        }
    }
    // The channels of a pixel move together too.
    let error = (3.0 * together * spread).sqrt() / variances;
    let bias = sum / (3.0 * together * variances).sqrt();
    Deviation { ratio: (squares / variances, error), bias, worst }
}

/// Random samples: as far from the truth as independent samples are, neither more nor less.
/// Jittered ones: nowhere farther, and nearer by far on the whole.
#[test]
fn pictures_by_chance_are_as_far_off_as_their_samples_allow() {
    let (mut truth, mut seen) = (Truth::default(), 0);
    for line in lines(PictureKind::Color) {
        let (line, times) = quick(&line);
        let line = line.with("-output", &["picture.pfm"]);
        let filter = reference::options(&line).filter;
        let expected = expected(truth.of(&line), filter, count(&line));
        let films: Vec<_> = (0..times).map(|seed| drawn(&line, PictureKind::Color, seed)).collect();
        let together = f64::from(2 * filter.map_or(0, |f| f.support()) + 1).powi(2);
        let Deviation { ratio: (ratio, error), bias, worst } = deviation(&films, &expected, together);
        println!("{ratio:.3} ± {error:.3} of the variance, bias {bias:.2}, worst {worst:.2}: {line}");
        assert!(bias.abs() < 5.0 && worst < 1.0, "{line}\n  bias {bias}, worst pixel {worst}");
        // The truth is a pattern of samples, too, and the formulas are of first order.
        let slack = 5.0 * error + 0.05;
        assert!(error < 0.1, "{line}\n  {error} is no test");
        if line.has("-random_samples") {
            assert!((ratio - 1.0).abs() < slack, "{line}\n  {ratio} of the variance expected");
        } else {
            assert!(ratio < 0.8 + slack, "{line}\n  {ratio} of the variance of random samples");
        }
        seen += 1;
    }
    assert_eq!(seen, 14, "command lines");
}

/// Scenes with a lens, a curved screen or lights that have an extent, and the flags they want.
/// Samples stand where the oracle's do, unless a lens needs more.
const EFFECTS: [(&str, &str); 6] = [
    ("scene7_10_soft_shadow.txt", "-uniform_samples 64 -light_samples 64 -shadows"),
    ("scene7_11_area_light.txt", "-uniform_samples 64 -light_samples 64 -shadows"),
    ("scene7_12_depth_of_field.txt", "-samples 1024 -shadows"),
    ("scene7_12_depth_of_field.txt", "-samples 1024 -shadows -blades 3"),
    ("scene7_14_curved_screen.txt", "-uniform_samples 64 -shadows"),
    ("scene7_15_absorption.txt", "-uniform_samples 64 -shadows -bounces 3 -fresnel"),
];

/// Many samples come to what the oracle finds with a grid over pixel, lens and lights.
#[test]
fn effects_are_those_of_the_oracle() {
    for (scene_name, flags) in EFFECTS {
        let words = format!("a7_sampling -input scenes/{scene_name} -size 24 24 -output picture.pfm {flags}");
        let words = words.split_whitespace().map(str::to_owned).collect();
        let line = CommandLine { assignment: 7, line: 0, words };
        let (pixel_side, lens_side, light_side, fresnel) = (8, 8, 8, line.has("-fresnel"));
        let wanted = Options { pixel_side, lens_side, light_side, fresnel, ..reference::options(&line) };
        let mut scene = scene::load(&line.scene_file()).unwrap_or_else(|error| panic!("{line}\n{error}"));
        if let (Some(lens), Some([blades])) = (&mut scene.camera.lens, line.numbers("-blades")) {
            lens.blades = Some(blades);
        }
        let exact = oracle::render(&scene, &wanted).unwrap_or_else(|error| panic!("{line}\n{error}")).colour;
        let film = drawn(&line, PictureKind::Color, 0);
        let pairs = film.pixels().iter().zip(&exact.pixels);
        let off: Vec<DVec3> = pairs.map(|(ours, exact)| ours.as_dvec3() - *exact).collect();
        let n = off.len() as f64;
        let rmse = (off.iter().map(|d| d.length_squared()).sum::<f64>() / (3.0 * n)).sqrt();
        let bias = (off.iter().sum::<DVec3>() / n).abs().max_element();
        println!("rmse {rmse:.5}, bias {bias:.5}: {line}");
        assert!(rmse < 0.01 && bias < 0.001, "{line}\n  rmse {rmse}, bias {bias}");
    }
}

/// Least and greatest colour of a pixel's fine samples, in levels, with some room for what lies
/// between them.
fn range(fine: &[DVec3]) -> (Vec3, Vec3) {
    let low = fine.iter().copied().reduce(DVec3::min).unwrap_or_default();
    let high = fine.iter().copied().reduce(DVec3::max).unwrap_or_default();
    let room = DVec3::splat(3.0 / 255.0);
    ((low - room).as_vec3(), (high + room).as_vec3())
}

/// Pictures of samples: the ground is right, dots have colours that their pixel has, there are as
/// many as samples where none can hide another, and none beyond.
#[test]
fn dots_are_where_samples_may_be() {
    let (mut truth, mut seen) = (Truth::default(), 0);
    for line in lines(PictureKind::Samples) {
        let film = drawn(&line, PictureKind::Samples, 0);
        let [_, zoom] = line.values("-render_samples").expect("it was asked for");
        let zoom: u32 = zoom.parse().expect("a number");
        let fine = truth.of(&line);
        let n = count(&line);
        let side = 2 * (zoom / 16) + 1;
        let mut painted_in_all = 0;
        for (i, j) in (0..fine.width).flat_map(|i| (0..fine.height).map(move |j| (i, j))) {
            let ground = if (i + j) % 2 == 0 { 51.0 / 255.0 } else { 0.0 };
            let (low, high) = range(fine.pixel(i, j));
            let cell = (0..zoom).flat_map(|x| (0..zoom).map(move |y| (x, y)));
            let painted: Vec<_> = cell
                .filter(|(x, y)| (film.get(i * zoom + x, j * zoom + y) - ground).abs().max_element() > 1e-6)
                .collect();
            for (x, y) in &painted {
                let color = film.get(i * zoom + x, j * zoom + y);
                assert!(color.cmpge(low).all() && color.cmple(high).all(), "{line}\n  ({i}, {j}): {color}");
            }
            let dots = painted.len() as u32;
            assert!(
                dots > 0 && dots <= n * side * side,
                "{line}\n  ({i}, {j}): {dots} painted for {n} samples"
            );
            if line.has("-jittered_samples") {
                // In a dot of one pixel nothing hides; a stratum is larger than that.
                assert!(side > 1 || dots == n, "{line}\n  ({i}, {j}): {dots} dots for {n} samples");
                let strata = n.isqrt();
                let has_one = |s: u32| {
                    let within =
                        |at: u32, s: u32| at * strata + strata > s * zoom && at * strata < (s + 1) * zoom;
                    painted.iter().any(|(x, y)| within(*x, s % strata) && within(*y, s / strata))
                };
                assert!((0..n).all(has_one), "{line}\n  ({i}, {j}): a stratum without a dot");
            }
            painted_in_all += dots;
        }
        if line.has("-random_samples") {
            check_painted(&line, painted_in_all, fine.width * fine.height, n, zoom, side);
        }
        seen += 1;
    }
    assert_eq!(seen, 10, "command lines");
}

/// A place of a cell is painted if any of `n` independent dots covers it.
fn check_painted(line: &CommandLine, painted: u32, cells: u32, n: u32, zoom: u32, side: u32) {
    let covering = |at: u32| {
        let reach = side / 2;
        f64::from((at + reach).min(zoom - 1) - at.saturating_sub(reach) + 1) / f64::from(zoom)
    };
    let places = (0..zoom).flat_map(|x| (0..zoom).map(move |y| (x, y)));
    let of_cell: f64 = places.map(|(x, y)| 1.0 - (1.0 - covering(x) * covering(y)).powi(n as i32)).sum();
    let (expected, found) = (of_cell * f64::from(cells), f64::from(painted));
    // Each dot hides another or not, and is cut off or not: less than its size, independently.
    let deviation = f64::from(side * side) * f64::from(n * cells).sqrt() / 2.0;
    assert!((found - expected).abs() < 5.0 * deviation, "{line}\n  {found} painted for {expected}");
}
