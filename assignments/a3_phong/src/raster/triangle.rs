//! One triangle: which pixel centres it covers, how deep it is there, and its colour.

use super::{Canvas, Corner};
use common::math::{DVec3, Vec3};
use common::tiles::Tile;

/// Pixels by which boxes on the screen are too large: far more than what rounding moves a
/// corner that is in the picture (about 10⁻¹² pixels).
const SLACK: f64 = 1.0 / 1024.0;

/// A triangle ready to be drawn.
pub struct Triangle {
    /// The edge opposite each corner as a linear function of (x, y, 1) in pixels: the triple
    /// product of the pixel's ray with the edge's two corners. All three have one sign where
    /// the ray's line passes the triangle.
    edges: [DVec3; 3],
    depths: [f64; 3],
    colors: [Vec3; 3],
    /// No pixel outside this can be covered.
    pub area: Tile,
}

impl Triangle {
    /// Prepares a triangle; `None` if it is surely out of sight.
    pub fn new(canvas: &Canvas, corners: &[Corner; 3]) -> Option<Self> {
        let [a, b, c] = corners.map(|corner| in_pixels(canvas, corner.screen));
        let area = area(canvas, [a, b, c])?;
        Some(Self {
            edges: [b.cross(c), c.cross(a), a.cross(b)],
            depths: corners.map(|corner| corner.depth),
            colors: corners.map(|corner| corner.color),
            area,
        })
    }

    /// The edges along row y: the part that does not depend on x.
    pub fn row(&self, y: u32) -> [f64; 3] {
        self.edges.map(|e| e.y * (f64::from(y) + 0.5) + e.z)
    }

    /// Weights of the three corners at the centre of pixel x in a row; `None` if not covered.
    ///
    /// The neighbour across an edge has the same three coefficients with the other sign, so its
    /// value has, bit for bit, the other sign as well: exactly one of the two is inside.
    #[inline]
    pub fn weights(&self, row: &[f64; 3], x: u32) -> Option<[f64; 3]> {
        let x = f64::from(x) + 0.5;
        let value: [f64; 3] = std::array::from_fn(|i| self.edges[i].x * x + row[i]);
        let [p, q, r] = std::array::from_fn(|i| is_left(value[i], &self.edges[i]));
        let total = value[0] + value[1] + value[2];
        (p == q && q == r && total != 0.0).then(|| value.map(|v| v / total))
    }

    /// The depth at a weighted point.
    #[inline]
    pub fn depth(&self, [a, b, c]: [f64; 3]) -> f64 {
        a * self.depths[0] + b * self.depths[1] + c * self.depths[2]
    }

    /// The colour at a weighted point. Weights refer to space, not to the screen, so nothing
    /// has to be divided by the depth. Written so that three equal colours stay exactly what
    /// they are: 0.9999999 would be one level darker in the file.
    #[inline]
    pub fn color(&self, [_, b, c]: [f64; 3]) -> Vec3 {
        let [first, second, third] = self.colors;
        first + (second - first) * b as f32 + (third - first) * c as f32
    }

    /// Whether a pixel centre of the rectangle may be covered: an edge that has the same strict
    /// sign at its four corners has it within, and all edges must be able to agree.
    pub fn may_touch(&self, part: Tile) -> bool {
        let (x0, x1) = (f64::from(part.x0), f64::from(part.x1));
        let (y0, y1) = (f64::from(part.y0), f64::from(part.y1));
        let at = |e: &DVec3| [(x0, y0), (x1, y0), (x0, y1), (x1, y1)].map(|(x, y)| e.x * x + e.y * y + e.z);
        let some = |test: fn(&f64) -> bool| self.edges.iter().all(|e| at(e).iter().any(test));
        some(|v| *v >= 0.0) || some(|v| *v <= 0.0)
    }
}

/// The sign of an edge's value; on the edge itself, the sign a little to the right and, if that
/// does not decide, a little below.
fn is_left(value: f64, edge: &DVec3) -> bool {
    value > 0.0 || (value == 0.0 && (edge.x > 0.0 || (edge.x == 0.0 && edge.y < 0.0)))
}

/// From the unit screen square to pixels, both homogeneous; see
/// [`common::camera::screen_position`] for the way back.
fn in_pixels(canvas: &Canvas, p: DVec3) -> DVec3 {
    let (w, h) = (f64::from(canvas.size.width()), f64::from(canvas.size.height()));
    let scale = w.max(h);
    DVec3::new((p.x - 0.5 * p.z) * scale + 0.5 * w * p.z, (p.y - 0.5 * p.z) * scale + 0.5 * h * p.z, p.z)
}

/// The pixels that a triangle may cover: those in its box on the screen, or all if it reaches
/// behind the eye. `None` if there are none.
fn area(canvas: &Canvas, corners: [DVec3; 3]) -> Option<Tile> {
    let (w, h) = (canvas.size.width(), canvas.size.height());
    let (width, height) = (f64::from(w), f64::from(h));
    let all = |test: &dyn Fn(&DVec3) -> bool| corners.iter().all(test);
    let beside = all(&|p| p.x < 0.0)
        || all(&|p| p.y < 0.0)
        || all(&|p| p.x > width * p.z)
        || all(&|p| p.y > height * p.z)
        || all(&|p| p.z <= 0.0)
        || !all(&|p| p.is_finite());
    if beside {
        return None;
    }
    if !all(&|p| p.z > 0.0) {
        return Some(Tile { x0: 0, y0: 0, x1: w, y1: h });
    }
    let points = corners.map(|p| p / p.z);
    let low = points.into_iter().fold(DVec3::INFINITY, DVec3::min);
    let high = points.into_iter().fold(DVec3::NEG_INFINITY, DVec3::max);
    // From the first to the last pixel centre within; none in most triangles of a net that is
    // finer than the picture. Casts saturate.
    let first = |x: f64| (x - 0.5 - SLACK).ceil() as u32;
    let behind_last = |x: f64, end: u32| ((x + 0.5 + SLACK).floor() as u32).min(end);
    let (x0, y0) = (first(low.x), first(low.y));
    let (x1, y1) = (behind_last(high.x, w), behind_last(high.y, h));
    (x0 < x1 && y0 < y1).then_some(Tile { x0, y0, x1, y1 })
}
