//! Property 3: what stands in front of the exact test.

use super::{EPS, any_ray, any_triangle};
use crate::Stress;
use crate::kit::simd_levels;
use common::math::{Bounds, Interval};
use common::shape::filter::Filter;
use common::shape::triangle_block::TriangleBlock;
use common::shape::{ExactRay, triangle};
use common::simd::dispatch;
use std::sync::atomic::{AtomicU64, Ordering};

/// The single-precision filter discards no triangle that is hit, is certain of none that is
/// missed, and knows a t that is not too early.
pub fn filter(stress: &Stress) {
    let certain = AtomicU64::new(0);
    for (name, level) in simd_levels() {
        stress.run(format!("p03 filter, {name}"), 305, 60_000, |draw| {
            let triangle = any_triangle(draw);
            let ray = any_ray(draw, &triangle);
            if !ray.is_usable() {
                return Ok(0.0);
            }
            let end = draw.magnitude(-2.0, 2.0) as f32;
            let interval = if draw.chance(0.5) { Interval::ALL } else { Interval { min: -end, max: end } };
            let filter = Filter::new(&ray, &Bounds::of_points(triangle));
            let block = TriangleBlock::pack([(0, triangle)]);
            let verdict = dispatch!(level, s => block.judge(s, &filter, interval));
            let hit = triangle::intersect(&ExactRay::new(&ray), &triangle).filter(|h| interval.contains(h.t));
            if hit.is_some() && verdict.possible & 1 == 0 {
                return Err(format!("hit and discarded: {ray:?} {triangle:?} {interval:?}"));
            }
            if verdict.certain & 1 == 1 {
                certain.fetch_add(1, Ordering::Relaxed);
                let latest = verdict.latest[0];
                if hit.is_none_or(|h| h.t > latest + latest.abs() * EPS as f32) {
                    return Err(format!(
                        "{hit:?} but certain until {latest}: {ray:?} {triangle:?} {interval:?}"
                    ));
                }
            }
            Ok(0.0)
        });
    }
    stress.expect("p03 the filter is certain now and then", certain.into_inner() as f64, |n| n > 10_000.0);
}
