//! Up to eight rays side by side, as planes and balls beside the tree see them.

use common::ray::Ray;

/// Rays side by side.
pub const RAYS: usize = 8;

/// The rays, one axis after the other.
pub struct Abreast {
    /// Origins, by axis.
    pub origin: [[f32; RAYS]; 3],
    /// Directions, by axis.
    pub direction: [[f32; RAYS]; 3],
    /// What they leave.
    pub home: [u32; RAYS],
}

impl Abreast {
    /// One to eight rays; unused places hold rays without a direction, which hit nothing.
    #[inline(always)]
    pub fn of(rays: &[Ray]) -> Self {
        let nowhere = [[0.0; RAYS]; 3];
        let mut all = Self { origin: nowhere, direction: nowhere, home: [Ray::ANYWHERE; RAYS] };
        for (lane, ray) in rays.iter().enumerate().take(RAYS) {
            all.home[lane] = ray.home;
            for axis in 0..3 {
                all.origin[axis][lane] = ray.origin[axis];
                all.direction[axis][lane] = ray.direction[axis];
            }
        }
        all
    }
}
