//! The colours of the cell picture.

use common::math::DVec3;

/// The ramp that counts from 2 to 16 run through, at equal distances.
const RAMP: [DVec3; 5] = [
    DVec3::new(0.25, 0.4, 1.0),
    DVec3::new(0.2, 0.9, 0.9),
    DVec3::new(0.3, 0.9, 0.2),
    DVec3::new(1.0, 0.9, 0.1),
    DVec3::new(1.0, 0.15, 0.1),
];

/// Linear RGB of a cell that holds `count` objects: white for one, then blue over green to red
/// for 2 to 16; more than 16 look like 16. An empty cell is black, but no picture shows one.
pub fn cell_colour(count: u32) -> DVec3 {
    match count {
        0 => DVec3::ZERO,
        1 => DVec3::ONE,
        _ => {
            let along = f64::from(count.min(16) - 2) / 14.0 * 4.0;
            let section = (along as usize).min(3);
            RAMP[section].lerp(RAMP[section + 1], along - section as f64)
        }
    }
}
