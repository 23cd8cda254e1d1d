//! The entry: a mesh and goals in, meshes out.

use crate::collapse::{self, Level};
use crate::goal::{Goal, Method, Settings, Simplified, Stopped};
use common::mesh::Mesh;
use thiserror::Error;

/// More triangles cannot be numbered.
const MOST_TRIANGLES: usize = 1 << 29;

/// What makes a simplification impossible.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum SimplifyError {
    /// A coordinate is infinite or not a number.
    #[error("vertex {vertex} is not finite")]
    NotFinite {
        /// Number of the vertex, from 0.
        vertex: usize,
    },
    /// A triangle has a corner that does not exist.
    #[error("triangle {triangle} has corner {corner}, but there are {vertices} vertices")]
    NoSuchVertex {
        /// Number of the triangle, from 0.
        triangle: usize,
        /// The corner.
        corner: u32,
        /// How many vertices there are.
        vertices: usize,
    },
    /// There are normals or texture coordinates, but not one for each vertex.
    #[error("{given} {what} for {vertices} vertices")]
    Unaligned {
        /// "normals" or "texture coordinates".
        what: &'static str,
        /// How many there are.
        given: usize,
        /// How many vertices there are.
        vertices: usize,
    },
    /// A ratio outside [0, 1] or an error below 0.
    #[error("goal {goal} cannot be: {value}")]
    BadGoal {
        /// Number of the goal, from 0.
        goal: usize,
        /// What was asked for.
        value: f64,
    },
    /// More triangles than can be numbered.
    #[error("{0} triangles are too many")]
    TooMany(usize),
}

/// Simplifies a mesh in one run: one result for each goal, in their order. Goals should ask for less
/// and less; one that asks for more than the one before it gets the same again.
///
/// Vertices at the same place are one place; normals and texture coordinates are carried along.
/// The surface stays one: no hole opens or closes, no part vanishes, nothing turns over. The result
/// is the same on every machine.
///
/// # Errors
/// If the mesh or a goal makes no sense, see [`SimplifyError`].
pub fn simplify(mesh: &Mesh, goals: &[Goal], settings: &Settings) -> Result<Vec<Simplified>, SimplifyError> {
    check_mesh(mesh)?;
    goals.iter().enumerate().try_for_each(|(i, goal)| check_goal(i, goal))?;
    let prepared = collapse::Prepared::new(mesh);
    Ok(match settings.method {
        Method::Memoryless => levels(prepared.memoryless(), goals, settings.bound),
        Method::Qem => levels(prepared.accumulated(), goals, settings.bound),
        Method::Melax => levels(prepared.melax(), goals, settings.bound),
    })
}

fn check_mesh(mesh: &Mesh) -> Result<(), SimplifyError> {
    let vertices = mesh.positions.len();
    if mesh.triangles.len() > MOST_TRIANGLES {
        return Err(SimplifyError::TooMany(mesh.triangles.len()));
    }
    for (what, given) in [("normals", mesh.normals.len()), ("texture coordinates", mesh.uvs.len())] {
        if given != 0 && given != vertices {
            return Err(SimplifyError::Unaligned { what, given, vertices });
        }
    }
    if let Some(vertex) = mesh.positions.iter().position(|p| !p.is_finite()) {
        return Err(SimplifyError::NotFinite { vertex });
    }
    let corners = mesh.triangles.as_flattened();
    // Hardly ever is there one: that the largest is none is found sooner.
    let largest = corners.iter().fold(0, |largest, &corner| largest.max(corner));
    if (largest as usize) < vertices {
        return Ok(());
    }
    match corners.iter().position(|&corner| corner as usize >= vertices) {
        Some(i) => Err(SimplifyError::NoSuchVertex { triangle: i / 3, corner: corners[i], vertices }),
        None => Ok(()),
    }
}

fn check_goal(number: usize, goal: &Goal) -> Result<(), SimplifyError> {
    let (value, most) = match *goal {
        Goal::Faces(_) => return Ok(()),
        Goal::Ratio(ratio) => (ratio, 1.0),
        Goal::Error(error) => (error, f64::INFINITY),
    };
    if (0.0..=most).contains(&value) { Ok(()) } else { Err(SimplifyError::BadGoal { goal: number, value }) }
}

fn levels(mut levels: impl Level, goals: &[Goal], bound: bool) -> Vec<Simplified> {
    let (all, mut results) = (levels.faces(), Vec::with_capacity(goals.len()));
    let Some((last, before)) = goals.split_last() else { return results };
    for goal in before {
        let reached = reach(&mut levels, all, goal);
        results.push(reached.unwrap_or_else(|stopped| levels.simplified(stopped, bound)));
    }
    let reached = reach(&mut levels, all, last);
    results.push(reached.unwrap_or_else(|stopped| levels.into_simplified(stopped, bound)));
    results
}

/// Goes on to a goal: the mesh if it had to be made to know the error, else why the run stopped there.
fn reach(levels: &mut impl Level, all: usize, goal: &Goal) -> Result<Simplified, Stopped> {
    match *goal {
        Goal::Faces(faces) => Err(stop(levels, faces)),
        // What is meant by 0.1 is not the binary fraction a little above or below it.
        Goal::Ratio(ratio) => Err(stop(levels, (all as f64 * ratio + 1e-6).floor() as usize)),
        Goal::Error(error) => Ok(within(levels, error)),
    }
}

/// Goes on until at most so many faces are left, and tells why it stopped.
fn stop(levels: &mut impl Level, faces: usize) -> Stopped {
    if levels.until(faces) { Stopped::Reached } else { Stopped::Stuck }
}

/// Goes down in steps, each from a copy of the last level that was within the error; where a step is
/// too large it is halved (in its logarithm), until it is a few hundredths.
fn within(levels: &mut impl Level, error: f64) -> Simplified {
    const FIRST_STEP: f64 = 0.5;
    const LAST_STEP: f64 = 0.98;
    let limit = error * levels.diagonal();
    let mut best = levels.simplified(Stopped::Reached, true);
    let mut step = FIRST_STEP;
    while step < LAST_STEP {
        let mut trial = levels.clone();
        let faces = (trial.faces() as f64 * step) as usize;
        let stopped = stop(&mut trial, faces);
        let simplified = trial.simplified(stopped, true);
        if simplified.error.is_some_and(|error| error <= limit) && trial.faces() < levels.faces() {
            *levels = trial;
            best = simplified;
            if stopped == Stopped::Stuck {
                break;
            }
        } else {
            step = step.sqrt();
        }
    }
    best
}
