//! The ray tree: mirrors and glass (course rule §4.5; Whitted, "An Improved Illumination Model
//! for Shaded Display", CACM 1980).

use crate::Mixture;
use crate::shade::local;
use crate::texture::{Glass, Medium};
use crate::{Hit, Options, Range, Ray, World, fresnel_reflectance, mirror, refract};
use common::math::DVec3;

/// A ray of the tree that has still to be followed.
struct Branch {
    ray: Ray,
    range: Range,
    /// What its colour is multiplied with on the way to the eye.
    factor: DVec3,
    /// Product of the Euclidean lengths of the colours on that way, for the cut-off.
    weight: f64,
    depth: u32,
    /// What it travels in.
    medium: Medium,
}

/// The colour that comes back along a primary ray.
///
/// The tree is summed branch by branch from a list, not by recursion: by the distributive law
/// each surface contributes its local colour times the factors above it, and any number of
/// bounces fits into memory.
pub(crate) fn colour(world: &World, options: &Options, ray: Ray, range: Range) -> DVec3 {
    let (factor, medium) = (DVec3::ONE, Medium::default());
    let mut pending = vec![Branch { ray, range, factor, weight: 1.0, depth: 0, medium }];
    let mut sum = DVec3::ZERO;
    while let Some(branch) = pending.pop() {
        let Some(hit) = world.nearest(&branch.ray, branch.range) else {
            let left = branch.medium.transmittance(f64::INFINITY);
            sum += branch.factor * left * world.background;
            continue;
        };
        let factor = branch.factor * branch.medium.transmittance(hit.t);
        let mixture = world.mixture(&hit);
        sum += factor * local(world, options, &branch.ray, &hit, &mixture);
        if branch.depth < options.bounces {
            pending.extend(children(options, &Branch { factor, ..branch }, &hit, &mixture));
        }
    }
    sum
}

/// The mirrored ray of a hit and the refracted ones, those of them that are made. There is one
/// refracted ray for each index of refraction in the mixture.
fn children(options: &Options, parent: &Branch, hit: &Hit, mixture: &Mixture) -> Vec<Branch> {
    let incoming = parent.ray.direction;
    let entering = incoming.dot(hit.normal) <= 0.0;
    let glasses = mixture.glasses();
    let kr = mirror_colour(options, incoming, hit, mixture, &glasses);
    let mirrored =
        grow(options, parent, hit, kr, || Some((mirrored_direction(incoming, hit), parent.medium.clone())));
    let refracted = glasses.iter().filter_map(|glass| {
        let kt = (1.0 - reflectance(options, incoming, hit, glass)) * glass.transparent;
        grow(options, parent, hit, kt, || {
            let normal = glass_normal(incoming, hit, glass.index);
            let direction = refract(incoming, normal, glass.index)?;
            Some((direction, if entering { mixture.inside() } else { Medium::default() }))
        })
    });
    mirrored.into_iter().chain(refracted).collect()
}

/// The mirrored unit direction: about the shading normal, but about the flat triangle's own
/// where that would lead to the other side of it.
fn mirrored_direction(incoming: DVec3, hit: &Hit) -> DVec3 {
    let smooth = mirror(incoming, hit.shading_normal);
    let stays = smooth.dot(hit.normal) * incoming.dot(hit.normal) <= 0.0;
    if stays { smooth.normalize() } else { mirror(incoming, hit.normal).normalize() }
}

/// The normal that glass goes by: the shading normal, but the flat triangle's own where the
/// refracted ray would not come out on the other side of it.
fn glass_normal(incoming: DVec3, hit: &Hit, index: f64) -> DVec3 {
    let passes = |d: DVec3| d.dot(hit.normal) * incoming.dot(hit.normal) >= 0.0;
    let smooth = refract(incoming, hit.shading_normal, index);
    if smooth.is_none_or(passes) { hit.shading_normal } else { hit.normal }
}

/// Colour of the mirrored ray: the materials' own, but with `-fresnel` the transparent ones
/// reflect in white what they do not let through.
fn mirror_colour(
    options: &Options,
    incoming: DVec3,
    hit: &Hit,
    mixture: &Mixture,
    glasses: &[Glass],
) -> DVec3 {
    let own = mixture.sum(|surface| {
        let by_fresnel = options.fresnel && surface.is_transparent();
        if by_fresnel { DVec3::ZERO } else { surface.reflective }
    });
    let of_glass: f64 = glasses.iter().map(|g| g.share * reflectance(options, incoming, hit, g)).sum();
    own + of_glass
}

/// The fraction of light that glass turns back: none without `-fresnel`.
fn reflectance(options: &Options, incoming: DVec3, hit: &Hit, glass: &Glass) -> f64 {
    if !options.fresnel {
        return 0.0;
    }
    fresnel_reflectance(incoming, glass_normal(incoming, hit, glass.index), glass.index)
}

/// A child of `parent` with colour `k`, unless `k` is black, its weight is below the cut-off,
/// or `way` gives no direction (total internal reflection).
fn grow(
    options: &Options,
    parent: &Branch,
    hit: &Hit,
    k: DVec3,
    way: impl FnOnce() -> Option<(DVec3, Medium)>,
) -> Option<Branch> {
    let weight = parent.weight * k.length();
    if k == DVec3::ZERO || weight < options.weight {
        return None;
    }
    let (direction, medium) = way()?;
    Some(Branch {
        ray: hit.leave(direction),
        range: Range::FORWARD,
        factor: parent.factor * k,
        weight,
        depth: parent.depth + 1,
        medium,
    })
}
