//! Property 13 for lights: what is offered follows its density, and the densities are those that
//! paths are weighed by.

use super::chi::Family;
use super::stage::{Stage, scene};
use crate::Stress;
use a8_path_tracing::light::Lights;
use common::accel::{Accel, List};
use common::counters::Counters;
use common::math::{DVec3, Interval, Vec3};
use common::ray::Ray;
use std::f64::consts::TAU;

/// Samples of a light; the sky has half a million at least.
pub(super) fn sample_count(stress: &Stress) -> usize {
    if stress.tier().is_thorough() { 1_000_000 } else { 50_000 }
}

/// Bins by the angle to the light's middle, and around it; all of the same solid angle.
const BINS: [usize; 2] = [16, 32];

/// Looks into a bin along each side: so many that lights' edges are known better than samples tell.
const FINE: usize = 40;

/// The same for ellipsoids, which are asked at points spread evenly over them: the density is
/// infinite at their rim, where the surface is seen edge-on.
const VERY_FINE: usize = 72;

const CAMERA: &str = "OrthographicCamera { center 0 0 9  direction 0 0 -1  up 0 1 0  size 1 }";
const LAMP: &str = "diffuseColor 0 0 0  emissiveColor 2 3 1";

/// A shining thing near the origin, seen from below.
struct Lamp {
    name: &'static str,
    objects: &'static str,
    /// A sphere around it.
    center: DVec3,
    radius: f64,
}

const LAMPS: [Lamp; 6] = [
    Lamp {
        name: "parallelogram",
        objects: "Triangle { vertex0 -1 0 -1 vertex1 1 0 -0.5 vertex2 1.5 0.5 1 }\n\
                  Triangle { vertex0 -1 0 -1 vertex1 1.5 0.5 1 vertex2 -0.5 0.5 0.5 }",
        center: DVec3::new(0.25, 0.25, 0.0),
        radius: 1.7,
    },
    Lamp {
        name: "triangle",
        objects: "Triangle { vertex0 -1 0 -1 vertex1 1 0 -0.5 vertex2 0.2 0.4 1.5 }",
        center: DVec3::new(0.0, 0.2, 0.1),
        radius: 1.65,
    },
    Lamp {
        name: "disc",
        objects: "Plane { normal 0.1 -1 0.2 offset 0 center 0 0 0 radius 1 }",
        center: DVec3::ZERO,
        radius: 1.05,
    },
    Lamp { name: "sphere", objects: "Sphere { center 0 0 0 radius 1 }", center: DVec3::ZERO, radius: 1.05 },
    Lamp {
        name: "ellipsoid",
        objects: "Transform { ZRotate 20 Scale 1 0.3 0.6 Sphere { center 0 0 0 radius 1 } }",
        center: DVec3::ZERO,
        radius: 1.05,
    },
    Lamp {
        name: "two triangles and a sphere",
        objects: "Triangle { vertex0 -1 0 -1 vertex1 -0.2 0 -0.5 vertex2 -0.8 0.4 0.5 }\n\
                  Triangle { vertex0 0.2 0 -1 vertex1 1 0.4 -0.5 vertex2 0.2 0.4 0.1 }\n\
                  Sphere { center 0.2 0.2 0.8 radius 0.3 }",
        center: DVec3::ZERO,
        radius: 1.5,
    },
];

impl Lamp {
    fn stage(&self) -> Stage {
        let text = scene(CAMERA, "0 0 0", &[], &[LAMP], self.objects);
        Stage::new(&text, &[], "-size 1 1")
    }
}

/// The directions around one, in bins.
struct Window {
    axes: [DVec3; 3],
    /// Cosine of the widest angle.
    least: f64,
}

impl Window {
    fn new(lamp: &Lamp, from: DVec3) -> Self {
        let way = lamp.center - from;
        let sine = lamp.radius / way.length();
        let axis = way.normalize();
        let (a, b) = axis.any_orthonormal_pair();
        Self { axes: [a, b, axis], least: (1.0 - sine * sine).sqrt() }
    }

    /// Solid angle of everything.
    fn solid_angle(&self) -> f64 {
        TAU * (1.0 - self.least)
    }

    /// The direction of a point of the unit square.
    fn direction(&self, [u, v]: [f64; 2]) -> DVec3 {
        let cosine = 1.0 - u * (1.0 - self.least);
        let (sine, (y, x)) = ((1.0 - cosine * cosine).sqrt(), (v * TAU).sin_cos());
        let [a, b, axis] = self.axes;
        (a * x + b * y) * sine + axis * cosine
    }

    fn bin(&self, direction: DVec3) -> usize {
        let [x, y, z] = self.axes.map(|axis| axis.dot(direction));
        let u = (1.0 - z) / (1.0 - self.least);
        let v = y.atan2(x).rem_euclid(TAU) / TAU;
        let [rows, columns] = BINS;
        let at = |x: f64, count: usize| ((x * count as f64) as usize).min(count - 1);
        assert!(u < 1.0, "a light is offered where none is: {direction}");
        at(u, rows) * columns + at(v, columns)
    }
}

/// Density of being offered, by what a ray in this direction meets.
fn density(stage: &Stage, list: &List, lights: &Lights, from: DVec3, normal: Vec3, direction: DVec3) -> f64 {
    let ray = Ray::new(from.as_vec3(), direction.as_vec3());
    let Some(hit) = list.nearest(&ray, Interval::FORWARD, &mut Counters::default()) else { return 0.0 };
    let surface = stage.studio.geometry.surface(&ray, &hit);
    if surface.geometric_normal.dot(direction) >= 0.0 {
        return 0.0;
    }
    f64::from(lights.pdf(from, normal, direction, f64::from(hit.t), &surface))
}

/// Places below the lamps, near and far, straight below and aside, and the side they look to.
const PLACES: [(DVec3, Vec3); 3] = [
    (DVec3::new(0.3, -2.0, 0.2), Vec3::Y),
    (DVec3::new(-4.0, -2.5, 3.0), Vec3::new(0.6, 0.8, 0.0)),
    (DVec3::new(3.0, -30.0, -5.0), Vec3::Y),
];

/// What lights offer follows its density.
pub fn offers(stress: &Stress) {
    stress.case("p13 offers of lights, χ²", || {
        let mut family = Family::default();
        let (mut draw, all) = (stress.draw(0xa817), sample_count(stress));
        for lamp in LAMPS {
            let stage = lamp.stage();
            let list = List::new(&stage.studio.geometry);
            for (from, normal) in PLACES {
                let window = Window::new(&lamp, from);
                let [rows, columns] = BINS;
                let mut due = vec![0.0; rows * columns + 1];
                let mut counts = vec![0u64; due.len()];
                let by_area = lamp.name == "ellipsoid";
                let (fine, samples) = if by_area { (VERY_FINE, all / 5) } else { (FINE, all) };
                // Ten times the samples tell of mistakes of the integral that a tenth does not.
                let fine = if stress.tier().is_thorough() { 3 * fine } else { fine };
                let share = window.solid_angle() / (rows * columns * fine * fine) as f64;
                stage.with_lights(|lights| {
                    for row in 0..rows * fine {
                        for column in 0..columns * fine {
                            // Anywhere in its part, so that edges do no harm in step.
                            let u = (row as f64 + draw.unit()) / (rows * fine) as f64;
                            let v = (column as f64 + draw.unit()) / (columns * fine) as f64;
                            let direction = window.direction([u, v]);
                            let density = density(&stage, &list, lights, from, normal, direction);
                            due[row / fine * columns + column / fine] += density * share;
                        }
                    }
                    for _ in 0..samples {
                        let offer = lights.offer(from, normal, [draw.unit(), draw.unit()]);
                        let place = offer.map_or(rows * columns, |offer| window.bin(offer.direction));
                        counts[place] += 1;
                    }
                });
                let sum: f64 = due.iter().sum();
                // Some lamps are asked at points of their back, too, which gives nothing.
                if !by_area {
                    assert!((sum - 1.0).abs() < 2e-3, "{} from {from}: density of {sum} in all", lamp.name);
                    assert!(counts[rows * columns] <= samples as u64 / 10_000, "{} from {from}", lamp.name);
                }
                // What is beside the window is beside the lamp: it has been asked for above, and what the
                // integral lacks of 1 there is its own mistake.
                let mut due: Vec<f64> = match by_area {
                    true => due.iter().map(|p| p * samples as f64).collect(),
                    false => due.iter().map(|p| p / sum * samples as f64).collect(),
                };
                due[rows * columns] = match by_area {
                    true => (1.0 - sum).max(0.0) * samples as f64,
                    false => counts[rows * columns] as f64,
                };
                family.test(format!("{} from {from}", lamp.name), &counts, &due);
            }
        }
        family.judge()
    });
}

/// Paths are weighed by the density of the offer.
pub fn weighed(stress: &Stress) {
    stress.case("p13 densities of offers and of paths", || {
        let mut draw = stress.draw(0xa818);
        let mut seen = 0;
        for lamp in LAMPS {
            let stage = lamp.stage();
            let list = List::new(&stage.studio.geometry);
            for (from, normal) in PLACES {
                stage.with_lights(|lights| {
                    for _ in 0..1000 {
                        let offer = lights.offer(from, normal, [draw.unit(), draw.unit()]);
                        let Some(offer) = offer else { continue };
                        let met = density(&stage, &list, lights, from, normal, offer.direction);
                        let ratio = met / f64::from(offer.pdf);
                        // A ray at the very edge may pass it, or meet another lamp in front.
                        let same = (ratio - 1.0).abs() < 1e-3 * (1.0 + from.length());
                        let light = offer.light / Vec3::new(2.0, 3.0, 1.0) * offer.pdf;
                        assert!((light - Vec3::ONE).abs().max_element() < 1e-4, "{}: {offer:?}", lamp.name);
                        seen += usize::from(same);
                    }
                });
            }
        }
        assert!(seen > 16_000, "only {seen} of 18,000 densities agree");
        Ok(0.0)
    });
}
