//! Pictures on surfaces, and pictures that are none.

use crate::{load, near, rules, scene_in, trace};
use common::geometry::Geometry;
use common::math::Vec3;
use common::picture::{Film, Size, Transfer, write};
use std::fs;
use std::path::Path;

/// Four pixels: red and green below, blue and white above.
fn write_corners(file: &Path) {
    let colors = [Vec3::X, Vec3::Y, Vec3::Z, Vec3::ONE];
    let film = Film::from_fn(Size::new(2, 2).unwrap(), |x, y| colors[(x + 2 * y) as usize]);
    write(file, &film, Transfer::Linear).unwrap();
}

const TEXTURE: &str = "Material { diffuseColor 0.3 0.3 0.3 ImageTexture { file corners.png } }";

/// A scene without lamps, so that colours come out as they are.
fn pictured(folder: &Path, materials: &[&str], objects: &str) -> common::scene::Scene {
    write_corners(&folder.join("corners.png"));
    let count = objects.matches('{').count();
    let (n, list) = (materials.len(), materials.join(" "));
    scene_in(
        folder,
        &format!(
            "Materials {{ numMaterials {n} {list} }}
             Group {{ numObjects {count} MaterialIndex {} {objects} }}",
            n - 1
        ),
    )
}

#[test]
fn a6t4_a_picture_hangs_on_a_wall_upright() {
    let folder = tempfile::tempdir().unwrap();
    let world = pictured(folder.path(), &[TEXTURE], "Plane { normal 0 0 1 offset 0 }");
    let at = |x: f32, y: f32| trace(&world, rules(0), Vec3::new(x, y, 3.0), Vec3::new(x, y, 0.0)).color;
    assert_eq!([at(0.25, 0.25), at(0.75, 0.25)], [Vec3::X, Vec3::Y], "red and green below");
    assert_eq!([at(0.25, 0.75), at(0.75, 0.75)], [Vec3::Z, Vec3::ONE], "blue and white above");
    assert_eq!(at(-1.75, 3.25), Vec3::X, "and again and again");
    assert!(near(at(0.5, 0.5), Vec3::splat(0.5)), "between all four");
}

#[test]
fn a6t4_scale_is_how_many_stand_side_by_side() {
    let folder = tempfile::tempdir().unwrap();
    let scaled = "Material { ImageTexture { file corners.png scale 2 -0.5 } }";
    let world = pictured(folder.path(), &[scaled], "Plane { normal 0 0 1 offset 0 }");
    let at = |x: f32, y: f32| trace(&world, rules(0), Vec3::new(x, y, 3.0), Vec3::new(x, y, 0.0)).color;
    assert_eq!([at(0.125, 0.5), at(0.375, 0.5)], [Vec3::Z, Vec3::ONE], "upside down");
    assert_eq!([at(0.125, 1.5), at(0.375, 1.5)], [Vec3::X, Vec3::Y]);
}

#[test]
fn a6t4_around_a_sphere() {
    let folder = tempfile::tempdir().unwrap();
    let world = pictured(folder.path(), &[TEXTURE], "Sphere { center 0 0 0 radius 1 }");
    let from = |origin: Vec3| trace(&world, rules(0), origin, Vec3::ZERO).color;
    // The middle of each quarter of the picture: longitudes ∓90°, latitudes ∓45°.
    assert!(near(from(Vec3::new(-2.0, -2.0, 0.0)), Vec3::X));
    assert!(near(from(Vec3::new(2.0, -2.0, 0.0)), Vec3::Y));
    assert!(near(from(Vec3::new(-2.0, 2.0, 0.0)), Vec3::Z));
    assert!(near(from(Vec3::new(2.0, 2.0, 0.0)), Vec3::ONE));
    for pole in [Vec3::Y, -Vec3::Y] {
        assert!(from(pole * 3.0).is_finite());
    }
}

#[test]
fn a6t4_a_texture_blends_pictures() {
    let folder = tempfile::tempdir().unwrap();
    let black = "Material { diffuseColor 0 0 0 }";
    let half = "Noise { materialIndex 0 materialIndex 1 octaves 0 }";
    let world = pictured(folder.path(), &[TEXTURE, black, half], "Plane { normal 0 0 1 offset 0 }");
    let color = trace(&world, rules(0), Vec3::new(0.75, 0.75, 3.0), Vec3::new(0.75, 0.75, 0.0)).color;
    assert_eq!(color, Vec3::splat(0.5));
}

#[test]
fn a6t4_a_file_is_read_once_however_it_is_called() {
    let folder = tempfile::tempdir().unwrap();
    let other = format!("Material {{ ImageTexture {{ file ../{}/corners.png }} }}", {
        let name = folder.path().file_name().unwrap();
        name.to_string_lossy().into_owned()
    });
    let world = pictured(folder.path(), &[TEXTURE, &other, TEXTURE], "Sphere { center 0 0 0 radius 1 }");
    let geometry = Geometry::build(&world).unwrap();
    let textured = load(&world, &geometry).unwrap();
    assert_eq!(textured.describe().unwrap(), "textures: 0 solid, 1 picture files of 1 KiB");
}

#[test]
fn a6t4_what_is_no_picture_is_an_error_with_its_place() {
    let folder = tempfile::tempdir().unwrap();
    let world = pictured(folder.path(), &[TEXTURE], "Sphere { center 0 0 0 radius 1 }");
    fs::write(folder.path().join("corners.png"), "no picture").unwrap();
    let geometry = Geometry::build(&world).unwrap();
    let error = load(&world, &geometry).err().expect("it cannot be read");
    let (text, cause) = (error.to_string(), error.source.to_string());
    assert!(text.starts_with("test.txt:1:") && text.contains("ImageTexture"), "{text}");
    assert!(cause.contains("corners.png"), "{cause}");
}
