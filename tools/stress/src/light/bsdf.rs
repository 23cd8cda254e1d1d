//! Property 13 for surfaces: samples follow their densities, and directions can be exchanged.

use super::chi::Family;
use crate::Stress;
use crate::kit::Draw;
use a4_whitted::refract;
use a8_path_tracing::bsdf::{Bsdf, Glossy};
use common::math::{DVec3, Vec3};
use common::scene::PhongMaterial;
use std::f64::consts::{FRAC_PI_2, TAU};

fn sample_count(stress: &Stress) -> usize {
    if stress.tier().is_thorough() { 1_000_000 } else { 200_000 }
}

/// Bins by the angle to the normal, and around it.
const BINS: [usize; 2] = [80, 160];

/// Points of a bin along each side at which the density is looked up: seen from aside, a sharp
/// highlight is narrower around the normal than towards it.
const FINE: [usize; 2] = [4, 16];

fn material(diffuse: f32, specular: f32, exponent: f32, mirror: f32, glass: f32) -> PhongMaterial {
    PhongMaterial {
        diffuse: Vec3::splat(diffuse),
        specular: Vec3::splat(specular),
        exponent,
        reflective: Vec3::splat(mirror),
        transparent: Vec3::splat(glass),
        index_of_refraction: 1.5,
        ..PhongMaterial::default()
    }
}

fn materials() -> Vec<(String, PhongMaterial)> {
    let glossy =
        [1.0, 5.0, 30.0, 200.0, 1000.0].map(|e| (format!("gloss {e}"), material(0.0, 1.0, e, 0.0, 0.0)));
    let others = [
        ("matt".to_owned(), material(0.8, 0.0, 1.0, 0.0, 0.0)),
        ("matt and gloss 20".to_owned(), material(0.5, 0.5, 20.0, 0.0, 0.0)),
        ("too much of matt and gloss 1000".to_owned(), material(0.9, 0.7, 1000.0, 0.0, 0.0)),
        ("all lobes".to_owned(), material(0.3, 0.3, 60.0, 0.2, 0.2)),
        ("matt and glass".to_owned(), material(0.4, 0.0, 1.0, 0.0, 0.6)),
    ];
    others.into_iter().chain(glossy).collect()
}

/// A slanted frame: two tangents and the normal.
fn frame() -> [Vec3; 3] {
    let normal = Vec3::new(0.3, 0.8, -0.5).normalize();
    let (a, b) = normal.any_orthonormal_pair();
    [a, b, normal]
}

/// The direction at an angle to the normal and around it.
fn direction([a, b, normal]: [Vec3; 3], angle: f64, around: f64) -> Vec3 {
    let [a, b, normal] = [a, b, normal].map(|v| v.as_dvec3());
    let (sine, cosine) = angle.sin_cos();
    ((a * around.cos() + b * around.sin()) * sine + normal * cosine).as_vec3()
}

/// Where the middle of part `i` of `count` lies.
fn middle(i: usize, count: usize) -> f64 {
    (i as f64 + 0.5) / count as f64
}

/// Probability of every bin of the upper hemisphere.
fn expected(bsdf: &Bsdf, out: Vec3) -> Vec<f64> {
    let frame = frame();
    let ([rows, columns], [along, around]) = (BINS, FINE);
    let cell = (FRAC_PI_2 / (rows * along) as f64) * (TAU / (columns * around) as f64);
    let mut bins = vec![0.0; rows * columns];
    for row in 0..rows * along {
        let angle = middle(row, rows * along) * FRAC_PI_2;
        for column in 0..columns * around {
            let into = direction(frame, angle, middle(column, columns * around) * TAU);
            let density = f64::from(bsdf.value(out, into, frame[2]).pdf);
            bins[row / along * columns + column / around] += density * angle.sin() * cell;
        }
    }
    bins
}

/// The bin of a direction.
fn bin(into: Vec3) -> usize {
    let [a, b, normal] = frame().map(|v| v.as_dvec3());
    let into = into.as_dvec3();
    let angle = into.dot(normal).clamp(-1.0, 1.0).acos();
    let around = into.dot(b).atan2(into.dot(a)).rem_euclid(TAU);
    let [rows, columns] = BINS;
    let row = ((angle / FRAC_PI_2 * rows as f64) as usize).min(rows - 1);
    row * columns + ((around / TAU * columns as f64) as usize).min(columns - 1)
}

/// Samples of surfaces follow their densities.
pub fn samples(stress: &Stress) {
    stress.case("p13 samples of surfaces, χ²", || {
        let mut family = Family::default();
        let (mut draw, samples) = (stress.draw(0xa813), sample_count(stress));
        for (name, material) in materials() {
            let bsdf = Bsdf::new(&material);
            let parts =
                [material.diffuse.x, material.specular.x, material.reflective.x, material.transparent.x];
            let specular = f64::from(parts[2] + parts[3]) / f64::from(parts.iter().sum::<f32>());
            for degrees in [0.0f64, 40.0, 80.0] {
                let out = direction(frame(), degrees.to_radians(), 1.0);
                let mut due = expected(&bsdf, out);
                let broad: f64 = due.iter().sum();
                // What is not broad and not specular goes below the surface, and is nothing.
                due.extend([specular, (1.0 - specular - broad).max(0.0)]);
                let mut counts = vec![0u64; due.len()];
                let (to_specular, to_nothing) = (due.len() - 2, due.len() - 1);
                for _ in 0..samples {
                    let uv = [draw.unit() as f32, draw.unit() as f32].map(|x| x.min(1.0 - f32::EPSILON));
                    let way = bsdf.sample(out, frame()[2], false, uv);
                    let place = match way {
                        None => to_nothing,
                        Some(way) if way.pdf == f32::INFINITY => to_specular,
                        Some(way) => bin(way.direction),
                    };
                    counts[place] += 1;
                }
                let due: Vec<f64> = due.iter().map(|p| p * samples as f64).collect();
                family.test(format!("{name} from {degrees}°"), &counts, &due);
                if parts[1] == 0.0 || degrees == 0.0 && parts[0] == 0.0 && material.exponent >= 30.0 {
                    assert!(
                        (broad + specular - 1.0).abs() < 1e-3,
                        "{name} from {degrees}°: {}",
                        broad + specular
                    );
                }
            }
        }
        family.judge()
    });
}

/// A direction of the upper hemisphere, all equally likely.
fn above(draw: &mut Draw) -> Vec3 {
    let normal = frame()[2].as_dvec3();
    let d: DVec3 = draw.direction();
    (if d.dot(normal) < 0.0 { -d } else { d }).as_vec3()
}

/// Weights are values over densities.
pub fn weights(stress: &Stress) {
    stress.case("p13 weights of samples", || {
        let mut draw = stress.draw(0xa814);
        for (name, material) in materials() {
            let bsdf = Bsdf::new(&material);
            for _ in 0..2000 {
                let out = above(&mut draw);
                let uv = [draw.unit() as f32, draw.unit() as f32].map(|x| x.min(1.0 - f32::EPSILON));
                let Some(way) = bsdf.sample(out, frame()[2], false, uv) else { continue };
                if way.pdf == f32::INFINITY || frame()[2].dot(way.direction) < 1e-3 {
                    continue;
                }
                let value = bsdf.value(out, way.direction, frame()[2]);
                let off = (value.response - way.weight * value.pdf).abs().max_element();
                assert!(off <= 1e-4 * value.response.max_element(), "{name}: {way:?} {value:?}");
                assert!((way.pdf / value.pdf - 1.0).abs() < 1e-3, "{name}: {way:?} {value:?}");
            }
        }
        Ok(0.0)
    });
}

/// Directions can be exchanged.
pub fn reciprocity(stress: &Stress) {
    stress.case("p13 reciprocity, relative difference", || {
        let mut draw = stress.draw(0xa815);
        let normal = frame()[2];
        let mut worst = 0.0f32;
        for (name, material) in materials() {
            let bsdf = Bsdf::new(&material);
            for _ in 0..20_000 {
                let (one, two) = (above(&mut draw), above(&mut draw));
                let f = |out: Vec3, into: Vec3| bsdf.value(out, into, normal).response.x / normal.dot(into);
                let (there, back) = (f(one, two), f(two, one));
                // What is below the smallest normal number has no relative error to speak of.
                let off = (there - back).abs() / there.max(back).max(1e-30);
                worst = worst.max(off);
                assert!(off <= 1e-5, "{name}: {one} {two}: {there} and {back}");
            }
        }
        Ok(f64::from(worst))
    });
}

/// Glass lets as much in as out.
pub fn glass(stress: &Stress) {
    stress.case("p13 glass both ways", || {
        let mut draw = stress.draw(0xa816);
        let normal = frame()[2].as_dvec3().normalize();
        for _ in 0..20_000 {
            let index = draw.between(1.01, 3.0);
            let incoming = -above(&mut draw).as_dvec3().normalize();
            let into = refract(incoming, normal, index);
            let through = into.refracted.expect("light always enters what is denser");
            let back = refract(-through, normal, index);
            assert!((into.reflectance - back.reflectance).abs() < 1e-6, "{index} {incoming}");
            let returned = back.refracted.expect("it came from there");
            assert!(returned.dot(-incoming) > 1.0 - 1e-6, "{index} {incoming} {returned}");
        }
        Ok(0.0)
    });
}

/// Share of light from an angle that the highlight sends on, by a grid of its own half vectors.
fn highlight(exponent: f32, degrees: f64) -> f64 {
    const SIDE: usize = 200;
    let glossy = Glossy::new(Vec3::ONE, exponent);
    let [_, _, normal] = frame();
    let out = direction(frame(), degrees.to_radians(), 0.0);
    let grid = (0..SIDE * SIDE).map(|i| [middle(i % SIDE, SIDE) as f32, middle(i / SIDE, SIDE) as f32]);
    let sent = grid.map(|uv| {
        let half = glossy.half_vector(uv, normal);
        let into = half * (2.0 * out.dot(half)) - out;
        let (value, density) = glossy.value(out, into, normal);
        let cosine = normal.dot(into);
        if cosine > 0.0 && density > 0.0 { f64::from(value * cosine / density) } else { 0.0 }
    });
    sent.sum::<f64>() / (SIDE * SIDE) as f64
}

/// Highlights never send back more than arrives.
pub fn highlights(stress: &Stress) {
    stress.case("p13 highlights, most that is sent back", || {
        let mut most: f64 = 0.0;
        for exponent in [0.0, 1.0, 2.0, 5.0, 10.0, 30.0, 100.0, 300.0, 1000.0, 10_000.0] {
            let straight = highlight(exponent, 0.0);
            assert!((straight - 1.0).abs() < 2e-3, "{exponent}: {straight} from straight above");
            for degrees in (1..18).map(|i| f64::from(5 * i)).chain([88.0, 89.0]) {
                let share = highlight(exponent, degrees);
                most = most.max(share);
                assert!(share <= 1.001, "{exponent} from {degrees}°: {share}");
                assert!(share > 0.0, "{exponent} from {degrees}°: {share}");
            }
        }
        Ok(most)
    });
}
