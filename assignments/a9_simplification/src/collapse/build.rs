//! From triangles to a surface: who is whose neighbour, and what is not a surface.
//!
//! Where more than two triangles meet at an edge, or two that turn the same way, nobody is
//! anybody's neighbour; where several fans meet in one point, each gets a copy of the point. So
//! everything becomes a surface with boundary, and the places where it was cut are held fast.

use crate::collapse::eight::{looks, normals};
use crate::collapse::surface::{Face, NONE, Point, Surface, previous};
use common::math::lanes::LANES;
use common::math::{Bounds, Vec3};
use common::simd::{self, Simd, dispatch};

/// A surface and how it was cut.
#[derive(Clone)]
pub(super) struct Built {
    pub surface: Surface,
    /// For the copies of points, which come after all others, the points they are copies of.
    pub copies: Vec<u32>,
    /// Whether a point is at a place where the surface was cut.
    pub cut: Vec<bool>,
}

/// A corner of a triangle.
#[derive(Clone, Copy, Default)]
struct Corner {
    /// The half-edge that leaves it.
    leaves: u32,
    /// The point where that ends.
    end: u32,
    /// The point where the half-edge starts that comes back.
    start: u32,
}

/// Corners by their points: those of point p are `corners[first[p]..first[p + 1]]`.
struct Around {
    first: Vec<u32>,
    corners: Vec<Corner>,
}

/// Builds the surface of triangles over points; no triangle has a point twice.
pub(super) fn build(places: &[Vec3], triangles: impl Iterator<Item = [u32; 3]>) -> Built {
    let mut faces = Vec::with_capacity(triangles.size_hint().1.unwrap_or(0));
    faces.extend(triangles.map(Face::new));
    let points = places.iter().map(|&at| Point { at, out: NONE }).collect();
    let alive = faces.len();
    let mut built = Built {
        surface: Surface { faces, points, alive, scale: scale_of(places) },
        copies: Vec::new(),
        cut: vec![false; places.len()],
    };
    built.surface.remember_normals();
    let around = Around::new(&built.surface);
    for point in built.join(&around) {
        let corners = around.of(point);
        if built.surface.fan(point).count() < corners.len() {
            built.split(point, corners);
        }
    }
    built
}

impl Surface {
    /// Pairs what leaves a point with what comes back, from corner to corner. Whether that leads once through all of
    /// them: then no two share a side in the same direction.
    #[inline(always)]
    fn join_circle(&mut self, corners: &[Corner]) -> bool {
        let first = corners[0];
        let mut at = first;
        for _ in 1..corners.len() {
            match corners.iter().find(|next| next.end == at.start) {
                Some(next) if next.leaves != first.leaves => {
                    self.set_twin(next.leaves, previous(at.leaves));
                    at = *next;
                }
                _ => return false,
            }
        }
        self.set_twin(first.leaves, previous(at.leaves));
        at.start == first.end
    }

    fn remember_normals(&mut self) {
        dispatch!(simd::level(), s => self.remember_normals_with(s));
    }

    #[inline(always)]
    fn remember_normals_with<S: Simd>(&mut self, simd: S) {
        let last = self.faces.len() as u32;
        let mut faces = [0; LANES];
        for first in (0..last).step_by(LANES) {
            for lane in 0..LANES {
                faces[lane] = (first + lane as u32).min(last - 1);
            }
            let looks = looks(simd, normals(simd, self, &faces));
            for lane in 0..LANES {
                self.faces[faces[lane] as usize].remember(looks[lane] as u32);
            }
        }
    }
}

fn scale_of(places: &[Vec3]) -> f64 {
    let bounds = Bounds::of_points(places.iter().copied());
    let size = (bounds.max.as_dvec3() - bounds.min.as_dvec3()).max_element();
    if size > 0.0 && size.is_finite() { (-size.log2().floor()).exp2() } else { 1.0 }
}

impl Around {
    fn new(surface: &Surface) -> Self {
        let mut first = vec![0u32; surface.points.len() + 1];
        for corner in surface.faces.iter().flat_map(Face::corners) {
            first[corner as usize + 1] += 1;
        }
        for i in 1..first.len() {
            first[i] += first[i - 1];
        }
        let mut corners = vec![Corner::default(); surface.faces.len() * 3];
        let mut free = first.clone();
        for (face, [a, b, c]) in (0..).zip(surface.faces.iter().map(Face::corners)) {
            for (i, [start, point, end]) in [[c, a, b], [a, b, c], [b, c, a]].into_iter().enumerate() {
                let slot = &mut free[point as usize];
                corners[*slot as usize] = Corner { leaves: 4 * face + i as u32, end, start };
                *slot += 1;
            }
        }
        Self { first, corners }
    }

    fn of(&self, point: u32) -> &[Corner] {
        let point = point as usize;
        &self.corners[self.first[point] as usize..self.first[point + 1] as usize]
    }
}

impl Built {
    /// Pairs the half-edges of every edge that has one on each side, from each of its ends, and finds out by which to
    /// leave a point. Returns the points that may have several fans.
    fn join(&mut self, around: &Around) -> Vec<u32> {
        let mut odd = Vec::new();
        for point in 0..self.surface.points.len() as u32 {
            let corners = around.of(point);
            let Some(any) = corners.first() else { continue };
            self.surface.points[point as usize].out = any.leaves;
            if !self.surface.join_circle(corners) {
                self.join_each(point, corners);
                odd.push(point);
            }
        }
        odd
    }

    /// Pairs what leaves a point if its corners are no circle.
    #[cold]
    fn join_each(&mut self, point: u32, corners: &[Corner]) {
        let mut open = None;
        for &Corner { leaves, end, .. } in corners {
            let same = corners.iter().filter(|other| other.end == end).count();
            let mut back = corners.iter().filter(|other| other.start == end);
            let (twin, more) =
                (back.next().map_or(NONE, |other| previous(other.leaves)), back.next().is_some());
            let is_cut = same > 1 || more;
            self.cut[point as usize] |= is_cut;
            self.surface.set_twin(leaves, if is_cut { NONE } else { twin });
            if is_cut || twin == NONE {
                open = open.or(Some(leaves));
            }
        }
        if let Some(open) = open {
            self.surface.points[point as usize].out = open;
        }
    }

    #[cold]
    fn split(&mut self, point: u32, corners: &[Corner]) {
        self.cut[point as usize] = true;
        let mut left: Vec<u32> = corners.iter().map(|corner| corner.leaves).collect();
        let mut fan = point;
        loop {
            let done: Vec<u32> = self.surface.fan(fan).collect();
            for &h in &done {
                self.surface.set_start(h, fan);
            }
            left.retain(|h| !done.contains(h));
            let Some(&any) = left.first() else { break };
            let open = left.iter().copied().find(|&h| self.surface.twin(h) == NONE);
            fan = self.surface.points.len() as u32;
            let at = self.surface.points[point as usize].at;
            self.surface.points.push(Point { at, out: open.unwrap_or(any) });
            self.copies.push(point);
            self.cut.push(true);
        }
    }
}
