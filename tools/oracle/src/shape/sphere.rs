//! The sphere.

use super::Crossing;
use crate::Ray;
use common::math::DVec3;

/// All points at `radius` from `center`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sphere {
    pub center: DVec3,
    pub radius: f64,
}

impl Sphere {
    /// The eight corners of the box around it.
    pub fn box_corners(&self) -> [DVec3; 8] {
        std::array::from_fn(|i| {
            let sign = |bit: usize| if i >> bit & 1 == 0 { -1.0 } else { 1.0 };
            self.center + self.radius * DVec3::new(sign(0), sign(1), sign(2))
        })
    }

    /// Both crossings, nearer first, or `None` where the line passes by. A tangent counts as
    /// two equal crossings.
    ///
    /// The half chord comes from the point of the line closest to the centre, not from
    /// b² − 4ac, which cancels when the sphere is far away.
    pub fn cross(&self, ray: &Ray) -> Option<[Crossing; 2]> {
        let to_center = self.center - ray.origin;
        let length_squared = ray.direction.length_squared();
        let closest = to_center.dot(ray.direction) / length_squared;
        let miss_squared = (to_center - closest * ray.direction).length_squared();
        let half_chord_squared = (self.radius * self.radius - miss_squared) / length_squared;
        let crossing = |t| Crossing { t, normal: ray.at(t) - self.center, triangle: 0 };
        // NaN is no crossing.
        (half_chord_squared >= 0.0).then(|| {
            let half_chord = half_chord_squared.sqrt();
            [closest - half_chord, closest + half_chord].map(crossing)
        })
    }
}
