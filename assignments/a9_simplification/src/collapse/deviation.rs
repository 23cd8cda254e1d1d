//! A bound of how far a simplified surface is from the original, anywhere on it.
//!
//! The distance to a triangle is a convex function, so that over a polygon it is largest at a
//! corner. Each simplified triangle is cut into polygons along the original's edges, by planes
//! that halve the angles between the original's faces; each polygon is then held against the face
//! that it lies over. Whichever face that is, its distance is a bound of that to the surface: how
//! well polygons and faces are matched decides how close the bound is, not whether it holds.

use crate::collapse::locate::{locate, nearest};
use crate::collapse::surface::{NONE, Surface};
use common::math::DVec3;

/// How much larger than the largest distance that was found the bound may be.
const SLACK: f64 = 1.1;
/// How many corners a polygon may have.
const CORNERS: usize = 12;
/// Into how many polygons a triangle is cut at most, for each triangle of the original.
const MOST_POLYGONS: usize = 64;

/// A convex polygon.
#[derive(Clone, Copy)]
struct Polygon {
    corners: [DVec3; CORNERS],
    count: usize,
}

/// A polygon, the original's face to hold it against, and the edge over which it came there.
struct Task {
    polygon: Polygon,
    face: u32,
    entry: u32,
}

/// Bound of the distance from any point of `simplified` to `original`, both in the same unit. For
/// every point of the original, `becomes` tells a point of the simplified surface close by.
pub(super) fn deviation(original: &Surface, simplified: &Surface, becomes: &[u32]) -> f64 {
    let near = closest(original, simplified, becomes);
    let mut bound = 0.0f64;
    let mut starts = Vec::with_capacity(simplified.faces.len());
    for face in &simplified.faces {
        let corners = face.corners();
        let [a, b, c] = corners.map(|p| simplified.at(p));
        let (square, landing) = locate(original, near[corners[0] as usize], (a + b + c) / 3.0);
        bound = bound.max(square);
        starts.push(landing.face);
    }
    bound = bound.sqrt();
    let most = MOST_POLYGONS * (1 + original.faces.len() / simplified.faces.len().max(1));
    let mut tasks = Vec::new();
    for (face, &start) in simplified.faces.iter().zip(&starts) {
        let polygon = Polygon::triangle(face.corners().map(|p| simplified.at(p)));
        tasks.push(Task { polygon, face: start, entry: NONE });
        let mut left = most;
        while let Some(task) = tasks.pop() {
            left = left.saturating_sub(1);
            bound = bound.max(task.hold(original, bound * SLACK, left > 0, &mut tasks));
        }
    }
    bound
}

/// For every simplified point the nearest of those points of the original that became it.
fn closest(original: &Surface, simplified: &Surface, becomes: &[u32]) -> Vec<u32> {
    let mut near = vec![(f64::MAX, 0); simplified.points.len()];
    for (point, &became) in becomes.iter().enumerate().filter(|(_, became)| **became != NONE) {
        let square = (original.at(point as u32) - simplified.at(became)).length_squared();
        let best = &mut near[became as usize];
        if square < best.0 {
            *best = (square, point as u32);
        }
    }
    near.into_iter().map(|(_, point)| point).collect()
}

impl Task {
    /// The distance of what lies over the face. The rest goes to the face's neighbours, unless all
    /// of it is nearer than `enough` or it may not be cut any more.
    fn hold(&self, original: &Surface, enough: f64, cut: bool, tasks: &mut Vec<Self>) -> f64 {
        let [a, b, c] = original.faces[self.face as usize].corners().map(|p| original.at(p));
        let whole = self.polygon.distance(a, b, c);
        if whole <= enough || !cut {
            return if whole <= enough { 0.0 } else { whole };
        }
        let mut inside = self.polygon;
        for (corner, (from, to)) in [(a, b), (b, c), (c, a)].into_iter().enumerate() {
            let h = 4 * self.face + corner as u32;
            let twin = original.twin(h);
            if h == self.entry || twin == NONE {
                continue;
            }
            // The plane through the edge and between the two faces; its normal looks away.
            let normals = [h, twin].map(|h| original.normal((h >> 2) as usize).normalize_or_zero());
            let away = (to - from).cross(normals[0] + normals[1]);
            let outside = inside.clip(|p| (p - from).dot(away));
            if let Some(polygon) = outside {
                tasks.push(Self { polygon, face: twin >> 2, entry: twin });
            }
            if inside.count == 0 {
                return 0.0;
            }
        }
        self.settle(original, inside, enough, tasks)
    }

    /// The distance of a polygon that lies over the face, if that is about what there is to find;
    /// else the polygon is held against a nearer face, or its halves are.
    fn settle(&self, original: &Surface, polygon: Polygon, enough: f64, tasks: &mut Vec<Self>) -> f64 {
        let corners = original.faces[self.face as usize].corners();
        let [a, b, c] = corners.map(|p| original.at(p));
        let distance = polygon.distance(a, b, c);
        if distance <= enough {
            return 0.0;
        }
        let found = |p: DVec3| locate(original, corners[0], p);
        let worst = polygon.corners().map(|p| found(p).0).fold(0.0, f64::max).sqrt();
        if distance <= worst * SLACK {
            return distance;
        }
        let middle = polygon.corners().sum::<DVec3>() / polygon.count as f64;
        let nearer = found(middle).1.face;
        if nearer != self.face {
            tasks.push(Self { polygon, face: nearer, entry: NONE });
        } else {
            tasks.extend(polygon.halves().map(|polygon| Self { polygon, face: nearer, entry: NONE }));
        }
        0.0
    }
}

impl Polygon {
    fn triangle([a, b, c]: [DVec3; 3]) -> Self {
        let mut corners = [DVec3::ZERO; CORNERS];
        corners[..3].copy_from_slice(&[a, b, c]);
        Self { corners, count: 3 }
    }

    fn corners(&self) -> impl Iterator<Item = DVec3> {
        self.corners[..self.count].iter().copied()
    }

    /// Cut across its longest side.
    fn halves(self) -> [Self; 2] {
        let sides = (0..self.count).map(|i| (self.corners[i], self.corners[(i + 1) % self.count]));
        let longest = sides.max_by(|s, t| (s.1 - s.0).length_squared().total_cmp(&(t.1 - t.0).length_squared()));
        let (p, q) = longest.expect("a polygon has sides");
        let (middle, along) = ((p + q) / 2.0, q - p);
        let mut kept = self;
        let rest = kept.clip(|x| (x - middle).dot(along));
        [kept, rest.unwrap_or(kept)]
    }

    /// Largest distance to a triangle.
    fn distance(&self, a: DVec3, b: DVec3, c: DVec3) -> f64 {
        let squares = self.corners().map(|p| {
            let [u, v, w] = nearest(p, a, b, c);
            (a * u + b * v + c * w - p).length_squared()
        });
        squares.fold(0.0, f64::max).sqrt()
    }

    fn push(&mut self, p: DVec3) {
        self.corners[self.count] = p;
        self.count += 1;
    }

    /// Keeps what is not above zero, and returns the rest if there is any. A polygon with too many
    /// corners is not cut.
    fn clip(&mut self, height: impl Fn(DVec3) -> f64) -> Option<Self> {
        let whole = *self;
        let heights: [f64; CORNERS] = std::array::from_fn(|i| if i < whole.count { height(whole.corners[i]) } else { 0.0 });
        let above = heights[..whole.count].iter().filter(|&&h| h > 0.0).count();
        if above == 0 || whole.count + 2 > CORNERS {
            return None;
        }
        if above == whole.count {
            self.count = 0;
            return Some(whole);
        }
        let (mut kept, mut rest) = (Self { count: 0, ..whole }, Self { count: 0, ..whole });
        for i in 0..whole.count {
            let j = (i + 1) % whole.count;
            let (p, q) = (whole.corners[i], whole.corners[j]);
            if heights[i] > 0.0 { rest.push(p) } else { kept.push(p) }
            if (heights[i] > 0.0) != (heights[j] > 0.0) {
                let crossing = p + (q - p) * (heights[i] / (heights[i] - heights[j]));
                kept.push(crossing);
                rest.push(crossing);
            }
        }
        *self = kept;
        Some(rest)
    }
}
