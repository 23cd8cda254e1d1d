//! Answers of triangle tests, held against what must be so of a closed body.

use super::kernel::Contender;
use super::meshes::{Body, CLASSES};
use crate::numerics::draw::Draw;
use crate::sample::Sample;
use crate::truth::Line;
use crate::world::World;
use common::ray::Ray;

/// Share of the product of lengths below which double precision does not vouch for the sign of a
/// volume.
const VAGUE: f64 = 1e-13;
/// An answer farther off than this share of t is another surface.
const FAR_OFF: f64 = 1e-3;
/// 2⁻²³.
const EPS: f64 = f32::EPSILON as f64;

/// What was wrong with the answers of one contender.
#[derive(Clone, Debug, Default)]
pub struct Verdict {
    /// By class: rays from inside that meet nothing in front of them.
    pub missed: [u64; CLASSES.len()],
    /// By class: rays from inside that meet an even number of walls, none included.
    pub even: [u64; CLASSES.len()],
    /// Nearest hits that are at no wall that may be the nearest.
    pub astray: u64,
    /// Relative errors of t of the other nearest hits, in 2⁻²³.
    pub error: Sample,
}

/// The nearest wall by double precision: that which is certain, and those before it that are
/// possible within its rounding, since the ray touches an edge.
struct Nearest {
    certain: f64,
    possible: Vec<f64>,
}

fn truth(world: &World, ray: &Ray) -> Nearest {
    let line = Line::new(ray);
    let mut nearest = Nearest { certain: f64::INFINITY, possible: Vec::new() };
    for triangle in 0..world.triangles() as u32 {
        let corners = world.corners(triangle);
        let [u, v, w] = line.volumes(corners);
        let (least, most) = (u.min(v).min(w), u.max(v).max(w));
        let reach = corners.iter().map(|p| (p.as_dvec3() - line.origin).length()).fold(0.0, f64::max);
        let vague = VAGUE * line.direction.length() * reach * reach;
        if least < -vague && most > vague {
            continue;
        }
        let t = line.crosses_plane(corners);
        if t > 0.0 && t.is_finite() {
            if least > vague || most < -vague {
                nearest.certain = nearest.certain.min(t);
            } else {
                nearest.possible.push(t);
            }
        }
    }
    let certain = nearest.certain;
    nearest.possible.retain(|t| *t < certain);
    nearest
}

/// Asks all contenders `rays` rays of each class.
pub fn judge(body: &Body, contenders: &[Box<dyn Contender + '_>], rays: usize) -> Vec<Verdict> {
    let mut verdicts = vec![Verdict::default(); contenders.len()];
    let (mut draw, mut found) = (Draw::new(20_130_628), Vec::new());
    for class in 0..CLASSES.len() {
        for _ in 0..rays {
            let ray = body.ray(class, &mut draw);
            let nearest = truth(&body.world, &ray);
            for (contender, verdict) in contenders.iter().zip(&mut verdicts) {
                found.clear();
                contender.crossings(&ray, &mut found);
                verdict.count(class, &found);
                verdict.compare(contender.nearest(&ray), &nearest);
            }
        }
    }
    verdicts.iter_mut().for_each(|verdict| verdict.error.sort());
    verdicts
}

impl Verdict {
    fn count(&mut self, class: usize, found: &[f64]) {
        let ahead = found.iter().filter(|t| **t > 0.0).count();
        self.missed[class] += u64::from(ahead == 0);
        self.even[class] += u64::from(ahead % 2 == 0);
    }

    fn compare(&mut self, t: f64, nearest: &Nearest) {
        if t == f64::INFINITY {
            // Counted as missed.
            return;
        }
        let error = |truth: &f64| ((t - truth) / truth).abs();
        let error = nearest.possible.iter().map(error).fold(error(&nearest.certain), f64::min);
        // Ordered so that NaN is astray.
        if error <= FAR_OFF {
            self.error.add(error / EPS);
        } else {
            self.astray += 1;
        }
    }
}
