//! A triangle as its surface points see it.

use crate::math::{DVec3, UNIT_ROUNDOFF, Vec3};

/// As many triangles are hit many times each: what their surface points have in common is worked
/// out once. Of larger meshes a picture may show few triangles, and memory is slower than
/// arithmetic.
const FEW: usize = 4096;

/// What surface points of a triangle want to know of it; none of it depends on the point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Facet {
    /// The unit normal; zero if there is no area.
    pub normal: DVec3,
    /// Largest magnitude of a coordinate.
    pub scale: f64,
    /// Twice the area.
    doubled: f64,
    /// An upper bound of the longest edge's length.
    longest: f64,
}

impl Facet {
    /// The facets of all triangles if there are few, else none.
    pub fn of_few(triangles: &[[Vec3; 3]]) -> Vec<Self> {
        if triangles.len() <= FEW { triangles.iter().map(Self::new).collect() } else { Vec::new() }
    }

    /// The facet of three corners.
    #[inline(always)]
    pub fn new(corners: &[Vec3; 3]) -> Self {
        let [a, b, c] = corners.map(|v| v.as_dvec3());
        let across = (b - a).cross(c - a);
        Self {
            normal: across.normalize_or_zero(),
            scale: a.abs().max(b.abs()).max(c.abs()).max_element(),
            doubled: across.length(),
            longest: edges(corners).iter().map(|e| e.abs().element_sum()).fold(0.0, f64::max),
        }
    }

    /// The point of these weights of the second and third corner.
    #[inline(always)]
    pub fn point(&self, corners: &[Vec3; 3], [u, v]: [f64; 2]) -> DVec3 {
        let [a, b, c] = corners.map(|v| v.as_dvec3());
        let [l0, l1, l2] = self.off_the_border(corners, [1.0 - u - v, u, v]);
        a * l0 + b * l1 + c * l2
    }

    /// Barycentric weights of a point that keeps a distance of 2⁻¹⁹·`scale` from the triangle's
    /// edges (less if the triangle is thinner than a few of those). A ray that leaves the very edge
    /// between two walls of a room would start, by rounding, behind one of them.
    #[inline(always)]
    fn off_the_border(&self, corners: &[Vec3; 3], weights: [f64; 3]) -> [f64; 3] {
        let margin = 32.0 * UNIT_ROUNDOFF * self.scale;
        // Most points are so far inside that no edge need be measured; 1.001 is for the rounding.
        let least = weights[0].min(weights[1]).min(weights[2]);
        if least * self.doubled > margin * self.longest * 1.001 {
            return weights;
        }
        near_the_border(weights, corners, margin / self.doubled)
    }
}

/// The edges, each opposite its corner.
#[inline(always)]
fn edges(corners: &[Vec3; 3]) -> [DVec3; 3] {
    let [a, b, c] = corners.map(|v| v.as_dvec3());
    [c - b, a - c, b - a]
}

#[cold]
fn near_the_border(weights: [f64; 3], corners: &[Vec3; 3], margin: f64) -> [f64; 3] {
    // The weight at that distance; NaN (no area) is no floor.
    let floor = edges(corners).map(|edge| (margin * edge.length()).min(0.2));
    if weights.iter().zip(floor).all(|(w, f)| *w >= f) {
        return weights;
    }
    let raised: [f64; 3] = std::array::from_fn(|i| weights[i].max(floor[i]));
    raised.map(|w| w / (raised[0] + raised[1] + raised[2]))
}
