//! The plane that a way over a ball stays in.
//!
//! Let p and y be at distances P and Y from the centre of a ball of radius r, ψ the angle between
//! them as seen from there, and θ the angle of incidence. The angle that the way sweeps is
//!
//! * mirrored: 2θ − asin(r sin θ / P) − asin(r sin θ / Y), which grows with θ;
//! * refracted: π + 2θ − 2 asin(sin θ / n) − asin(r sin θ / P) − asin(r sin θ / Y), which is convex
//!   in θ for n ≥ 1: its derivative is 2 less terms of the form cos θ / √(m² − sin² θ), m ≥ 1,
//!   which shrink.
//!
//! It has to be ψ, or for refracted ways on the far side of the ball 2π − ψ.

use super::root::{root, turn};
use super::{Ball, BallWay};
use common::math::{DVec3, Vec3};
use common::shape::sphere::Sphere;
use std::f64::consts::{FRAC_PI_2, PI};

/// Two points and a ball, in the plane of all three.
pub struct Plane<'b> {
    ball: &'b Ball,
    /// Unit vectors from the centre to the first point, and across towards the second.
    axes: [DVec3; 2],
    /// The two points' distances from the centre.
    distances: [f64; 2],
    /// Distance of the second point from the line through the first and the centre.
    aside: f64,
    /// The second point.
    to: DVec3,
}

impl<'b> Plane<'b> {
    /// `None` where one of the points is not outside, or all are in line.
    pub fn new(ball: &'b Ball, from: DVec3, to: DVec3) -> Option<Self> {
        let (a, b) = (from - ball.sphere.center, to - ball.sphere.center);
        let distances = [a.length(), b.length()];
        let axis = a / distances[0];
        let across = b - axis * axis.dot(b);
        let aside = across.length();
        let outside = distances.iter().all(|d| *d > ball.sphere.radius * (1.0 + 1e-9));
        (outside && aside > distances[1] * 1e-9).then(|| Self {
            ball,
            axes: [axis, across / aside],
            distances,
            aside,
            to,
        })
    }

    /// The angle between the two points.
    fn angle(&self) -> f64 {
        self.aside.atan2(self.axes[0].dot(self.to - self.ball.sphere.center))
    }

    /// Σ asin(r sin θ / distance) over both points, and its derivative.
    fn outer(&self, sine: f64, cosine: f64) -> (f64, f64) {
        let one = |distance: f64| {
            let s = sine * self.ball.sphere.radius / distance;
            (s.asin(), cosine * self.ball.sphere.radius / (distance * (1.0 - s * s).sqrt()))
        };
        let (a, b) = (one(self.distances[0]), one(self.distances[1]));
        (a.0 + b.0, a.1 + b.1)
    }

    /// The angle swept by a mirrored way, and its derivative.
    pub fn swept_mirrored(&self, angle: f64) -> (f64, f64) {
        let (sine, cosine) = angle.sin_cos();
        let outer = self.outer(sine, cosine);
        (2.0 * angle - outer.0, 2.0 - outer.1)
    }

    /// The angle swept by a refracted way less π, and its derivative.
    pub fn swept_refracted(&self, angle: f64) -> (f64, f64) {
        let (sine, cosine) = angle.sin_cos();
        let (outer, index) = (self.outer(sine, cosine), self.ball.index_of_refraction);
        let inner = (sine / index).asin();
        let inner_slope = cosine / (index * index - sine * sine).sqrt().max(1e-300);
        (2.0 * (angle - inner) - outer.0, 2.0 * (1.0 - inner_slope) - outer.1)
    }

    /// The way by reflection.
    pub fn mirrored(&self) -> Option<BallWay> {
        let swept = |angle: f64| self.swept_mirrored(angle);
        let angle = root(swept, self.angle(), 0.0, FRAC_PI_2)?;
        self.way(angle, 1.0, swept(angle).1, false)
    }

    /// The ways through the ball: on its far side, then the two on the near side before and after
    /// the least angle that they sweep.
    pub fn refracted(&self) -> [Option<BallWay>; 3] {
        let swept = |angle: f64| self.swept_refracted(angle);
        let missing = PI - self.angle();
        let way = |angle: f64, side: f64| self.way(angle, side, swept(angle).1, true);
        let far = root(swept, missing, 0.0, FRAC_PI_2).and_then(|angle| way(angle, -1.0));
        // A convex function from 0 on falls by less than its first slope times the way there.
        if -swept(0.0).1 * FRAC_PI_2 <= missing {
            return [far, None, None];
        }
        let lowest = turn(|angle| swept(angle).1);
        let dip = |angle: f64| {
            let (value, slope) = swept(angle);
            (-value, -slope)
        };
        let near = root(dip, missing, 0.0, lowest);
        let after = root(swept, -missing, lowest, FRAC_PI_2);
        [far, near.and_then(|angle| way(angle, 1.0)), after.and_then(|angle| way(angle, 1.0))]
    }

    /// See [`BallWay::per_area`]: a step dφ around the axis and one db of the distance between centre
    /// and ray make the solid angle sin α dα dφ here and the area aside·dφ·Y′·|dΨ/db| db there,
    /// where sin α = b / P, and P′, Y′ are the legs √(P² − b²), √(Y² − b²).
    pub fn per_area(&self, incidence: f64, slope: f64) -> f64 {
        let radius = self.ball.sphere.radius;
        let (sine, cosine) = incidence.sin_cos();
        let [first, second] = self.distances;
        let off = radius * sine;
        let legs = ((first * first - off * off) * (second * second - off * off)).sqrt();
        off * radius * cosine / (first * self.aside * legs * slope.abs())
    }

    /// The way of an angle of incidence, on the side of the second point (1) or the other (−1).
    /// `slope` is the derivative of the angle that it sweeps.
    fn way(&self, incidence: f64, side: f64, slope: f64, through: bool) -> Option<BallWay> {
        let Self { ball, axes: [axis, across], distances: [first, _], to, .. } = *self;
        let Sphere { center, radius } = ball.sphere;
        let sine = incidence.sin();
        // Distance of the rays outside from the centre.
        let off = radius * sine;
        let at = |angle: f64| center + (axis * angle.cos() + across * (side * angle.sin())) * radius;
        let tilt = off / first;
        let entry_angle = incidence - tilt.asin();
        let inner = (sine / ball.index_of_refraction).min(1.0).asin();
        let entry = at(entry_angle);
        let exit = through.then(|| at(entry_angle + PI - 2.0 * inner));
        let direction = across * (side * tilt) - axis * (1.0 - tilt * tilt).max(0.0).sqrt();
        let share = ball.share(direction, (entry - center) / radius, through, inner);
        let per_area = self.per_area(incidence, slope);
        let arrival = (to - exit.unwrap_or(entry)).normalize_or_zero();
        (per_area.is_finite() && share != Vec3::ZERO).then_some(BallWay {
            direction,
            entry,
            exit,
            arrival,
            share,
            per_area,
        })
    }
}
