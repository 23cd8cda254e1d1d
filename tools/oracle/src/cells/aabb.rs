//! Boxes along the axes.

use common::math::DVec3;

/// A closed box; flat ones are legal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Aabb {
    pub min: DVec3,
    pub max: DVec3,
}

impl Aabb {
    /// The smallest box around at least one point.
    pub fn of(points: &[DVec3]) -> Self {
        let one = |&p: &DVec3| Self { min: p, max: p };
        points.iter().map(one).reduce(Self::around).expect("a box around no point")
    }

    /// The smallest box around both.
    pub fn around(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// Do the closed boxes overlap? Touching counts.
    pub fn touches(&self, other: &Self) -> bool {
        self.min.cmple(other.max).all() && other.min.cmple(self.max).all()
    }

    /// Its midpoint.
    pub fn center(&self) -> DVec3 {
        (self.min + self.max) / 2.0
    }

    /// Half its extent along each axis.
    pub fn half(&self) -> DVec3 {
        (self.max - self.min) / 2.0
    }
}
