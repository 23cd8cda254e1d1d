//! Local light: a surface's own, ambient, diffuse and highlights, with shadows (course rules §4.3
//! and §4.4).

use crate::light::Arriving;
use crate::object::Object;
use crate::{Hit, Mixture, Model, Options, Range, Ray, Specular, World};
use common::math::DVec3;

/// The colour of a hit by its own light, the lights and the ambient light alone; `mixture` is its
/// material.
///
/// A surface seen from behind (ray·N > 0) is black, its own light included, unless `-shade_back`
/// turns its normal round. Which side is seen depends on the flat triangle, the light on
/// the interpolated normal.
pub(crate) fn local(world: &World, options: &Options, ray: &Ray, hit: &Hit, mixture: &Mixture) -> DVec3 {
    let from_behind = ray.direction.dot(hit.normal) > 0.0;
    if from_behind && !options.shade_back {
        return DVec3::ZERO;
    }
    let side = if from_behind { -1.0 } else { 1.0 };
    let (normal, flat) = (side * hit.shading_normal, side * hit.normal);
    let lit = sum_of_lights(world, hit.point, normal, |arriving| {
        // A smooth normal may lean towards a light that would have to come through the surface.
        if arriving.direction.dot(flat) <= 0.0 {
            return DVec3::ZERO;
        }
        let visible = visibility(world, options, hit, arriving);
        visible
            * mixture.sum(|surface| {
                let highlight = match options.model {
                    Model::Flat | Model::Diffuse => 0.0,
                    Model::Phong | Model::Whitted => {
                        lobe(options.specular, normal, arriving.direction, -ray.direction)
                            .powf(surface.exponent)
                    }
                };
                surface.diffuse + surface.specular * highlight
            })
    });
    let own = mixture.sum(|surface| surface.emissive);
    own + world.ambient * mixture.sum(|surface| surface.diffuse) + lit
}

/// Σ reflectance ∘ light · max(0, L·N) over the lights in front of the surface.
pub(crate) fn sum_of_lights(
    world: &World,
    point: DVec3,
    normal: DVec3,
    reflectance: impl Fn(&Arriving) -> DVec3,
) -> DVec3 {
    let arriving = world.arriving(point);
    arriving
        .into_iter()
        .map(|a| (a, normal.dot(a.direction)))
        .filter(|&(_, cosine)| cosine > 0.0)
        .map(|(a, cosine)| reflectance(&a) * a.color * cosine)
        .sum()
}

/// The cosine that the exponent is applied to, never negative. Both forms are multiplied by
/// N·L afterwards, so that they differ in the shape of the highlight only.
fn lobe(form: Specular, normal: DVec3, to_light: DVec3, to_eye: DVec3) -> f64 {
    let cosine = match form {
        Specular::Blinn => normal.dot((to_light + to_eye).normalize_or_zero()),
        Specular::Phong => (2.0 * normal.dot(to_light) * normal - to_light).dot(to_eye),
    };
    cosine.max(0.0)
}

/// Which part of a light gets through to a hit: white for all of it, black for none.
fn visibility(world: &World, options: &Options, hit: &Hit, arriving: &Arriving) -> DVec3 {
    if options.model != Model::Whitted || !options.shadows {
        return DVec3::ONE;
    }
    let (ray, distance) = shadow_ray(hit, arriving);
    // A surface that the light sits on does not hide it.
    let range = Range { min: 0.0, max: distance - hit.standoff };
    if options.transparent_shadows {
        filtered(world, &ray, range, hit.standoff)
    } else if world.nearest(&ray, range).is_some() {
        DVec3::ZERO
    } else {
        DVec3::ONE
    }
}

/// A ray from beside the surface to the light, and how long it is. It is aimed anew from where it
/// starts: one that ran beside the true way would meet a light's own surface too early.
fn shadow_ray(hit: &Hit, arriving: &Arriving) -> (Ray, f64) {
    let ray = hit.leave(arriving.direction);
    if arriving.distance.is_infinite() {
        return (ray, arriving.distance);
    }
    let way = hit.point + arriving.distance * arriving.direction - ray.origin;
    (Ray { direction: way.normalize(), ..ray }, way.length())
}

/// The product of the transparent colours of every surface crossed.
///
/// A ray along the common edge of two triangles meets both. That is one surface, so crossings
/// of one material, on one side, at one place (within `same`) count once.
fn filtered(world: &World, ray: &Ray, range: Range, same: f64) -> DVec3 {
    let mut crossed = Vec::new();
    world.cross(ray, |object, crossing| {
        if range.contains(crossing.t) {
            let leaving = ray.direction.dot(object.world_normal(&crossing)) > 0.0;
            crossed.push((crossing.t, leaving, object, crossing.triangle));
        }
    });
    crossed.sort_by(|a, b| a.1.cmp(&b.1).then(a.0.total_cmp(&b.0)));
    crossed.dedup_by(|b, a| a.1 == b.1 && b.0 - a.0 <= same && a.2.material == b.2.material);
    let passing = |&(t, _, object, triangle): &(f64, bool, &Object, usize)| {
        world.mixture_at(object, triangle, ray.at(t)).sum(|surface| surface.transparent)
    };
    crossed.iter().map(passing).product()
}
