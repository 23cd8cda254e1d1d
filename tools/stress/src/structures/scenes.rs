//! Property 10: on every scene and every mesh of `scenes/`.

use super::any_interval;
use crate::kit::{Draw, agree, aim, committed_scenes, file_mesh, repository, scene_of, structures};
use crate::{Stress, Trials};
use a5_grid::Fit;
use common::accel::{Accel, List};
use common::camera::Camera;
use common::geometry::Geometry;
use common::math::{Bounds, Vec3};
use common::ray::Ray;

/// Rays for each scene and mesh in the full tier. Where there are so many primitives that the list
/// would take hours, it answers the first of them, and the others are held to the grid's answers.
const FULL_RAYS: u64 = 1_000_000;

/// A camera ray, a ray through the box, or one aimed at an edge or a corner.
fn scene_ray(draw: &mut Draw, camera: &Camera, geometry: &Geometry, around: &Bounds) -> Ray {
    let (min, max) = (around.min, around.max);
    match draw.below(4) {
        0 => camera.ray((draw.unit(), draw.unit())),
        1 if !geometry.triangles().is_empty() => {
            let origin = draw.point(min - (max - min), max + (max - min));
            aim(draw, geometry.triangles(), origin)
        }
        2 => Ray::new(draw.point(min, max), draw.direction().as_vec3()),
        _ => {
            let origin = draw.point(min - (max - min), max + (max - min));
            Ray::new(origin, draw.point(min, max) - origin)
        }
    }
}

/// A geometry with structures of all kinds around it.
fn geometry_agrees(stress: &Stress, name: &str, geometry: &Geometry, camera: &Camera) {
    let around = geometry.bounds().unwrap_or(Bounds { min: -Vec3::ONE, max: Vec3::ONE });
    let reach = around.size().max_element().max(1.0);
    let list = List::new(geometry);
    let size = geometry.len() as u64;
    let counts: &[[u32; 3]] =
        if size > 2000 { &[[40, 40, 33]] } else { &[[1, 1, 1], [7, 10, 3], [24, 1, 17]] };
    let mut grids: Vec<_> = counts.iter().map(|&n| (n, Fit::Exact)).collect();
    grids.push(([9, 8, 7], Fit::Bounds));
    list.validate().unwrap_or_else(|e| panic!("{name}: {e}"));
    let others = structures(geometry, &grids);
    let ray = |draw: &mut Draw| (scene_ray(draw, camera, geometry, &around), any_interval(draw, reach));
    // As many rays as keep the list's triangle tests to a number, within reason.
    let by_list = |tests: u64, least, most| (tests / size.max(1)).clamp(least, most);
    let by_list = Trials::new(by_list(2_000_000, 200, 2_000), by_list(1_200_000_000, 100_000, FULL_RAYS));
    stress.run(format!("p10 {name}"), 1001, by_list, |draw| {
        let (ray, interval) = ray(draw);
        agree(&list, &others, &ray, interval)
    });
    let rest = FULL_RAYS - by_list.full;
    if rest > 0 && stress.tier().is_thorough() {
        let (grid, others) = others.split_first().expect("a grid");
        stress.run(format!("p10 {name}, against the grid"), 1003, Trials::new(0, rest), |draw| {
            let (ray, interval) = ray(draw);
            agree(&*grid.accel, others, &ray, interval)
        });
    }
}

/// Every ray-traced scene of the repository.
pub fn scenes(stress: &Stress) {
    for (name, scene) in committed_scenes() {
        let geometry = Geometry::build(&scene).unwrap_or_else(|e| panic!("{name}: {e}"));
        geometry_agrees(stress, &name, &geometry, &Camera::new(&scene.camera));
    }
}

/// Every mesh of the repository by itself.
pub fn meshes(stress: &Stress) {
    let folder = repository().join("scenes/meshes");
    let entries = std::fs::read_dir(folder).expect("the meshes of the repository");
    let names = entries.map(|e| e.expect("a folder entry").file_name().to_string_lossy().into_owned());
    let mut names: Vec<String> = names.filter(|name| name.ends_with(".obj")).collect();
    names.sort();
    for name in names {
        let scene = scene_of("TriangleMesh { obj_file it }", file_mesh(&name));
        let geometry = Geometry::build(&scene).unwrap_or_else(|e| panic!("{name}: {e}"));
        geometry_agrees(stress, &format!("mesh {name}"), &geometry, &Camera::new(&scene.camera));
    }
}
