//! What a picture makes of a pixel's nearest hit.

use crate::World;
use common::counters::Counters;
use common::geometry::{Geometry, Hit, Surface};
use common::math::Vec3;
use common::picture::Film;
use common::ray::Ray;
use std::cell::OnceCell;

/// One camera ray and what it met. The surface point is worked out when first asked for, and
/// only then: a depth picture never needs it.
pub struct Sight<'a> {
    /// The camera ray, of unit direction.
    pub ray: Ray,
    /// The nearest hit; `None` also when no layer needs one.
    pub hit: Option<Hit>,
    /// [`Counters::work`] of this thread before the ray was traced: what has been added since
    /// was done for this pixel.
    pub work_before: u64,
    geometry: &'a Geometry,
    surface: OnceCell<Surface>,
}

impl<'a> Sight<'a> {
    /// A sight whose surface is not yet worked out.
    #[inline]
    pub fn new(geometry: &'a Geometry, ray: Ray, hit: Option<Hit>) -> Self {
        Self { ray, hit, work_before: 0, geometry, surface: OnceCell::new() }
    }

    /// Works out the surfaces of all, whether anyone will ask for them or not.
    pub fn work_out(sights: &[Self]) {
        for sight in sights {
            sight.surface();
        }
    }

    /// Counts hits whose surface was worked out and, unless a layer works them out by itself,
    /// those whose was not.
    pub fn count(sights: &[Self], by_itself: bool, counters: &mut Counters) {
        for sight in sights.iter().filter(|sight| sight.hit.is_some()) {
            let asked = sight.surface.get().is_some();
            counters.surfaces += u64::from(asked);
            counters.skipped_surface += u64::from(!asked && !by_itself);
        }
    }

    /// The surface point of the hit.
    pub fn surface(&self) -> Option<&Surface> {
        let hit = self.hit.as_ref()?;
        Some(self.surface.get_or_init(|| self.geometry.surface(&self.ray, hit)))
    }
}

/// A picture as a function of what each pixel's ray met.
pub trait Layer: Sync {
    /// Linear RGB of one camera ray.
    fn value(&self, sight: &Sight, counters: &mut Counters) -> Vec3;

    /// The same of many camera rays, to the last bit; a layer that sends rays of its own may be
    /// faster with many at a time.
    fn values(&self, sights: &[Sight], counters: &mut Counters, out: &mut [Vec3]) {
        for (sight, out) in sights.iter().zip(out) {
            *out = self.value(sight, counters);
        }
    }

    /// Whether it looks at the nearest hit at all; if no layer does, none is searched for.
    fn needs_hit(&self) -> bool {
        true
    }

    /// Whether it works out the surface of every hit by itself instead of asking the sight for it,
    /// and counts that.
    fn works_out_surfaces(&self) -> bool {
        false
    }

    /// Whether it looks at [`Sight::work_before`], so that every camera ray must be traced alone.
    fn watches_work(&self) -> bool {
        false
    }

    /// Called once with the whole picture, before it is written: a layer whose colours depend on
    /// all pixels sets them here. Returns what one must know to read the picture.
    fn develop(&self, _: &mut Film) -> Option<String> {
        None
    }
}

/// A1T2: the diffuse colour of what was hit, unlit.
pub struct FlatColor<'a> {
    scene: &'a dyn World,
}

impl<'a> FlatColor<'a> {
    /// The colours of this scene.
    pub fn new(scene: &'a dyn World) -> Self {
        Self { scene }
    }
}

impl Layer for FlatColor<'_> {
    fn value(&self, sight: &Sight, _: &mut Counters) -> Vec3 {
        let plain = sight.hit.and_then(|hit| self.scene.plain(sight.geometry.material(hit.primitive)));
        if let Some(material) = plain {
            return material.diffuse;
        }
        let Some(surface) = sight.surface() else { return self.scene.as_scene().background.color };
        self.scene.at(surface).blend(|m| m.diffuse)
    }
}

/// A1T3: distance as grey, near white and far black; what is missed is black.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Depth {
    /// The distance that is white.
    pub min: f32,
    /// The distance that is black.
    pub max: f32,
}

impl Layer for Depth {
    fn value(&self, sight: &Sight, _: &mut Counters) -> Vec3 {
        let grey = |t: f32| ((self.max - t) / (self.max - self.min)).clamp(0.0, 1.0);
        sight.hit.map_or(Vec3::ZERO, |hit| Vec3::splat(grey(hit.t)))
    }
}
