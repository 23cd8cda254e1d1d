//! A bound of how far a surface is from another, anywhere on it.
//!
//! The distance to a triangle is a convex function, so that over a polygon it is largest at a
//! corner. Each triangle of the one is cut into polygons along the edges of the other, by planes
//! that halve the angles between its faces; each polygon is then held against the face
//! that it lies over. Whichever face that is, its distance is a bound of that to the surface: how
//! well polygons and faces are matched decides how close the bound is, not whether it holds.

use crate::collapse::cells::Cells;
use crate::collapse::locate::locate;
use crate::collapse::polygon::Polygon;
use crate::collapse::surface::{NONE, Surface};
use common::math::DVec3;

/// How much larger than the largest distance that was found the bound may be.
const SLACK: f64 = 1.05;
/// Distances below the rounding of single precision, in units of the box, are as good as this.
const LEAST: f64 = 1.0 / (1u64 << 23) as f64;
/// Through how many faces a polygon is passed on.
const LONGEST_WAY: u32 = 256;
/// How far a polygon may reach at first, in terms of the longest side of the face it is held against.
const LARGE: f64 = 2.0;
/// Into how many polygons a triangle is cut at most, for each triangle of the other surface.
const MOST_POLYGONS: usize = 256;
/// Into a part of all that are left, if that is more.
const SHARE: usize = 8;

/// A polygon and the other surface's face to hold it against.
struct Task {
    polygon: Polygon,
    face: u32,
    /// The edge over which it came there.
    entry: u32,
    /// How many faces it came through; [`NONE`] once its way was lost, as happens far from the
    /// surface.
    way: u32,
}

/// Bound of the distance from any point of `from` to `to`, both in the same unit. For every point
/// of `from`, `near` tells a point of `to` that should be close.
pub(super) fn deviation(from: &Surface, to: &Surface, near: &[u32]) -> f64 {
    let mut bound = LEAST;
    let cells = Cells::new(to);
    let find = |p: DVec3| cells.nearest(p);
    let mut starts = Vec::with_capacity(from.faces.len());
    for face in &from.faces {
        let corners = face.corners();
        let [a, b, c] = corners.map(|p| from.at(p));
        let (square, landing) = locate(to, near[corners[0] as usize], (a + b + c) / 3.0);
        // A point of faces without area may find nothing around it.
        let face = if landing.face == NONE { find((a + b + c) / 3.0).1 } else { landing.face };
        starts.push((square, face));
    }
    // A large distance is there to be found early, so that the others need not be looked at.
    let largest = from.faces.iter().zip(&starts).max_by(|x, y| x.1.0.total_cmp(&y.1.0));
    if let Some((face, _)) = largest {
        let [a, b, c] = face.corners().map(|p| from.at(p));
        bound = bound.max(find((a + b + c) / 3.0).0.sqrt());
    }
    let most = MOST_POLYGONS * (1 + to.faces.len() / from.faces.len().max(1));
    // What most faces do not need is there for large ones.
    let mut spare = most * from.faces.len();
    let mut tasks = Vec::new();
    for (face, &(_, start)) in from.faces.iter().zip(&starts) {
        let polygon = Polygon::triangle(face.corners().map(|p| from.at(p)));
        tasks.push(Task { polygon, face: start, entry: NONE, way: 0 });
        let may = most.max(spare / SHARE);
        let mut left = may;
        while let Some(task) = tasks.pop() {
            left = left.saturating_sub(1);
            bound = bound.max(task.hold(to, &find, bound * SLACK, left > 0, &mut tasks));
        }
        spare = spare.saturating_sub(may - left);
    }
    bound * SLACK
}

/// For every simplified point the nearest of those points of the original that became it.
pub(super) fn closest(original: &Surface, simplified: &Surface, becomes: &[u32]) -> Vec<u32> {
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
    /// of it is nearer than `enough` or it may not be cut any more. `find` tells the nearest place.
    fn hold(
        &self,
        to: &Surface,
        find: &impl Fn(DVec3) -> (f64, u32),
        enough: f64,
        cut: bool,
        tasks: &mut Vec<Self>,
    ) -> f64 {
        let [a, b, c] = to.faces[self.face as usize].corners().map(|p| to.at(p));
        let whole = self.polygon.distance(a, b, c);
        if whole <= enough {
            return 0.0;
        }
        if !cut {
            return whole.min(self.polygon.about_middle(find));
        }
        // A large polygon comes apart into slivers on its way: better in halves, each from its own place.
        if self.way == 0 && self.polygon.reach2() > LARGE * LARGE * longest2([a, b, c]) {
            tasks.extend(self.polygon.halves().map(|polygon| {
                let face = find(polygon.middle()).1;
                Self { polygon, face, entry: NONE, way: 0 }
            }));
            return 0.0;
        }
        if self.way > LONGEST_WAY {
            return self.settle(to, find, self.polygon, enough, tasks);
        }
        let mut inside = self.polygon;
        for (corner, (start, end)) in [(a, b), (b, c), (c, a)].into_iter().enumerate() {
            let h = 4 * self.face + corner as u32;
            let twin = to.twin(h);
            if h == self.entry || twin == NONE {
                continue;
            }
            // The plane through the edge and between the two faces; its normal looks away.
            let normals = [h, twin].map(|h| to.normal((h >> 2) as usize).normalize_or_zero());
            let away = (end - start).cross(normals[0] + normals[1]);
            let outside = inside.clip(|p| (p - start).dot(away));
            if let Some(polygon) = outside {
                tasks.push(Self { polygon, face: twin >> 2, entry: twin, way: self.way + 1 });
            }
            if inside.count == 0 {
                return 0.0;
            }
        }
        self.settle(to, find, inside, enough, tasks)
    }

    /// The distance of a polygon that lies over the face, if that is about what there is to find;
    /// else the polygon is held against a nearer face, or its halves are.
    fn settle(
        &self,
        to: &Surface,
        find: &impl Fn(DVec3) -> (f64, u32),
        polygon: Polygon,
        enough: f64,
        tasks: &mut Vec<Self>,
    ) -> f64 {
        let [a, b, c] = to.faces[self.face as usize].corners().map(|p| to.at(p));
        let distance = polygon.distance(a, b, c).min(polygon.about_middle(find));
        if distance <= enough {
            return 0.0;
        }
        let worst = polygon.corners().map(|p| find(p).0).fold(0.0, f64::max).sqrt();
        if distance <= worst * SLACK {
            return distance;
        }
        let nearer = find(polygon.middle()).1;
        let lost = |polygon, way| Self { polygon, face: nearer, entry: NONE, way };
        if nearer != self.face {
            tasks.push(lost(polygon, NONE));
            return 0.0;
        }
        // What is larger than the face may find its way from here.
        let is_large = polygon.reach2() > longest2([a, b, c]);
        tasks.extend(polygon.halves().map(|half| lost(half, if is_large { 0 } else { NONE })));
        0.0
    }
}

/// Square of the longest side of a triangle.
fn longest2([a, b, c]: [DVec3; 3]) -> f64 {
    a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a))
}
