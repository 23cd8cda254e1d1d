//! The scenes of the course: all of them can be drawn, and no surface shadows itself in them.

use common::math::DVec3;
use common::scene::{Scene, load};
use oracle::{Model, Options, Raster, render};
use std::path::PathBuf;

/// The scenes of assignments 1 to 7 by name, without the largest mesh.
fn scenes() -> Vec<(String, Scene)> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let entries = std::fs::read_dir(folder).expect("the folder of scenes");
    let files = entries.map(|entry| entry.expect("a folder entry").path());
    let name = |path: &PathBuf| path.file_name().unwrap().to_string_lossy().into_owned();
    let wanted = |n: &str| (1..=7).any(|assignment| n.starts_with(&format!("scene{assignment}")));
    let mut found: Vec<(String, Scene)> = files
        .map(|path| (name(&path), path))
        .filter(|(name, _)| wanted(name) && !name.contains("40k"))
        .map(|(name, path)| (name, load(&path).unwrap_or_else(|e| panic!("{e}"))))
        .collect();
    found.sort_by(|a, b| a.0.cmp(&b.0));
    assert!(found.len() > 50, "only {} scenes", found.len());
    found
}

fn draw(scene: &Scene, options: &Options) -> Raster {
    let options = Options { width: 32, height: 32, lens_side: 2, ..options.clone() };
    render(scene, &options).expect("a picture").colour
}

#[test]
fn every_scene_can_be_drawn() {
    let options = Options { shadows: true, shade_back: true, bounces: 4, weight: 0.01, ..Options::default() };
    for (name, scene) in scenes() {
        let picture = draw(&scene, &options);
        let finite = picture.pixels.iter().all(|p| p.is_finite() && p.min_element() >= 0.0);
        assert!(finite, "{name}");
        let background = scene.background.color.as_dvec3();
        assert!(picture.pixels.iter().any(|&p| p != background), "{name} shows nothing");
    }
}

/// With transparent shadows, and every surface perfectly clear, nothing can be in shadow.
#[test]
fn clear_surfaces_cast_no_shadow() {
    let clear = Options { shadows: true, transparent_shadows: true, ..Options::default() };
    let none = Options { model: Model::Phong, ..Options::default() };
    for (name, mut scene) in scenes() {
        for material in &mut scene.materials {
            if let common::scene::Material::Phong(phong) = material {
                phong.transparent = common::math::Vec3::ONE;
            }
        }
        assert_eq!(draw(&scene, &clear), draw(&scene, &none), "{name}");
    }
}

/// Acne would show as dark pixels on the side of a closed convex object that faces the light:
/// with a lamp at the eye, everything that the camera sees is lit.
#[test]
fn a_lamp_at_the_eye_shows_no_shadow() {
    use common::scene::{CameraKind, LightKind, LightSpec};
    for (name, mut scene) in scenes() {
        // A lens looks past the lamp.
        if !matches!(scene.camera.kind, CameraKind::Perspective { .. }) || scene.camera.lens.is_some() {
            continue;
        }
        scene.lights = vec![LightSpec {
            color: common::math::Vec3::ONE,
            kind: LightKind::Point { position: scene.camera.center, attenuation: [1.0, 0.0, 0.0] },
            position: scene.camera.position,
        }];
        let shadows = Options { shadows: true, shade_back: true, ..Options::default() };
        let (with, without) = (draw(&scene, &shadows), draw(&scene, &Options { shadows: false, ..shadows }));
        let differs = |(a, b): (&DVec3, &DVec3)| a != b;
        let spoiled = with.pixels.iter().zip(&without.pixels).filter(|&pair| differs(pair)).count();
        assert_eq!(spoiled, 0, "{name}");
    }
}
