//! Property 1: rays from inside a closed mesh, aimed at corners, edges and middles, all hit.

use super::{from_inside, grid, must_hit, must_hit_together};
use crate::kit::{Placement, closed_meshes, geometry_of, placed};
use crate::{Stress, Trials};
use a6_kdtree::bvh::Bvh;
use a6_kdtree::kdtree::{KdTree, Options};
use common::accel::List;
use common::math::DVec3;
use common::mesh::Mesh;
use common::ray::Ray;

/// So many trials for all meshes together.
fn shared(meshes: &[(&'static str, Mesh)], quick: u64, full: u64) -> Trials {
    let count = meshes.len() as u64;
    Trials::new(quick / count, full / count)
}

/// A mesh as it is, with points inside.
fn here(name: &str, mesh: &Mesh) -> Placement {
    let place = placed(mesh, 1.0, DVec3::ZERO, (40_000 / mesh.triangles.len()).clamp(4, 64));
    assert!(place.inside.len() >= 4, "{name}: no point inside");
    place
}

/// Three quarters of the rays are aimed at corners and edges: with those of [`trees`] more than
/// 10⁸ in the full tier.
pub fn grids(stress: &Stress) {
    let meshes = closed_meshes();
    for (name, mesh) in &meshes {
        let place = here(name, mesh);
        let geometry = geometry_of(&place.triangles);
        let grid = grid(&geometry);
        stress.run(format!("p01 grid, {name}"), 101, shared(&meshes, 10_000_000, 60_000_000), |draw| {
            must_hit(&grid, &from_inside(draw, &place.triangles, &place.inside))
        });
    }
}

/// The kd-tree, and the hierarchy; there eight at a time, which `must_hit_together` asks for.
pub fn trees(stress: &Stress) {
    let meshes = closed_meshes();
    for (name, mesh) in &meshes {
        let place = here(name, mesh);
        let geometry = geometry_of(&place.triangles);
        let (tree, bvh) = (KdTree::new(&geometry, Options::default()), Bvh::new(&geometry));
        stress.run(format!("p01 kd-tree, {name}"), 103, shared(&meshes, 5_000_000, 40_000_000), |draw| {
            must_hit(&tree, &from_inside(draw, &place.triangles, &place.inside))
        });
        let eights = shared(&meshes, 5_000_000 / 8, 5_000_000);
        stress.run(format!("p01 hierarchy (8 rays each), {name}"), 104, eights, |draw| {
            let first = from_inside(draw, &place.triangles, &place.inside);
            let bundled = draw.chance(0.5);
            let rays = [(); 8].map(|()| match bundled {
                true => Ray::new(first.origin, first.direction + (draw.cube() * 0.02).as_vec3()),
                false => from_inside(draw, &place.triangles, &place.inside),
            });
            must_hit_together(&bvh, &rays)
        });
    }
}

/// No structure at all.
pub fn lists(stress: &Stress) {
    for (name, mesh) in closed_meshes() {
        let place = here(name, &mesh);
        let geometry = geometry_of(&place.triangles);
        let list = List::new(&geometry);
        let trials = (10_000_000 / mesh.triangles.len() as u64).clamp(500, 30_000);
        let trials = Trials::new(trials, 30 * trials);
        stress.run(format!("p01 list, {name}"), 102, trials, |draw| {
            must_hit(&list, &from_inside(draw, &place.triangles, &place.inside))
        });
    }
}
