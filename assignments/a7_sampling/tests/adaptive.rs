//! A7T6: the error that was asked for, no more work than it takes, and the same bits for all tiles
//! and threads.

use a1_ray_casting::{CastArgs, Sight, Studio};
use a7_sampling::sampler::{Pattern, Pixel};
use a7_sampling::{Adaptive, Exposure, Kernel, Program, Shade};
use common::accel::List;
use common::camera::Camera;
use common::counters::Counters;
use common::geometry::Geometry;
use common::math::Vec3;
use common::mesh::{Mesh, MeshError};
use common::picture::{Film, Size};
use common::scene::{MeshSource, parse_str};
use std::sync::Arc;
use tests::program::parsed_words;

const SIDE: u32 = 48;

/// A screen of 2 × 2, seen straight on; the ball is behind the eye.
const SCREEN: &str = "OrthographicCamera { center 0 0 5 direction 0 0 -1 up 0 1 0 size 2 }
    Materials { numMaterials 1 Material { } }
    Group { numObjects 1 MaterialIndex 0 Sphere { center 0 0 9 radius 1 } }";

/// Scenes without meshes.
struct Nothing;

impl MeshSource for Nothing {
    fn mesh(&mut self, name: &str) -> Result<Arc<Mesh>, MeshError> {
        panic!("there is no mesh {name}")
    }
}

type Drawing = fn(f32, f32) -> Vec3;

/// The colour of a drawing where the ray sets out.
struct Drawn(Drawing);

impl Shade for Drawn {
    fn radiances(&self, sights: &[Sight], _: &[(Pixel, u32)], _: &mut Counters, radiances: &mut [Vec3]) {
        for (sight, radiance) in sights.iter().zip(radiances) {
            *radiance = (self.0)(sight.ray.origin.x, sight.ray.origin.y);
        }
    }
}

/// A slanted edge that passes through one pixel in twenty.
const EDGE: Drawing = |x, y| if 0.3 * x + y < 0.123 { Vec3::new(1.0, 0.5, 0.0) } else { Vec3::splat(0.2) };

/// Detail everywhere.
const NOISE: Drawing = |x, y| Vec3::splat(0.5 + 0.5 * (40.0 * x * y).sin() * (31.0 * x + 57.0 * y).cos());

struct Easel {
    studio: Studio,
    cast: CastArgs,
    drawing: Drawing,
}

impl Easel {
    fn new(drawing: Drawing, flags: &str) -> Self {
        let words = format!("a7_sampling -input none -output none.tga -size {SIDE} {SIDE} {flags}");
        let words: Vec<String> = words.split_whitespace().map(str::to_owned).collect();
        let cast = parsed_words::<Program>(&words).args.cast().clone();
        let scene = parse_str("screen", SCREEN, &mut Nothing).unwrap();
        let (geometry, camera) = (Geometry::build(&scene).unwrap(), Camera::new(&scene.camera));
        let size = Size::new(i64::from(SIDE), i64::from(SIDE)).unwrap();
        Self { studio: Studio { scene, geometry, camera, size }, cast, drawing }
    }

    fn with<T>(
        &self,
        pattern: Pattern,
        seed: u64,
        kernel: Option<Kernel>,
        make: impl FnOnce(&Exposure) -> T,
    ) -> T {
        make(&Exposure {
            studio: &self.studio,
            cast: &self.cast,
            accel: &List::new(&self.studio.geometry),
            shade: &Drawn(self.drawing),
            sampler: &*pattern.sampler(4096, SIDE, seed),
            aperture: None,
            kernel,
        })
    }

    fn uniform(&self, pattern: Pattern, seed: u64, kernel: Option<Kernel>, samples: u32) -> Film {
        self.with(pattern, seed, kernel, |exposure| exposure.picture(samples, None).0)
    }

    fn adaptive(&self, pattern: Pattern, kernel: Option<Kernel>, plan: Adaptive) -> (Film, Vec<u32>) {
        self.with(pattern, 1, kernel, |exposure| {
            let (film, survey, _) = plan.picture(exposure, None).unwrap();
            (film, survey.counts())
        })
    }
}

/// Squared error of each pixel, the mean of its channels.
fn squared_errors(film: &Film, truth: &Film) -> Vec<f64> {
    let square = |(a, b): (&Vec3, &Vec3)| (*a - *b).as_dvec3().length_squared() / 3.0;
    film.pixels().iter().zip(truth.pixels()).map(square).collect()
}

fn root_mean(squares: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = squares.fold((0.0, 0.0), |(sum, count), square| (sum + square, count + 1.0));
    (sum / f64::max(count, 1.0)).sqrt()
}

/// Only the pixels that the edge concerns count, not the flat ones: their root mean square error
/// is below what was asked, for good patterns and bad, with and without a filter.
#[test]
fn a7t6_reaches_the_error_that_was_asked_for() {
    let easel = Easel::new(EDGE, "");
    let kernels = [None, Some(Kernel::Gaussian(0.5)), Some(Kernel::Tent(1.0)), Some(Kernel::Mitchell(2.0))];
    for kernel in kernels {
        let truth = easel.uniform(Pattern::Sobol, 99, kernel, 2048);
        for (pattern, error) in [
            (Pattern::Sobol, 0.03),
            (Pattern::Sobol, 0.006),
            (Pattern::Halton, 0.03),
            (Pattern::Random, 0.03),
        ] {
            let (film, counts) = easel.adaptive(pattern, kernel, Adaptive { error, most: 1024 });
            let errors = squared_errors(&film, &truth);
            // Also those that were stopped at once, but should not have been.
            let concerned = errors.iter().zip(&counts).filter(|(error, n)| **n > 8 || **error > 1e-10);
            let concerned: Vec<f64> = concerned.map(|(error, _)| *error).collect();
            assert!(concerned.len() >= SIDE as usize, "{kernel:?} {pattern:?}: {}", concerned.len());
            let reached = root_mean(concerned.iter().copied());
            assert!(reached < error, "{kernel:?} {pattern:?}: {reached} instead of {error}");
            assert!(
                reached > error / 8.0,
                "{kernel:?} {pattern:?}: far too much work, {reached} for {error}"
            );
            // A standard error is exceeded now and then, but four times it hardly ever.
            let far = errors.iter().filter(|e| e.sqrt() > 4.0 * error).count();
            assert!(far * 500 <= errors.len(), "{kernel:?} {pattern:?}: {far} pixels are far off");
        }
    }
}

#[test]
fn a7t6_flat_areas_keep_the_fewest_samples() {
    let (_, counts) =
        Easel::new(EDGE, "").adaptive(Pattern::Sobol, None, Adaptive { error: 0.01, most: 1024 });
    let fewest = counts.iter().filter(|n| **n == 8).count();
    assert!(fewest > counts.len() * 85 / 100, "{fewest} of {}", counts.len());
    let (_, all) = Easel::new(|_, _| Vec3::splat(0.7), "").adaptive(
        Pattern::Random,
        Some(Kernel::Gaussian(0.5)),
        Adaptive { error: 1e-5, most: 1024 },
    );
    assert!(all.iter().all(|n| *n == 8));
}

/// The same error by as many samples for all takes at least three times as many.
#[test]
fn a7t6_takes_a_third_of_the_samples_where_much_is_flat() {
    let easel = Easel::new(EDGE, "");
    let truth = easel.uniform(Pattern::Sobol, 99, None, 4096);
    let (film, counts) = easel.adaptive(Pattern::Sobol, None, Adaptive { error: 0.01, most: 4096 });
    let mean = counts.iter().map(|n| f64::from(*n)).sum::<f64>() / counts.len() as f64;
    let thrice = (3.0 * mean) as u32;
    let [own, other] = [film, easel.uniform(Pattern::Sobol, 1, None, thrice)]
        .map(|film| root_mean(squared_errors(&film, &truth).into_iter()));
    assert!(own < other, "{mean} samples: {own}; {thrice} for all: {other}");
}

#[test]
fn a7t6_never_takes_more_than_it_may() {
    for most in [1, 5, 8, 100] {
        let (_, counts) =
            Easel::new(NOISE, "").adaptive(Pattern::Sobol, None, Adaptive { error: 1e-4, most });
        assert!(counts.iter().all(|n| *n <= most), "{most}");
        assert!(counts.iter().filter(|n| **n == most).count() * 10 > 9 * counts.len(), "{most}");
    }
}

#[test]
fn a7t6_tiles_and_threads_change_no_bit() {
    let plan = Adaptive { error: 0.02, most: 256 };
    for (drawing, kernel) in [(EDGE, None), (NOISE, Some(Kernel::Gaussian(0.5)))] {
        let shoot = |flags: &str| Easel::new(drawing, flags).adaptive(Pattern::Sobol, kernel, plan);
        let first = shoot("-threads 1 -tile 16");
        for flags in
            ["-threads 2 -tile 16", "-threads 7 -tile 16", "-threads 1 -tile 5", "-threads 7 -tile 5"]
        {
            assert!(first == shoot(flags), "{flags}");
        }
    }
}

/// The samples that pixels are spared are counted; traced all the same they cost just as many rays
/// and change nothing.
#[test]
fn a7t6_spared_samples_are_counted_and_change_no_bit() {
    let plan = Adaptive { error: 0.02, most: 64 };
    for kernel in [None, Some(Kernel::Gaussian(0.5))] {
        let shoot = |flags: &str| {
            Easel::new(EDGE, flags).with(Pattern::Sobol, 1, kernel, |exposure| {
                let (film, survey, counters) = plan.picture(exposure, None).unwrap();
                (film, survey.counts(), counters)
            })
        };
        let (film, counts, skipping) = shoot("-noskip tile");
        let (same, as_many, toiling) = shoot("-noskip tile -noskip converged");
        assert!(film == same && counts == as_many);
        let all = u64::from(SIDE * SIDE * plan.most);
        assert!(skipping.skipped_converged > all / 2, "{skipping:?}");
        assert_eq!(skipping.rays + skipping.skipped_converged, all);
        assert_eq!((toiling.rays, toiling.skipped_converged), (all, 0));
    }
}
