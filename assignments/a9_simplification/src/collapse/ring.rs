//! What is around an edge, and whether it may be drawn together.

use crate::collapse::locate::square;
use crate::collapse::surface::{NONE, Surface, previous};
use common::math::DVec3;

/// Least cosine of the angle by which one step may turn a face.
pub(super) const LEAST_COSINE: f64 = 0.5;
/// Least quality 4√3·area/Σ side² of a face that a step makes, 1 for an equilateral triangle;
/// faces that become better may be worse than that.
pub(super) const LEAST_QUALITY: f64 = 1e-3;
/// A surface is folded back on itself where a face looks elsewhere than all around do: the least cosine of a face that
/// does not.
pub(super) const FOLDED: f64 = 0.15;
/// How much it counts if a tip is cut off, in terms of planes that are as far off: with more of it there is less left
/// for all else.
const TIP: f64 = 0.3;
/// Below this the area could be one of rounding.
const ROUNDING: f64 = 1e-13;

/// A face that stays when an edge is drawn together, seen from the end that moves: the other two
/// corners, counter-clockwise. Normals are as long as twice the area.
#[derive(Clone, Copy)]
pub(super) struct Stays {
    /// The other two corners.
    pub points: [u32; 2],
    /// Its normal as it is.
    pub before: DVec3,
    /// Its normal after the step.
    pub after: DVec3,
    face: u32,
    from: DVec3,
    sides: [DVec3; 2],
}

/// A face that vanishes with the edge.
#[derive(Clone, Copy)]
pub(super) struct Vanishes {
    /// The corner opposite the edge.
    pub opposite: u32,
    /// Its normal, as long as twice the area.
    pub normal: DVec3,
}

/// The surroundings of one edge; kept from edge to edge for its memory.
#[derive(Clone, Default)]
pub(super) struct Ring {
    /// Faces at either end that are not at the edge.
    pub stays: Vec<Stays>,
    /// Faces at the edge.
    pub vanishes: Vec<Vanishes>,
    /// Points next to the start and to the end of the edge.
    near: [Vec<u32>; 2],
    /// Sum of all normals before the step.
    before: DVec3,
}

impl Ring {
    /// Looks around the edge of half-edge `h`.
    pub(super) fn look(&mut self, surface: &Surface, h: u32) {
        self.stays.clear();
        self.vanishes.clear();
        let ends = [surface.start(h), surface.end(h)];
        let edge_faces = [h >> 2, surface.twin(h) >> 2];
        for (side, end) in ends.into_iter().enumerate() {
            self.look_from(surface, end, edge_faces, side);
        }
    }

    /// Walks around one end of the edge.
    #[inline(always)]
    fn look_from(&mut self, surface: &Surface, end: u32, edge_faces: [u32; 2], side: usize) {
        let near = &mut self.near[side];
        near.clear();
        let from = surface.at(end);
        let first = surface.points[end as usize].out;
        let (mut spoke, mut point) = (first, surface.end(first));
        let mut at = surface.at(point);
        loop {
            near.push(point);
            let incoming = previous(spoke);
            let after = surface.start(incoming);
            let at_after = surface.at(after);
            let normal = (at - from).cross(at_after - from);
            if !edge_faces.contains(&(spoke >> 2)) {
                let (points, sides) = ([point, after], [at, at_after]);
                let face = spoke >> 2;
                self.stays.push(Stays { points, before: normal, after: normal, face, from, sides });
            } else if side == 0 {
                // Of a face at the edge one of the two is the edge's other end.
                let first_is_end = spoke >> 2 == edge_faces[0];
                self.vanishes.push(Vanishes { opposite: if first_is_end { after } else { point }, normal });
            }
            (point, at) = (after, at_after);
            spoke = surface.twin(incoming);
            if spoke == first {
                return;
            }
            if spoke == NONE {
                near.push(point);
                return;
            }
        }
    }

    /// Whether the surface stays one (Dey, Edelsbrunner, Guha & Nekhayev 1999, "Topology
    /// preserving edge contraction"): the ends share no neighbours but the corners opposite the
    /// edge, no two boundaries meet, and something is left. `place_of` tells copies of a point, if there are any.
    pub(super) fn keeps_topology(
        &self,
        surface: &Surface,
        h: u32,
        place_of: Option<impl Fn(u32) -> u32>,
    ) -> bool {
        let inner = surface.twin(h) != NONE;
        if inner && surface.on_boundary(surface.start(h)) && surface.on_boundary(surface.end(h)) {
            return false;
        }
        // A tetrahedron, or a single triangle.
        let least = if inner { 3 } else { 2 };
        if self.near.iter().all(|near| near.len() == least) {
            return false;
        }
        let [near_start, near_end] = &self.near;
        let shared = match place_of {
            None => near_start.iter().filter(|v| near_end.contains(v)).count(),
            Some(place_of) => {
                let is_shared = |v: &&u32| near_end.iter().any(|&w| place_of(**v) == place_of(w));
                near_start.iter().filter(is_shared).count()
            }
        };
        shared == if inner { 2 } else { 1 }
    }

    /// Whether no face that stays turns over or becomes a sliver when its end moves to `place`, and none overhangs what is
    /// around it where none did: it may have turned little by little. Works out the normals after the step.
    pub(super) fn keeps_shape(&mut self, surface: &Surface, place: DVec3) -> bool {
        let (mut before, mut after) = (DVec3::ZERO, DVec3::ZERO);
        for face in &mut self.stays {
            let [p, q] = face.sides;
            face.after = (p - place).cross(q - place);
            if !(face.keeps_shape(place) && surface.faces[face.face as usize].looks_along(face.after)) {
                return false;
            }
            before += face.before;
            after += face.after;
        }
        self.before = self.vanishes.iter().fold(before, |sum, face| sum + face.normal);
        let folds_up = self.stays.iter().any(|face| is_steep(face.after, after, 0.0));
        !folds_up || self.is_folded(0.0)
    }

    /// Whether some of the normals before the step points elsewhere than all of them together: by more than this least
    /// cosine.
    fn is_folded(&self, least: f64) -> bool {
        let least2 = least * least * self.before.length_squared();
        self.stays.iter().any(|face| is_steep(face.before, self.before, least2))
            || self.vanishes.iter().any(|face| is_steep(face.normal, self.before, least2))
    }

    /// What it costs that the ends of the edge, which were at `from`, are off the surface once its point is at `place`:
    /// the squared distance, times √area of each face. To be asked after [`Ring::keeps_shape`].
    ///
    /// Where a thin sheet ends, all planes are about one, and to move along it costs nothing by their measure: the end
    /// would be cut off, farther with each step. So this counts where the surface is folded back on itself, and only there.
    pub(super) fn lost(&self, from: [DVec3; 2], place: DVec3) -> f64 {
        if !self.is_folded(FOLDED) {
            return 0.0;
        }
        let off = from.map(|end| {
            let squares = self.stays.iter().map(|face| square(end, [place, face.sides[0], face.sides[1]]));
            squares.fold(f64::INFINITY, f64::min)
        });
        let before =
            self.stays.iter().map(|face| face.before).chain(self.vanishes.iter().map(|face| face.normal));
        let weight: f64 = before.map(|normal| normal.length().sqrt()).sum();
        TIP * weight * off[0].max(off[1])
    }
}

/// Whether a normal points elsewhere than `all`, the sum of many: along it by less than the square root of `least2` in
/// terms of its own length.
#[inline(always)]
fn is_steep(normal: DVec3, all: DVec3, least2: f64) -> bool {
    let along = normal.dot(all);
    along < 0.0 || along * along < least2 * normal.length_squared()
}

impl Stays {
    /// Whether it neither turns too far nor becomes a sliver when its end moves to `place`.
    #[inline(always)]
    fn keeps_shape(&self, place: DVec3) -> bool {
        let [p, q] = self.sides;
        let (before, after) = (self.before.length_squared(), self.after.length_squared());
        let size_from =
            |end: DVec3| (q - p).length_squared() + (p - end).length_squared() + (q - end).length_squared();
        // Most faces are far from being slivers: those are not compared with what they were.
        let size = size_from(place);
        (is_no_sliver(after, size) || is_no_worse(after, size, before, size_from(self.from)))
            && has_not_turned(self.before, self.after, before, after)
    }
}

/// Neither a sliver nor worse than it was; squared normals and sums of squared sides.
#[inline(always)]
pub(super) fn is_no_worse(after: f64, size: f64, before: f64, old_size: f64) -> bool {
    let square = size * size;
    is_no_sliver(after, size)
        || (after * old_size * old_size >= before * square && after > ROUNDING * ROUNDING * square)
}

#[inline(always)]
fn is_no_sliver(after: f64, size: f64) -> bool {
    // 4√3·area/Σ side² where the area is half of the normal.
    const LEAST: f64 = LEAST_QUALITY * LEAST_QUALITY / 12.0;
    after >= LEAST * (size * size)
}

#[inline(always)]
fn has_not_turned(before: DVec3, after: DVec3, before2: f64, after2: f64) -> bool {
    let cosine = before.dot(after);
    before2 == 0.0 || (cosine > 0.0 && cosine * cosine > LEAST_COSINE * LEAST_COSINE * before2 * after2)
}
