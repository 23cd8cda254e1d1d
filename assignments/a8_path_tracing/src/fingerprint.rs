//! A number for a scene: two scenes of one number are the same, beyond reasonable doubt.

use crate::film::checkpoint::checksum;
use a7_sampling::sampler::hash::mix;
use common::mesh::Mesh;
use common::scene::{Material, Scene};
use std::fmt::Debug;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// A number for all that a scene says, with its meshes and pictures; neither where their files lie
/// matters nor where things stand in the scene's own file.
///
/// # Errors
/// If a picture can no longer be read.
pub fn fingerprint(scene: &Scene) -> io::Result<u64> {
    let mut sum = Sum(0);
    sum.add_text(&scene.camera);
    sum.add_text(&(scene.background.color, scene.background.ambient_light));
    sum.add_file(scene.background.environment.as_deref())?;
    sum.add_text(&scene.lights);
    for material in &scene.materials {
        let mut material = material.clone();
        if let Material::Phong(phong) = &mut material
            && let Some(image) = &mut phong.image
        {
            sum.add_file(Some(&std::mem::replace(&mut image.file, PathBuf::new())))?;
        }
        sum.add_text(&material);
    }
    sum.add_text(&scene.nodes);
    scene.meshes.iter().for_each(|mesh| sum.add_mesh(mesh));
    Ok(sum.0)
}

/// What has been added so far.
struct Sum(u64);

impl Sum {
    fn add_bytes(&mut self, bytes: &[u8]) {
        self.0 = mix(self.0.rotate_left(1) ^ checksum(bytes));
    }

    /// Numbers are shown with as many digits as they need, so different values differ.
    fn add_text(&mut self, value: &impl Debug) {
        self.add_bytes(without_positions(&format!("{value:?}")).as_bytes());
    }

    fn add_file(&mut self, path: Option<&Path>) -> io::Result<()> {
        match path {
            Some(path) => self.add_bytes(&fs::read(path)?),
            None => self.add_bytes(&[]),
        }
        Ok(())
    }

    fn add_mesh(&mut self, mesh: &Mesh) {
        let spatial = mesh.positions.iter().chain(&mesh.normals).flat_map(|v| v.to_array());
        let flat = mesh.uvs.iter().flat_map(|uv| uv.to_array());
        let numbers: Vec<u8> = spatial.chain(flat).flat_map(f32::to_le_bytes).collect();
        let corners: Vec<u8> = mesh.triangles.iter().flatten().flat_map(|i| i.to_le_bytes()).collect();
        self.add_bytes(&numbers);
        self.add_bytes(&corners);
        self.add_text(&[mesh.positions.len(), mesh.normals.len(), mesh.uvs.len()]);
    }
}

/// The text of a value without the lines and columns in it.
fn without_positions(text: &str) -> String {
    let mut parts = text.split("Position {");
    let first = parts.next().unwrap_or_default();
    let rest = parts.map(|part| part.split_once('}').map_or("", |(_, rest)| rest));
    std::iter::once(first).chain(rest).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use common::picture::{Film, Size, Transfer, write};

    const SCENE: &str = "PerspectiveCamera { center 0 0 5 direction 0 0 -1 up 0 1 0 angle 30 }
        Materials { numMaterials 1 Material { ImageTexture { file p.tga } } }
        Group { numObjects 2 MaterialIndex 0 Sphere { center 0 0 0 radius 1 }
            TriangleMesh { obj_file m.obj } }";

    /// The number of a scene that lies in a folder of its own.
    fn number(scene: &str, corner: &str, grey: f32) -> u64 {
        let folder = tempfile::tempdir().unwrap();
        let file = |name: &str| folder.path().join(name);
        fs::write(file("s.txt"), scene).unwrap();
        fs::write(file("m.obj"), format!("v 0 0 0\nv 1 0 0\nv 0 1 {corner}\nf 1 2 3\n")).unwrap();
        let film = Film::filled(Size::new(2, 2).unwrap(), common::math::Vec3::splat(grey));
        write(&file("p.tga"), &film, Transfer::Linear).unwrap();
        fingerprint(&common::scene::load(&file("s.txt")).unwrap()).unwrap()
    }

    #[test]
    fn all_that_is_seen_counts_and_where_it_lies_does_not() {
        let one = number(SCENE, "0", 0.5);
        assert_eq!(one, number(SCENE, "0", 0.5), "the folder is another");
        let moved = format!("# another comment\n\n{}", SCENE.replace("Sphere", "\n  Sphere"));
        assert_eq!(one, number(&moved, "0", 0.5), "lines and columns are others");
        let others = [
            number(&SCENE.replace("radius 1", "radius 1.0000001"), "0", 0.5),
            number(&SCENE.replace("angle 30", "angle 31"), "0", 0.5),
            number(&SCENE.replace("p.tga", "p.tga scale 2 2"), "0", 0.5),
            number(SCENE, "0.5", 0.5),
            number(SCENE, "0", 0.6),
        ];
        for (i, other) in others.iter().enumerate() {
            assert!(*other != one && !others[..i].contains(other), "{i}");
        }
    }
}
