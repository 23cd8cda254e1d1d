//! What is around an edge, and whether it may be drawn together.

use crate::collapse::surface::{NONE, Surface};
use common::math::DVec3;

/// A face that stays when an edge is drawn together, seen from the end that moves: the other two
/// corners, counter-clockwise.
#[derive(Clone, Copy)]
pub(super) struct Stays {
    pub from: DVec3,
    pub sides: [DVec3; 2],
}

/// The surroundings of one edge; kept from edge to edge for its memory.
#[derive(Default)]
pub(super) struct Ring {
    /// Faces at either end that are not at the edge.
    pub stays: Vec<Stays>,
    /// Points next to the start of the edge.
    near_start: Vec<u32>,
    /// Points next to the end of the edge.
    near_end: Vec<u32>,
}

pub(super) struct Limits {
    pub cos2: f64,
    pub sliver: f64,
}

impl Ring {
    /// Looks around the edge of half-edge `h`.
    pub(super) fn look(&mut self, surface: &Surface, h: u32) {
        let twin = surface.twin(h);
        let gone = [h >> 2, twin >> 2];
        self.stays.clear();
        for (near, end) in [(&mut self.near_start, surface.start(h)), (&mut self.near_end, surface.end(h))] {
            near.clear();
            let from = surface.at(end);
            let first = surface.points[end as usize].out;
            let mut spoke = first;
            let mut v = surface.end(spoke);
            let mut at = surface.at(v);
            loop {
                near.push(v);
                let in_ = super::surface::previous(spoke);
                v = surface.start(in_);
                let following = surface.at(v);
                if !gone.contains(&(spoke >> 2)) {
                    self.stays.push(Stays { from, sides: [at, following] });
                }
                at = following;
                spoke = surface.twin(in_);
                if spoke == first {
                    break;
                }
                if spoke == NONE {
                    near.push(v);
                    break;
                }
            }
        }
    }

    /// Whether the surface stays one (Dey et al. 1999, "Topology preserving edge contraction"): the
    /// ends share no neighbours but the corners opposite the edge, no two boundaries meet, and
    /// something is left.
    pub(super) fn keeps_topology(&self, surface: &Surface, h: u32, canon: impl Fn(u32) -> u32) -> bool {
        let inner = surface.twin(h) != NONE;
        let (a, b) = (surface.start(h), surface.end(h));
        if inner && surface.on_boundary(a) && surface.on_boundary(b) {
            return false;
        }
        let smallest = if inner { 3 } else { 2 };
        if self.near_start.len() == smallest && self.near_end.len() == smallest {
            return false;
        }
        let shared = self.near_start.iter().filter(|&&v| self.near_end.iter().any(|&w| canon(v) == canon(w)));
        shared.count() == if inner { 2 } else { 1 }
    }

    /// Whether no face that stays turns over or becomes a sliver when its end moves to `place`.
    pub(super) fn keeps_shape(&self, place: DVec3, limits: &Limits) -> bool {
        self.stays.iter().all(|face| {
            let [p, q] = face.sides;
            let side = q - p;
            let before = side.cross(face.from - p);
            let (u, w) = (place - p, place - q);
            let after = side.cross(u);
            let dot = before.dot(after);
            let (b2, a2) = (before.length_squared(), after.length_squared());
            if b2 == 0.0 {
                return a2 > 0.0;
            }
            if !(dot > 0.0 && dot * dot > limits.cos2 * b2 * a2) {
                return false;
            }
            let s2 = side.length_squared();
            let sum = s2 + u.length_squared() + w.length_squared();
            // 4√3·area/Σl² = q; area = √a2/2.
            if a2 >= limits.sliver * sum * sum {
                return true;
            }
            let old = s2 + (face.from - p).length_squared() + (face.from - q).length_squared();
            a2 * old * old >= b2 * sum * sum
        })
    }
}
