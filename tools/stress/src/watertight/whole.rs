//! Property 1: rays from inside a closed mesh, aimed at corners, edges and middles, all hit.

use super::{from_inside, grid, must_hit, must_hit_together};
use crate::kit::{Placement, closed_meshes, geometry_of, placed};
use crate::{Stress, Trials};
use a6_kdtree::bvh::Bvh;
use a6_kdtree::kdtree::{KdTree, Options};
use common::accel::{Accel, List};
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

/// Rays from inside through a structure.
fn all_hit(
    stress: &Stress,
    name: String,
    (seed, trials): (u64, Trials),
    place: &Placement,
    accel: &dyn Accel,
) {
    stress
        .run(name, seed, trials, |draw| must_hit(accel, &from_inside(draw, &place.triangles, &place.inside)));
}

/// With those of [`trees`] 10⁷ rays in the quick tier. Three quarters of them are aimed at corners
/// and edges: more than 10⁸ in the full tier.
pub fn grids(stress: &Stress) {
    let meshes = closed_meshes();
    for (name, mesh) in &meshes {
        let place = here(name, mesh);
        let geometry = geometry_of(&place.triangles);
        let grid = grid(&geometry);
        let trials = shared(&meshes, 5_000_000, 60_000_000);
        all_hit(stress, format!("p01 grid, {name}"), (101, trials), &place, &grid);
    }
}

/// The kd-tree, and the hierarchy; there eight at a time, which `must_hit_together` asks for.
pub fn trees(stress: &Stress) {
    let meshes = closed_meshes();
    for (name, mesh) in &meshes {
        let place = here(name, mesh);
        let geometry = geometry_of(&place.triangles);
        let (tree, bvh) = (KdTree::new(&geometry, Options::default()), Bvh::new(&geometry));
        let trials = shared(&meshes, 2_500_000, 40_000_000);
        all_hit(stress, format!("p01 kd-tree, {name}"), (103, trials), &place, &tree);
        let eights = shared(&meshes, 2_500_000 / 8, 5_000_000);
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
        all_hit(stress, format!("p01 list, {name}"), (102, trials), &place, &list);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kit::convex_sphere;
    use crate::{Property, Tier, again, examine};

    /// The structure lacks a triangle, in which rays are lost.
    fn one_is_missing(stress: &Stress) {
        let place = here("planted", &convex_sphere(2));
        let mut fewer = place.triangles.clone();
        fewer.remove(17);
        let geometry = geometry_of(&fewer);
        let trials = Trials::new(20_000, 20_000);
        all_hit(stress, "planted".to_owned(), (105, trials), &place, &List::new(&geometry));
    }

    #[test]
    fn a_missing_triangle_is_found_and_its_ray_is_lost_again() {
        let check = one_is_missing;
        let planted = Property { number: 1, name: "p01_planted", promise: "does not hold", check };
        let rows = examine(&planted, Stress::new(1, planted.name, Tier::Quick, 5));
        let first = rows[0].first.clone().expect("rays are lost");
        assert!((10..2_000).contains(&rows[0].failures), "{}", rows[0].failures);
        assert!(first.text.contains("origin") && first.text.contains("0x"), "{}", first.text);
        let alone = again(&planted, Tier::Quick, 5, "planted", first.trial).expect("the row is there");
        assert_eq!((alone.trials, alone.first), (1, Some(first.clone())));
        let next = first.trial.map(|trial| trial + 1);
        let other = again(&planted, Tier::Quick, 5, "planted", next).expect("the row is there");
        assert_ne!(other.first, Some(first), "another trial is another ray");
    }
}
