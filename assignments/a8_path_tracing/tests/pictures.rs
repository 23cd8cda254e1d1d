//! What becomes of sums in pictures.

use a7_sampling::sampler::Pixel;
use a8_path_tracing::film::{Frame, Sums, develop};
use a8_path_tracing::render::{Goal, Rendering};
use a8_path_tracing::{Aov, Estimator, Found, Layout};
use common::counters::Counters;
use common::math::Vec3;
use common::picture::{Film, Size, Transfer};
use common::tiles::TileOptions;
use std::ops::Range;
use std::path::Path;

/// A wall that leans back: depth 2 on the left to 5 on the right, nothing in the last column.
struct Wall;

impl Estimator for Wall {
    type Scratch = ();
    fn trace(&self, (): &mut (), p: &[Pixel], r: Range<u32>, _: &mut Counters, f: &mut [Found]) {
        for (i, found) in f.iter_mut().enumerate() {
            let (x, _) = p[i / r.len()];
            let met =
                Found { radiance: Vec3::X, albedo: Vec3::Y, normal: Vec3::NEG_Z, depth: 2.0 + x as f32 };
            *found = if x < 4 { met } else { Found { albedo: Vec3::splat(0.2), ..Found::default() } };
        }
    }
}

fn wall(layout: Layout) -> Sums {
    let mut sums = Sums::new(Frame::whole(Size::new(5, 2).unwrap()), layout, 0).unwrap();
    Rendering { goal: Goal { end: 3, time: None, error: None }, options: TileOptions::default() }.run(
        &Wall,
        &mut sums,
        |_| {},
    );
    sums
}

fn row(film: &Film) -> Vec<Vec3> {
    assert_eq!(film.row(0), film.row(1));
    film.row(0).to_vec()
}

#[test]
fn float_files_hold_means_and_levels_are_scaled() {
    let sums = wall(Layout { halves: false, aovs: [true; 3] });
    let of = |aov, file: &str| row(&develop::aov(&sums, aov, Path::new(file)).unwrap());
    let (met, missed) = (|value| [value; 4].to_vec(), |value: Vec3| [value].to_vec());
    assert_eq!(of(Aov::Normal, "n.exr"), [met(Vec3::NEG_Z), missed(Vec3::ZERO)].concat());
    let half = Vec3::splat(0.5);
    assert_eq!(of(Aov::Normal, "n.png"), [met(Vec3::new(0.5, 0.5, 0.0)), missed(half)].concat());
    assert_eq!(of(Aov::Albedo, "a.tga"), [met(Vec3::Y), missed(Vec3::splat(0.2))].concat());
    let depths = |values: [f32; 5]| values.map(Vec3::splat).to_vec();
    assert_eq!(of(Aov::Depth, "d.pfm"), depths([2.0, 3.0, 4.0, 5.0, 0.0]));
    let grey = of(Aov::Depth, "d.tga");
    let expected = depths([1.0, 0.7, 0.4, 0.1, 0.0]);
    assert!(grey.iter().zip(&expected).all(|(a, b)| (*a - *b).abs().max_element() < 1e-6), "{grey:?}");
    assert_eq!(row(&develop::radiance(&sums)), [met(Vec3::X), missed(Vec3::ZERO)].concat());
    // Only light is coded by the curve.
    let coded = Aov::ALL.map(|aov| develop::transfer(aov, Transfer::Srgb));
    assert_eq!(coded, [Transfer::Srgb, Transfer::Linear, Transfer::Linear]);
}

#[test]
fn what_is_not_kept_cannot_be_shown() {
    let sums = wall(Layout { halves: true, aovs: [false, true, false] });
    let kept = Aov::ALL.map(|aov| develop::aov(&sums, aov, Path::new("a.exr")).is_some());
    assert_eq!(kept, [false, true, false]);
    assert_eq!(sums.aov(Aov::Normal, 0), Some(Vec3::NEG_Z));
}
