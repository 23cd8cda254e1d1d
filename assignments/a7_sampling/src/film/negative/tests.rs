//! Sums of samples come to what the course says of pixels.

use super::*;
use crate::Sample;
use crate::sampler::{Jittered, Sampler};

const SIZE: (i64, i64) = (7, 5);

/// A picture of `color(x, y)` in pixels, by nine jittered samples per pixel, exposed so many
/// rows at a time.
fn picture(kernel: Option<Kernel>, rows: u32, color: impl Fn(f64, f64) -> Vec3) -> Film {
    let size = Size::new(SIZE.0, SIZE.1).unwrap();
    let (mut film, mut negative, mut done) = (Film::new(size), Negative::new(size, kernel), 0);
    let (mut shares, sampler) = (Shares::new(kernel), Jittered::new(9, 1));
    while done < size.height() {
        let from = negative.end();
        let to = (from + rows).min(size.height());
        negative.extend_to(to);
        for (x, y) in (from..to).flat_map(|y| (0..size.width()).map(move |x| (x, y))) {
            shares.clear();
            let sample = |s| {
                let at = sampler.pair((x, y), s, 0);
                Sample { pixel: (x, y), at, color: color(f64::from(x) + at[0], f64::from(y) + at[1]) }
            };
            shares.add_all(&(0..9).map(sample).collect::<Vec<_>>());
            negative.add(x, y, shares.sums());
        }
        done = negative.develop(done, &mut film);
    }
    film
}

const KERNELS: [Kernel; 6] = [
    Kernel::Box(1.7),
    Kernel::Tent(2.3),
    Kernel::Gaussian(0.6),
    Kernel::Mitchell(2.0),
    Kernel::Lanczos(3.0),
    Kernel::BlackmanHarris(1.5),
];

/// The rule of the course, sample by sample.
fn by_definition(kernel: Kernel, x: u32, y: u32, color: impl Fn(f64, f64) -> Vec3) -> Vec3 {
    let (support, sampler) = (kernel.support() as i64, Jittered::new(9, 1));
    let (mut sum, mut weights) = (common::math::DVec3::ZERO, 0.0);
    for (i, j) in (0..SIZE.0).flat_map(|i| (0..SIZE.1).map(move |j| (i, j))) {
        if (i - i64::from(x)).abs() > support || (j - i64::from(y)).abs() > support {
            continue;
        }
        for s in 0..9 {
            let [u, v] = sampler.pair((i as u32, j as u32), s, 0);
            let (px, py) = (i as f64 + u, j as f64 + v);
            let w = kernel.weight(px - f64::from(x) - 0.5, py - f64::from(y) - 0.5);
            sum += color(px, py).as_dvec3() * w;
            weights += w;
        }
    }
    (sum / weights).as_vec3()
}

fn pattern(x: f64, y: f64) -> Vec3 {
    Vec3::new((x * 1.3 + y).sin() as f32, (x * y) as f32, if x > 3.3 { 9.0 } else { 0.0 })
}

#[test]
fn a7t2_pixels_are_weighted_means_of_all_samples_near() {
    for kernel in KERNELS {
        let film = picture(Some(kernel), 5, pattern);
        for (x, y) in (0..5).flat_map(|y| (0..7).map(move |x| (x, y))) {
            let expected = by_definition(kernel, x, y, pattern);
            let off = (film.get(x, y) - expected).abs().max_element();
            assert!(off < 2e-5 * expected.abs().max_element().max(1.0), "{kernel:?} ({x}, {y}) {off}");
        }
    }
}

#[test]
fn a7t2_one_color_stays_that_color() {
    for kernel in KERNELS.into_iter().map(Some).chain([None, Some(Kernel::Tent(0.1))]) {
        for pixel in picture(kernel, 5, |_, _| Vec3::new(1.0, 0.25, 3.0)).pixels() {
            let off = (*pixel - Vec3::new(1.0, 0.25, 3.0)).abs().max_element();
            assert!(off < 1e-6, "{kernel:?} {pixel}");
        }
    }
}

/// One pixel with a hundred times the samples of the others is no heavier than they are.
#[test]
fn a7t6_more_samples_are_no_more_weight() {
    let size = Size::new(3, 1).unwrap();
    let value = |x: u32| Vec3::splat(x as f32);
    let picture = |counts: [u32; 3]| {
        let kernel = Some(Kernel::Gaussian(0.8));
        let (mut negative, mut film) = (Negative::new(size, kernel), Film::new(size));
        negative.extend_to(1);
        for x in 0..3 {
            let mut shares = Shares::new(kernel);
            (0..counts[x as usize]).for_each(|_| shares.add([0.3, 0.6], value(x)));
            negative.add(x, 0, shares.sums());
        }
        negative.develop(0, &mut film);
        film
    };
    let (even, uneven) = (picture([2; 3]), picture([2, 200, 2]));
    for (a, b) in even.pixels().iter().zip(uneven.pixels()) {
        assert!((*a - *b).abs().max_element() < 1e-5, "{a} {b}");
    }
}

#[test]
fn rows_may_come_a_few_at_a_time() {
    for kernel in KERNELS.into_iter().map(Some).chain([None]) {
        assert_eq!(picture(kernel, 1, pattern), picture(kernel, 5, pattern), "{kernel:?}");
    }
}
