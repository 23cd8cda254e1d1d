//! Who takes part.

use a9_simplification::{Goal, Method, Settings, Stopped, simplify};
use common::cli::AppError;
use common::mesh::Mesh;

/// A way to simplify.
#[derive(Clone, Copy)]
pub struct Contender {
    /// What it is called in tables.
    pub name: &'static str,
    /// From a mesh and a share of its triangles to a mesh of at most as many, with a bound of its
    /// error if that is asked for and can be had.
    pub run: fn(&Mesh, f64, bool) -> Result<Outcome, AppError>,
}

/// What comes out.
pub struct Outcome {
    /// The mesh.
    pub mesh: Mesh,
    /// Whether it says that it could do no more.
    pub stuck: bool,
    /// The Hausdorff distance that it vouches for, in the mesh's unit.
    pub bound: Option<f64>,
}

const OURS: [Contender; 3] = [
    Contender { name: "qem", run: |mesh, ratio, bound| ours(mesh, ratio, bound, Method::Qem) },
    Contender { name: "memoryless", run: |mesh, ratio, bound| ours(mesh, ratio, bound, Method::Memoryless) },
    Contender { name: "melax", run: |mesh, ratio, bound| ours(mesh, ratio, bound, Method::Melax) },
];

#[cfg(feature = "peers")]
const PEERS: &[Contender] = &super::peers::ALL;
#[cfg(not(feature = "peers"))]
const PEERS: &[Contender] = &[];

/// Whether that is one of ours, which must keep all promises.
pub fn is_ours(name: &str) -> bool {
    OURS.iter().any(|c| c.name == name)
}

/// The contenders of these names, or all.
///
/// # Errors
/// If there is none of a name.
pub fn chosen(names: &[String]) -> Result<Vec<Contender>, AppError> {
    let all = || OURS.iter().chain(PEERS).copied();
    if names.is_empty() {
        return Ok(all().collect());
    }
    let find = |name: &String| {
        let known: Vec<&str> = all().map(|c| c.name).collect();
        let unknown =
            || AppError::Usage(format!("no method is called {name}; there are {}", known.join(", ")));
        all().find(|c| c.name == name).ok_or_else(unknown)
    };
    names.iter().map(find).collect()
}

fn ours(mesh: &Mesh, ratio: f64, bound: bool, method: Method) -> Result<Outcome, AppError> {
    let mut results = simplify(mesh, &[Goal::Ratio(ratio)], &Settings { method, bound })?;
    let result = results.remove(0);
    Ok(Outcome { mesh: result.mesh, stuck: result.stopped == Stopped::Stuck, bound: result.error })
}
