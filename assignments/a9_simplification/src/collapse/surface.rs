//! Triangles that know their neighbours.
//!
//! A half-edge is a side of a triangle, seen from that triangle: number 4·face + corner, running
//! from that corner to the next. Its twin is the same edge seen from the other side. Three of four
//! slots are used, so that a face is 32 bytes that never straddle two cache lines and the next
//! half-edge is found by arithmetic on two bits.

use common::math::{DVec3, Vec3};

/// No half-edge, no vertex.
pub(super) const NONE: u32 = u32::MAX;

/// A triangle: its corners counter-clockwise, and the twins of the half-edges that leave them.
#[derive(Clone, Copy)]
pub(super) struct Face {
    /// Points at the corners; the fourth is [`NONE`] once the face is gone, 0 before.
    vertex: [u32; 4],
    /// [`NONE`] at a boundary; the fourth remembers where the face looked at first.
    twin: [u32; 4],
}

/// A point of the surface.
#[derive(Clone, Copy)]
pub(super) struct Point {
    /// Where it is, in the unit of the mesh.
    pub at: Vec3,
    /// A half-edge that leaves it; on the boundary the one that has no twin. [`NONE`] once gone.
    pub out: u32,
}

impl Point {
    /// As it lies in memory: where it is, and four bytes that are no number.
    #[inline(always)]
    pub(super) fn row(&self) -> [f32; 4] {
        [self.at.x, self.at.y, self.at.z, f32::from_bits(self.out)]
    }
}

/// An oriented surface, with or without boundary, in which every point has one fan of triangles.
#[derive(Clone)]
pub(super) struct Surface {
    pub faces: Vec<Face>,
    pub points: Vec<Point>,
    /// How many faces are not gone.
    pub alive: usize,
    /// Power of two that brings the largest side of the box to between 1 and 2.
    pub scale: f64,
}

/// The half-edge after this one around its face.
#[inline(always)]
pub(super) fn next(h: u32) -> u32 {
    // Two bits each for what follows corner 0, 1 and 2.
    (h & !3) | ((0b00_10_01 >> ((h & 3) * 2)) & 3)
}

/// The half-edge before this one around its face.
#[inline(always)]
pub(super) fn previous(h: u32) -> u32 {
    (h & !3) | ((0b01_00_10 >> ((h & 3) * 2)) & 3)
}

impl Face {
    pub(super) fn new(corners: [u32; 3]) -> Self {
        let [a, b, c] = corners;
        Self { vertex: [a, b, c, 0], twin: [NONE; 4] }
    }

    /// Remembers a direction, as [`looks`](crate::collapse::eight::looks) tells it.
    #[inline(always)]
    pub(super) fn remember(&mut self, look: u32) {
        self.twin[3] = look;
    }

    /// What was remembered, as it is kept.
    #[inline(always)]
    pub(super) fn remembered(&self) -> u32 {
        self.twin[3]
    }

    /// What was remembered: the largest component is 511, others are up to half of 1 off.
    #[inline(always)]
    pub(super) fn look(&self) -> [i16; 3] {
        [22, 12, 2].map(|shift| ((self.twin[3] << shift) as i32 >> 22) as i16)
    }

    /// Whether a direction is within a right angle of what was remembered.
    #[inline(always)]
    pub(super) fn looks_along(&self, normal: DVec3) -> bool {
        let [x, y, z] = self.look().map(f64::from);
        normal.x * x + normal.y * y + normal.z * z >= 0.0
    }

    /// Takes over the twins of another face, renumbered, and what it remembers.
    pub(super) fn copy_rest(&mut self, other: &Self, half_edge: impl Fn(u32) -> u32) {
        let [a, b, c, looked] = other.twin;
        self.twin = [half_edge(a), half_edge(b), half_edge(c), looked];
    }

    /// Whether it was removed.
    #[inline(always)]
    pub(super) fn is_gone(&self) -> bool {
        self.vertex[3] == NONE
    }

    /// Whether one of its sides has no twin.
    #[inline(always)]
    pub(super) fn is_at_boundary(&self) -> bool {
        self.twin[..3].contains(&NONE)
    }

    /// Its corners.
    #[inline(always)]
    pub(super) fn corners(&self) -> [u32; 3] {
        [self.vertex[0], self.vertex[1], self.vertex[2]]
    }
}

impl Surface {
    /// Where a half-edge starts.
    #[inline(always)]
    pub(super) fn start(&self, h: u32) -> u32 {
        self.faces[(h >> 2) as usize].vertex[(h & 3) as usize]
    }

    /// Where a half-edge ends.
    #[inline(always)]
    pub(super) fn end(&self, h: u32) -> u32 {
        self.start(next(h))
    }

    /// The same edge from the other side, [`NONE`] at a boundary.
    #[inline(always)]
    pub(super) fn twin(&self, h: u32) -> u32 {
        self.faces[(h >> 2) as usize].twin[(h & 3) as usize]
    }

    /// For every edge that is there one of its half-edges.
    #[inline(always)]
    pub(super) fn edges(&self) -> impl Iterator<Item = u32> {
        let alive = self.faces.iter().enumerate().filter(|(_, face)| !face.is_gone());
        alive.flat_map(|(i, face)| {
            let sides = (0..3).map(move |side| (4 * i as u32 + side, face.twin[side as usize]));
            sides.filter(|(h, twin)| h < twin).map(|(h, _)| h)
        })
    }

    pub(super) fn set_start(&mut self, h: u32, point: u32) {
        self.faces[(h >> 2) as usize].vertex[(h & 3) as usize] = point;
    }

    /// Tells one half-edge who its twin is.
    #[inline(always)]
    pub(super) fn set_twin(&mut self, h: u32, twin: u32) {
        self.faces[(h >> 2) as usize].twin[(h & 3) as usize] = twin;
    }

    /// Makes two half-edges each other's twin; either may be [`NONE`].
    pub(super) fn pair(&mut self, h: u32, t: u32) {
        for (one, other) in [(h, t), (t, h)] {
            if one != NONE {
                self.set_twin(one, other);
            }
        }
    }

    pub(super) fn is_alive(&self, face: u32) -> bool {
        !self.faces[face as usize].is_gone()
    }

    pub(super) fn kill(&mut self, face: u32) {
        self.faces[face as usize].vertex[3] = NONE;
        self.alive -= 1;
    }

    /// The half-edge that leaves the same point in the next face counter-clockwise, [`NONE`]
    /// where the fan ends.
    #[inline(always)]
    pub(super) fn turn(&self, h: u32) -> u32 {
        self.twin(previous(h))
    }

    /// Whether a point is on the boundary.
    pub(super) fn on_boundary(&self, point: u32) -> bool {
        self.twin(self.points[point as usize].out) == NONE
    }

    /// The half-edges that leave a point, counter-clockwise, starting at the boundary if there is one.
    #[inline(always)]
    pub(super) fn fan(&self, point: u32) -> Fan<'_> {
        let first = self.points[point as usize].out;
        Fan { surface: self, first, h: first }
    }

    /// Where a point is, in units of about the box; differences are those of exact arithmetic.
    #[inline(always)]
    pub(super) fn at(&self, point: u32) -> DVec3 {
        self.points[point as usize].at.as_dvec3() * self.scale
    }

    /// Where the corners of a face are; `map` would be a call of its own.
    #[inline(always)]
    pub(super) fn places(&self, face: usize) -> [DVec3; 3] {
        let [a, b, c] = self.faces[face].corners();
        [self.at(a), self.at(b), self.at(c)]
    }

    /// The normal of a face, as long as twice its area.
    #[inline(always)]
    pub(super) fn normal(&self, face: usize) -> DVec3 {
        let [a, b, c] = self.places(face);
        (b - a).cross(c - a)
    }

    /// The nearest place that the mesh can hold, in its own unit.
    pub(super) fn round(&self, at: DVec3) -> Vec3 {
        (at / self.scale).as_vec3()
    }
}

/// See [`Surface::fan`].
pub(super) struct Fan<'a> {
    surface: &'a Surface,
    first: u32,
    h: u32,
}

impl Iterator for Fan<'_> {
    type Item = u32;

    #[inline(always)]
    fn next(&mut self) -> Option<u32> {
        let h = self.h;
        if h == NONE {
            return None;
        }
        let following = self.surface.turn(h);
        self.h = if following == self.first { NONE } else { following };
        Some(h)
    }
}
