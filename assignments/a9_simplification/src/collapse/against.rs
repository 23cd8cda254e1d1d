//! Which faces look against the original? Those whose normals point away from every triangle that is
//! nearest to their middles.
//!
//! To find the nearest of all triangles for each face takes as long as a fast simplification. But most
//! faces have no triangle near by that looks another way: it is enough to know some distance that is
//! no less than that of the nearest, and to hold the original against balls of that radius.

use crate::collapse::balls::{Ball, Balls};
use crate::collapse::cells::Cells;
use crate::collapse::locate::{locate, nearest};
use crate::collapse::surface::{Face, Surface};
use common::math::DVec3;

/// How much larger a ball is than it need be, lest rounding leave something out.
const LARGER: f64 = 1.0 + 1e-9;

/// How many samples of the original are taken around a suspect.
const MOST_SAMPLES: usize = 60;

/// A simplified face that may look against the original, and how far one looks around it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Suspect {
    pub face: u32,
    pub around: Ball,
}

/// The original near a suspect.
pub(super) struct Witness<'a> {
    original: &'a Surface,
    around: Ball,
    near: Vec<u32>,
    cells: Cells<'a>,
}

/// All faces that look against the original, and perhaps a few that do not. `near` tells for every point of the surface
/// one of the original's that should be close, `was` for every face which of the original's it was.
pub(super) fn suspects(original: &Surface, surface: &Surface, near: &[u32], was: &[u32]) -> Vec<Suspect> {
    let ball = |(i, face): (usize, &Face)| {
        let [a, b, c] = face.corners();
        let (first, p, q) = (surface.at(a), surface.at(b), surface.at(c));
        let centre = (first + p + q) / 3.0;
        let any = original.at(near[a as usize]).distance_squared(centre);
        let square = square(original, was[i], centre).min(any);
        (Ball { centre, radius: square.sqrt() * LARGER }, (p - first).cross(q - first))
    };
    let balls = Balls::new(surface.faces.iter().enumerate().map(ball).collect(), mean_side(original));
    // For every face the squared distance of the nearest that looks another way.
    let mut against = vec![f64::INFINITY; balls.all.len()];
    for (i, face) in (0..).zip(&original.faces) {
        let [a, b, c] = face.corners();
        let (a, b, c) = (original.at(a), original.at(b), original.at(c));
        let (low, high, normal) = (a.min(b).min(c), a.max(b).max(c), (b - a).cross(c - a));
        balls.near(low, high, |face, looks| {
            if normal.dot(looks) < 0.0 {
                let (ball, nearest) = (&balls.all[face as usize].0, &mut against[face as usize]);
                if ball.meets(low, high) {
                    *nearest = nearest.min(square(original, i, ball.centre));
                }
            }
        });
    }
    let found = |(i, &(around, looks)): (usize, &(Ball, DVec3))| {
        let corner = surface.faces[i].corners()[0];
        if against[i] > around.radius * around.radius {
            return None;
        }
        let (square, landing) = locate(original, near[corner as usize], around.centre);
        let agrees = original.normal(landing.face as usize).dot(looks) >= 0.0;
        let is_nearer = square <= same_distance(against[i], around.centre).powi(2);
        (!(agrees && is_nearer)).then_some(Suspect { face: i as u32, around })
    };
    balls.all.iter().enumerate().filter_map(found).collect()
}

/// What cannot be told from the distance from a point, whose square is given: distances are no better
/// than coordinates.
fn same_distance(square: f64, from: DVec3) -> f64 {
    square.sqrt() + 8.0 * f64::EPSILON * from.abs().max_element()
}

/// Mean length of some sides.
fn mean_side(surface: &Surface) -> f64 {
    let stride = 1 + surface.faces.len() / 1000;
    let side = |[a, b, _]: [u32; 3]| (surface.at(a) - surface.at(b)).length();
    let sides = surface.faces.iter().step_by(stride);
    sides.map(|face| side(face.corners())).sum::<f64>() * stride as f64 / surface.faces.len().max(1) as f64
}

/// Squared distance to a face.
#[inline(always)]
fn square(surface: &Surface, face: u32, p: DVec3) -> f64 {
    let [a, b, c] = surface.faces[face as usize].corners();
    let (a, b, c) = (surface.at(a), surface.at(b), surface.at(c));
    let [u, v, w] = nearest(p, a, b, c);
    (a * u + b * v + c * w).distance_squared(p)
}

impl<'a> Witness<'a> {
    /// For every suspect one that knows the original around it.
    pub(super) fn all(original: &'a Surface, suspects: &[Suspect]) -> Vec<Self> {
        let balls =
            Balls::new(suspects.iter().map(|suspect| (suspect.around, ())).collect(), mean_side(original));
        let mut near = vec![Vec::new(); suspects.len()];
        for (i, face) in (0..).zip(&original.faces) {
            let [a, b, c] = face.corners();
            let (a, b, c) = (original.at(a), original.at(b), original.at(c));
            let (low, high) = (a.min(b).min(c), a.max(b).max(c));
            balls.near(low, high, |ball, ()| {
                let near = &mut near[ball as usize];
                if balls.all[ball as usize].0.meets(low, high) && near.last() != Some(&i) {
                    near.push(i);
                }
            });
        }
        let witness = |(near, suspect): (Vec<u32>, &Suspect)| Self {
            original,
            around: suspect.around,
            cells: Cells::of(original, &near),
            near,
        };
        near.into_iter().zip(suspects).map(witness).collect()
    }

    /// Whether a triangle looks along something of all that is nearest to its middle, and that is
    /// not too far away to be known.
    pub(super) fn agrees(&self, [a, b, c]: [DVec3; 3]) -> bool {
        let (middle, normal) = ((a + b + c) / 3.0, (b - a).cross(c - a));
        let along = |face: u32| normal.dot(self.original.normal(face as usize)) >= 0.0;
        let (square, nearest) = self.cells.nearest(middle);
        let reach = same_distance(square, middle);
        let known = self.around.centre.distance(middle) + reach <= self.around.radius;
        known && (along(nearest) || self.cells.any_within(middle, reach, along))
    }

    /// Middles of some of the original's faces around the suspect.
    pub(super) fn samples(&self) -> impl Iterator<Item = DVec3> {
        let stride = self.near.len().div_ceil(MOST_SAMPLES).max(1);
        let middle = |&face: &u32| {
            let [a, b, c] = self.original.faces[face as usize].corners();
            (self.original.at(a) + self.original.at(b) + self.original.at(c)) / 3.0
        };
        self.near.iter().step_by(stride).map(middle)
    }
}
