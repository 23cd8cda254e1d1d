//! Property 17 on meshes that are no surface: reported, never a loop or a panic.

use super::METHODS;
use super::shapes::irregular;
use crate::Stress;
use crate::kit::Draw;
use a9_simplification::measure::Original;
use a9_simplification::{Goal, Method, Settings, Simplified, Stopped, simplify};
use common::math::Vec3;
use common::mesh::Mesh;

fn simplified(mesh: &Mesh, goal: Goal, method: Method) -> Result<Simplified, String> {
    let results = simplify(mesh, &[goal], &Settings { method, bound: true });
    Ok(results.map_err(|error| error.to_string())?.remove(0))
}

/// What holds for any mesh at all: an end with a reason, finite places, nothing new that is wrong.
fn sound(mesh: &Mesh, ratio: f64, method: Method) -> Result<Simplified, String> {
    let result = simplified(mesh, Goal::Ratio(ratio), method)?;
    let faces = result.mesh.triangles.len();
    if faces as f64 > mesh.triangles.len() as f64 * ratio + 1e-6 && result.stopped == Stopped::Reached {
        return Err(format!("{method:?} to {ratio}: {faces} faces, and it does not say why"));
    }
    if !result.mesh.positions.iter().all(|p| p.is_finite()) {
        return Err(format!("{method:?} to {ratio}: a vertex is not finite"));
    }
    Ok(result)
}

/// Bow-tie, fin, Möbius band, ball with inverted faces.
pub fn named(stress: &Stress) {
    for (name, mesh) in irregular() {
        let before = *Original::new(&mesh).topology();
        for method in METHODS {
            stress.case(format!("p17 {name}, {method:?}"), || {
                for ratio in [0.9, 0.5, 0.2, 0.0] {
                    let result = sound(&mesh, ratio, method)?;
                    let broken = before.broken_by(Original::new(&result.mesh).topology());
                    if result.irregular.held == 0 {
                        return Err("nothing is said about it".to_owned());
                    }
                    if !broken.is_empty() {
                        return Err(format!("to {ratio}: {}", broken.join("; ")));
                    }
                }
                Ok(0.0)
            });
        }
    }
}

/// Triangles over a few points, any three of them; sizes from 10⁻³⁰ to 10³⁰, points on a coarse
/// lattice, in a line or in a plane.
fn soup(draw: &mut Draw) -> Mesh {
    let size = draw.pick(&[1.0, 1.0, 1e-30, 1e30, 1e-3]);
    let (kind, points) = (draw.below(4), 3 + draw.below(30));
    let positions = (0..points).map(|_| {
        let p = draw.cube().as_vec3();
        let p = match kind {
            0 => p,
            1 => (p * 2.0).round(),
            2 => Vec3::new(p.x, 0.0, 0.0),
            _ => Vec3::new(p.x, p.y, 0.0),
        };
        p * size
    });
    let positions: Vec<Vec3> = positions.collect();
    let triangles = (0..draw.below(120)).map(|_| [(); 3].map(|()| draw.below(points) as u32)).collect();
    Mesh { positions, triangles, ..Mesh::default() }
}

/// Soups by every method to every ratio.
pub fn soups(stress: &Stress) {
    stress.run("p17 soups", 1701, 10_000, |draw| {
        let mesh = soup(draw);
        let (method, ratio) = (draw.pick(&METHODS), draw.pick(&[0.9, 0.5, 0.1, 0.0]));
        let result = sound(&mesh, ratio, method).map_err(|why| format!("{why}\n{mesh:?}"))?;
        Ok(result.mesh.triangles.len() as f64 / (mesh.triangles.len() as f64).max(1.0))
    });
}
