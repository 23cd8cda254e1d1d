//! Ways over balls, held against tracing them.

use super::*;

const RADIUS: f64 = 0.7;

fn ball(index: f64) -> Ball {
    Ball {
        primitive: 0,
        sphere: Sphere { center: DVec3::new(0.2, -0.1, 0.3), radius: RADIUS },
        mirror: Vec3::ZERO,
        glass: Vec3::ONE,
        index_of_refraction: index,
        absorption: Vec3::splat(0.1),
    }
}

/// Points all round, from almost touching to far away.
fn points() -> impl Iterator<Item = (DVec3, DVec3)> {
    let unit = |i: u32| f64::from(i.wrapping_mul(2_654_435_769)) / 4_294_967_296.0;
    let around = move |i: u32| {
        let (z, angle) = (2.0 * unit(i) - 1.0, unit(i + 7) * std::f64::consts::TAU);
        let distance = RADIUS * (1.05 + 4.0 * unit(i + 13).powi(2));
        let aside = (1.0 - z * z).sqrt();
        DVec3::new(0.2, -0.1, 0.3) + DVec3::new(aside * angle.cos(), aside * angle.sin(), z) * distance
    };
    (0..400).map(move |i| (around(3 * i + 1), around(5 * i + 2)))
}

/// Where a ray that meets the ball goes on, mirrored or through it: a point and a unit direction.
fn traced(ball: &Ball, from: DVec3, direction: DVec3, through: bool) -> Option<(DVec3, DVec3)> {
    let nearest = |from: DVec3, direction: DVec3, far: bool| {
        let to_center = ball.sphere.center - from;
        let along = to_center.dot(direction);
        let half = (ball.sphere.radius.powi(2) - (to_center - direction * along).length_squared()).max(-1.0);
        (half > 0.0).then(|| from + direction * if far { along + half.sqrt() } else { along - half.sqrt() })
    };
    let normal = |p: DVec3| (p - ball.sphere.center) / ball.sphere.radius;
    let entry = nearest(from, direction, false)?;
    if !through {
        let n = normal(entry);
        return Some((entry, direction - n * (2.0 * direction.dot(n))));
    }
    let inside = refract(direction, normal(entry), ball.index_of_refraction).refracted?;
    let exit = nearest(entry, inside, true)?;
    Some((exit, refract(inside, normal(exit), ball.index_of_refraction).refracted?))
}

/// How far a line passes from a point.
fn misses(point: DVec3, (from, direction): (DVec3, DVec3)) -> f64 {
    (point - from).cross(direction).length()
}

#[test]
fn a8t3_ways_lead_where_they_should() {
    let mut found = [0; 4];
    for index in [1.0, 1.33, 1.5, 2.4] {
        for (from, to) in points() {
            let ways: Vec<BallWay> = ball(index).ways(from, to, true).collect();
            for way in &ways {
                let ray = traced(&ball(index), from, way.direction, way.exit.is_some()).unwrap();
                assert!(misses(to, ray) < 1e-4, "{index} {from} {to}: {way:?}");
                assert!((ray.1 - way.arrival).length() < 1e-3, "{index} {from} {to}: {way:?}");
            }
            found[ways.iter().filter(|w| w.exit.is_some()).count()] += 1;
        }
    }
    assert!(found[0] > 100 && found[1] > 100, "{found:?}");
}

/// Before the point where a ball gathers light, it comes on three ways at once near the axis.
#[test]
fn a8t3_inside_a_caustic_light_comes_on_three_ways() {
    let ball = ball(1.5);
    let to = |aside: f64| ball.sphere.center + DVec3::new(aside, 0.0, -1.5 * RADIUS);
    let count = |aside: f64| {
        let from = ball.sphere.center + DVec3::new(0.0, 0.0, 4.0 * RADIUS);
        ball.ways(from, to(aside), true).filter(|way| way.exit.is_some()).count()
    };
    assert_eq!([count(0.01 * RADIUS), count(3.0 * RADIUS)], [3, 1]);
}

/// A fan of rays in the plane of both points and the centre: wherever it sweeps over the second
/// point there is a way, and nowhere else.
#[test]
fn a8t3_no_way_is_forgotten() {
    const FAN: i32 = 20_000;
    for index in [1.2, 1.5] {
        for (from, to) in points().step_by(5) {
            let ball = ball(index);
            let (a, b) = (from - ball.sphere.center, to - ball.sphere.center);
            let axis = a.normalize();
            let across = (b - axis * axis.dot(b)).normalize();
            for through in [false, true] {
                let side = |step: i32| {
                    let tilt = f64::from(step) / f64::from(FAN) * RADIUS / a.length();
                    let direction = across * tilt - axis * (1.0 - tilt * tilt).sqrt();
                    let (point, onward) = traced(&ball, from, direction, through)?;
                    let ahead = (to - point).dot(onward) > 0.0;
                    let turned = across * onward.dot(axis) - axis * onward.dot(across);
                    ahead.then(|| (to - point).dot(turned) > 0.0)
                };
                let crossings = (1 - FAN..FAN - 1)
                    .filter(|step| matches!((side(*step), side(step + 1)), (Some(a), Some(b)) if a != b))
                    .count();
                let ways = ball.ways(from, to, true).filter(|w| w.exit.is_some() == through).count();
                assert_eq!(ways, crossings, "{index} {from} {to} {through}");
            }
        }
    }
}

/// The solid angle that a small area at the far end fills, by moving the beginning's direction.
#[test]
fn a8t3_solid_angles_are_those_of_differences() {
    const STEP: f64 = 1e-6;
    let mut worst: f64 = 0.0;
    for (from, to) in points() {
        let ball = ball(1.5);
        for way in ball.ways(from, to, true) {
            let through = way.exit.is_some();
            let (a, b) = way.direction.any_orthonormal_pair();
            let lands = |direction: DVec3| {
                let (point, onward) = traced(&ball, from, direction.normalize(), through)?;
                // On the plane through the point, across the way.
                Some(point + onward * ((to - point).dot(way.arrival) / onward.dot(way.arrival)))
            };
            let corners = [a, -a, b, -b].map(|side| lands(way.direction + side * STEP));
            let [Some(right), Some(left), Some(up), Some(down)] = corners else { continue };
            let area = (right - left).cross(up - down).length() / (4.0 * STEP * STEP);
            let told = ball.per_area(from, way.direction, to, through).unwrap();
            assert!((told / way.per_area - 1.0).abs() < 1e-3, "{told} {way:?}");
            // Where rays cross (a caustic) the area is about none, at the rim of the ball it grows
            // so fast that differences tell little.
            if (0.1..300.0).contains(&area) {
                worst = worst.max((way.per_area * area - 1.0).abs());
            }
        }
    }
    assert!(worst < 1e-3, "{worst}");
}
