//! Pictures on surfaces: where they lie, and what is between their pixels.

mod support;

use common::math::{DVec3, Vec3};
use common::picture::{Film, Size, Transfer, write};
use oracle::{Model, Options, OracleError, render};
use std::path::PathBuf;
use support::{close, scene, see};

fn flat() -> Options {
    Options { model: Model::Flat, ..Options::default() }
}

/// Writes a picture of 2 × 2 pixels and says where: below black and red, above green and white.
fn picture(name: &str) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let colors = [[Vec3::ZERO, Vec3::X], [Vec3::Y, Vec3::ONE]];
    let film = Film::from_fn(Size::new(2, 2).unwrap(), |x, y| colors[y as usize][x as usize]);
    write(&path, &film, Transfer::Linear).unwrap();
    path
}

/// The colour on `object`, whose material is the picture `scale` times over, from `eye`.
fn pictured(name: &str, scale: &str, object: &str, eye: DVec3, look: DVec3) -> DVec3 {
    let file = picture(name);
    let materials = format!(
        "Materials {{ numMaterials 1 Material {{ ImageTexture {{ file {} scale {scale} }} }} }}",
        file.display()
    );
    see(&flat(), eye, look, &format!("{materials} Group {{ numObjects 1 MaterialIndex 0 {object} }}"))
}

#[test]
fn pictures_stand_upright_on_walls_and_repeat() {
    let wall = "Plane { normal 0 0 1 offset 0 }";
    let at = |x, y, scale| pictured("wall.png", scale, wall, DVec3::new(x, y, 1.0), -DVec3::Z);
    for (shift_x, shift_y) in [(0.0, 0.0), (1.0, 0.0), (-3.0, 2.0)] {
        let at = |x: f64, y: f64| at(x + shift_x, y + shift_y, "1 1");
        close(at(0.25, 0.25), DVec3::ZERO, 1e-12);
        close(at(0.75, 0.25), DVec3::X, 1e-12);
        close(at(0.25, 0.75), DVec3::Y, 1e-12);
        close(at(0.75, 0.75), DVec3::ONE, 1e-12);
        // Halfway, also across the border to the next copy.
        close(at(0.5, 0.25), DVec3::X / 2.0, 1e-12);
        close(at(0.0, 0.25), DVec3::X / 2.0, 1e-12);
        close(at(0.5, 0.5), DVec3::new(0.5, 0.5, 0.25), 1e-12);
    }
    close(at(0.375, 0.5, "2 0.5"), DVec3::X, 1e-12);
}

#[test]
fn pictures_wrap_round_balls() {
    let ball = "Sphere { center 0 0 0 radius 2 }";
    let from = |eye: DVec3| pictured("ball.png", "1 1", ball, 5.0 * eye, -eye);
    close(from(DVec3::Z), DVec3::new(0.5, 0.5, 0.25), 1e-12);
    // 90° east and 45° north is three quarters of the way along both.
    close(from(DVec3::new(1.0, 1.0, 0.0).normalize()), DVec3::ONE, 1e-12);
    close(from(DVec3::new(-1.0, 1.0, 0.0).normalize()), DVec3::Y, 1e-12);
    assert!(from(DVec3::Y).is_finite());
}

#[test]
fn a_triangle_shows_half_a_picture_and_moves_with_it() {
    let triangle = "Transform { Translate 5 0 0 UniformScale 2
        Triangle { vertex0 0 0 0 vertex1 2 0 0 vertex2 0 2 0 } }";
    let at =
        |x, y| pictured("triangle.png", "1 1", triangle, DVec3::new(5.0 + 4.0 * x, 4.0 * y, 1.0), -DVec3::Z);
    close(at(0.25, 0.25), DVec3::ZERO, 1e-12);
    close(at(0.625, 0.25), DVec3::X * 0.75, 1e-12);
}

#[test]
fn a_missing_picture_is_an_error() {
    let scene = scene(
        "OrthographicCamera { center 0 0 10 direction 0 0 -1 up 0 1 0 size 4 }
         Materials { numMaterials 1 Material { ImageTexture { file /no/such/picture.png } } }
         Group { numObjects 1 MaterialIndex 0 Sphere { center 0 0 0 radius 1 } }",
    );
    let error = render(&scene, &flat()).unwrap_err();
    assert!(matches!(&error, OracleError::Picture(text) if text.contains("picture.png")), "{error}");
}
