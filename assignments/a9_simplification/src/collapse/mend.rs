//! Faces that look against the original are put right.
//!
//! No step turns a face over. But many small turns add up, and a face drifts over ground that looks
//! elsewhere than the triangle it was once: on rough ground a few in a thousand end with a normal
//! that points against the original's where that is nearest to their middle. Here each of those has one
//! of its corners moved, by as little as will do.

use crate::collapse::against::{Suspect, Witness};
use crate::collapse::balls::Ball;
use crate::collapse::locate::nearest;
use crate::collapse::ring::is_no_worse;
use crate::collapse::surface::{Surface, next, previous};
use common::math::{DVec3, Vec3};

/// How far a corner is moved, in lengths of an edge: the first that helps is taken.
const STEPS: [f64; 9] = [0.03, 0.05, 0.08, 0.11, 0.16, 0.23, 0.34, 0.5, 0.75];
/// How often all faces that still look against the original are tried again.
const ROUNDS: usize = 3;

/// A better place for a point, and by how much more the original would be off.
struct Move {
    point: u32,
    place: Vec3,
    worse: f64,
}

/// Moves points that are not fixed until no suspect looks against the original; tells how many
/// still do.
pub(super) fn mend(surface: &mut Surface, original: &Surface, fixed: &[bool], suspects: Vec<Suspect>) -> usize {
    let suspects: Vec<Suspect> = suspects.into_iter().map(|suspect| suspect.with_room(surface)).collect();
    let witnesses = Witness::all(original, &suspects);
    let mut left: Vec<_> = suspects.iter().zip(&witnesses).collect();
    for _ in 0..ROUNDS {
        left.retain(|(suspect, witness)| {
            let Some(best) = suspect.best_move(witness, surface, fixed) else { return false };
            if let Some(best) = &best {
                surface.points[best.point as usize].at = best.place;
            }
            best.is_none()
        });
        if left.is_empty() {
            break;
        }
    }
    left.len()
}

impl Suspect {
    /// Looks as far as its corners may move.
    fn with_room(self, surface: &Surface) -> Self {
        let Ball { centre, radius } = self.around;
        let fans = surface.faces[self.face as usize].corners().map(|corner| surface.fan(corner));
        let neighbours = fans.into_iter().flatten().flat_map(|h| [next(h), previous(h)]);
        let farthest = neighbours.map(|h| surface.at(surface.start(h)).distance(centre)).fold(0.0, f64::max);
        Self { around: Ball { centre, radius: farthest + 2.0 * radius }, ..self }
    }

    /// The least move that helps, if there is any; `None` if nothing is wrong.
    fn best_move(&self, witness: &Witness, surface: &Surface, fixed: &[bool]) -> Option<Option<Move>> {
        let corners = surface.faces[self.face as usize].corners();
        if witness.agrees(corners.map(|point| surface.at(point))) {
            return None;
        }
        let may_move = |point: &&u32| !fixed[**point as usize];
        let moves = |&step: &f64| -> Vec<Move> {
            let points = corners.iter().filter(may_move);
            points.flat_map(|&point| self.moves(witness, surface, point, step)).collect()
        };
        let found = STEPS.iter().map(moves).find(|moves| !moves.is_empty());
        Some(found.and_then(|moves| moves.into_iter().min_by(|a, b| a.worse.total_cmp(&b.worse))))
    }

    /// Places for a corner at which the face looks along the original and no other ceases to: all
    /// around it, but on the boundary only along that.
    fn moves(&self, witness: &Witness, surface: &Surface, point: u32, step: f64) -> Vec<Move> {
        let from = surface.at(point);
        let ways: Vec<DVec3> = if surface.on_boundary(point) {
            let first = surface.points[point as usize].out;
            let last = surface.fan(point).last().map_or(first, previous);
            [surface.end(first), surface.start(last)].map(|p| surface.at(p) - from).to_vec()
        } else {
            let lengths = surface.fan(point).map(|h| surface.at(surface.end(h)).distance(from));
            let (sum, count) = lengths.fold((0.0, 0.0), |(sum, count), length| (sum + length, count + 1.0));
            (0..27).map(|i| on_cube(i).normalize_or_zero() * (sum / count)).collect()
        };
        let moved = |way: DVec3| {
            let place = surface.round(from + way * step);
            let to = place.as_dvec3() * surface.scale;
            let helps = self.helps(witness, surface, point, to);
            helps.then(|| Move { point, place, worse: worse(witness, surface, point, to) })
        };
        ways.into_iter().filter_map(moved).collect()
    }

    /// Whether the face looks along the original when a point is moved, and no other ceases to.
    fn helps(&self, witness: &Witness, surface: &Surface, point: u32, to: DVec3) -> bool {
        let from = surface.at(point);
        let keeps = |h: u32| {
            let [p, q] = sides(surface, h);
            let turns = (p - from).cross(q - from).dot((p - to).cross(q - to)) <= 0.0;
            (h >> 2 == self.face || !turns) && keeps_shape(from, to, [p, q])
        };
        let agrees = |h: u32, corner: DVec3| {
            let [p, q] = sides(surface, h);
            witness.agrees([corner, p, q])
        };
        // What looks against the original already may do so a while longer.
        let others = |h: u32| h >> 2 == self.face || agrees(h, to) || !agrees(h, from);
        surface.fan(point).all(keeps)
            && surface.fan(point).filter(|h| h >> 2 == self.face).all(|h| agrees(h, to))
            && surface.fan(point).all(others)
    }
}

/// Corners, middles of sides and of faces of a cube; the thirteenth is its middle.
fn on_cube(i: i32) -> DVec3 {
    DVec3::new(f64::from(i % 3), f64::from(i / 3 % 3), f64::from(i / 9)) - 1.0
}

/// The other two corners of the face of a half-edge.
fn sides(surface: &Surface, h: u32) -> [DVec3; 2] {
    [next(h), previous(h)].map(|h| surface.at(surface.start(h)))
}

/// By how much the sum of the squares of the original's distances grows when a point is moved.
/// What is far from all faces there does not count, as it is nearest to the rim, which stays.
fn worse(witness: &Witness, surface: &Surface, point: u32, to: DVec3) -> f64 {
    let square = |sample: DVec3, corner: DVec3| {
        let squares = surface.fan(point).map(|h| {
            let [p, q] = sides(surface, h);
            let [u, v, w] = nearest(sample, corner, p, q);
            (corner * u + p * v + q * w).distance_squared(sample)
        });
        squares.fold(f64::INFINITY, f64::min)
    };
    let from = surface.at(point);
    witness.samples().map(|sample| square(sample, to) - square(sample, from)).sum()
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
