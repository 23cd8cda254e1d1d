//! A4T2, A4T3: the recursion of mirrored and refracted rays, without recursion.
//!
//! Rays are followed generation by generation, those of many camera rays together: all rays of a
//! generation are sent at once, then all shadow rays from what they hit, light by light. Structures
//! that follow several rays at a time like that. Radiance is linear, so a ray needs only its own
//! factor and the owner, the camera ray whose radiance it adds to.

use crate::generation::{Branch, Generation};
use crate::interior::Interior;
use crate::shadow::{Asked, ShadowRays};
use crate::{RayKind, Recorder, Whitted};
use a1_ray_casting::{Mixture, Sight};
use a2_transforms::Lamps;
use common::counters::Counters;
use common::geometry::{Hit, Surface};
use common::math::{DVec3, Interval, Vec3};
use common::ray::Ray;
use common::scene::PhongMaterial;
use common::simd::{self, Simd, dispatch};

/// An owner with more rays than this in one generation is finished alone, last rays first, so that
/// memory is needed for the depth of its tree and not for its width.
const WIDE: usize = 64;

/// Camera rays on the way to their radiance.
pub struct Wave<'a, 'w, R: Recorder, L: Lamps> {
    /// Scene, structure and rules.
    pub whitted: &'a Whitted<'w>,
    /// Where light comes from, by owner.
    pub lamps: &'a mut [L],
    /// Where rays and skips are counted.
    pub counters: &'a mut Counters,
    /// Who watches.
    pub recorder: &'a mut R,
    /// What has arrived, by owner.
    pub radiances: &'a mut [Vec3],
}

impl<R: Recorder, L: Lamps> Wave<'_, '_, R, L> {
    /// Follows camera rays and all that comes of them.
    pub fn run(&mut self, sights: &[Sight]) {
        let camera = |(owner, sight): (u32, &Sight)| Branch {
            ray: sight.ray,
            kind: RayKind::Camera,
            settled: false,
            depth: 0,
            weight: 1.0,
            throughput: Vec3::ONE,
            owner,
            parent: R::Id::default(),
        };
        let branches: Vec<_> = (0..).zip(sights).map(camera).collect();
        let hits: Vec<_> = sights.iter().map(|sight| sight.hit).collect();
        let mut next = self.follow(&branches, &hits);
        let mut alone = Vec::new();
        while !next.is_empty() {
            set_aside_wide(&mut next, sights.len(), &mut alone);
            next = self.send(&next);
        }
        for mut waiting in alone {
            while !waiting.is_empty() {
                let last = waiting.split_off(waiting.len().saturating_sub(WIDE));
                waiting.extend(self.send(&last));
            }
        }
    }

    /// Traces rays and follows them.
    fn send(&mut self, branches: &[Branch<R::Id>]) -> Vec<Branch<R::Id>> {
        let asked = branches.iter().filter(|branch| !branch.settled);
        let rays: Vec<Ray> = asked.map(|branch| branch.ray).collect();
        let mut hits = vec![None; rays.len()];
        self.counters.rays += rays.len() as u64;
        let accel = self.whitted.accel;
        accel.nearest_many(&rays, Interval::FORWARD, &mut hits, self.counters);
        self.follow(branches, &hits)
    }

    /// Adds what rays bring by themselves and by the lights; returns the rays that come of them.
    /// `hits` are those of the rays that were traced.
    fn follow(&mut self, branches: &[Branch<R::Id>], hits: &[Option<Hit>]) -> Vec<Branch<R::Id>> {
        dispatch!(simd::level(), s => s.vectorize(
            #[inline(always)]
            || self.shade(branches, hits),
        ))
    }

    /// The same with the instructions that are there. None of them fuses or reorders what is
    /// written here, so all give the same bits.
    #[inline(always)]
    fn shade(&mut self, branches: &[Branch<R::Id>], hits: &[Option<Hit>]) -> Vec<Branch<R::Id>> {
        let whitted = self.whitted;
        let geometry = whitted.accel.geometry();
        let most = branches.len();
        // Refracted rays join the mirrored ones.
        let mut next =
            Generation { mirrored: Vec::with_capacity(2 * most), refracted: Vec::with_capacity(most) };
        let mut shadows = ShadowRays::new(whitted, most);
        let mut seen = None;
        let mut hits = hits.iter();
        for branch in branches {
            if branch.settled {
                self.radiances[branch.owner as usize] += branch.throughput;
                continue;
            }
            let hit = hits.next().expect("there is one for each ray that was traced");
            let id = self.recorder.ray(branch.parent, branch.kind, &branch.ray, *hit, branch.weight);
            let radiance = &mut self.radiances[branch.owner as usize];
            let Some(hit) = hit else {
                *radiance += branch.throughput * whitted.scene.as_scene().background.color;
                continue;
            };
            self.counters.surfaces += 1;
            let surface = &geometry.surface(&branch.ray, hit);
            let mixture = whitted.scene.at(surface);
            let departure = surface.departure();
            let incoming = branch.ray.direction.as_dvec3();
            let throughput = branch.throughput * inside(&mixture, surface, incoming, hit.t);
            let at = Branch { throughput, parent: id, ..*branch };
            let lamps = &mut self.lamps[branch.owner as usize];
            if branch.depth < whitted.rules.bounces {
                let mut known = || {
                    let interior: Interior = whitted.interior(surface, lamps, &mut seen)?;
                    whitted.known_inside(surface, &interior)
                };
                next.add(whitted, &at, surface, &departure, &mixture, &mut known, self.counters);
            }
            let reflect = |m: &PhongMaterial, n, l, v| whitted.phong.reflect(m, n, l, v);
            let inside = match incoming.dot(surface.geometric_normal) > 0.0 {
                true => whitted.interior(surface, lamps, &mut seen),
                false => None,
            };
            // No light comes from outside to the inner side of a closed body, which is black anyway
            // without `shade_back`.
            if inside.is_some_and(|inside| inside.dark) && whitted.light.shade_back {
                self.counters.skipped_shadow_inside += lamps.looks(whitted.light.scene) as u64;
            }
            let mut asked = Asked { whitted, lamps, counters: self.counters, inside, blocked: false };
            let own = whitted.light.gather(
                surface,
                &mixture,
                branch.ray.direction,
                reflect,
                &mut asked,
                #[inline(always)]
                |look, light, reflected| {
                    shadows.add(look, light, surface, &departure, branch.owner, throughput * reflected, id)
                },
            );
            *radiance += throughput * own;
        }
        shadows.send(self.radiances, self.counters, self.recorder);
        next.mirrored.append(&mut next.refracted);
        next.mirrored
    }
}

/// Takes the rays of owners that have very many out of a generation; each owner's go together.
fn set_aside_wide<I: Copy>(next: &mut Vec<Branch<I>>, owners: usize, alone: &mut Vec<Vec<Branch<I>>>) {
    if next.len() <= WIDE {
        return;
    }
    let mut counts = vec![0usize; owners];
    next.iter().for_each(|branch| counts[branch.owner as usize] += 1);
    for owner in (0..owners).filter(|owner| counts[*owner] > WIDE) {
        alone.push(next.extract_if(.., |branch| branch.owner as usize == owner).collect());
    }
}

/// What Beer–Lambert absorption leaves of light that came through the body to this surface: a
/// ray that meets a transparent surface from behind has travelled inside. Of a mixture each part
/// leaves its own share.
fn inside(mixture: &Mixture, surface: &Surface, incoming: DVec3, t: f32) -> Vec3 {
    let leaves = incoming.dot(surface.geometric_normal) > 0.0;
    if !leaves {
        return Vec3::ONE;
    }
    mixture.blend(|m| match m.absorption == Vec3::ZERO {
        true => Vec3::ONE,
        false => (-m.absorption * t).exp(),
    })
}
