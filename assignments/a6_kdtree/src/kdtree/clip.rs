//! Perfect splits: the part of a triangle that lies in a box.
//!
//! The box around that part is often much smaller than what the triangle's own box and the
//! node's have in common, and what does not reach a node need not be held by it (Havran &
//! Bittner, "On improving kd-trees for ray shooting", 2002; Wald & Havran 2006, section 4.1).
//!
//! Nothing may be lost to rounding. The planes are moved outward by a slack of 2⁻⁴⁰ of the
//! largest coordinate before they cut, a thousand times what ten cuts in `f64` can be off (each
//! a few units of 2⁻⁵²), so whatever a cut loses lies outside the true box.

use common::math::{Bounds, DVec3, Vec3};

/// Three corners, and at most one more for each of seven cuts.
const CORNERS: usize = 10;

/// A convex polygon.
#[derive(Clone, Copy)]
struct Polygon {
    corners: [[f64; 3]; CORNERS],
    len: usize,
}

/// What lies on one side of a plane across an axis.
#[derive(Clone, Copy)]
struct HalfSpace {
    axis: usize,
    plane: f64,
    /// +1 keeps what is below the plane, −1 what is above; both keep what is in it.
    side: f64,
}

impl HalfSpace {
    #[inline]
    fn height(&self, p: &[f64; 3]) -> f64 {
        (p[self.axis] - self.plane) * self.side
    }

    /// Where an edge that changes sides meets the plane.
    #[inline]
    fn crossing(&self, a: &[f64; 3], b: &[f64; 3], share: f64) -> [f64; 3] {
        let mut p = [0, 1, 2].map(|k| a[k] + (b[k] - a[k]) * share);
        p[self.axis] = self.plane;
        p
    }
}

impl Polygon {
    fn new(vertices: &[Vec3; 3]) -> Self {
        let mut corners = [[0.0; 3]; CORNERS];
        for (corner, vertex) in corners.iter_mut().zip(vertices) {
            *corner = vertex.as_dvec3().to_array();
        }
        Self { corners, len: 3 }
    }

    fn corners(&self) -> &[[f64; 3]] {
        &self.corners[..self.len]
    }

    /// The part in a half space (Sutherland & Hodgman 1974), perhaps nothing. Uncut if rounding
    /// made it so crooked that its corners would not fit: more than the part is always safe.
    #[inline]
    fn cut(&self, half: HalfSpace) -> Self {
        let mut part = Self { corners: [[0.0; 3]; CORNERS], len: 0 };
        let Some(mut a) = self.corners().last() else { return part };
        let mut height_a = half.height(a);
        for b in self.corners() {
            let height_b = half.height(b);
            if part.len + 2 > CORNERS {
                return *self;
            }
            if (height_a < 0.0 && height_b > 0.0) || (height_a > 0.0 && height_b < 0.0) {
                part.push(half.crossing(a, b, height_a / (height_a - height_b)));
            }
            if height_b <= 0.0 {
                part.push(*b);
            }
            (a, height_a) = (b, height_b);
        }
        part
    }

    #[inline]
    fn push(&mut self, corner: [f64; 3]) {
        self.corners[self.len] = corner;
        self.len += 1;
    }

    /// The box around it, `pad` wider on every side; `None` if nothing is left.
    fn bounds(&self, pad: f64) -> Option<Bounds> {
        let [first, rest @ ..] = self.corners() else { return None };
        let (mut min, mut max) = (DVec3::from_array(*first), DVec3::from_array(*first));
        for corner in rest {
            let corner = DVec3::from_array(*corner);
            (min, max) = (min.min(corner), max.max(corner));
        }
        Some(Bounds::enclosing(min - DVec3::splat(pad), max + DVec3::splat(pad)))
    }
}

/// What two boxes have in common; `None` if they do not touch.
pub fn common_part(a: &Bounds, b: &Bounds) -> Option<Bounds> {
    let part = Bounds { min: a.min.max(b.min), max: a.max.min(b.max) };
    (!part.is_empty()).then_some(part)
}

/// A box cut in two by the plane `axis` = `at`, which belongs to both parts.
pub fn halves(bounds: &Bounds, axis: usize, at: f32) -> [Bounds; 2] {
    let (mut left, mut right) = (*bounds, *bounds);
    left.max[axis] = left.max[axis].min(at);
    right.min[axis] = right.min[axis].max(at);
    [left, right]
}

/// The boxes of the parts of a triangle within `bounds` on both sides of the plane
/// `axis` = `at`: never too small, `None` where there is surely nothing.
pub fn split_triangle(vertices: &[Vec3; 3], bounds: &Bounds, axis: usize, at: f32) -> [Option<Bounds>; 2] {
    let whole = Bounds::of_points(*vertices);
    let reach = f64::from(whole.reach_from(Vec3::ZERO));
    let slack = reach * 2f64.powi(-40);
    let mut polygon = Polygon::new(vertices);
    for k in 0..3 {
        if whole.min[k] < bounds.min[k] {
            polygon = polygon.cut(HalfSpace { axis: k, plane: f64::from(bounds.min[k]) - slack, side: -1.0 });
        }
        if whole.max[k] > bounds.max[k] {
            polygon = polygon.cut(HalfSpace { axis: k, plane: f64::from(bounds.max[k]) + slack, side: 1.0 });
        }
    }
    let [left, right] = halves(bounds, axis, at);
    let part = |side: f64, half: &Bounds| {
        let plane = f64::from(at) + side * slack;
        let part = polygon.cut(HalfSpace { axis, plane, side }).bounds(slack / 16.0)?;
        common_part(&part, half)
    };
    [part(1.0, &left), part(-1.0, &right)]
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRIANGLE: [Vec3; 3] = [Vec3::ZERO, Vec3::new(4.0, 0.0, 0.0), Vec3::new(0.0, 4.0, 2.0)];

    #[test]
    fn a6t1_parts_are_tight() {
        let whole = Bounds::of_points(TRIANGLE);
        let [left, right] = split_triangle(&TRIANGLE, &whole, 0, 2.0);
        let near = |a: Vec3, b: Vec3| (a - b).abs().max_element() < 1e-6;
        let (left, right) = (left.unwrap(), right.unwrap());
        assert!(near(left.max, Vec3::new(2.0, 4.0, 2.0)) && near(left.min, Vec3::ZERO));
        assert!(near(right.min, Vec3::new(2.0, 0.0, 0.0)) && near(right.max, Vec3::new(4.0, 2.0, 1.0)));
    }

    #[test]
    fn a6t1_a_corner_that_touches_stays() {
        let beside = Bounds { min: Vec3::new(4.0, -1.0, -1.0), max: Vec3::new(6.0, 1.0, 1.0) };
        let [left, right] = split_triangle(&TRIANGLE, &beside, 0, 5.0);
        assert!(left.is_some_and(|b| b.min.x == 4.0) && right.is_none());
    }

    #[test]
    fn a6t1_nothing_where_the_triangle_passes_a_corner_of_the_box() {
        let corner = Bounds { min: Vec3::new(3.0, 3.0, 0.0), max: Vec3::new(4.0, 4.0, 2.0) };
        assert_eq!(split_triangle(&TRIANGLE, &corner, 1, 3.5), [None, None]);
    }
}
