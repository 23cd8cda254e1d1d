//! Affine maps of the plane.

/// A point of the plane, x to the right and y up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point2 {
    /// Distance from the left side of the picture, which has width 1.
    pub x: f64,
    /// Distance from the bottom of the picture, which has height 1.
    pub y: f64,
}

/// The map p ↦ A·p + b: the upper two rows of a 3 × 3 matrix whose last row is 0 0 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Affine2 {
    /// Each row holds two entries of A and one of b.
    pub rows: [[f64; 3]; 2],
}

impl Affine2 {
    /// The map that leaves every point where it is.
    pub const IDENTITY: Self = Self { rows: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]] };

    /// The image of a point.
    pub fn apply(&self, p: Point2) -> Point2 {
        let [x, y] = self.rows.map(|[a, b, c]| a * p.x + b * p.y + c);
        Point2 { x, y }
    }

    /// The map that does `first`, then `self`.
    pub fn after(&self, first: &Self) -> Self {
        let [u, v] = first.rows;
        Self {
            rows: self
                .rows
                .map(|[a, b, c]| [a * u[0] + b * v[0], a * u[1] + b * v[1], a * u[2] + b * v[2] + c]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a0t2_a_product_does_both_maps_in_order(
            first in any::<[[i8; 3]; 2]>(),
            second in any::<[[i8; 3]; 2]>(),
            (x, y) in any::<(i8, i8)>(),
        ) {
            // Small integers make every operation exact.
            let [first, second] = [first, second].map(|rows| Affine2 {
                rows: rows.map(|row| row.map(f64::from)),
            });
            let p = Point2 { x: x.into(), y: y.into() };
            prop_assert_eq!(second.after(&first).apply(p), second.apply(first.apply(p)));
            prop_assert_eq!(first.after(&Affine2::IDENTITY), first);
        }
    }
}
