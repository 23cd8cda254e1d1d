//! Faces that look against the original are put right.
//!
//! No step turns a face over. But many small turns add up, and a face drifts over ground that looks
//! elsewhere than the triangle it was once: on rough ground a few in a thousand end with a normal
//! that points against the original's where that is nearest to their middle. Here each of those has one
//! of its corners moved, by as little as will do.

use crate::collapse::against::middle;
use crate::collapse::locate::{locate, square};
use crate::collapse::nearby::Nearby;
use crate::collapse::ring::is_no_worse;
use crate::collapse::surface::{NONE, Surface, next, previous};
use crate::collapse::witness::{Vicinity, Witness};
use common::math::{DVec3, Vec3};

/// How far a corner is moved, in lengths of an edge: the first that helps is taken.
const STEPS: [f64; 9] = [0.03, 0.05, 0.08, 0.11, 0.16, 0.23, 0.34, 0.5, 0.75];
/// In how many directions, as points of a lattice on a side, and how often what still looks against the
/// original is tried again.
const FINENESS: [i32; 3] = [3, 4, FINEST];
const FINEST: i32 = 7;
/// How many samples of the original tell which of several moves is best.
const MOST_SAMPLES: usize = 60;

/// Moves points so that faces look along the original.
pub(super) struct Mender<'a> {
    original: &'a Surface,
    witness: Witness<'a>,
    /// Points that may not be moved.
    fixed: &'a [bool],
    /// For every point one of the original's that should be close.
    near: &'a [u32],
    is_quick: bool,
}

/// A point that may be moved.
struct Corner {
    point: u32,
    from: DVec3,
    /// Where to, as far as its edges are long.
    ways: Vec<DVec3>,
    spokes: Vec<Spoke>,
}

/// A face at such a point.
struct Spoke {
    face: u32,
    /// Its other two corners.
    sides: [DVec3; 2],
    /// What is near its middle.
    vicinity: Vicinity,
}

/// A better place for a point.
#[derive(Clone, Copy)]
struct Move {
    point: u32,
    place: Vec3,
    to: DVec3,
}

impl<'a> Mender<'a> {
    /// For surfaces of an original; for a quick one it is enough that the point that moves stays near that.
    pub(super) fn new(original: &'a Nearby<'a>, fixed: &'a [bool], near: &'a [u32], is_quick: bool) -> Self {
        Self { original: original.surface, witness: Witness(original), fixed, near, is_quick }
    }

    /// Moves corners of some faces until none of them looks against the original, and no other that
    /// does not do so already; tells how many still do.
    pub(super) fn mend(&self, surface: &mut Surface, mut faces: Vec<u32>) -> usize {
        for fineness in FINENESS {
            faces.retain(|&face| {
                if self.agrees(surface, face) {
                    return false;
                }
                let best = self.best_move(surface, face, fineness);
                if let Some(best) = best {
                    surface.points[best.point as usize].at = best.place;
                }
                best.is_none()
            });
        }
        faces.len()
    }

    fn agrees(&self, surface: &Surface, face: u32) -> bool {
        let points = surface.faces[face as usize].corners();
        let corners = points.map(|p| surface.at(p));
        let (middle, _) = middle(corners);
        self.witness.agrees(corners, self.farthest(points, middle))
    }

    /// What the original is not farther than from the middle of a face with some corners: what is found from one of them may
    /// be far from the nearest.
    fn farthest(&self, points: [u32; 3], middle: DVec3) -> f64 {
        let squares = points.map(|point| locate(self.original, self.near[point as usize], middle).0);
        squares.into_iter().fold(f64::INFINITY, f64::min).sqrt()
    }

    /// Of the least moves that help the one that is best for what is around.
    fn best_move(&self, surface: &Surface, face: u32, fineness: i32) -> Option<Move> {
        let points = surface.faces[face as usize].corners();
        let may_move = points.into_iter().filter(|&point| !self.fixed[point as usize]);
        let mut corners: Vec<Corner> = may_move.map(|point| self.corner(surface, point, fineness)).collect();
        let moves = |&step: &f64| -> Vec<Move> {
            corners.iter_mut().flat_map(|corner| self.moves(surface, face, corner, step)).collect()
        };
        let found = STEPS.iter().map(moves).find(|moves| !moves.is_empty())?;
        if let [only] = found[..] {
            return Some(only);
        }
        if self.is_quick {
            let off = |to: &Move| locate(self.original, self.near[to.point as usize], to.to).0;
            return found
                .into_iter()
                .map(|to| (off(&to), to))
                .min_by(|a, b| a.0.total_cmp(&b.0))
                .map(|(_, to)| to);
        }
        let samples = self.samples(surface, face);
        // Moves of one point follow each other.
        let mut now = (NONE, Vec::new());
        let judged = found.into_iter().map(|to| {
            if now.0 != to.point {
                now = (to.point, squares(&samples, surface, to.point, surface.at(to.point)));
            }
            let then = squares(&samples, surface, to.point, to.to);
            (then.iter().zip(&now.1).map(|(then, now)| then - now).sum::<f64>(), to)
        });
        judged.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, best)| best)
    }

    /// A point and where to it may be moved: all around it, but on the boundary only along that unless
    /// nothing else has helped.
    fn corner(&self, surface: &Surface, point: u32, fineness: i32) -> Corner {
        let from = surface.at(point);
        let ways = if surface.on_boundary(point) && fineness < FINEST {
            let first = surface.points[point as usize].out;
            let last = surface.fan(point).last().map_or(first, previous);
            [surface.end(first), surface.start(last)].map(|p| surface.at(p) - from).to_vec()
        } else {
            let lengths = surface.fan(point).map(|h| surface.at(surface.end(h)).distance(from));
            let (sum, count) = lengths.fold((0.0, 0.0), |(sum, count), length| (sum + length, count + 1.0));
            ways_from_middle(fineness).map(|way| way * (sum / count)).collect()
        };
        let spoke = |h: u32| {
            let [p, q] = sides(surface, h);
            let (middle, _) = middle([from, p, q]);
            let vicinity =
                Vicinity::of(middle, self.farthest(surface.faces[(h >> 2) as usize].corners(), middle));
            Spoke { face: h >> 2, sides: [p, q], vicinity }
        };
        Corner { point, from, ways, spokes: surface.fan(point).map(spoke).collect() }
    }

    /// Places for a corner, so far away, at which the face looks along the original and no other ceases to.
    fn moves(&self, surface: &Surface, face: u32, corner: &mut Corner, step: f64) -> Vec<Move> {
        let longest = corner.ways.iter().map(|way| way.length()).fold(0.0, f64::max);
        for spoke in &mut corner.spokes {
            // The middle moves by a third of it.
            self.witness.widen(&mut spoke.vicinity, longest * step * 0.34);
        }
        let moved = |way: &DVec3| {
            let place = surface.round(corner.from + *way * step);
            Move { point: corner.point, place, to: place.as_dvec3() * surface.scale }
        };
        corner.ways.iter().map(moved).filter(|to| corner.helps(face, to.to)).collect()
    }

    /// Middles of some of the original's faces around a face.
    fn samples(&self, surface: &Surface, face: u32) -> Vec<DVec3> {
        let (low, high) = around(surface, face);
        let samples = self.witness.middles_within(low, high);
        let stride = samples.len().div_ceil(MOST_SAMPLES).max(1);
        samples.into_iter().step_by(stride).collect()
    }
}

/// The box around all neighbours of a face's corners.
fn around(surface: &Surface, face: u32) -> (DVec3, DVec3) {
    let corners = surface.faces[face as usize].corners();
    let points =
        corners.into_iter().flat_map(|corner| surface.fan(corner)).map(|h| surface.at(surface.end(h)));
    let empty = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    points.fold(empty, |(low, high), p| (low.min(p), high.max(p)))
}

impl Corner {
    /// Whether a face looks along the original if the point moves, and no other ceases to.
    fn helps(&self, face: u32, to: DVec3) -> bool {
        let from = self.from;
        let keeps = |spoke: &Spoke| {
            let [p, q] = spoke.sides;
            let turns = (p - from).cross(q - from).dot((p - to).cross(q - to)) <= 0.0;
            (spoke.face == face || !turns) && keeps_shape(from, to, spoke.sides)
        };
        let agrees = |spoke: &Spoke, corner: DVec3| {
            let [p, q] = spoke.sides;
            spoke.vicinity.agrees([corner, p, q])
        };
        // What looks against the original already may do so a while longer.
        let others = |spoke: &Spoke| spoke.face == face || agrees(spoke, to) || !agrees(spoke, from);
        self.spokes.iter().all(keeps)
            && self.spokes.iter().filter(|spoke| spoke.face == face).all(|spoke| agrees(spoke, to))
            && self.spokes.iter().all(others)
    }
}

/// Directions from the middle of a cube to the points of a lattice, `n` on a side; also no direction.
fn ways_from_middle(n: i32) -> impl Iterator<Item = DVec3> {
    let middle = f64::from(n - 1) / 2.0;
    let point = move |i: i32| DVec3::new(f64::from(i % n), f64::from(i / n % n), f64::from(i / n / n));
    (0..n * n * n).map(move |i| (point(i) - middle).normalize_or_zero())
}

/// The other two corners of the face of a half-edge.
fn sides(surface: &Surface, h: u32) -> [DVec3; 2] {
    [next(h), previous(h)].map(|h| surface.at(surface.start(h)))
}

/// The squared distances of samples from the faces around a point if that were elsewhere.
/// What is far from all faces there does not count, as it is nearest to the rim, which stays.
fn squares(samples: &[DVec3], surface: &Surface, point: u32, at: DVec3) -> Vec<f64> {
    let least = |sample: &DVec3| {
        let squares = surface.fan(point).map(|h| {
            let [p, q] = sides(surface, h);
            square(*sample, [at, p, q])
        });
        squares.fold(f64::INFINITY, f64::min)
    };
    samples.iter().map(least).collect()
}

/// Whether a face is not made a sliver when one of its corners moves; the others are p and q.
fn keeps_shape(from: DVec3, to: DVec3, [p, q]: [DVec3; 2]) -> bool {
    let measure = |corner: DVec3| {
        let (u, w) = (p - corner, q - corner);
        (u.cross(w).length_squared(), (q - p).length_squared() + u.length_squared() + w.length_squared())
    };
    let ((after, size), (before, old_size)) = (measure(to), measure(from));
    is_no_worse(after, size, before, old_size)
}
