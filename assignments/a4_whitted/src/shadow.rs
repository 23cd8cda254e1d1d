//! A4T1: shadow rays.

use crate::interior::{Interior, comes_through};
use crate::{Recorder, Whitted};
use a2_transforms::{Incident, Lamps, Source};
use common::cli::Skip;
use common::counters::Counters;
use common::geometry::{Departure, Hit, Surface};
use common::math::{Interval, Vec3};
use common::ray::Ray;
use common::scene::Scene;

/// The lamps as shadow rays look at them: what adds nothing is counted, and left out unless
/// switched off.
pub struct Asked<'a, 'w, L: Lamps> {
    /// Its rules.
    pub whitted: &'a Whitted<'w>,
    /// Where light comes from.
    pub lamps: &'a mut L,
    /// Where skips are counted.
    pub counters: &'a mut Counters,
    /// The closed body, if the surface is seen from inside one. If that is dark, no light is looked at.
    pub inside: Option<Interior>,
    /// Whether the body stands before the light that was looked at last.
    pub blocked: bool,
}

impl<L: Lamps> Lamps for Asked<'_, '_, L> {
    #[inline(always)]
    fn looks(&self, scene: &Scene) -> usize {
        if self.inside.is_some_and(|inside| inside.dark) { 0 } else { self.lamps.looks(scene) }
    }

    #[inline(always)]
    fn look(&mut self, scene: &Scene, index: usize, surface: &Surface) -> Incident {
        self.blocked = false;
        let Some(Interior { body, .. }) = self.inside else { return self.lamps.look(scene, index, surface) };
        let dark = |source| Incident { direction: Vec3::ZERO, color: Vec3::ZERO, source };
        if let Some(source) = self.lamps.source(scene, index) {
            self.blocked = comes_through(&source, surface, &body.bounds);
            return if self.blocked { dark(source) } else { self.lamps.look(scene, index, surface) };
        }
        let light = self.lamps.look(scene, index, surface);
        self.blocked = comes_through(&light.source, surface, &body.bounds);
        if self.blocked { dark(light.source) } else { light }
    }

    fn source(&self, scene: &Scene, index: usize) -> Option<Source> {
        self.lamps.source(scene, index)
    }

    fn skip(&mut self, why: Skip) -> bool {
        if self.blocked {
            self.counters.skipped_shadow_inside += 1;
            return true;
        }
        let rules = &self.whitted.rules;
        let (skips, counter) = match why {
            Skip::Dark => (rules.skip_dark, &mut self.counters.skipped_shadow_dark),
            _ => (rules.skip_behind, &mut self.counters.skipped_shadow_behind),
        };
        *counter += u64::from(skips && rules.shadows);
        skips || !rules.shadows
    }
}

/// A shadow ray's share of an owner's radiance if nothing blocks it.
struct Promise<I> {
    owner: u32,
    radiance: Vec3,
    parent: I,
}

/// The shadow rays of one look at one light, from many surface points.
struct Bunch<I> {
    rays: Vec<Ray>,
    promises: Vec<Promise<I>>,
    interval: Interval,
}

/// Shadow rays that wait to be sent, look by look.
pub struct ShadowRays<'a, 'w, I> {
    whitted: &'a Whitted<'w>,
    bunches: Vec<Bunch<I>>,
    /// Surface points that they are sent from, at most.
    points: usize,
}

impl<'a, 'w, I: Copy> ShadowRays<'a, 'w, I> {
    /// None yet, of so many surface points at most.
    pub fn new(whitted: &'a Whitted<'w>, points: usize) -> Self {
        Self { whitted, bunches: Vec::new(), points }
    }

    /// One more, from beside the surface to the light; a light at a point is at t = 1, so that what
    /// stands behind it casts no shadow. Without shadows it is as good as sent.
    #[expect(clippy::too_many_arguments, reason = "a ray, what it is for, and who made it")]
    #[inline(always)]
    pub fn add(
        &mut self,
        look: usize,
        light: &Incident,
        surface: &Surface,
        departure: &Departure,
        owner: u32,
        radiance: Vec3,
        parent: I,
    ) {
        let (ray, interval) = match light.source {
            Source::Direction(towards) => {
                let direction = towards.as_vec3();
                let start = departure.towards(direction.as_dvec3());
                (Ray::leaving(surface.primitive, start, direction), Interval::FORWARD)
            }
            Source::Point(position) => {
                let start = departure.towards(position - surface.point);
                let direction = (position - start.as_dvec3()).as_vec3();
                // A light on the surface itself may be on the other side of where the ray starts.
                let leaves = departure.towards(direction.as_dvec3()) == start;
                let home = if leaves { surface.primitive } else { Ray::ANYWHERE };
                (Ray::leaving(home, start, direction), Interval::up_to(1.0))
            }
        };
        while self.bunches.len() <= look {
            let (rays, promises) = (Vec::with_capacity(self.points), Vec::with_capacity(self.points));
            self.bunches.push(Bunch { rays, promises, interval });
        }
        let bunch = &mut self.bunches[look];
        bunch.interval = interval;
        bunch.rays.push(ray);
        bunch.promises.push(Promise { owner, radiance, parent });
    }

    /// Sends all and adds what is not blocked to the radiance of its owners.
    pub fn send<R: Recorder<Id = I>>(
        self,
        radiances: &mut [Vec3],
        counters: &mut Counters,
        recorder: &mut R,
    ) {
        let rules = &self.whitted.rules;
        for Bunch { rays, promises, interval } in self.bunches {
            let mut add = |i: usize, share: Vec3| {
                let promise: &Promise<I> = &promises[i];
                radiances[promise.owner as usize] += share * promise.radiance;
                if rules.shadows {
                    recorder.shadow(promise.parent, &rays[i], share);
                }
            };
            if !rules.shadows {
                (0..rays.len()).for_each(|i| add(i, Vec3::ONE));
                continue;
            }
            counters.shadow_rays += rays.len() as u64;
            if rules.transparent_shadows {
                for (i, ray) in rays.iter().enumerate() {
                    add(i, self.whitted.filtered(ray, interval, counters));
                }
                continue;
            }
            let mut blocked = vec![false; rays.len()];
            self.whitted.accel.any_many(&rays, interval, &mut blocked, counters);
            for (i, blocked) in blocked.into_iter().enumerate() {
                add(i, if blocked { Vec3::ZERO } else { Vec3::ONE });
            }
        }
    }
}

impl Whitted<'_> {
    /// The product of the transparent colours on the way; black at the first opaque surface.
    fn filtered(&self, ray: &Ray, mut interval: Interval, counters: &mut Counters) -> Vec3 {
        let mut share = Vec3::ONE;
        while let Some(hit) = self.accel.nearest(ray, interval, counters) {
            share *= self.transparency(ray, &hit, counters);
            if share == Vec3::ZERO {
                break;
            }
            interval.min = hit.t;
        }
        share
    }

    /// The transparent colour of what was hit. Only a texture needs the point.
    fn transparency(&self, ray: &Ray, hit: &Hit, counters: &mut Counters) -> Vec3 {
        let geometry = self.accel.geometry();
        match self.scene.plain(geometry.material(hit.primitive)) {
            Some(material) if self.rules.skip_surface => {
                counters.skipped_surface += 1;
                material.transparent
            }
            _ => {
                counters.surfaces += 1;
                self.scene.at(&geometry.surface(ray, hit)).blend(|m| m.transparent)
            }
        }
    }
}
