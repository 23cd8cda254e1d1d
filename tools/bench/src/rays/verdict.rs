//! Answers held against the truth.

use super::contender::{Answer, Contender};
use super::sets::RaySet;
use crate::sample::Sample;
use crate::truth::{Line, Truth, cosine};
use crate::world::World;
use common::math::UNIT_ROUNDOFF;
use common::ray::Ray;
use rayon::prelude::*;

/// Rays that are answered together: enough for streams of rays from everywhere.
const BATCH: usize = 1 << 18;
/// Roundings to single precision that a t of another triangle may be off by, at right angles.
const ROUNDINGS: f64 = 64.0;
/// Cosine of the flattest angle that still excuses more rounding than steeper ones: at most
/// 4·10⁻⁴ of the distance.
const FLATTEST: f64 = 0.01;
/// Errors of t are relative to t, but to no less than this share of the mesh's diagonal: beside
/// the surface that a ray leaves, rounding of the origin is all there is.
const NEAREST: f64 = 1e-3;

/// What was wrong with a contender's answers to a set.
#[derive(Clone, Debug, Default)]
pub struct Verdict {
    /// Rays that were asked.
    pub asked: usize,
    /// Truly a hit, said to be none.
    pub missed: usize,
    /// Truly none, said to be a hit.
    pub false_hits: usize,
    /// Another triangle, at a t that rounding does not explain.
    pub wrong: usize,
    /// Any-hit answers that differ from the truth.
    pub any_wrong: usize,
    /// Relative errors of t of all right hits.
    pub error: Sample,
    /// The first wrong answer of each kind: the ray's place in the set, the truth, the answer.
    pub cases: Vec<(&'static str, usize, Truth, Answer)>,
}

/// The kinds of wrong answer; the first is right.
const KINDS: [&str; 4] = ["", "missed", "false hit", "wrong surface"];

/// Asks a contender all rays of a set, with all threads, or as many as it can afford.
pub fn judge(world: &World, set: &RaySet, contender: &dyn Contender) -> Verdict {
    let step = set.rays.len().div_ceil(contender.affordable()).max(1);
    let places: Vec<usize> = (0..set.rays.len()).step_by(step).collect();
    let rays: Vec<Ray> = places.iter().map(|i| set.rays[*i]).collect();
    let mut answers = vec![Answer::MISS; rays.len()];
    let mut any = vec![false; rays.len()];
    let batches = rays.par_chunks(BATCH).zip(answers.par_chunks_mut(BATCH)).zip(any.par_chunks_mut(BATCH));
    batches.for_each(|((rays, answers), any)| {
        contender.nearest_batch(rays, set.reach, answers);
        contender.any_batch(rays, set.reach, any);
    });
    let mut verdict = Verdict { asked: rays.len(), ..Verdict::default() };
    for ((place, answer), any) in places.into_iter().zip(answers).zip(any) {
        verdict.note(world, &set.rays[place], place, set.truth[place], answer);
        if any != set.truth[place].is_hit() {
            verdict.any_wrong += 1;
            verdict.keep("any hit", place, set.truth[place], answer);
        }
    }
    verdict.error.sort();
    verdict
}

impl Verdict {
    /// Wrong answers of all kinds.
    pub fn wrong(&self) -> usize {
        self.missed + self.false_hits + self.wrong + self.any_wrong
    }

    fn note(&mut self, world: &World, ray: &Ray, place: usize, truth: Truth, answer: Answer) {
        let kind = kind(world, ray, truth, answer);
        match kind {
            0 => {}
            1 => self.missed += 1,
            2 => self.false_hits += 1,
            _ => self.wrong += 1,
        }
        if kind == 0 && truth.is_hit() {
            let length = f64::from(ray.direction.length());
            let off = (f64::from(answer.t) - truth.t).abs() * length;
            self.error.add(off / (truth.t * length).max(NEAREST * world.diagonal()));
        } else if kind > 0 {
            self.keep(KINDS[kind], place, truth, answer);
        }
    }

    /// Keeps the first case of each kind.
    fn keep(&mut self, kind: &'static str, place: usize, truth: Truth, answer: Answer) {
        if !self.cases.iter().any(|(known, ..)| *known == kind) {
            self.cases.push((kind, place, truth, answer));
        }
    }
}

/// Which of [`KINDS`] an answer is.
///
/// Another triangle than the true one is right if its t agrees within rounding, as at a common
/// edge. How far single precision throws t grows with the distance, with the coordinates, and as
/// the angle between ray and triangle closes.
fn kind(world: &World, ray: &Ray, truth: Truth, answer: Answer) -> usize {
    match (truth.is_hit(), answer.is_hit()) {
        (false, false) => return 0,
        (true, false) => return 1,
        (false, true) => return 2,
        _ if truth.primitive == answer.primitive => return 0,
        _ => {}
    }
    let line = Line::new(ray);
    let length = line.direction.length();
    let flat = |primitive: u32| cosine(line.direction, world.corners(primitive));
    let angle = flat(truth.primitive).min(flat(answer.primitive)).max(FLATTEST);
    let size = truth.t * length + line.origin.abs().max_element();
    let off = (f64::from(answer.t) - truth.t).abs() * length;
    // Ordered so that a NaN is wrong.
    if off <= ROUNDINGS * UNIT_ROUNDOFF * size / angle { 0 } else { 3 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rays::sets;
    use crate::truth::{MISS, Tree};

    /// Says what the truth says, but lies about every ray whose place ends in the given digits.
    struct Liar<'a> {
        set: &'a RaySet,
        lie: fn(Answer) -> Answer,
    }

    impl Liar<'_> {
        fn truth(&self, ray: &Ray) -> (usize, Answer) {
            let place = self.set.rays.iter().position(|r| r == ray).unwrap();
            let truth = self.set.truth[place];
            (place, Answer { t: truth.t as f32, primitive: truth.primitive })
        }
    }

    impl Contender for Liar<'_> {
        fn nearest(&self, ray: &Ray, _: f32) -> Answer {
            let (place, answer) = self.truth(ray);
            if place % 8 == 3 { (self.lie)(answer) } else { answer }
        }
        fn any(&self, ray: &Ray, _: f32) -> bool {
            self.truth(ray).1.is_hit()
        }
        fn bytes(&self) -> Option<usize> {
            None
        }
    }

    #[test]
    fn every_kind_of_lie_is_seen() {
        let world = World::named("sphere1k").unwrap();
        let tree = Tree::new(&world.mesh);
        let set = &sets::make(&world, &tree, 32, &["random".to_owned()])[0];
        let count = |hit: bool| (3..1024).step_by(8).filter(|i| set.truth[*i].is_hit() == hit).count();
        let judged = |lie| judge(&world, set, &Liar { set, lie });
        let honest = judged(|a| a);
        assert!(honest.cases.is_empty() && honest.asked == 1024 && honest.error.quantile(1.0) < 1e-7);
        let lost = judged(|_| Answer::MISS);
        assert_eq!((lost.missed, lost.false_hits, lost.wrong), (count(true), 0, 0));
        let seen = judged(|a| if a.is_hit() { a } else { Answer { t: 1.0, primitive: 0 } });
        assert_eq!((seen.missed, seen.false_hits, seen.wrong), (0, count(false), 0));
        let other =
            judged(|a| if a.is_hit() { Answer { t: a.t * 1.1, primitive: a.primitive ^ 1 } } else { a });
        assert_eq!((other.missed, other.false_hits, other.wrong), (0, 0, count(true)));
        assert_eq!(other.cases.len(), 1);
        let neighbour = judged(|a| if a.is_hit() { Answer { primitive: a.primitive ^ 1, ..a } } else { a });
        assert!(neighbour.cases.is_empty(), "another triangle at the same t is right");
        assert_eq!(Answer::MISS.primitive, MISS);
    }
}
