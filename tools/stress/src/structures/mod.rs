//! accuracy.md, properties 9 and 10: grids and trees answer what the list answers, bit for bit,
//! for every ray there is.

mod far;
mod scenes;
mod special;

pub use far::far_away;
pub use scenes::{meshes, scenes};
pub use special::{flat_boxes, not_finite, special};

use crate::kit::Draw;
use common::math::Interval;

fn any_interval(draw: &mut Draw, reach: f32) -> Interval {
    match draw.below(4) {
        0 => Interval::ALL,
        1 => Interval::up_to(reach * draw.unit() as f32),
        2 => Interval { min: reach * draw.unit() as f32, max: f32::INFINITY },
        _ => Interval::FORWARD,
    }
}
