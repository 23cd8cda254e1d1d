//! The grid must never change a picture: through any grid, every scene of the course gives the
//! same film as through the list, bit for bit, and every camera ray the same hit.

use common::scene::{self, Material};
use std::collections::BTreeSet;
use tests::stage::Stage;
use tests::{CommandLine, cost, workspace_file};

/// From a single cell to the finest grid of the course.
const GRIDS: [[u32; 3]; 4] = [[1, 1, 1], [7, 5, 3], [20, 20, 20], [40, 40, 33]];

/// The scene files of the course's command lines, each once.
fn scenes() -> BTreeSet<String> {
    CommandLine::of_ray_tracers().iter().map(|line| line.scene().to_owned()).collect()
}

/// Side of a picture, so that brute force takes a fraction of a second.
fn side(primitives: usize) -> u32 {
    const RAY_TESTS: f64 = 2e6;
    (RAY_TESTS / primitives as f64).sqrt().clamp(64.0, 120.0) as u32
}

/// The flags of the pictures to compare: everything on, and in scenes with glass both ways of
/// casting shadows, since they ask the structure different questions.
fn variants(scene: &str) -> Vec<String> {
    let read = scene::load(&workspace_file(scene)).unwrap_or_else(|error| panic!("{error}"));
    let side = side(cost::primitives(&read));
    let all = format!("-size {side} {} -shadows -bounces 3 -shade_back", side * 3 / 4);
    let is_glass = |m: &Material| matches!(m, Material::Phong(p) if p.transparent != Default::default());
    let glass = read.materials.iter().any(is_glass);
    let filtered = glass.then(|| format!("{all} -transparent_shadows"));
    [all].into_iter().chain(filtered).collect()
}

/// Compares all grids with the list, and returns how many pictures were compared.
fn compare(scene: &str, flags: &str) -> usize {
    let stage = Stage::open(scene, flags);
    let list = stage.list();
    let expected = stage.films(list.as_accel());
    let grids = GRIDS.iter().filter_map(|&cells| Some((cells, stage.grid(cells)?)));
    let mut compared = 0;
    for (cells, grid) in grids {
        grid.as_accel().validate().unwrap_or_else(|why| panic!("{scene}, grid {cells:?}: {why}"));
        let difference = expected.first_difference(&stage.films(grid.as_accel()));
        assert_eq!(difference, None, "{scene} {flags}: list and grid {cells:?}");
        compared += 1;
    }
    compared
}

#[test]
fn a5t3_the_grid_never_changes_a_picture() {
    let scenes = scenes();
    let compared: usize =
        scenes.iter().flat_map(|scene| variants(scene).into_iter().map(move |f| compare(scene, &f))).sum();
    println!("{} scenes, {compared} pairs of pictures, no bit different", scenes.len());
    assert!(compared >= 4 * (scenes.len() - 1), "only {compared} pictures compared");
}
