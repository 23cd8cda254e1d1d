//! A mesh made ready, and the levels that one run goes through.

use crate::collapse::accumulated::Accumulated;
use crate::collapse::against::Made;
use crate::collapse::build::{Built, build};
use crate::collapse::cost::Cost;
use crate::collapse::deviation::{closest, deviation};
use crate::collapse::melax::Curvature;
use crate::collapse::memoryless::Memoryless;
use crate::collapse::mend::Mender;
use crate::collapse::nearby::Nearby;
use crate::collapse::original::Original;
use crate::collapse::refit::Refit;
use crate::collapse::run::Run;
use crate::collapse::snapshot::Snapshot;
use crate::collapse::surface::Surface;
use crate::collapse::wedges::Wedges;
use crate::collapse::weld::{Welded, same, weld};
use crate::goal::{Irregular, Simplified, Stopped};
use common::math::Bounds;
use common::mesh::Mesh;
use std::collections::HashSet;

/// A mesh whose neighbourhoods are known.
pub(crate) struct Prepared<'a> {
    mesh: &'a Mesh,
    welded: Welded,
    built: Built,
    /// Triangles that are there already.
    repeated: HashSet<usize>,
    irregular: Irregular,
}

/// A run at some level.
pub(crate) trait Level: Clone {
    /// How many triangles there are.
    fn faces(&self) -> usize;

    /// Diagonal of the original's box.
    fn diagonal(&self) -> f64;

    /// Goes on until at most so many triangles are left; false if that cannot be.
    fn until(&mut self, faces: usize) -> bool;

    /// The mesh at this level; with the bound of its error if that is wanted.
    fn simplified(&self, stopped: Stopped, bound: bool) -> Simplified;

    /// The same for the last level of a run: what is not needed any more is let go before more is asked of the memory.
    fn into_simplified(self, stopped: Stopped, bound: bool) -> Simplified;
}

/// How a run is finished: by a fit to samples of the original.
#[derive(Clone, Copy)]
struct Finish {
    /// Samples for each point that is left, at most.
    samples: usize,
    /// Triangles of the original for each that is left from which on it is done.
    from: usize,
    /// How often samples are tied anew, at most.
    rounds: usize,
}

/// Triangles of the original for each that is left, from which on more than one round is worth its time.
const FEW: usize = 20;

/// As many samples as were found to lower the error.
const ALWAYS: Finish = Finish { samples: 32, from: 1, rounds: 3 };
/// Where it costs little.
const QUICKLY: Finish = Finish { samples: 8, from: FEW, rounds: 1 };
/// Points stay where the run put them.
const NEVER: Finish = Finish { samples: 0, from: usize::MAX, rounds: 0 };

struct Levels<'a, C: Cost> {
    prepared: &'a Prepared<'a>,
    run: Run<C>,
    finish: Finish,
}

impl<'a> Prepared<'a> {
    /// Welds the mesh and finds everyone's neighbours.
    pub(crate) fn new(mesh: &'a Mesh) -> Self {
        let welded = weld(&mesh.positions, &mesh.triangles);
        let triangles = || mesh.triangles.iter().map(|t| t.map(|v| welded.point_of[v as usize]));
        let proper = || triangles().filter(|&t| Original::is_proper(t));
        let mut repeated = HashSet::new();
        let mut built = build(&welded.places, proper());
        // A repeated triangle has the same edges; so there are none if nothing was cut.
        if built.cut.contains(&true) {
            repeated = repeats(triangles());
            if !repeated.is_empty() {
                let kept =
                    triangles().enumerate().filter(|(i, t)| Original::is_proper(*t) && !repeated.contains(i));
                built = build(&welded.places, kept.map(|(_, t)| t));
            }
        }
        let irregular = Irregular {
            collapsed: mesh.triangles.len() - built.surface.faces.len() - repeated.len(),
            repeated: repeated.len(),
            held: built.cut[..welded.places.len()].iter().filter(|&&cut| cut).count(),
        };
        Self { mesh, welded, built, repeated, irregular }
    }

    /// A run with memoryless quadrics, fitted to the original.
    pub(crate) fn memoryless(&self) -> impl Level {
        self.start(Memoryless::new, ALWAYS)
    }

    /// A run with accumulated quadrics.
    pub(crate) fn accumulated(&self) -> impl Level {
        self.start(Accumulated::new, QUICKLY)
    }

    /// A run with Melax's cost.
    pub(crate) fn melax(&self) -> impl Level {
        self.start(|_| Curvature, NEVER)
    }

    fn start<C: Cost>(&self, cost: impl Fn(&Surface) -> C, finish: Finish) -> Levels<'_, C> {
        let run = Run::new(self.built.clone(), self.wedges(), cost);
        Levels { prepared: self, run, finish }
    }

    fn wedges(&self) -> Option<Wedges> {
        let mesh = self.mesh;
        if mesh.normals.is_empty() && mesh.uvs.is_empty() {
            return None;
        }
        let proper = |t: &[u32; 3]| Original::is_proper(t.map(|v| self.welded.point_of[v as usize]));
        let kept = mesh.triangles.iter().enumerate().filter(|(i, t)| proper(t) && !self.repeated.contains(i));
        Some(Wedges::new(mesh, same(mesh), kept.map(|(_, t)| *t)))
    }
}

/// Which triangles are turned or plain copies of earlier ones.
fn repeats(triangles: impl Iterator<Item = [u32; 3]>) -> HashSet<usize> {
    let mut seen = HashSet::new();
    let turned = |[a, b, c]: [u32; 3]| [[a, b, c], [b, c, a], [c, a, b]].into_iter().min();
    let repeats = triangles.enumerate().filter(|&(_, t)| Original::is_proper(t) && !seen.insert(turned(t)));
    repeats.map(|(i, _)| i).collect()
}

impl<C: Cost> Levels<'_, C> {
    /// The mesh that is left, finished.
    fn finished(&self, mut snapshot: Snapshot, stopped: Stopped, bound: bool) -> Simplified {
        let Prepared { welded, built, irregular, .. } = self.prepared;
        let changed = snapshot.surface.alive < built.surface.faces.len();
        let mut against = 0;
        if changed {
            let near = closest(&built.surface, &snapshot.surface, &snapshot.becomes);
            self.fit(&mut snapshot, &near);
            against = self.mend(&mut snapshot, &near);
        }
        let error = bound.then(|| if changed { self.error(&snapshot) } else { 0.0 });
        let (mesh, becomes) = snapshot.mesh(&welded.point_of, self.run.wedges.as_ref());
        Simplified { mesh, stopped, error, against, becomes, irregular: *irregular }
    }

    /// Moves the points that are left to where the original wants them; `near` tells for each a point
    /// of the original that is close.
    fn fit(&self, snapshot: &mut Snapshot, near: &[u32]) {
        let Prepared { mesh, welded, built, .. } = self.prepared;
        let Finish { samples, from, rounds } = self.finish;
        let for_each = built.surface.faces.len() / snapshot.surface.alive.max(1);
        if for_each < from {
            return;
        }
        // Where few points are left, samples and rounds are cheap, and each has more to tell.
        let samples = samples.max(for_each / 4);
        let rounds = if for_each >= FEW { rounds } else { rounds.min(1) };
        let original = Original::new(mesh, welded, &built.surface);
        for round in 0..rounds {
            let refit = Refit::new(&original, &snapshot.surface, &snapshot.becomes, samples);
            // The first round brings back tips that got lost, however far.
            refit.apply(&mut snapshot.surface, &snapshot.fixed, (round > 0).then_some(near));
        }
    }

    /// Sees to it that no face looks against the original, and tells how many still do.
    fn mend(&self, snapshot: &mut Snapshot, near: &[u32]) -> usize {
        let original = &self.prepared.built.surface;
        let made = Made { original, left: &snapshot.surface, near, was: &snapshot.faces };
        let sorted = Nearby::new(original, made.mean_reach());
        let suspects = made.suspects(&sorted);
        Mender::new(&sorted, &snapshot.fixed, near, C::IS_QUICK).mend(&mut snapshot.surface, suspects)
    }

    /// Bound of the distance between what is left and the original, both ways.
    fn error(&self, snapshot: &Snapshot) -> f64 {
        let (original, left) = (&self.prepared.built.surface, &snapshot.surface);
        let near = closest(original, left, &snapshot.becomes);
        let there = deviation(left, original, &near);
        // Copies of points come after those that are told what they became.
        let held = |point: usize| self.run.original((snapshot.becomes.len() + point) as u32);
        let copies = (0..self.run.copies.len()).map(|copy| snapshot.becomes[held(copy) as usize]);
        let becomes: Vec<u32> = snapshot.becomes.iter().copied().chain(copies).collect();
        there.max(deviation(original, left, &becomes)) / original.scale
    }
}

impl<C: Cost> Clone for Levels<'_, C> {
    fn clone(&self) -> Self {
        Self { prepared: self.prepared, run: self.run.clone(), finish: self.finish }
    }
}

impl<C: Cost> Level for Levels<'_, C> {
    fn faces(&self) -> usize {
        self.run.surface.alive
    }

    fn diagonal(&self) -> f64 {
        let bounds = Bounds::of_points(self.prepared.welded.places.iter().copied());
        let size = bounds.max.as_dvec3() - bounds.min.as_dvec3();
        if bounds.is_empty() { 0.0 } else { size.length() }
    }

    fn until(&mut self, faces: usize) -> bool {
        self.run.until(faces)
    }

    fn simplified(&self, stopped: Stopped, bound: bool) -> Simplified {
        self.finished(Snapshot::take(&self.run), stopped, bound)
    }

    fn into_simplified(mut self, stopped: Stopped, bound: bool) -> Simplified {
        self.run.let_go_of_prices();
        let snapshot = Snapshot::take(&self.run);
        self.run.let_go_of_surface();
        self.finished(snapshot, stopped, bound)
    }
}
