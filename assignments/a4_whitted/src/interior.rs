//! What is known of the inside of closed bodies, where shadow rays come from no light outside.

use crate::Whitted;
use a1_ray_casting::Mixture;
use a2_transforms::{Lamps, Source};
use common::geometry::{Body, Surface};
use common::math::{Bounds, Vec3};
use common::scene::Scene;

/// The inside of a closed convex body.
#[derive(Clone, Copy)]
pub struct Interior {
    /// Where it is, and what bounds it.
    pub body: Body,
    /// Whether all light comes from outside.
    pub dark: bool,
}

/// Whether a point is outside a box.
fn is_outside(p: Vec3, body: &Bounds) -> bool {
    p.cmplt(body.min).any() || p.cmpgt(body.max).any()
}

/// Whether all lights are known to be outside the box of a body.
fn all_outside(lamps: &impl Lamps, scene: &Scene, body: &Bounds) -> bool {
    (0..lamps.looks(scene)).all(|index| match lamps.source(scene, index) {
        Some(Source::Direction(_)) => true,
        Some(Source::Point(position)) => is_outside(position.as_vec3(), body),
        None => false,
    })
}

/// Whether light comes to the inner side of a body's surface from outside its box.
pub fn comes_through(source: &Source, surface: &Surface, body: &Bounds) -> bool {
    let towards = match *source {
        Source::Direction(towards) => towards.as_vec3().as_dvec3(),
        Source::Point(position) if is_outside(position.as_vec3(), body) => position - surface.point,
        Source::Point(_) => return false,
    };
    surface.geometric_normal.dot(towards) < 0.0
}

impl Whitted<'_> {
    /// The inside of the body that a surface bounds, if it does and that matters. Rays of a wave
    /// are mostly in the same one: `seen` is what was found last.
    #[inline(always)]
    pub(crate) fn interior(
        &self,
        surface: &Surface,
        lamps: &impl Lamps,
        seen: &mut Option<Interior>,
    ) -> Option<Interior> {
        if let Some(seen) = seen.filter(|seen| seen.body.is_bounded_by(surface.primitive)) {
            return Some(seen);
        }
        let rules = &self.rules;
        if !rules.skip_inside || !rules.shadows || rules.transparent_shadows {
            return None;
        }
        let body = self.accel.geometry().convex_body(surface.primitive)?;
        let dark = all_outside(lamps, self.light.scene, &body.bounds);
        *seen = Some(Interior { body, dark });
        *seen
    }

    /// What a ray of the last generation brings that sets out from a surface into the body that
    /// this bounds, if that can be told without tracing it: it meets the body's inner side, and
    /// nothing of that depends on where.
    #[inline(always)]
    pub(crate) fn known_inside(&self, surface: &Surface, interior: &Interior) -> Option<Vec3> {
        if !self.rules.skip_known || !interior.dark || !self.accel.geometry().is_hollow(surface.primitive) {
            return None;
        }
        let material = self.scene.plain(surface.material)?;
        let same_at_any_distance = material.absorption == Vec3::ZERO;
        same_at_any_distance.then(|| match self.light.shade_back {
            true => self.light.own(&Mixture::Plain(material)),
            false => Vec3::ZERO,
        })
    }
}
