//! The ray tree: mirrors and glass (course rule §4.5; Whitted, "An Improved Illumination Model
//! for Shaded Display", CACM 1980).

use crate::optics::transmittance;
use crate::shade::local;
use crate::{Hit, Options, Range, Ray, Surface, World, fresnel_reflectance, mirror, refract};
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
    /// Absorption of the object that it travels in; zero outside.
    absorption: DVec3,
}

/// The colour that comes back along a primary ray.
///
/// The tree is summed branch by branch from a list, not by recursion: by the distributive law
/// each surface contributes its local colour times the factors above it, and any number of
/// bounces fits into memory.
pub(crate) fn colour(world: &World, options: &Options, ray: Ray, range: Range) -> DVec3 {
    let (factor, absorption) = (DVec3::ONE, DVec3::ZERO);
    let mut pending = vec![Branch { ray, range, factor, weight: 1.0, depth: 0, absorption }];
    let mut sum = DVec3::ZERO;
    while let Some(branch) = pending.pop() {
        let Some(hit) = world.nearest(&branch.ray, branch.range) else {
            let left = transmittance(branch.absorption, f64::INFINITY);
            sum += branch.factor * left * world.background;
            continue;
        };
        let factor = branch.factor * transmittance(branch.absorption, hit.t);
        sum += factor * local(world, options, &branch.ray, &hit);
        if branch.depth < options.bounces {
            pending.extend(children(options, &Branch { factor, ..branch }, &hit));
        }
    }
    sum
}

/// The mirrored and the refracted ray of a hit, those of them that are made.
fn children(options: &Options, parent: &Branch, hit: &Hit) -> impl Iterator<Item = Branch> {
    let (kr, kt) = weights(options, parent.ray.direction, hit);
    let incoming = parent.ray.direction;
    let entering = incoming.dot(hit.normal) <= 0.0;
    let mirrored = grow(options, parent, hit, kr, || {
        Some((mirror(incoming, hit.normal).normalize(), parent.absorption))
    });
    let refracted = grow(options, parent, hit, kt, || {
        let direction = refract(incoming, hit.normal, hit.surface.index_of_refraction)?;
        Some((direction, if entering { hit.surface.absorption } else { DVec3::ZERO }))
    });
    mirrored.into_iter().chain(refracted)
}

/// Colours of the mirrored and the refracted ray: the material's own, or with `-fresnel` at a
/// transparent material the reflectance R in white and (1 − R)·kt.
fn weights(options: &Options, incoming: DVec3, hit: &Hit) -> (DVec3, DVec3) {
    let surface: &Surface = hit.surface;
    if options.fresnel && surface.is_transparent() {
        let share = fresnel_reflectance(incoming, hit.normal, surface.index_of_refraction);
        return (DVec3::splat(share), (1.0 - share) * surface.transparent);
    }
    (surface.reflective, surface.transparent)
}

/// A child of `parent` with colour `k`, unless `k` is black, its weight is below the cut-off,
/// or `way` gives no direction (total internal reflection).
fn grow(
    options: &Options,
    parent: &Branch,
    hit: &Hit,
    k: DVec3,
    way: impl FnOnce() -> Option<(DVec3, DVec3)>,
) -> Option<Branch> {
    let weight = parent.weight * k.length();
    if k == DVec3::ZERO || weight < options.weight {
        return None;
    }
    let (direction, absorption) = way()?;
    Some(Branch {
        ray: hit.leave(direction),
        range: Range::FORWARD,
        factor: parent.factor * k,
        weight,
        depth: parent.depth + 1,
        absorption,
    })
}
