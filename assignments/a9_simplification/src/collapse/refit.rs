//! Moves the points that are left to where the original wants them.
//!
//! The middles of the original's triangles are samples; each is tied to the nearest place on the
//! simplified surface, which is a weighted mean of three points. The squared distances along the
//! normals there are a convex function of all points at once; it is lowered by moving each point
//! as if the others moved along as far as they have weight (majorisation by Jensen's inequality),
//! so that no system has to be solved.

use crate::collapse::locate::{Landing, locate};
use crate::collapse::original::Original;
use crate::collapse::quadric::Symmetric;
use crate::collapse::surface::{NONE, Surface, previous};
use common::math::DVec3;

/// How often points are moved.
const STEPS: usize = 2;
/// Samples that are further off count more, in proportion to their square over the mean square …
const FAR: f64 = 0.3;
/// … up to a limit, lest a single spike outweighs all that is around it.
const FARTHEST: f64 = 100.0;
/// How much a point resists, as a share of the weight of the triangles around it.
const INERTIA: f64 = 0.03;
/// How much it resists where nothing pulls, as a share of what does.
const LEAST_RANK: f64 = 1e-3;
/// Least cosine between a face and itself before, or the original where it is.
const LEAST_COSINE: f64 = 0.5;
/// Least share of its area that a face keeps in one move.
const LEAST_AREA: f64 = 0.1;

/// How far from the original a point may be moved, in terms of the root mean square of the samples.
const ASTRAY: f64 = 3.0;

/// What pulls at a point.
#[derive(Clone, Copy, Default)]
struct Pull {
    stiffness: Symmetric,
    force: DVec3,
}

/// The samples of an original, tied to a simplified surface.
pub(super) struct Refit<'a> {
    original: &'a Original<'a>,
    /// Every which triangle is a sample.
    stride: usize,
    landings: Vec<Landing>,
    /// For every face of the simplified surface the sum of the normals of what landed there.
    looks: Vec<DVec3>,
    /// Mean over the samples of the squared distance.
    mean_square: f64,
}

impl<'a> Refit<'a> {
    /// Ties the samples: `becomes` tells for every point of the original a point of the surface
    /// close by, [`NONE`] if there is none. No more than about `samples` are taken for each point
    /// that is left.
    pub(super) fn new(original: &'a Original, surface: &Surface, becomes: &[u32], samples: usize) -> Self {
        // There are half as many points as faces.
        let stride = (2 * original.triangles().len() / (surface.alive * samples).max(1)).max(1);
        let mut landings = Vec::with_capacity(original.triangles().len() / stride + 1);
        let mut looks = vec![DVec3::ZERO; surface.faces.len()];
        let (mut sum, mut weight) = (0.0, 0.0);
        for corners in original.triangles().step_by(stride) {
            let (centre, normal) = original.middle(corners);
            let found = Original::is_proper(corners).then(|| land(surface, becomes, corners, centre, normal));
            let Some((square, landing)) = found.flatten() else {
                landings.push(Landing::NOWHERE);
                continue;
            };
            let area = normal.length();
            (sum, weight) = (sum + area * square, weight + area);
            looks[landing.face as usize] += normal;
            landings.push(landing);
        }
        Self { original, stride, landings, looks, mean_square: sum / weight }
    }

    /// Moves the points of the surface, except those that are fixed or on the boundary. If `near` tells
    /// for each a point of the original that is close, none goes astray.
    pub(super) fn apply(&self, surface: &mut Surface, fixed: &[bool], near: Option<&[u32]>) {
        // Also not if it is not a number, because there are no samples.
        if self.mean_square > 0.0 {
            let areas: Vec<f64> = (0..surface.faces.len()).map(|i| surface.normal(i).length()).collect();
            for _ in 0..STEPS {
                let pulls = self.pulls(surface);
                self.move_points(surface, (fixed, near), &pulls, &areas);
            }
        }
    }

    fn pulls(&self, surface: &Surface) -> Vec<Pull> {
        let mut pulls = vec![Pull::default(); surface.points.len()];
        let samples = self.original.triangles().step_by(self.stride).zip(&self.landings);
        for (corners, landing) in samples.filter(|(_, landing)| landing.face != NONE) {
            let (centre, area_normal) = self.original.middle(corners);
            let (apart, along) = landing.apart(surface, centre);
            // Everything is divided by |along|² in the end, so that no root need be taken.
            let (reach, length2) = (apart.dot(along), along.length_squared());
            if length2 == 0.0 {
                continue;
            }
            let far = (reach * reach / (length2 * self.mean_square)).min(FARTHEST);
            let weight = area_normal.length() * (1.0 + FAR * far) / length2;
            let plane = Symmetric::outer(along, weight);
            let force = along * (weight * reach);
            let corners = surface.faces[landing.face as usize].corners();
            for (point, share) in corners.into_iter().zip(landing.weights) {
                let pull = &mut pulls[point as usize];
                pull.stiffness += plane * f64::from(share);
                pull.force += force * f64::from(share);
            }
        }
        pulls
    }

    fn move_points(
        &self,
        surface: &mut Surface,
        (fixed, near): (&[bool], Option<&[u32]>),
        pulls: &[Pull],
        areas: &[f64],
    ) {
        for point in 0..surface.points.len() as u32 {
            if fixed[point as usize] || surface.on_boundary(point) {
                continue;
            }
            let Pull { mut stiffness, force } = pulls[point as usize];
            let area: f64 = surface.fan(point).map(|h| areas[(h >> 2) as usize]).sum();
            stiffness.add_diagonal(INERTIA * area + LEAST_RANK * stiffness.trace());
            let step = stiffness.solve(force);
            let from = surface.at(point);
            for share in [1.0, 0.5] {
                let place = surface.round(from + step * share);
                let to = place.as_dvec3() * surface.scale;
                let strays = || near.is_some_and(|near| self.strays(near[point as usize], from, to));
                if self.may_move(surface, point, to) && !strays() {
                    surface.points[point as usize].at = place;
                    break;
                }
            }
        }
    }

    /// Whether a point would move away from the original, farther than most samples are.
    fn strays(&self, near: u32, from: DVec3, to: DVec3) -> bool {
        let square = |p: DVec3| locate(self.original.surface, near, p).0;
        let after = square(to);
        after > ASTRAY * ASTRAY * self.mean_square && after > square(from)
    }

    /// Whether the faces around go on looking where they look and where the original does.
    fn may_move(&self, surface: &Surface, point: u32, to: DVec3) -> bool {
        let from = surface.at(point);
        surface.fan(point).all(|h| {
            let [p, q] = [surface.at(surface.end(h)), surface.at(surface.start(previous(h)))];
            let (before, after) = ((p - from).cross(q - from), (p - to).cross(q - to));
            let look = self.looks[(h >> 2) as usize];
            let shrinks = after.length_squared() <= LEAST_AREA * LEAST_AREA * before.length_squared();
            !shrinks
                && turns_less(before, after)
                && (turns_less(after, look) || brings_nearer(before, after, look))
        })
    }
}

/// Where the middle of a triangle of the original lands, and how far away. Around one of its corners the
/// nearest may be on another side of a sharp edge: if the face there looks elsewhere, the other corners are
/// asked, too, and what looks against the triangle is none of its business.
fn land(
    surface: &Surface,
    becomes: &[u32],
    corners: [u32; 3],
    centre: DVec3,
    normal: DVec3,
) -> Option<(f64, Landing)> {
    let mut best = (f64::INFINITY, Landing::NOWHERE);
    for corner in corners {
        let start = becomes[corner as usize];
        if start == NONE {
            return None;
        }
        let found = locate(surface, start, centre);
        if found.0 < best.0 {
            best = found;
        }
        let look = surface.normal(best.1.face as usize);
        if turns_less(look, normal) {
            return Some(best);
        }
    }
    let looks_along = surface.normal(best.1.face as usize).dot(normal) > 0.0;
    let apart = best.1.apart(surface, centre).0;
    let beside = apart.dot(normal).powi(2) < 0.25 * apart.length_squared() * normal.length_squared();
    (looks_along || (!best.1.is_inside() && beside)).then_some(best)
}

/// Whether the angle between two vectors has at least the least cosine; also if one is zero.
fn turns_less(a: DVec3, b: DVec3) -> bool {
    let dot = a.dot(b);
    dot >= 0.0 && dot * dot >= LEAST_COSINE * LEAST_COSINE * a.length_squared() * b.length_squared()
}

/// Whether `after` makes a smaller angle with `look` than `before` does.
fn brings_nearer(before: DVec3, after: DVec3, look: DVec3) -> bool {
    before.dot(look) * after.length() <= after.dot(look) * before.length()
}

impl Landing {
    /// The way from where a sample landed to where it is, and the direction in which that counts:
    /// along the normal of the face, or straight if it landed on the face's rim.
    #[inline(always)]
    fn apart(&self, surface: &Surface, sample: DVec3) -> (DVec3, DVec3) {
        let [a, b, c] = surface.places(self.face as usize);
        let [u, v, w] = [f64::from(self.weights[0]), f64::from(self.weights[1]), f64::from(self.weights[2])];
        let apart = sample - (a * u + b * v + c * w);
        (apart, if self.is_inside() { (b - a).cross(c - a) } else { apart })
    }
}
