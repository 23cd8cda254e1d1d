//! Wrong scenes and meshes: the mistakes that people make in them.

use super::{GOOD, refused, scratch};
use crate::binary::Binary;
use std::fs;

/// What is changed in the good scene: the first occurrence of one text becomes another; and
/// what must be said about it, the place first.
const MISTAKES: &[(&str, &str, &[&str])] = &[
    ("Sphere", "Spere", &["scene.txt:19:5", "found `Spere`", "did you mean `Sphere`?"]),
    ("Sphere", "sphere", &["scene.txt:19:5", "did you mean `Sphere`?"]),
    ("diffuseColor", "difuseColor", &["scene.txt:14:21", "did you mean `diffuseColor`?"]),
    ("obj } }\n}\n", "obj } }\n", &["scene.txt:21:66", "the file ends inside of this `Group`"]),
    ("numObjects 3", "numObjects 4", &["scene.txt:22:1", "says 4", "after 3 objects"]),
    ("numObjects 3", "numObjects 2", &["scene.txt:21:5", "says 2", "object number 3"]),
    ("numObjects 3", "numObjects 1000000000", &["scene.txt:22:1", "says 1000000000"]),
    ("numLights 1", "numLights 2", &["scene.txt:11:1", "says 2", "after 1 light"]),
    ("radius 1", "radius", &["scene.txt:19:35", "expected a number for `radius`", "found `}`"]),
    ("radius 1", "radius one", &["scene.txt:19:35", "found `one`"]),
    ("radius 1", "radius 0", &["scene.txt:19:35", "must be above zero"]),
    ("radius 1", "radius nan", &["scene.txt:19:35", "must be finite"]),
    ("radius 1", "radius 1e999", &["scene.txt:19:35"]),
    ("center 0 0 0", "center 0, 0, 0", &["scene.txt:19:21", "not by commas"]),
    ("Scale 1 2 1", "Scale 1 0 1", &["scene.txt:21:17", "singular"]),
    ("MaterialIndex 0", "MaterialIndex 7", &["scene.txt:18:19", "no material 7"]),
    ("    MaterialIndex 0\n", "", &["scene.txt:18:5", "no material"]),
    ("up 0 1 0", "up 0 0 2", &["scene.txt:4:5", "parallel to `direction`"]),
    ("normal 0 1 0", "normal 0 0 0", &["scene.txt:20:13", "zero vector"]),
    ("size 5\n", "angle 30\n", &["scene.txt:5:5", "found `angle`"]),
    ("OrthographicCamera", "Background { } OrthographicCamera", &["scene.txt:7:1"]),
    ("cube.obj", "cub.obj", &["scene.txt:21:54", "no file `cub.obj`", "did you mean `cube.obj`?"]),
    ("cube.obj", "../", &["scene.txt:21:54", "no file `../`"]),
];

/// Meshes that are none, and what must be said about them besides the place in the scene.
const MESHES: &[(&str, &str)] = &[
    ("", "no triangles"),
    ("hello world\n", "no triangles"),
    ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "bad.obj:4: vertex index 4 is out of range"),
    ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n", "bad.obj:4: vertex index 0"),
    ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 x\n", "bad.obj:4: expected a vertex index, found `x`"),
    ("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "no area"),
    ("v 0 0\nf 1 1 1\n", "bad.obj:1: expected 3 numbers"),
    ("v 0 0 nan\nf 1 1 1\n", "bad.obj:1: `nan`"),
];

const DRAW: [&str; 6] = ["-input", "scene.txt", "-size", "9", "9", "-output"];

/// Draws `text` as a scene, over an old picture.
fn refused_scene(binary: &Binary, text: &[u8], needles: &[&str]) {
    let args: Vec<&str> = DRAW.into_iter().chain(["old.tga"]).collect();
    refused(binary, &scratch(text), &args, needles);
}

/// The mistakes that are made most, one at a time.
///
/// # Panics
/// If one is not refused as it should be.
pub fn classic_mistakes(binary: &Binary) {
    for (from, to, needles) in MISTAKES {
        assert!(GOOD.contains(from), "{from}");
        refused_scene(binary, GOOD.replacen(from, to, 1).as_bytes(), needles);
    }
}

/// Scenes that lack or double a block, or have them in the wrong order; files that are no scene.
///
/// # Panics
/// If one is not refused as it should be.
pub fn not_a_scene(binary: &Binary) {
    let block = |name: &str, next: &str| {
        let (start, end) = (GOOD.find(name).unwrap_or(0), GOOD.find(next).unwrap_or(GOOD.len()));
        &GOOD[start..end]
    };
    let (camera, group) = (block("OrthographicCamera", "Background"), block("Group", "no such block"));
    let materials = block("Materials", "Group");
    let cases: [(String, &[&str]); 6] = [
        (GOOD.replace(camera, ""), &["this file has no camera"]),
        (GOOD.replacen(camera, &camera.repeat(2), 1), &["scene.txt:7:1", "a second camera"]),
        (GOOD.replace(group, ""), &["scene.txt:", "Group"]),
        (GOOD.replace(materials, "") + materials, &["scene.txt:14:5", "must stand before the `Group`"]),
        (String::new(), &["scene.txt:1:1", "no camera"]),
        (GOOD.to_owned() + "}\n", &["scene.txt:23:1"]),
    ];
    for (text, needles) in &cases {
        refused_scene(binary, text.as_bytes(), needles);
    }
    refused_scene(binary, b"\x00\x01\xff\xfe\x80binary", &["scene.txt:1:3", "not UTF-8"]);
    let files = [
        ("nosuch.txt", "there is no such scene file"),
        ("goood.txt", "did you mean `good.txt`?"),
        ("folder.tga", "this is a folder"),
    ];
    for (file, needle) in files {
        refused(binary, &scratch(b""), &["-input", file, "-output", "old.tga"], &[file, needle]);
    }
}

/// Meshes that cannot be used.
///
/// # Panics
/// If one is not refused as it should be.
pub fn wrong_meshes(binary: &Binary) {
    for (mesh, needle) in MESHES {
        let scratch = scratch(GOOD.replace("cube.obj", "bad.obj").as_bytes());
        fs::write(scratch.file("bad.obj"), mesh).expect("there is room for temporary files");
        let args: Vec<&str> = DRAW.into_iter().chain(["old.tga"]).collect();
        refused(binary, &scratch, &args, &["scene.txt:21:54", needle]);
    }
}
