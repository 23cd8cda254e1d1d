//! A4T2, A4T3: where light goes at a surface that may be mixed of several materials and may be
//! shaded smoother than it is.

use crate::{Crossing, mirror, refract};
use a1_ray_casting::{Mixture, Part};
use common::geometry::Surface;
use common::math::{DVec3, Vec3};
use common::scene::PhongMaterial;

/// All that is transparent with one index of refraction: it takes one refracted ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pane {
    /// The index.
    pub index_of_refraction: f32,
    /// Weighted sum of the transparent colours.
    pub color: Vec3,
    /// Sum of the weights of what is transparent, in [0, 1].
    pub share: f32,
}

/// The transparent materials of a mixture, one pane for each index of refraction, in the order
/// in which the indices first come up. With `black` opaque materials are panes too, of no share.
#[inline]
pub fn panes(mixture: &Mixture, black: bool) -> impl Iterator<Item = Pane> {
    let (mut one, several) = match mixture {
        Mixture::Plain(material) => (pane(material, black), &[][..]),
        Mixture::Blend(parts) => (None, &parts[..]),
    };
    let mut blended = blended_panes(several, black);
    // Most surfaces are not mixed; then what goes through mixtures is not even set up.
    std::iter::from_fn(move || one.take().or_else(|| if several.is_empty() { None } else { blended.next() }))
}

/// What most surfaces are: nothing mixed, mostly opaque.
fn pane(material: &PhongMaterial, black: bool) -> Option<Pane> {
    let (color, transparent) = (material.transparent, material.transparent != Vec3::ZERO);
    let share = f32::from(u8::from(transparent));
    let index_of_refraction = material.index_of_refraction;
    (transparent || black).then_some(Pane { index_of_refraction, color, share })
}

fn blended_panes(parts: &[Part], black: bool) -> impl Iterator<Item = Pane> {
    let parts = parts.iter().map(|part| (part.weight, &*part.material));
    let clear = move || parts.clone().filter(move |(_, m)| black || m.transparent != Vec3::ZERO);
    let earlier = clear.clone();
    let first = move |(i, index): &(usize, f32)| {
        earlier().take(*i).all(|(_, other)| other.index_of_refraction != *index)
    };
    let indices = clear().map(|(_, m)| m.index_of_refraction).enumerate().filter(first);
    indices.map(move |(_, index)| {
        let same = clear().filter(|(_, m)| m.index_of_refraction == index);
        let glass = same.clone().filter(|(_, m)| m.transparent != Vec3::ZERO);
        Pane {
            index_of_refraction: index,
            color: same.map(|(weight, m)| m.transparent * weight).sum(),
            share: glass.map(|(weight, _)| weight).sum(),
        }
    })
}

/// What the opaque materials of a mixture mirror. With Fresnel's equations the transparent ones
/// mirror what these say, and not their reflective colour.
pub fn opaque_mirror(mixture: &Mixture) -> Vec3 {
    let opaque = mixture.parts().filter(|(_, m)| m.transparent == Vec3::ZERO);
    opaque.map(|(weight, m)| m.reflective * weight).sum()
}

/// The mirrored direction, about the smooth normal if there is one. Where that would point to
/// the other side of the surface, as it may at grazing incidence, it is taken about the
/// geometric normal: a mirror never lets light through, and has no black specks.
#[inline]
pub fn mirrored_direction(incoming: DVec3, surface: &Surface) -> DVec3 {
    let flat = || mirror(incoming, surface.geometric_normal);
    if !surface.is_smooth() {
        return flat();
    }
    let direction = mirror(incoming, surface.shading_normal());
    let turned_back = direction.dot(surface.geometric_normal) * side(incoming, surface) < 0.0;
    if turned_back { direction } else { flat() }
}

/// Refraction at the smooth normal if there is one; at the geometric normal where the refracted
/// ray would not get through the surface, so that inside and outside stay what they are.
#[inline(always)]
pub fn crossing(incoming: DVec3, surface: &Surface, index_of_refraction: f32) -> Crossing {
    let index = f64::from(index_of_refraction);
    let flat = || refract(incoming, surface.geometric_normal, index);
    if !surface.is_smooth() {
        return flat();
    }
    let crossing = refract(incoming, surface.shading_normal(), index);
    let through = |d: DVec3| d.dot(surface.geometric_normal) * side(incoming, surface) > 0.0;
    if crossing.refracted.is_none_or(through) { crossing } else { flat() }
}

/// Below zero for a ray that comes from outside.
fn side(incoming: DVec3, surface: &Surface) -> f64 {
    incoming.dot(surface.geometric_normal)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::borrow::Cow;

    fn glass(weight: f32, level: f32, index_of_refraction: f32) -> Part<'static> {
        let transparent = Vec3::splat(level);
        let reflective = Vec3::splat(1.0 - level);
        let material =
            PhongMaterial { transparent, reflective, index_of_refraction, ..PhongMaterial::default() };
        Part { weight, material: Cow::Owned(material) }
    }

    #[test]
    fn one_pane_for_each_index_of_refraction() {
        let parts =
            [glass(0.25, 1.0, 1.5), glass(0.25, 0.0, 1.1), glass(0.25, 0.5, 2.0), glass(0.25, 0.5, 1.5)];
        let mixture = Mixture::Blend(parts.to_vec());
        let pane = |index_of_refraction, level, share| Pane {
            index_of_refraction,
            color: Vec3::splat(level),
            share,
        };
        let clear = [pane(1.5, 0.375, 0.5), pane(2.0, 0.125, 0.25)];
        assert_eq!(panes(&mixture, false).collect::<Vec<_>>(), clear);
        let all = [clear[0], pane(1.1, 0.0, 0.0), clear[1]];
        assert_eq!(panes(&mixture, true).collect::<Vec<_>>(), all);
        assert_eq!(opaque_mirror(&mixture), Vec3::splat(0.25));
    }

    #[test]
    fn a_plain_material_is_one_pane_of_its_own_color() {
        let part = glass(1.0, 0.3, 1.3);
        let mixture = Mixture::Plain(&part.material);
        let all: Vec<Pane> = panes(&mixture, false).collect();
        assert_eq!(all, [Pane { index_of_refraction: 1.3, color: part.material.transparent, share: 1.0 }]);
    }

    fn leaning(normal: DVec3) -> Surface {
        Surface {
            point: DVec3::ZERO,
            error: DVec3::ZERO,
            normal: normal.normalize().as_vec3(),
            geometric_normal: DVec3::Y,
            material: 0,
            primitive: 0,
            weights: [0.0; 2],
        }
    }

    /// Rays over a floor whose smooth normal leans by up to 80°, from both sides.
    #[test]
    fn a_leaning_normal_sends_no_light_through_a_mirror_and_all_through_glass() {
        for (lean, from) in (-16..=16).flat_map(|i| (-17..=17).map(move |j| (i * 5, j * 5))) {
            let tilted = |degrees: i32| {
                let (s, c) = f64::from(degrees).to_radians().sin_cos();
                DVec3::new(s, c, 0.0)
            };
            for (incoming, outside) in [(-tilted(from), true), (tilted(from), false)] {
                let surface = leaning(common::geometry::facing(tilted(lean), incoming, !outside));
                let off = mirrored_direction(incoming, &surface).y;
                assert_eq!(off > 0.0, outside, "mirror {lean} {from} {outside}");
                let refracted = crossing(incoming, &surface, 1.5).refracted;
                let through = refracted.is_none_or(|d| (d.y < 0.0) == outside);
                assert!(through, "glass {lean} {from} {outside}");
            }
        }
    }
}
