//! Property 17: a surface stays one, at every ratio, by every method.

use crate::shapes::{METHODS, generated, grid, normal, one};
use crate::topology::counts;
use a9_simplification::{Goal, Method, Settings, Stopped, simplify};
use common::math::Vec3;
use common::mesh::Mesh;

fn stays_whole(mesh: &Mesh) {
    let before = counts(mesh);
    for method in METHODS {
        let goals = [0.5, 0.1, 0.01].map(Goal::Ratio);
        let levels = simplify(mesh, &goals, &Settings { method, bound: false }).unwrap();
        for (level, ratio) in levels.iter().zip([0.5, 0.1, 0.01]) {
            assert_eq!(counts(&level.mesh), before, "{method:?} {ratio}");
            let most = (mesh.triangles.len() as f64 * ratio) as usize;
            assert!(
                level.mesh.triangles.len() <= most || level.stopped == Stopped::Stuck,
                "{method:?} {ratio}"
            );
            assert!(level.mesh.triangles.len() + 2 >= most, "no more than asked for");
            assert_eq!(level.becomes.len(), mesh.positions.len());
            assert!(level.becomes.iter().all(|&v| (v as usize) < level.mesh.positions.len()));
        }
    }
}

#[test]
fn p17_a_ball_stays_whole_and_looks_outward() {
    let ball = generated("sphere10k");
    stays_whole(&ball);
    for method in [Method::Qem, Method::Memoryless] {
        let mesh = one(&ball, Goal::Ratio(0.05), method).mesh;
        let inward = |t: &&[u32; 3]| normal(&mesh, **t).dot(mesh.positions[t[0] as usize]) <= 0.0;
        assert_eq!(mesh.triangles.iter().filter(inward).count(), 0, "{method:?}");
    }
}

#[test]
fn p17_a_gyroid_keeps_its_handles() {
    let gyroid = generated("gyroid20k");
    assert!(counts(&gyroid).euler < -10);
    stays_whole(&gyroid);
}

#[test]
fn p17_a_terrain_keeps_its_rim() {
    let terrain = generated("terrain10k");
    assert_eq!(counts(&terrain).loops, 1);
    stays_whole(&terrain);
}

#[test]
fn p17_holes_stay_open() {
    let mut holed = grid(30, |u, v| Vec3::new(u, v, 0.1 * (7.0 * u).sin() * (5.0 * v).cos()));
    let mut i = 0;
    holed.triangles.retain(|_| {
        i += 1;
        ![202, 203, 700, 704, 705, 1190].contains(&i)
    });
    assert!(counts(&holed).loops >= 4);
    stays_whole(&holed);
}

#[test]
fn one_run_gives_what_separate_runs_give() {
    let ball = generated("sphere5000");
    let goals = [Goal::Ratio(0.3), Goal::Faces(400), Goal::Ratio(0.5), Goal::Faces(100)];
    let levels = simplify(&ball, &goals, &Settings::default()).unwrap();
    for (level, goal) in levels.iter().zip(&goals).filter(|(_, goal)| **goal != Goal::Ratio(0.5)) {
        assert_eq!(level.mesh, one(&ball, *goal, Method::Memoryless).mesh);
    }
    assert_eq!(levels[2].mesh, levels[1].mesh, "there is no way back");
}

#[test]
fn scaling_by_a_power_of_two_changes_nothing_else() {
    let terrain = generated("terrain5000");
    for method in METHODS {
        let plain = one(&terrain, Goal::Ratio(0.1), method);
        for exponent in [-60, 60] {
            let factor = 2f32.powi(exponent);
            let mut scaled = terrain.clone();
            scaled.positions.iter_mut().for_each(|p| *p *= factor);
            let mut simplified = one(&scaled, Goal::Ratio(0.1), method);
            simplified.mesh.positions.iter_mut().for_each(|p| *p /= factor);
            assert_eq!(simplified.mesh, plain.mesh, "{method:?}");
            assert_eq!(simplified.error.unwrap(), plain.error.unwrap() * f64::from(factor));
        }
    }
}

#[test]
fn nothing_is_done_to_what_is_small_enough() {
    let ball = generated("sphere500");
    for method in METHODS {
        let same = one(&ball, Goal::Ratio(1.0), method);
        assert_eq!(same.mesh.triangles.len(), ball.triangles.len());
        assert_eq!(same.error, Some(0.0));
        assert_eq!(same.stopped, Stopped::Reached);
    }
}
