//! Axis-aligned boxes.

use super::{DVec3, Vec3};

/// A closed axis-aligned box; flat and single-point boxes are legal, `min > max` means empty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Smallest corner.
    pub min: Vec3,
    /// Largest corner.
    pub max: Vec3,
}

impl Bounds {
    /// The box of nothing: the neutral element of [`Bounds::union`].
    pub const EMPTY: Self = Self { min: Vec3::INFINITY, max: Vec3::NEG_INFINITY };

    /// The smallest box around some points.
    pub fn of_points(points: impl IntoIterator<Item = Vec3>) -> Self {
        points.into_iter().fold(Self::EMPTY, |b, p| Self { min: b.min.min(p), max: b.max.max(p) })
    }

    /// The smallest `f32` box around a box given in `f64`: corners are rounded outward.
    pub fn enclosing(min: DVec3, max: DVec3) -> Self {
        let down = |x: f64| {
            if f64::from(x as f32) > x { (x as f32).next_down() } else { x as f32 }
        };
        let up = |x: f64| {
            if f64::from(x as f32) < x { (x as f32).next_up() } else { x as f32 }
        };
        Self {
            min: Vec3::new(down(min.x), down(min.y), down(min.z)),
            max: Vec3::new(up(max.x), up(max.y), up(max.z)),
        }
    }

    /// The smallest box around both.
    pub fn union(&self, other: &Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// Whether there is no point in it.
    pub fn is_empty(&self) -> bool {
        !self.min.cmple(self.max).all()
    }

    /// Whether the boxes share a point (touching counts).
    pub fn overlaps(&self, other: &Self) -> bool {
        self.min.cmple(other.max).all() && other.min.cmple(self.max).all()
    }

    /// Side lengths; negative when empty.
    pub fn size(&self) -> Vec3 {
        self.max - self.min
    }

    /// The axis along which it is longest; the first of those that are.
    pub fn longest_axis(&self) -> usize {
        let size = self.size();
        (0..3).fold(0, |best, axis| if size[axis] > size[best] { axis } else { best })
    }

    /// The eight corners, x varying fastest.
    pub fn corners(&self) -> [Vec3; 8] {
        let pick = |bit: bool, axis: usize| if bit { self.max[axis] } else { self.min[axis] };
        std::array::from_fn(|i| Vec3::new(pick(i & 1 != 0, 0), pick(i & 2 != 0, 1), pick(i & 4 != 0, 2)))
    }

    /// The largest |p − from| along any axis, over all points p of the box; 0 when empty.
    pub fn reach_from(&self, from: Vec3) -> f32 {
        let far = (self.min - from).abs().max((self.max - from).abs());
        if self.is_empty() { 0.0 } else { far.max_element() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn empty_is_neutral_and_flat_is_not_empty() {
        let flat = Bounds::of_points([Vec3::ZERO, Vec3::new(1.0, 0.0, 2.0)]);
        assert!(!flat.is_empty() && Bounds::EMPTY.is_empty());
        assert_eq!(flat.union(&Bounds::EMPTY), flat);
        assert!(flat.overlaps(&Bounds { min: Vec3::new(1.0, -1.0, 0.0), max: Vec3::new(2.0, 0.0, 1.0) }));
    }

    #[test]
    fn enclosing_rounds_outward() {
        let tenth = DVec3::splat(0.1);
        let b = Bounds::enclosing(-tenth, tenth);
        assert!(f64::from(b.max.x) >= 0.1 && f64::from(b.min.x) <= -0.1);
        assert!(b.max.x.next_down() < 0.1);
    }

    #[test]
    fn the_longest_axis_is_the_first_of_equals() {
        let sized = |size| Bounds { min: Vec3::ONE, max: Vec3::ONE + Vec3::from_array(size) };
        assert_eq!([[1.0, 2.0, 3.0], [1.0, 2.0, 2.0], [0.0; 3]].map(|s| sized(s).longest_axis()), [2, 1, 0]);
        assert_eq!(Bounds::EMPTY.longest_axis(), 0);
    }
}
