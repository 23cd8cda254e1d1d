//! Is the result whole, and is it what was asked for?

use super::Row;
use super::contender::{self, Contender, Outcome};
use crate::sample::Sample;
use a9_simplification::measure::{Comparison, Original};
use common::cli::AppError;
use common::mesh::Mesh;

/// Numbers of threads that must make the same mesh.
const THREADS: [usize; 2] = [1, 3];

/// Runs a method and looks for everything that property 17 forbids. To ask for a bound of the error
/// must not change the mesh either.
///
/// # Errors
/// If it fails.
pub fn judge(
    contender: &Contender,
    mesh: &Mesh,
    original: &Original,
    ratio: f64,
    samples: usize,
) -> Result<Row, AppError> {
    let outcome = (contender.run)(mesh, ratio, true)?;
    let comparison = original.compare(&outcome.mesh, samples);
    let mut faults = original.topology().broken_by(&comparison.topology);
    faults.extend(of_shape(&comparison));
    faults.extend(of_goal(&outcome, mesh, ratio));
    let bound = outcome.bound.map(|bound| bound / original.diagonal());
    faults.extend(of_bound(bound, &comparison));
    if contender::is_ours(contender.name) {
        for threads in THREADS {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
            if pool.install(|| (contender.run)(mesh, ratio, false))?.mesh != outcome.mesh {
                faults.push(format!("another mesh on {threads} threads"));
            }
        }
    }
    let faces = outcome.mesh.triangles.len();
    Ok(Row { name: contender.name, faces, cpu: Sample::default(), comparison, bound, faults })
}

fn of_shape(comparison: &Comparison) -> Option<String> {
    let against = comparison.flips.faces;
    (against > 0).then(|| format!("{against} faces against the original"))
}

fn of_goal(outcome: &Outcome, mesh: &Mesh, ratio: f64) -> Option<String> {
    let (faces, most) = (outcome.mesh.triangles.len(), mesh.triangles.len() as f64 * ratio);
    let missed = faces as f64 > most && !outcome.stuck;
    missed.then(|| format!("{faces} faces are more than {most:.0}"))
}

/// No sample of either surface may be further off than is vouched for, but for the rounding of the
/// mesh to single precision.
fn of_bound(bound: Option<f64>, comparison: &Comparison) -> Option<String> {
    let (bound, seen) = (bound?, comparison.distance.hausdorff());
    let vouched = seen <= bound * (1.0 + 1e-6) + f64::from(f32::EPSILON);
    (!vouched).then(|| format!("vouches for {bound:.3e}, but is off by {seen:.3e}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simplify::part::part;

    fn faults(run: fn(&Mesh, f64, bool) -> Result<Outcome, AppError>) -> Vec<String> {
        let mesh = part(1_000);
        let contender = Contender { name: "somebody", run };
        judge(&contender, &mesh, &Original::new(&mesh), 0.5, 1_000).unwrap().faults
    }

    #[test]
    fn faults_are_found() {
        let all = |mesh: &Mesh, _, _| Ok(Outcome { mesh: mesh.clone(), stuck: true, bound: Some(0.0) });
        assert_eq!(faults(all), Vec::<String>::new());
        let torn = faults(|mesh, _, _| {
            let mut mesh = mesh.clone();
            mesh.triangles.truncate(600);
            mesh.triangles[0].swap(0, 1);
            Ok(Outcome { mesh, stuck: false, bound: Some(1e-9) })
        });
        for fault in
            ["Euler", "boundary loops", "against the original", "600 faces are more than 344", "vouches for"]
        {
            assert!(torn.iter().any(|f| f.contains(fault)), "{fault}: {torn:?}");
        }
    }
}
