//! Eight rays beside one: what is discarded and what is kept.

use super::*;
use crate::math::{Bounds, Interval, Vec3};
use crate::ray::Ray;
use crate::shape::ExactRay;
use crate::shape::filter::{Errors, Filter};
use crate::shape::triangle::intersect;
use crate::shape::triangle_block::TriangleBlock;
use crate::simd::{by_name, dispatch, f32x8};
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Coordinates of all sizes, often 0, seldom so large that products overflow.
fn vector(random: &mut Pcg64Mcg) -> Vec3 {
    let sizes = [0.0, 1e-20, 1e-3, 1.0, 1.0, 1.0, 1e3, 1e19];
    let sized = random.next_u32().is_multiple_of(4);
    Vec3::from_array(std::array::from_fn(|_| {
        let size = if sized { sizes[random.next_u32() as usize % 8] } else { 1.0 };
        (random.next_u32() as f32 / u32::MAX as f32 - 0.5) * size
    }))
}

#[test]
fn a6t2_what_is_not_met_by_eight_rays_is_possible_for_none() {
    let mut random = Pcg64Mcg::seed_from_u64(3);
    let (mut possible, mut met, mut all) = (0, 0, 0);
    for round in 0..4000 {
        let triangles: Vec<[Vec3; 3]> = (0..1 + round % 8)
            .map(|_| {
                let at = vector(&mut random);
                [at, at + vector(&mut random) * 0.3, at + vector(&mut random) * 0.3]
            })
            .collect();
        let block = TriangleBlock::pack((0..).zip(triangles.iter().copied()));
        let bounds = Bounds::of_points(triangles.iter().flatten().copied());
        let rays: [Ray; LANES] = std::array::from_fn(|_| Ray::new(vector(&mut random), vector(&mut random)));
        let filters = rays.each_ref().map(|ray| Filter::new(ray, &bounds));
        let side = |ray: &Ray| (bounds.min - ray.origin).abs().max((bounds.max - ray.origin).abs());
        let far = rays.each_ref().map(|ray| side(ray).max_element());
        let step = rays.each_ref().map(|ray| ray.direction.abs().max_element());
        for min in [0.0, -0.5, f32::NEG_INFINITY] {
            let interval = Interval { min, max: f32::INFINITY };
            for level in ["baseline", "sse4", "avx2", "avx512"].into_iter().filter_map(by_name) {
                let (bits, verdicts) = dispatch!(level, s => {
                    let [o, d] = Ray::columns(s, rays.each_ref());
                    let [far, step] = [&far, &step].map(|v| f32x8::from_slice(s, v));
                    let eight = Rays::new(s, [o, d], Errors::abreast(s, far, step), min);
                    let bits = Unfolded::of(&block.faces(s)).rays_meeting(s, &eight, triangles.len());
                    (bits, filters.each_ref().map(|filter| block.judge(s, filter, interval)))
                });
                let used = (1 << triangles.len()) - 1;
                for (lane, ray) in rays.iter().enumerate().filter(|(_, ray)| ray.is_usable()) {
                    let is_met = bits >> lane & 1 == 1;
                    let is_certain = verdicts[lane].certain & used != 0;
                    let exact = triangles
                        .iter()
                        .any(|t| intersect(&ExactRay::new(ray), t).is_some_and(|hit| hit.t >= min));
                    assert!(is_met || !exact && !is_certain, "{ray:?} {triangles:?} {min}");
                    possible += usize::from(verdicts[lane].possible & used != 0);
                    met += usize::from(is_met);
                    all += 1;
                }
            }
        }
    }
    // Where rays have no end it knows what the filter knows.
    assert!(
        met <= possible * 101 / 100 && met < all * 2 / 3,
        "{met} of {all} kept, {possible} by the filter"
    );
}

/// Coordinates of one size.
fn plain(random: &mut Pcg64Mcg) -> Vec3 {
    Vec3::from_array(std::array::from_fn(|_| random.next_u32() as f32 / u32::MAX as f32 - 0.5))
}

#[test]
fn a6t2_what_is_certain_for_rays_side_by_side_is_hit_in_time() {
    let mut random = Pcg64Mcg::seed_from_u64(7);
    let (mut certain, mut possible, mut all) = (0, 0, 0);
    for _ in 0..4000 {
        let triangle = [plain(&mut random), plain(&mut random), plain(&mut random)];
        let block = TriangleBlock::pack([(0, triangle)]);
        let bounds = Bounds::of_points(triangle);
        let rays: [Ray; LANES] = std::array::from_fn(|_| {
            let (origin, [a, b, c]) = (plain(&mut random), triangle);
            Ray::new(origin, (a + b + c) / 3.0 + plain(&mut random) * 0.3 - origin)
        });
        let side = |ray: &Ray| (bounds.min - ray.origin).abs().max((bounds.max - ray.origin).abs());
        let far = rays.each_ref().map(|ray| side(ray).max_element());
        let step = rays.each_ref().map(|ray| ray.direction.abs().max_element());
        let end = random.next_u32() as f32 / u32::MAX as f32 * 3.0;
        for level in ["baseline", "sse4", "avx2", "avx512"].into_iter().filter_map(by_name) {
            let (verdicts, [earliest, latest]) = dispatch!(level, s => {
                let lines = Ray::columns(s, rays.each_ref());
                let errors = Errors::abreast(s, f32x8::from_slice(s, &far), f32x8::from_slice(s, &step));
                let eight = Rays::new(s, lines, errors, 0.0);
                let verdicts = Unfolded::of(&block.faces(s)).judge(s, &eight, 0, 0x7f, f32x8::splat(s, end).min(errors[0]));
                let t = verdicts.as_ref().map_or([[0.0; LANES]; 2], |v| [*v.earliest, *v.latest]);
                (verdicts.map_or([0, 0], |v| [v.possible, v.certain]), t)
            });
            for (lane, ray) in rays.iter().enumerate().filter(|(_, ray)| ray.is_usable()) {
                let [is_possible, is_certain] = verdicts.map(|bits| bits >> lane & 1 == 1);
                let t = intersect(&ExactRay::new(ray), &triangle).map(|hit| hit.t);
                let counts = t.is_some_and(|t| (0.0..=end).contains(&t)) && lane < 7;
                let in_time = t.is_some_and(|t| earliest[lane] <= t && t <= latest[lane]);
                assert!(is_possible || !counts, "{ray:?} {triangle:?} {end}");
                assert!(!is_certain || counts && in_time, "{ray:?} {triangle:?} {end}");
                certain += usize::from(is_certain);
                possible += usize::from(is_possible);
                all += 1;
            }
        }
    }
    assert!(
        certain > all / 4 && possible < certain * 11 / 10,
        "{certain} certain, {possible} possible of {all}"
    );
}
