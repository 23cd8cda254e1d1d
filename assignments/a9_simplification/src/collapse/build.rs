//! From triangles to a surface: who is whose neighbour, and what is not a surface.
//!
//! Where more than two triangles meet at an edge, or two that turn the same way, nobody is
//! anybody's neighbour; where several fans meet in one point, each gets a copy of the point. So
//! everything becomes a surface with boundary, and the places where it was cut are held fast.

use crate::collapse::circle::Around;
use crate::collapse::eight::{eight_from, looks, normals};
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

/// So many faces are looked at while they are at hand.
const AT_ONCE: usize = 256;

/// Builds the surface of triangles over points; no triangle has a point twice.
pub(super) fn build(places: &[Vec3], triangles: impl Iterator<Item = [u32; 3]>) -> Built {
    let faces = Vec::with_capacity(triangles.size_hint().1.unwrap_or(0));
    let points = places.iter().map(|&at| Point { at, out: NONE }).collect();
    let mut built = Built {
        surface: Surface { faces, points, alive: 0, scale: scale_of(places) },
        copies: Vec::new(),
        cut: vec![false; places.len()],
    };
    let counts = built.surface.add_faces(triangles.map(Face::new));
    let around = Around::new(&built.surface, counts);
    for point in dispatch!(simd::level(), s => built.join(s, &around)) {
        let leaves = around.of(point);
        if built.surface.fan(point).count() < leaves.len() {
            built.split(point, leaves);
        }
    }
    built
}

impl Surface {
    /// Takes faces, who remember where to they look. Tells how many corners there are at each point, and 0.
    fn add_faces(&mut self, mut faces: impl Iterator<Item = Face>) -> Vec<u32> {
        let mut counts = vec![0; self.points.len() + 1];
        loop {
            let known = self.faces.len();
            self.faces.extend(faces.by_ref().take(AT_ONCE));
            if self.faces.len() == known {
                self.alive = known;
                return counts;
            }
            for corner in self.faces[known..].iter().flat_map(Face::corners) {
                counts[corner as usize] += 1;
            }
            dispatch!(simd::level(), s => self.remember_normals(s, known as u32));
        }
    }

    /// From some face on.
    #[inline(always)]
    fn remember_normals<S: Simd>(&mut self, simd: S, from: u32) {
        let last = self.faces.len() as u32;
        for first in (from..last).step_by(LANES) {
            let faces = eight_from(first, last);
            let looks = looks(simd, normals(simd, self, &faces));
            for (face, look) in faces.into_iter().zip(looks) {
                self.faces[face as usize].remember(look as u32);
            }
        }
    }
}

fn scale_of(places: &[Vec3]) -> f64 {
    let bounds = Bounds::of_points(places.iter().copied());
    let size = (bounds.max.as_dvec3() - bounds.min.as_dvec3()).max_element();
    if size > 0.0 && size.is_finite() { (-size.log2().floor()).exp2() } else { 1.0 }
}

impl Built {
    /// Pairs the half-edges of every edge that has one on each side, from each of its ends, and finds out by which to
    /// leave a point. Returns the points that may have several fans.
    #[inline(always)]
    fn join<S: Simd>(&mut self, simd: S, around: &Around) -> Vec<u32> {
        let mut odd = Vec::new();
        for point in 0..self.surface.points.len() as u32 {
            let leaves = around.of(point);
            let Some(&any) = leaves.first() else { continue };
            self.surface.points[point as usize].out = any;
            if !self.surface.join_circle(simd, leaves) {
                self.join_each(point, leaves);
                odd.push(point);
            }
        }
        odd
    }

    /// Pairs what leaves a point if that is no circle.
    #[cold]
    fn join_each(&mut self, point: u32, leaves: &[u32]) {
        let ends: Vec<u32> = leaves.iter().map(|&h| self.surface.end(h)).collect();
        let back: Vec<(u32, u32)> =
            leaves.iter().map(|&h| (self.surface.start(previous(h)), previous(h))).collect();
        let mut open = None;
        for (&h, end) in leaves.iter().zip(&ends) {
            let same = ends.iter().filter(|other| *other == end).count();
            let mut back = back.iter().filter(|(start, _)| start == end).map(|&(_, back)| back);
            let (twin, more) = (back.next().unwrap_or(NONE), back.next().is_some());
            let is_cut = same > 1 || more;
            self.cut[point as usize] |= is_cut;
            self.surface.set_twin(h, if is_cut { NONE } else { twin });
            if is_cut || twin == NONE {
                open = open.or(Some(h));
            }
        }
        if let Some(open) = open {
            self.surface.points[point as usize].out = open;
        }
    }

    #[cold]
    fn split(&mut self, point: u32, leaves: &[u32]) {
        self.cut[point as usize] = true;
        let mut left = leaves.to_vec();
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
