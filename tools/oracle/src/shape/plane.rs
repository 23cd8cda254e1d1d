//! The plane and the disc.

use super::Crossing;
use crate::Ray;
use common::math::DVec3;
use common::scene::Disc;

/// All points P with P·normal = offset; with a disc, those near its centre only.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plane {
    /// Unit length.
    pub normal: DVec3,
    pub offset: f64,
    /// Its centre lies on the plane.
    pub disc: Option<Disc>,
}

impl Plane {
    /// A plane with `normal` of any length but zero, `offset` along the unit normal, and the
    /// disc's centre anywhere: it is projected onto the plane.
    pub fn new(normal: DVec3, offset: f64, disc: Option<Disc>) -> Self {
        let normal = normal.normalize();
        let project =
            |d: Disc| Disc { center: d.center + (offset - d.center.dot(normal)) * normal, radius: d.radius };
        Self { normal, offset, disc: disc.map(project) }
    }

    /// The crossing, if the line is not parallel. The rim of a disc belongs to it.
    pub fn cross(&self, ray: &Ray) -> Option<Crossing> {
        let t = (self.offset - ray.origin.dot(self.normal)) / ray.direction.dot(self.normal);
        if !t.is_finite() {
            return None;
        }
        let inside = |d: Disc| ray.at(t).distance(d.center) <= d.radius;
        self.disc.is_none_or(inside).then_some(Crossing { t, normal: self.normal, triangle: 0 })
    }

    /// A point of the plane that tells how far from the origin it is.
    pub fn anchor(&self) -> DVec3 {
        self.disc.map_or(self.offset * self.normal, |d| d.center)
    }
}
