//! Lights asked over balls of mirror and glass.
//!
//! What a matt surface asks for here, a path must not count a second time: a [`Chain`] remembers
//! whether it came by such a way.

use super::surface::Place;
use super::{Began, Path, PathTracer, Scratch};
use crate::Integrator;
use crate::bsdf::Bsdf;
use crate::light::{Ball, BallWay, Target};
use crate::numbers::{Choice, Use};
use common::geometry::{Hit, Surface};
use common::math::{DVec3, Vec3};
use common::ray::Ray;

/// Share of the light that was asked directly below which a way is followed at random only.
const LITTLE: f32 = 0.4;

/// How likely a surface asks over a ball: in proportion to the part of the sky that it fills, so
/// that many small balls cost no more than a few large ones.
fn chance_to_ask(ball: &Ball, from: DVec3) -> f64 {
    (1.5 * ball.radius().powi(2) / (ball.center() - from).length_squared()).min(1.0)
}

/// How far a path is on a way that would have been asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Chain {
    /// It is on none.
    None,
    /// It has left the surface that asked.
    Begun,
    /// It is inside this ball.
    Inside(u32),
    /// It has left a ball.
    Over {
        /// Which.
        ball: u32,
        /// Whether it went through or was mirrored.
        through: bool,
    },
}

impl PathTracer<'_> {
    /// Whether a surface asks over balls.
    pub(super) fn asks_over_balls(&self, bsdf: &Bsdf, generation: u32) -> bool {
        !self.balls.is_empty()
            && self.rules.integrator != Integrator::Naive
            && bsdf.is_matt()
            && self.rules.bounces.is_none_or(|most| generation < most)
    }

    /// Whether a path that is refracted in and out may still meet a light.
    fn goes_through(&self, generation: u32) -> bool {
        self.rules.bounces.is_none_or(|most| generation + 2 <= most)
    }

    /// How far a path is on such a way when it goes on from a surface, as `way` says along a mirror
    /// or through glass.
    pub(super) fn next_link(
        &self,
        path: &Path,
        place: &Place,
        bsdf: &Bsdf,
        specular: bool,
        same_side: bool,
        generation: u32,
    ) -> Chain {
        if !specular {
            return if self.asks_over_balls(bsdf, generation) { Chain::Begun } else { Chain::None };
        }
        if path.chain == Chain::None {
            return Chain::None;
        }
        let primitive = place.surface.primitive;
        let Some(ball) = self.balls.iter().position(|b| b.primitive == primitive) else { return Chain::None };
        let ball = ball as u32;
        match path.chain {
            // From inside nobody asks over the ball.
            Chain::Begun if place.inside => Chain::None,
            Chain::Begun if same_side => Chain::Over { ball, through: false },
            Chain::Begun if self.goes_through(generation.saturating_sub(1)) => Chain::Inside(ball),
            Chain::Inside(of) if of == ball && !same_side => Chain::Over { ball, through: true },
            _ => Chain::None,
        }
    }

    /// Density with which the surface where a path began would have asked for what the path has met
    /// over a ball, per steradian there.
    pub(super) fn density_over_ball(
        &self,
        (from, direction, _): Began,
        ball: u32,
        through: bool,
        arrival: DVec3,
        met: &Surface,
    ) -> f32 {
        let ball = &self.balls[ball as usize];
        let Some(area) = self.lights.area_per_chance(ball.center(), met.primitive) else { return 0.0 };
        let per_area = ball.per_area(from, direction.as_dvec3(), met.point, through);
        let upright = -met.geometric_normal.dot(arrival);
        let chance = chance_to_ask(ball, from);
        per_area.map_or(0.0, |per_area| (chance / (area * per_area * upright)) as f32)
    }

    /// Asks lights over some of the balls, and sends shadow rays along one of the ways found.
    /// `direct` is about what the light that was asked directly sends.
    pub(super) fn ask_over_balls(
        &self,
        scratch: &mut Scratch,
        place: &Place,
        path: &Path,
        bsdf: &Bsdf,
        generation: u32,
        direct: f32,
    ) {
        if !self.asks_over_balls(bsdf, generation) {
            return;
        }
        let (point, through) = (place.surface.point, self.goes_through(generation));
        // Some of it is above the horizon.
        let rises = |ball: &Ball| {
            place.surface.geometric_normal.dot(ball.center() - point).abs() <= ball.radius()
                || place.geometric.as_dvec3().dot(ball.center() - point) > 0.0
        };
        let (mut total, mut chosen) = (0.0, None);
        for (index, ball) in (0..).zip(&self.balls) {
            let [asks, takes] = path.stream.beside(generation, Choice::Ball(index));
            let chance = chance_to_ask(ball, point);
            if asks >= chance || !rises(ball) {
                continue;
            }
            let uv = self.numbers.pair(&path.stream, &scratch.rows, Use::Caustic(generation));
            let Some(target) = self.lights.target(ball.center(), uv) else { continue };
            let mut takes = takes as f32;
            for way in ball.ways(point, target.surface.point, through) {
                let light = self.light_over(place, path, bsdf, &way, &target, chance);
                let worth = light.element_sum();
                if worth.is_nan() || worth <= 0.0 {
                    continue;
                }
                total += worth;
                // Each way takes over with its share of the sum so far.
                let share = worth / total;
                if takes < share {
                    takes /= share;
                    chosen = Some((ball, way, target, light / worth));
                } else {
                    takes = (takes - share) / (1.0 - share);
                }
            }
        }
        let Some((ball, way, target, color)) = chosen else { return };
        // Most ways bring so little that few need be followed.
        let follows = (total / (LITTLE * direct)).min(1.0);
        if direct == 0.0 || path.stream.beside(generation, Choice::Followed)[0] < f64::from(follows) {
            let light = color * if direct == 0.0 { total } else { total / follows };
            self.follow(scratch, place, path.slot, (ball, &way, &target), light);
        }
    }

    /// What a way brings, if nothing is in between, weighed against paths that find it by chance.
    fn light_over(
        &self,
        place: &Place,
        path: &Path,
        bsdf: &Bsdf,
        way: &BallWay,
        target: &Target,
        chance: f64,
    ) -> Vec3 {
        let upright = -target.surface.geometric_normal.dot(way.arrival);
        let into = way.direction.as_vec3();
        if upright <= 0.0 || place.geometric.dot(into) <= 0.0 {
            return Vec3::ZERO;
        }
        let value = bsdf.value(place.out, into, place.normal);
        let density = (chance / (way.per_area * upright * target.area_per_chance)) as f32;
        let weight = self.asked_for(density, value.pdf) / density;
        path.throughput * value.response * target.radiance * way.share * weight
    }

    /// The shadow rays of a way.
    fn follow(
        &self,
        scratch: &mut Scratch,
        place: &Place,
        slot: u32,
        (ball, way, target): (&Ball, &BallWay, &Target),
        light: Vec3,
    ) {
        let start = place.departure.towards(way.direction);
        let on_ball = |point: DVec3, direction: DVec3| -> Surface {
            let ray = Ray::new(point.as_vec3(), direction.as_vec3());
            self.studio.geometry.surface(&ray, &Hit { t: 0.0, primitive: ball.primitive, u: 0.0, v: 0.0 })
        };
        let entry = on_ball(way.entry, way.direction);
        let outside = |surface: &Surface| surface.leave(surface.geometric_normal);
        let inside = |surface: &Surface| surface.leave(-surface.geometric_normal);
        let end = target.surface.leave(-way.arrival);
        let leg = |from: Vec3, to: Vec3| Ray::new(from, to - from);
        let first = leg(start, outside(&entry));
        match way.exit {
            None => scratch.near.push_way(&[first, leg(outside(&entry), end)], slot, light),
            Some(exit) => {
                let exit = on_ball(exit, way.arrival);
                let middle = leg(inside(&entry), inside(&exit));
                scratch.near.push_way(&[first, middle, leg(outside(&exit), end)], slot, light);
            }
        }
    }
}
