//! Property 17 on meshes that are whole: methods × ratios × numbers of threads.

use super::METHODS;
use crate::Stress;
use crate::kit::{convex_sphere, fan, file_mesh, lumpy_sphere};
use a9_simplification::measure::{Comparison, Original};
use a9_simplification::{Goal, Method, Settings, Simplified, Stopped, simplify};
use common::math::Vec3;
use common::mesh::Mesh;
use modeller::generated::Recipe;
use rayon::prelude::*;

/// Points of either surface that are looked at.
const SAMPLES: usize = 5_000;

/// `sphere5000` and the like.
fn generated(recipe: &str) -> Mesh {
    let made = recipe.parse::<Recipe>().unwrap_or_else(|why| panic!("{why}")).make();
    let positions = made.positions.into_iter().map(Vec3::from_array).collect();
    Mesh { positions, triangles: made.triangles, ..Mesh::default() }
}

/// Closed ones, one with a boundary, some with sharp edges, some with vertices of many triangles.
fn meshes(stress: &Stress) -> Vec<(String, Mesh)> {
    let thorough = stress.tier().is_thorough();
    let recipes: &[&str] = match thorough {
        true => &["sphere40k", "gyroid40k", "terrain40k", "sphere1000", "gyroid3000", "terrain3000"],
        false => &["sphere2000", "gyroid1000", "terrain1000"],
    };
    let files: &[&str] = match thorough {
        true => &["cube", "diamond", "logo", "vase", "bunny_200", "bunny_1k", "bunny_5k", "bunny_40k"],
        false => &["cube", "diamond", "bunny_1k"],
    };
    let mut all: Vec<(String, Mesh)> = recipes.iter().map(|r| ((*r).to_owned(), generated(r))).collect();
    all.extend(files.iter().map(|name| ((*name).to_owned(), file_mesh(&format!("{name}.obj")))));
    let level = if thorough { 5 } else { 3 };
    all.push(("lumpy sphere".to_owned(), lumpy_sphere(level, 17)));
    all.push(("convex sphere".to_owned(), convex_sphere(level)));
    all.push(("split square fans".to_owned(), fan(64, 17)));
    all
}

/// Every mesh × method × ratio. The value is the distance as a share of what was vouched for.
pub fn whole(stress: &Stress) {
    let (ratios, threads): (&[f64], &[usize]) = match stress.tier().is_thorough() {
        true => (&[1.0, 0.9, 0.5, 0.25, 0.1, 0.03, 0.01, 0.001, 0.0], &[1, 2, 3, 7, 16]),
        false => (&[0.5, 0.1, 0.0], &[1, 3]),
    };
    for (name, mesh) in meshes(stress) {
        let original = Original::new(&mesh);
        for method in METHODS {
            stress.case(format!("p17 {name}, {method:?}, all ratios"), || {
                // Sheets thinner than the error leave some faces no place to look along the original.
                let told = |ratio| method == Method::Melax || name.starts_with("gyroid") && ratio <= 0.001;
                let judged = ratios
                    .par_iter()
                    .map(|&ratio| judge(&mesh, &original, method, ratio, (threads, told(ratio))));
                judged.try_reduce(|| 0.0, |a, b| Ok(a.max(b)))
            });
        }
    }
}

fn run(mesh: &Mesh, method: Method, ratio: f64, bound: bool) -> Result<Simplified, String> {
    let results = simplify(mesh, &[Goal::Ratio(ratio)], &Settings { method, bound });
    Ok(results.map_err(|error| error.to_string())?.remove(0))
}

/// One result, by everything that the property forbids; if `told`, faces against the original are
/// forgiven as far as the result itself tells of them.
fn judge(
    mesh: &Mesh,
    original: &Original,
    method: Method,
    ratio: f64,
    (threads, told): (&[usize], bool),
) -> Result<f64, String> {
    let result = run(mesh, method, ratio, true)?;
    let comparison = original.compare(&result.mesh, SAMPLES);
    let mut faults = original.topology().broken_by(&comparison.topology);
    let (faces, most) = (result.mesh.triangles.len(), mesh.triangles.len() as f64 * ratio + 1e-6);
    if faces as f64 > most && result.stopped != Stopped::Stuck {
        faults.push(format!("{faces} faces are more than {most:.0}, and it does not say why"));
    }
    if comparison.flips.faces > if told { result.against } else { 0 } {
        faults.push(format!("{} faces against the original", comparison.flips.faces));
    }
    for &count in threads {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build().map_err(|e| e.to_string())?;
        if pool.install(|| run(mesh, method, ratio, false))?.mesh != result.mesh {
            faults.push(format!("another mesh on {count} threads"));
        }
    }
    let share = share_of_bound(original, &result, &comparison)?;
    if share > 1.0 {
        faults.push(format!("off by {share} of what it vouches for"));
    }
    if faults.is_empty() { Ok(share) } else { Err(format!("to {ratio}: {}", faults.join("; "))) }
}

/// The measured distance over the one vouched for, which may be a little off by the rounding of
/// the mesh to single precision.
fn share_of_bound(original: &Original, result: &Simplified, found: &Comparison) -> Result<f64, String> {
    let bound = result.error.ok_or("no bound of the error, although it was asked for")?;
    let allowed = bound / original.diagonal() * (1.0 + 1e-6) + f64::from(f32::EPSILON);
    Ok(found.distance.hausdorff() / allowed)
}
