//! Property 17: nothing is turned over.

use crate::shapes::{METHODS, generated, grid};
use a9_simplification::measure::Original;
use a9_simplification::{Goal, Settings, simplify};
use common::math::Vec3;
use common::mesh::Mesh;

const RATIOS: [f64; 4] = [0.5, 0.2, 0.1, 0.02];

/// No triangle of the result looks against all of the original's that are nearest to its middle, which is
/// for `measure` to say, and the simplifier says the same.
fn nothing_looks_against(name: &str, mesh: &Mesh) {
    let original = Original::new(mesh);
    for method in METHODS {
        let goals = RATIOS.map(Goal::Ratio);
        let levels = simplify(mesh, &goals, &Settings { method, bound: false }).unwrap();
        for (level, ratio) in levels.iter().zip(RATIOS) {
            let flips = original.compare(&level.mesh, 100).flips;
            assert_eq!((flips.faces, level.against), (0, 0), "{name} {method:?} {ratio}");
        }
    }
}

#[test]
fn p17_nothing_is_turned_over() {
    for recipe in ["sphere10k", "gyroid20k", "terrain20k"] {
        nothing_looks_against(recipe, &generated(recipe));
    }
}

#[test]
fn p17_nothing_is_turned_over_on_folds_and_in_creases() {
    let folds = grid(60, |u, v| Vec3::new(u, v, 0.15 * (40.0 * u).sin() * (31.0 * v).cos()));
    nothing_looks_against("folds", &folds);
    let creases = grid(60, |u, v| Vec3::new(u, v, 0.5 * ((8.0 * u).fract() - 0.5).abs()));
    nothing_looks_against("creases", &creases);
}
