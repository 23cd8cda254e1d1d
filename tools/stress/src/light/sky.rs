//! Property 13 for the sky.

use super::chi::Family;
use super::lights::sample_count;
use crate::Stress;
use a8_path_tracing::light::Environment;
use common::math::{DVec3, Vec3};
use common::picture::{Film, Size};
use std::f64::consts::TAU;

/// A sky with a sun, a black patch, and a sloping rest.
fn sky() -> Environment {
    Environment::new(Film::from_fn(Size::new(16, 8).unwrap(), |x, y| match (x, y) {
        (11, 6) => Vec3::splat(900.0),
        (0..4, 2) => Vec3::ZERO,
        _ => Vec3::new(0.1 + x as f32 * 0.05, 0.3, 0.2 + y as f32 * 0.1),
    }))
}

/// What the sky offers follows its density.
pub fn sky_offers(stress: &Stress) {
    stress.case("p13 offers of the sky, χ²", || {
        // Bins are quarters of pixels along each side, in which the density times the sine is one.
        let (columns, rows) = (64usize, 32usize);
        let sky = sky();
        let place = |i: f64, j: f64| {
            let (longitude, from_below) = ((i / 64.0 - 0.5) * TAU, j / 64.0 * TAU);
            let sine = from_below.sin();
            (DVec3::new(-longitude.sin() * sine, -from_below.cos(), longitude.cos() * sine), sine)
        };
        let mut due: Vec<f64> = (0..columns * rows)
            .map(|bin| {
                let (direction, sine) = place((bin % columns) as f64 + 0.5, (bin / columns) as f64 + 0.5);
                sky.look(direction).1 * sine * (TAU / 64.0).powi(2)
            })
            .collect();
        let sum: f64 = due.iter().sum();
        assert!((sum - 1.0).abs() < 1e-6, "{sum}");
        let mut counts = vec![0u64; columns * rows];
        let (mut draw, samples) = (stress.draw(0xa81a), sample_count(stress).max(500_000));
        for _ in 0..samples {
            let (direction, radiance, pdf) = sky.sample([draw.unit(), draw.unit()]).expect("it is not black");
            let (seen, density) = sky.look(direction);
            assert!(seen == radiance && (density / pdf - 1.0).abs() < 1e-6, "{direction}: {density} {pdf}");
            let across = ((-direction.x).atan2(direction.z) / TAU + 0.5) * 64.0;
            let up = (-direction.y).acos() / TAU * 64.0;
            counts[(up as usize).min(rows - 1) * columns + (across as usize).min(columns - 1)] += 1;
        }
        due.iter_mut().for_each(|p| *p *= samples as f64);
        let mut family = Family::default();
        family.test("sky".to_owned(), &counts, &due);
        family.judge()
    });
}
