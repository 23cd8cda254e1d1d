//! Smooth meshes: interpolated normals for light, the flat triangle for everything else.

mod support;

use common::math::{DVec3, Vec3};
use common::mesh::Mesh;
use common::scene::Scene;
use oracle::{Model, Options, Range, World, render};
use support::{close, ray, scene_with_mesh};

/// An octahedron around the origin.
fn octahedron() -> Mesh {
    let positions = vec![Vec3::X, Vec3::Y, Vec3::Z, -Vec3::X, -Vec3::Y, -Vec3::Z];
    let triangles =
        vec![[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2], [1, 0, 5], [3, 1, 5], [4, 3, 5], [0, 4, 5]];
    Mesh { positions, triangles, ..Mesh::default() }
}

fn scene(mesh: Mesh, object: &str) -> Scene {
    let text = format!(
        "OrthographicCamera {{ center 0 0 10 direction 0 0 -1 up 0 1 0 size 2.5 }}
         Lights {{ numLights 1 DirectionalLight {{ direction 0 0 -1 color 1 1 1 }} }}
         Materials {{ numMaterials 1 Material {{ }} }}
         Group {{ numObjects 1 MaterialIndex 0 {object} }}"
    );
    scene_with_mesh(&text, mesh)
}

const SMOOTH: &str = "TriangleMesh { obj_file m.obj smooth 1 }";

/// Flat and shading normal where a ray along −`from` meets the mesh.
fn normals(mesh: Mesh, object: &str, from: DVec3) -> (DVec3, DVec3) {
    let world = World::new(&scene(mesh, object)).unwrap();
    let hit = world.nearest(&ray(5.0 * from, -from), Range::FORWARD).expect("a hit");
    (hit.normal, hit.shading_normal)
}

#[test]
fn averages_are_interpolated() {
    let middle = DVec3::ONE.normalize();
    let (flat, smooth) = normals(octahedron(), SMOOTH, middle);
    close(flat, middle, 1e-12);
    close(smooth, middle, 1e-12);
    // A point of the octahedron is its corners' weighted sum, and the corners' normals are they.
    let way = DVec3::new(0.7, 0.2, 0.1);
    let (flat, smooth) = normals(octahedron(), SMOOTH, way);
    close(flat, middle, 1e-12);
    close(smooth, way.normalize(), 1e-12);
    let (_, plain) = normals(octahedron(), "TriangleMesh { obj_file m.obj }", way);
    assert_eq!(plain, flat);
}

/// How a flat face is cut into triangles must not matter: a pyramid whose base is two triangles
/// has a corner that both share and one that only one has.
#[test]
fn averages_are_weighted_by_angles() {
    let corner = |x: f32, y: f32| Vec3::new(x, y, 0.0);
    let positions = vec![corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0), Vec3::NEG_Z];
    let sides = [[1, 0, 4], [2, 1, 4], [3, 2, 4], [0, 3, 4]];
    let normal_at = |base: [[u32; 3]; 2]| {
        let triangles = base.into_iter().chain(sides).collect();
        let mesh = Mesh { positions: positions.clone(), triangles, ..Mesh::default() };
        let world = World::new(&scene(mesh, SMOOTH)).unwrap();
        let down = ray(DVec3::new(0.001, 0.0005, 5.0), -DVec3::Z);
        world.nearest(&down, Range::FORWARD).expect("the base").shading_normal
    };
    close(normal_at([[0, 1, 2], [0, 2, 3]]), normal_at([[0, 1, 3], [1, 2, 3]]), 0.01);
}

#[test]
fn given_normals_win_and_inverted_ones_are_turned() {
    let lean = Vec3::new(1.0, 1.0, 3.0);
    for sign in [1.0, -1.0] {
        let mesh = Mesh {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
            triangles: vec![[0, 1, 2]],
            normals: vec![sign * lean; 3],
            ..Mesh::default()
        };
        let world = World::new(&scene(mesh, SMOOTH)).unwrap();
        let hit = world.nearest(&ray(DVec3::new(0.2, 0.2, 5.0), -DVec3::Z), Range::FORWARD).unwrap();
        close(hit.shading_normal, lean.as_dvec3().normalize(), 1e-7);
        close(hit.normal, DVec3::Z, 1e-15);
    }
}

#[test]
fn normals_go_with_the_inverse_transpose() {
    let squashed = format!("Transform {{ Scale 1 0.25 1 {SMOOTH} }}");
    let (_, smooth) = normals(octahedron(), &squashed, DVec3::Y);
    close(smooth, DVec3::Y, 1e-12);
    // Halfway along an edge both corners have the same weight, and unit normals.
    let edge = DVec3::new(0.5, 0.125, 0.0);
    let (_, smooth) = normals(octahedron(), &squashed, edge);
    close(smooth, DVec3::new(1.0, 1.0, 0.0).normalize(), 1e-12);
}

/// A silhouette of a smooth ball is not black, and the ball does not shadow itself.
#[test]
fn outlines_stay_lit() {
    let scene = scene(octahedron(), SMOOTH);
    let options = Options { width: 64, height: 64, normals: true, ..Options::default() };
    let plain = render(&scene, &options).unwrap();
    let shadows = render(&scene, &Options { shadows: true, ..options.clone() }).unwrap();
    assert_eq!(plain.colour, shadows.colour);
    let lit = plain.colour.pixels.iter().filter(|&&p| p != DVec3::splat(0.5) && p.x > 0.0).count();
    let hit = plain.normals.unwrap().pixels.iter().filter(|&&n| n != DVec3::ZERO).count();
    assert!(lit == hit && hit > 500, "{lit} of {hit} lit");
    let flat = render(&scene, &Options { model: Model::Flat, ..options }).unwrap();
    assert!(flat.colour.pixels.iter().filter(|&&p| p == DVec3::ONE).count() == hit);
}

/// Lights that the flat triangle turns its back to do not count, whatever the normals say.
#[test]
fn no_light_comes_through_a_triangle() {
    let mesh = Mesh {
        positions: vec![Vec3::new(-1.0, -1.0, 0.0), Vec3::new(1.0, -1.0, 0.0), Vec3::new(0.0, 1.0, 0.0)],
        triangles: vec![[0, 1, 2]],
        normals: vec![Vec3::new(1.0, 0.0, 0.2); 3],
        ..Mesh::default()
    };
    let mut scene = scene(mesh, SMOOTH);
    let mut brightest = |direction: DVec3| {
        scene.lights[0].kind = common::scene::LightKind::Directional { direction };
        let picture =
            render(&scene, &Options { width: 16, height: 16, ..Options::default() }).unwrap().colour;
        picture.pixels.iter().filter(|&&p| p != DVec3::splat(0.5)).map(|p| p.x).fold(0.0, f64::max)
    };
    assert!(brightest(DVec3::new(-1.0, 0.0, -0.1)) > 0.9);
    assert_eq!(brightest(DVec3::new(-1.0, 0.0, 0.1)), 0.0);
}
