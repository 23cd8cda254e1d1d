//! A5T1: does a shape touch a box? Answers "yes" when in doubt.

use common::math::DVec3;

/// A triangle prepared for tests against many boxes.
pub struct TriangleOverlap {
    corners: [DVec3; 3],
    edges: [DVec3; 3],
    normal: DVec3,
    slack: DVec3,
}

impl TriangleOverlap {
    /// `slack` widens every box, for rounding.
    pub fn new(corners: [DVec3; 3], slack: f64) -> Self {
        let [a, b, c] = corners;
        let edges = [b - a, c - b, a - c];
        Self { corners, edges, normal: edges[0].cross(edges[1]), slack: DVec3::splat(slack) }
    }

    /// Whether the triangle shares a point with a box that overlaps its own: no separating axis
    /// among the triangle's normal, and the nine products of its edges with the axes
    /// (Akenine-Möller, "Fast 3D Triangle-Box Overlap Testing", 2001).
    pub fn meets_box(&self, min: DVec3, max: DVec3) -> bool {
        let center = (min + max) / 2.0;
        let half = (max - min) / 2.0 + self.slack;
        let v = self.corners.map(|p| p - center);
        if self.normal.dot(v[0]).abs() > half.dot(self.normal.abs()) {
            return false;
        }
        let separates = |axis: DVec3| {
            let p = v.map(|x| axis.dot(x));
            let reach = half.dot(axis.abs());
            p[0].min(p[1]).min(p[2]) > reach || p[0].max(p[1]).max(p[2]) < -reach
        };
        !self.edges.iter().any(|e| {
            separates(DVec3::new(0.0, -e.z, e.y))
                || separates(DVec3::new(e.z, 0.0, -e.x))
                || separates(DVec3::new(-e.y, e.x, 0.0))
        })
    }
}

/// Whether the surface of a sphere shares a point with a box: the nearest point of the box is
/// within the radius and the farthest is not.
pub fn sphere_meets_box(center: DVec3, radius: f64, min: DVec3, max: DVec3, slack: f64) -> bool {
    let nearest = (min - center).max(center - max).max(DVec3::ZERO);
    let farthest = (min - center).abs().max((max - center).abs());
    nearest.length() <= radius + slack && farthest.length() >= radius - slack
}

#[cfg(test)]
mod tests {
    use super::*;

    const MIN: DVec3 = DVec3::ZERO;
    const MAX: DVec3 = DVec3::ONE;

    #[test]
    fn a5t1_triangle_cutting_a_corner_of_its_own_box() {
        // The triangle's box contains the cell's corner (1 1 1), the triangle passes beside it.
        let far = [DVec3::new(3.0, 0.5, 0.5), DVec3::new(0.5, 3.0, 0.5), DVec3::new(0.5, 0.5, 3.0)];
        assert!(!TriangleOverlap::new(far, 0.0).meets_box(MIN, MAX));
        let near = far.map(|p| p - DVec3::splat(0.4));
        assert!(TriangleOverlap::new(near, 0.0).meets_box(MIN, MAX));
    }

    #[test]
    fn a5t1_touching_counts() {
        let beside = [DVec3::new(1.0, 0.2, 0.2), DVec3::new(2.0, 0.2, 0.2), DVec3::new(1.5, 0.2, 0.9)];
        assert!(TriangleOverlap::new(beside, 0.0).meets_box(MIN, MAX));
        assert!(sphere_meets_box(DVec3::new(2.0, 0.5, 0.5), 1.0, MIN, MAX, 0.0));
        assert!(!sphere_meets_box(DVec3::new(2.1, 0.5, 0.5), 1.0, MIN, MAX, 0.0));
    }

    #[test]
    fn a5t1_the_inside_of_a_sphere_is_not_its_surface() {
        assert!(!sphere_meets_box(DVec3::splat(0.5), 5.0, MIN, MAX, 0.0));
    }
}
