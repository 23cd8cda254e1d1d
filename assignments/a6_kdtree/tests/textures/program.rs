//! The program as a whole on textured scenes.

use a6_kdtree::Program;
use common::cli::AppError;
use common::math::Vec3;
use common::picture::{Film, Size, Transfer, read, write};
use std::fs;
use std::path::Path;

const SCENE: &str = "
    OrthographicCamera { center 0.5 0.5 5 direction 0 0 -1 up 0 1 0 size 3 }
    Lights { numLights 1 DirectionalLight { direction 0 0 -1 color 1 1 1 } }
    Materials { numMaterials 4
        Material { ImageTexture { file blue.png } } Material { diffuseColor 1 1 0 }
        Checkerboard { materialIndex 0 materialIndex 1 }
        Marble { materialIndex 0 materialIndex 2 octaves 3 frequency 3 amplitude 2 } }
    Group { numObjects 3 MaterialIndex 2 Plane { normal 0 0 1 offset 0.5 }
        MaterialIndex 3 Sphere { center 0.5 0.5 1 radius 0.25 }
        Triangle { vertex0 -1 -1 0.6 vertex1 -0.5 -1 0.6 vertex2 -1 -0.5 0.6 } }";

fn in_folder(scene: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("scene.txt"), scene).unwrap();
    let blue = Film::filled(Size::new(3, 3).unwrap(), Vec3::Z);
    write(&folder.path().join("blue.png"), &blue, Transfer::Linear).unwrap();
    folder
}

/// Runs the program on `scene.txt` of a folder; `@` in the flags stands for the folder.
fn run(folder: &Path, flags: &str) -> Result<(), AppError> {
    let folder = folder.display();
    let words = format!("a6_kdtree -input @/scene.txt -threads 1 {flags}").replace('@', &folder.to_string());
    let parsed = common::cli::try_parse_from::<Program>(words.split_whitespace());
    a6_kdtree::run(&parsed.unwrap_or_else(|stop| panic!("{}", stop.text)).options.args)
}

fn picture(folder: &Path, name: &str) -> Film {
    read(&folder.join(name), Transfer::Linear).unwrap()
}

#[test]
fn a6t3_the_picture_has_the_squares() {
    let folder = in_folder(SCENE);
    run(folder.path(), "-output @/out.png -size 30 30").unwrap();
    let film = picture(folder.path(), "out.png");
    // The picture shows [−1, 2]², ten pixels a square; the square around the middle is first,
    // half of its height away the sphere does not reach.
    assert_eq!(film.get(11, 18), Vec3::Z);
    assert_eq!([film.get(5, 15), film.get(25, 15), film.get(15, 5)], [Vec3::new(1.0, 1.0, 0.0); 3]);
    assert_eq!([film.get(5, 25), film.get(25, 25)], [Vec3::Z; 2]);
}

#[test]
fn a6t3_structures_preview_and_cells_take_textures() {
    let folder = in_folder(SCENE);
    for (name, flags) in
        [("list", "-accel list"), ("kdtree", "-kdtree"), ("bvh", "-accel bvh"), ("grid", "-grid 3 4 5")]
    {
        let all = "-shadows -bounces 2 -transparent_shadows -shade_back -size 40 30";
        run(folder.path(), &format!("-output @/{name}.pfm {all} {flags}")).unwrap();
        assert_eq!(
            picture(folder.path(), "list.pfm"),
            picture(folder.path(), &format!("{name}.pfm")),
            "{name}"
        );
    }
    run(folder.path(), "-output @/cells.png -grid 3 4 5 -visualize_grid -preview @/flat.png").unwrap();
    run(folder.path(), "-preview @/smooth.png -gouraud -size 30 30").unwrap();
    let preview = picture(folder.path(), "smooth.png");
    assert!(preview.pixels().iter().any(|c| c.z > 0.9 && c.x < 0.1), "blue squares");
    assert!(preview.pixels().iter().any(|c| c.x > 0.9 && c.z < 0.1), "yellow squares");
}

#[test]
fn a6t4_a_bad_picture_is_bad_input() {
    let folder = in_folder(SCENE);
    fs::write(folder.path().join("blue.png"), [0x89, b'P', b'N', b'G', 13, 10, 26, 10, 0]).unwrap();
    let error = run(folder.path(), "-output @/out.png").unwrap_err();
    let report = error.report();
    assert_eq!(error.code(), 2);
    assert!(report.contains("scene.txt:5:20: this `ImageTexture`"), "{report}");
    assert!(report.contains("caused by: ") && report.contains("blue.png"), "{report}");
    assert!(!folder.path().join("out.png").exists());
}

#[test]
fn a6t4_a_missing_picture_is_bad_input() {
    let folder = in_folder(&SCENE.replace("blue.png", "green.png"));
    let error = run(folder.path(), "-output @/out.png").unwrap_err();
    assert_eq!(error.code(), 2);
    let report = error.report();
    assert!(report.contains("scene.txt:5:40") && report.contains("green.png"), "{report}");
}
