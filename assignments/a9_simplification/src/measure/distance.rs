//! A9T4: how far two surfaces are apart.

use super::edges::Edges;
use super::samples::Samples;
use super::surface::Surface;
use super::tree::{Nearest, Tree};
use common::math::DVec3;
use rayon::prelude::*;
use std::ops::Range;

/// Points that one thread takes at a time; sums are added up in the order of these parts.
const PART: usize = 2048;

/// Distances from one surface to another, in units of the meshes or relative to something.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OneWay {
    /// Square root of the mean of squared distances over the area.
    pub rms: f64,
    /// Mean distance over the area.
    pub mean: f64,
    /// Largest distance that was met, among samples of the area, vertices and middles of edges: a
    /// lower bound of the one-sided Hausdorff distance.
    pub max: f64,
    /// The point of the first surface where that was.
    pub farthest: DVec3,
}

impl OneWay {
    /// From a surface to the triangles of a tree: `samples` points of its area, all vertices, and
    /// the middles of all edges. Infinite if there is something and the tree is empty.
    pub fn between(from: &Surface, edges: &Edges, to: &Tree, samples: usize) -> Self {
        let samples = Samples::new(from, samples);
        let mut found = Self::of(samples.len(), |i| samples.point(i), to);
        let point = |v: u32| from.welded.positions[v as usize].as_dvec3();
        let ends: Vec<[u32; 2]> = edges.iter().map(|edge| edge.vertices()).collect();
        let corners: &[u32] = from.welded.triangles.as_flattened();
        found.extend(to, corners.len(), |i| point(corners[i]));
        found.extend(to, ends.len(), |i| ends[i].map(point).iter().sum::<DVec3>() * 0.5);
        found
    }

    /// From some points, each of the same weight.
    pub fn of_points(points: &[DVec3], to: &Tree) -> Self {
        Self::of(points.len(), |i| points[i], to)
    }

    fn of(count: usize, point: impl Fn(usize) -> DVec3 + Sync, to: &Tree) -> Self {
        let sums: Vec<Sums> = parts(count).map(|range| Sums::of(range, &point, to)).collect();
        let all = sums.into_iter().fold(Sums::default(), Sums::and);
        let (max, farthest) = all.farthest.unwrap_or_default();
        let count = count.max(1) as f64;
        Self { rms: (all.squares / count).sqrt(), mean: all.distances / count, max, farthest }
    }

    /// The same, divided by a length (nothing happens to it if that is 0).
    #[must_use]
    pub fn relative_to(self, length: f64) -> Self {
        let unit = if length > 0.0 { length } else { 1.0 };
        Self { rms: self.rms / unit, mean: self.mean / unit, max: self.max / unit, ..self }
    }

    /// Takes the largest distance of further points into account. Most of them are known not to
    /// be the farthest as soon as one triangle near enough is found.
    fn extend(&mut self, to: &Tree, count: usize, point: impl Fn(usize) -> DVec3 + Sync) {
        let least = self.max * self.max;
        let farther = |range: Range<usize>| {
            let (mut worst, mut hint) = ((least, None), None);
            for i in range {
                let p = point(i);
                if let Some(nearest) = to.nearest_beyond(p, worst.0, hint) {
                    worst = (nearest.squared, Some(p));
                    hint = Some(nearest.place);
                } else if hint.is_none() {
                    hint = to.nearest(p, None).map(|nearest| nearest.place);
                }
            }
            worst
        };
        for (squared, at) in parts(count).map(farther).collect::<Vec<_>>() {
            if let (true, Some(p)) = (squared.sqrt() > self.max, at) {
                (self.max, self.farthest) = (squared.sqrt(), p);
            }
        }
    }
}

fn parts(count: usize) -> impl IndexedParallelIterator<Item = Range<usize>> {
    (0..count.div_ceil(PART)).into_par_iter().map(move |k| k * PART..count.min((k + 1) * PART))
}

/// Sums over some points.
#[derive(Default)]
struct Sums {
    squares: f64,
    distances: f64,
    farthest: Option<(f64, DVec3)>,
}

impl Sums {
    fn of(range: Range<usize>, point: impl Fn(usize) -> DVec3, to: &Tree) -> Self {
        let mut sums = Self::default();
        let mut last: Option<Nearest> = None;
        for p in range.map(point) {
            last = to.nearest(p, last.map(|n| n.place));
            let distance = last.map_or(f64::INFINITY, |n| n.distance());
            let one =
                Self { squares: distance * distance, distances: distance, farthest: Some((distance, p)) };
            sums = sums.and(one);
        }
        sums
    }

    /// Of these points and of those behind them.
    fn and(self, behind: Self) -> Self {
        let farther = |best: (f64, DVec3)| behind.farthest.is_some_and(|other| other.0 > best.0);
        Self {
            squares: self.squares + behind.squares,
            distances: self.distances + behind.distances,
            farthest: if self.farthest.is_none_or(farther) { behind.farthest } else { self.farthest },
        }
    }
}

/// Distances both ways between an original and what became of it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Distance {
    /// From the original to the other: what has got lost.
    pub forward: OneWay,
    /// From the other to the original: what has been made up.
    pub backward: OneWay,
}

impl Distance {
    /// Two-sided RMS distance √((a² + b²) / 2).
    pub fn rms(&self) -> f64 {
        ((self.forward.rms.powi(2) + self.backward.rms.powi(2)) / 2.0).sqrt()
    }

    /// Two-sided Hausdorff distance, as far as samples tell.
    pub fn hausdorff(&self) -> f64 {
        self.forward.max.max(self.backward.max)
    }
}
