//! Work beyond rays that a scene does not need: doing it costs exactly what the counters say and
//! changes no bit of the picture. Rays that are not sent are in `counts.rs`.

use a1_ray_casting::{CastArgs, FlatColor, Picture, Report, Studio, picture};
use a6_kdtree::AccelArgs;
use a6_kdtree::kdtree::{KdTree, Options};
use common::accel::List;
use common::cli::Skip;
use common::counters::Counters;
use std::fs;
use std::path::Path;
use tests::program::parsed_words;
use tests::stage::Stage;
use tests::workspace_file;

/// A picture in floating point and what was counted.
struct Drawn {
    picture: Vec<u8>,
    counters: Counters,
}

const CAMERA: &str = "PerspectiveCamera { center 0 1 6 direction 0 -0.1 -1 up 0 1 0 angle 40 }
    Lights { numLights 1 DirectionalLight { direction -1 -2 -3 color 0.8 0.8 0.8 } }
    Materials { numMaterials 1 PhongMaterial { diffuseColor 0.8 0.7 0.6 } }";

/// Writes a scene of so many objects into a folder; meshes are named by their files.
fn write_scene(folder: &Path, objects: &[&str]) -> String {
    let meshes = workspace_file("scenes/meshes").display().to_string();
    let list = objects.join("\n").replace("MESHES", &meshes);
    let file = folder.join("scene.txt");
    let text = format!("{CAMERA} Group {{ numObjects {} MaterialIndex 0 {list} }}", objects.len());
    fs::write(&file, text).expect("there is room for temporary files");
    file.display().to_string()
}

fn words(program: &str, scene: &str, out: &Path, flags: &str) -> Vec<String> {
    let line = format!("{program} -input {scene} -output {} {flags}", out.display());
    line.split_whitespace().map(str::to_owned).collect()
}

/// What assignment 6 draws, which draws what those below draw.
fn trees(scene: &str, flags: &str) -> Drawn {
    let folder = tempfile::tempdir().expect("there is room for temporary files");
    let out = folder.path().join("out.pfm");
    let args: AccelArgs = parsed_words::<a6_kdtree::Program>(&words("a6_kdtree", scene, &out, flags)).args;
    let opened = Studio::open(args.cast(), &[&out]);
    let (studio, mut report) = opened.unwrap_or_else(|e| panic!("{}", e.report()));
    let tracer = args.structure(&studio.geometry, None).unwrap_or_else(|e| panic!("{}", e.report()));
    let whitted = &args.grid.whitted;
    a4_whitted::expose(whitted, &studio, &studio.scene, tracer.as_accel(), Vec::new(), &mut report)
        .unwrap_or_else(|e| panic!("{}", e.report()));
    tracer.count(&mut report.counters);
    Drawn { picture: fs::read(&out).expect("it was written"), counters: report.counters }
}

/// The same with a skip and without, whose pictures are the same to the last bit.
fn both(scene: &str, flags: &str, skip: &str) -> [Counters; 2] {
    let [skipping, toiling] = ["", skip].map(|name| {
        let switch = if name.is_empty() { String::new() } else { format!("-noskip {name}") };
        trees(scene, &format!("{flags} {switch}"))
    });
    assert!(skipping.picture == toiling.picture, "-noskip {skip} changes the picture of {scene}");
    [skipping.counters, toiling.counters]
}

/// What assignment 1 draws in flat colours.
fn flat(flags: &str) -> Drawn {
    let folder = tempfile::tempdir().expect("there is room for temporary files");
    let out = folder.path().join("out.pfm");
    let scene = workspace_file("scenes/scene2_09_bunny_200.txt").display().to_string();
    let args: CastArgs =
        parsed_words::<a1_ray_casting::Program>(&words("a1_ray_casting", &scene, &out, flags)).args;
    let (studio, mut report): (Studio, Report) =
        Studio::open(&args, &[&out]).unwrap_or_else(|e| panic!("{}", e.report()));
    let pictures: Vec<Picture> = picture(&args.output, FlatColor::new(&studio.scene))
        .into_iter()
        .chain(args.depth_picture())
        .collect();
    studio
        .expose(&args, &List::new(&studio.geometry), &pictures, &mut report)
        .unwrap_or_else(|e| panic!("{}", e.report()));
    Drawn { picture: fs::read(&out).expect("it was written"), counters: report.counters }
}

#[test]
fn a1t2_flat_colours_need_no_points_and_normals() {
    let (skipping, toiling) = (flat("-size 80 80"), flat("-size 80 80 -noskip surface"));
    assert!(skipping.picture == toiling.picture);
    let (a, b) = (skipping.counters, toiling.counters);
    assert!(a.skipped_surface > 500, "{a:?}");
    assert_eq!((a.surfaces, b.surfaces, b.skipped_surface), (0, a.skipped_surface, 0));
}

#[test]
fn a4t1_shadow_rays_need_points_of_textures_only() {
    let flags = "-size 100 100 -shadows -transparent_shadows";
    let open = || Stage::open("scenes/scene4_09_transparent_sphere_2.0.txt", flags);
    let films = |stage: &Stage| stage.films(stage.list().as_accel());
    let (skipping, toiling) = (films(&open()), films(&open().not_skipping(Skip::Surface)));
    assert_eq!(skipping.first_difference(&toiling), None);
    let (a, b) = (skipping.counters, toiling.counters);
    assert!(a.skipped_surface > 1000, "{a:?}");
    assert_eq!((b.surfaces, b.skipped_surface), (a.surfaces + a.skipped_surface, 0));
}

/// Every hit that is shaded has its point worked out once; candidates before it and what shadow
/// rays meet have none.
#[test]
fn a4_only_the_hit_that_counts_has_a_point() {
    let stage = Stage::open("scenes/scene5_07_bunny_mesh_1k.txt", "-size 60 60 -shadows");
    let films = stage.films(stage.list().as_accel());
    let hits = films.layers[1].pixels().iter().filter(|p| p.z == 1.0).count() as u64;
    // Once for the colour, once for the picture of normals.
    assert_eq!(films.counters.surfaces, 2 * hits);
    assert!(films.counters.exact_tests > films.counters.surfaces, "some were hit behind others");
}

#[test]
fn a2t3_pictures_that_nobody_asked_for() {
    let scene = workspace_file("scenes/scene4_04_reflective_sphere.txt").display().to_string();
    let [a, b] = both(&scene, "-size 60 60 -shadows", "pictures");
    assert_eq!((a.pictures, b.pictures), (1, 3));
    assert_eq!((a.rays, a.shadow_rays, a.intersections), (b.rays, b.shadow_rays, b.intersections));
    assert!(b.surfaces > a.surfaces, "normals ask for points of their own");
}

#[test]
fn a2t1_a_mesh_file_is_read_once() {
    let folder = tempfile::tempdir().expect("there is room for temporary files");
    let copy = |x: i32| {
        format!("Transform {{ Translate {x} 0 0 TriangleMesh {{ obj_file MESHES/bunny_200.obj }} }}")
    };
    let copies = [copy(-1), copy(0), copy(1)];
    let scene = write_scene(folder.path(), &copies.each_ref().map(String::as_str));
    for accel in ["-accel bvh", "-accel list"] {
        let [a, b] = both(&scene, &format!("-size 60 60 {accel}"), "shared");
        assert_eq!((a.mesh_files, a.skipped_mesh_file), (1, 2));
        assert_eq!((b.mesh_files, b.skipped_mesh_file), (3, 0));
    }
    // Copies that were read apart share no tree either.
    let large = ["-2", "0", "2"].map(|x| {
        format!("Transform {{ Translate {x} 0 0 TriangleMesh {{ obj_file MESHES/bunny_1k.obj }} }}")
    });
    let scene = write_scene(folder.path(), &large.each_ref().map(String::as_str));
    let [a, b] = both(&scene, "-size 60 60 -accel instances -noskip lazy", "shared");
    // The one at the top is another.
    assert_eq!((a.structures, b.structures), (2, 4));
}

const BALL: &str = "Sphere { center 0 1 0 radius 1 }";
const BEHIND: &str = "Transform { Translate 0 0 20 TriangleMesh { obj_file MESHES/bunny_1k.obj } }";

#[test]
fn a6t3_nothing_is_built_that_no_ray_asks_for() {
    let folder = tempfile::tempdir().expect("there is room for temporary files");
    let scene = write_scene(folder.path(), &[BEHIND]);
    for structure in ["-accel bvh", "-kdtree", "-accel instances"] {
        let [a, b] = both(&scene, &format!("-size 40 40 {structure}"), "lazy");
        assert_eq!((a.structures, a.skipped_structure), (0, 1), "{structure}");
        assert_eq!(b.skipped_structure, 0, "{structure}");
        assert_eq!(b.structures, if structure.ends_with("instances") { 2 } else { 1 });
    }
    // The tree at the top and that of the ball are asked, that of the mesh is not.
    let scene = write_scene(folder.path(), &[BALL, BEHIND]);
    let [a, b] = both(&scene, "-size 40 40 -shadows -accel instances", "lazy");
    assert_eq!((a.structures, a.skipped_structure), (2, 1));
    assert_eq!((b.structures, b.skipped_structure), (3, 0));
}

#[test]
fn a6t3_a_handful_of_primitives_gets_no_tree() {
    let scene = workspace_file("scenes/scene4_04_reflective_sphere.txt").display().to_string();
    let [a, b] = both(&scene, "-size 60 60 -shadows -bounces 2", "handful");
    assert_eq!((a.structures, a.skipped_structure, a.cells), (0, 1, 0));
    assert_eq!((b.structures, b.skipped_structure), (1, 0));
    assert!(b.cells > 0, "rays went through the tree");
    assert_eq!((a.rays, a.shadow_rays), (b.rays, b.shadow_rays));
}

#[test]
fn a2t2_baked_spheres_have_no_matrix() {
    let folder = tempfile::tempdir().expect("there is room for temporary files");
    let under = |maps: &str| format!("Transform {{ {maps} {BALL} }}");
    let rigid = under("Translate 1 2 3 Rotate { 1 2 3 40 } UniformScale 0.5");
    let squashed = under("Scale 1 0.5 1");
    let scene = write_scene(folder.path(), &[BALL, &under("Translate 0 0 0"), &rigid, &squashed]);
    let counters = trees(&scene, "-size 8 8").counters;
    assert_eq!((counters.matrices, counters.skipped_matrix), (1, 3));
}

/// A tree of the same balls holds as much with planes around them and has the same size.
#[test]
fn a6t2_planes_are_in_no_tree() {
    let folder = tempfile::tempdir().expect("there is room for temporary files");
    let balls: Vec<String> =
        (0..20).map(|i| format!("Sphere {{ center {} 1 0 radius 0.3 }}", i - 10)).collect();
    let mut objects: Vec<&str> = balls.iter().map(String::as_str).collect();
    let held = |objects: &[&str]| {
        let scene = write_scene(folder.path(), objects);
        let args = parsed_words::<a6_kdtree::Program>(&words("a6_kdtree", &scene, Path::new("o.pfm"), ""));
        let (studio, _) = Studio::open(args.args.cast(), &[]).unwrap_or_else(|e| panic!("{}", e.report()));
        let tree = KdTree::new(&studio.geometry, Options::default());
        (tree.summary().references, tree.root_box(), studio.geometry.sheets().len())
    };
    let (references, bounds, none) = held(&objects);
    objects.push("Plane { normal 0 1 0 offset 0 }");
    objects.push("Plane { normal 0 0 1 offset -5 }");
    assert_eq!((held(&objects), none), ((references, bounds, 2), 0));
}
