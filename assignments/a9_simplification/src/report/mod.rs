//! What is told of a simplification, as text ([`std::fmt::Display`]) or JSON ([`Report::json`]).

mod json;
mod text;

use crate::goal::{Goal, Irregular, Method, Simplified, Stopped};
use crate::measure::{Comparison, Original, Quality, Topology};
use std::time::{Duration, Instant};

/// One mesh and what became of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// The file, or whatever names the mesh.
    pub input: String,
    /// How it was simplified.
    pub method: Method,
    /// What it was like; `None` if nothing was measured.
    pub original: Option<Before>,
    /// What became of it.
    pub levels: Vec<Level>,
    /// Wall-clock time of each phase, in the order they happened. All levels come from one run.
    pub times: Vec<(&'static str, Duration)>,
}

/// A mesh before it is simplified.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Before {
    /// Diagonal of its box, in its own unit.
    pub diagonal: f64,
    /// How its triangles hang together.
    pub topology: Topology,
    /// How they are shaped.
    pub quality: Quality,
    /// Points of the area at which distances were taken.
    pub samples: usize,
}

/// One simplified mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// What was asked for; `None` of a mesh that somebody else simplified.
    pub goal: Option<Goal>,
    /// Triangles.
    pub faces: usize,
    /// Why it has no fewer.
    pub stopped: Stopped,
    /// The bound of the Hausdorff distance that the simplifier vouches for, in the mesh's own unit;
    /// NaN if none was asked for.
    pub bound: f64,
    /// Triangles that look against the original, for whose corners there was no better place.
    pub against: usize,
    /// What was found in the original that is no part of a surface.
    pub irregular: Irregular,
    /// What was measured.
    pub comparison: Option<Comparison>,
    /// What must be known to read its picture.
    pub notes: Vec<String>,
}

impl Report {
    /// Of a mesh of which nothing is known yet.
    pub fn new(input: &str, method: Method) -> Self {
        Self { input: input.to_owned(), method, original: None, levels: Vec::new(), times: Vec::new() }
    }

    /// Runs one phase and notes how long it took.
    pub fn time<T>(&mut self, phase: &'static str, work: impl FnOnce() -> T) -> T {
        let started = Instant::now();
        let result = work();
        self.times.push((phase, started.elapsed()));
        result
    }

    /// Notes what the original is like.
    pub fn describe(&mut self, original: &Original, samples: usize) {
        let (topology, quality) = (*original.topology(), *original.quality());
        self.original = Some(Before { diagonal: original.diagonal(), topology, quality, samples });
    }

    /// What a level broke that was whole before; nothing if that was not measured.
    pub fn broken(&self, level: &Level) -> Vec<String> {
        let (Some(before), Some(after)) = (&self.original, &level.comparison) else { return Vec::new() };
        let mut broken = before.topology.broken_by(&after.topology);
        if after.flips.turned > 0 {
            broken.push(format!("faces turned over: {}", after.flips.turned));
        }
        broken
    }

    /// What one might not expect: goals that were not reached, a mesh that is no surface.
    pub fn warnings(&self) -> Vec<String> {
        let irregular = self.levels.first().and_then(|level| text::irregular(&level.irregular));
        let against = self.levels.iter().filter(|level| level.against > 0).map(|level| {
            let (faces, against) = (level.faces, level.against);
            format!("of {faces} triangles {against} look against the original: ask for more triangles")
        });
        self.levels.iter().filter_map(Level::warning).chain(against).chain(irregular).collect()
    }

    /// A line for each level that was measured: how far it is from the original.
    pub fn distances(&self) -> Vec<String> {
        let line = |level: &Level| {
            let d = level.comparison.as_ref()?.distance;
            let (rms, hausdorff) = (d.rms(), d.hausdorff());
            Some(format!("{}: rms {rms:.3e}, hausdorff {hausdorff:.3e} of its diagonal", self.input))
        };
        self.levels.iter().filter_map(line).collect()
    }
}

impl Level {
    /// Of a result for a goal.
    pub fn new((goal, result): (Option<Goal>, &Simplified)) -> Self {
        Self {
            goal,
            faces: result.mesh.triangles.len(),
            stopped: result.stopped,
            bound: result.error.unwrap_or(f64::NAN),
            against: result.against,
            irregular: result.irregular,
            comparison: None,
            notes: Vec::new(),
        }
    }

    /// What came out, in a few words.
    pub fn summary(&self) -> String {
        format!("{} triangles, {}", self.faces, self.why())
    }

    /// Why there are no fewer triangles.
    fn why(&self) -> String {
        match (self.stopped, self.goal) {
            (_, None) => "as it was given".to_owned(),
            (Stopped::Stuck, _) => "no edge is left that may go".to_owned(),
            (Stopped::Reached, Some(Goal::Ratio(r))) => format!("ratio {r} reached"),
            (Stopped::Reached, Some(Goal::Faces(n))) => format!("{n} faces reached"),
            (Stopped::Reached, Some(Goal::Error(e))) => format!("the fewest that were found within {e}"),
        }
    }

    /// The warning that the goal was not reached, if it was not. To come to an end without having
    /// spent the whole error is no failure.
    pub fn warning(&self) -> Option<String> {
        let missed = self.stopped == Stopped::Stuck && !matches!(self.goal, Some(Goal::Error(_)));
        missed.then(|| format!("stopped at {} triangles: no edge is left that may go", self.faces))
    }
}

/// The method's name on the command line.
fn method(method: Method) -> &'static str {
    match method {
        Method::Qem => "qem",
        Method::Memoryless => "memoryless",
        Method::Melax => "melax",
    }
}

/// What counts as a fault or tells surfaces apart, with its name.
fn counts(t: &Topology) -> [(&'static str, i64); 13] {
    let n = |count: usize| count as i64;
    [
        ("faces", n(t.faces)),
        ("vertices", n(t.vertices)),
        ("edges", n(t.edges)),
        ("components", n(t.components)),
        ("euler", t.euler),
        ("boundary_edges", n(t.boundary_edges)),
        ("boundary_loops", n(t.boundary_loops)),
        ("non_manifold_edges", n(t.non_manifold_edges)),
        ("non_manifold_vertices", n(t.non_manifold_vertices)),
        ("inconsistent_edges", n(t.inconsistent_edges)),
        ("folded_edges", n(t.folded_edges)),
        ("duplicate_faces", n(t.duplicate_faces)),
        ("zero_area_faces", n(t.zero_area_faces)),
    ]
}
