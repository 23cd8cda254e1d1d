//! A scene with something of everything, for pictures of which no bit may change.

use super::stage::{obj, scene};
use crate::kit::lumpy_sphere;

/// Something of everything: a mesh, glass, a mirror, gloss, lamps of four kinds, a lens. The mesh, `lumps.obj`, is that of
/// [`lumps`].
pub fn everything() -> String {
    let camera = "PerspectiveCamera { center 0 1.6 5  direction 0 -0.2 -1  up 0 1 0  angle 45  aperture 0.1  focalDistance 5 }";
    let objects = "MaterialIndex 0 Plane { normal 0 1 0 offset 0 }\n\
        MaterialIndex 1 Sphere { center -1 0.7 0.6 radius 0.6 }\n\
        MaterialIndex 2 Sphere { center 1.2 0.7 0 radius 0.7 }\n\
        MaterialIndex 3 Sphere { center 0 2.6 0 radius 0.3 }\n\
        Triangle { vertex0 -2 2 -1 vertex1 -1 2 -1 vertex2 -1 2 0 }\n\
        MaterialIndex 4 Transform { Translate 0 1 -0.6 TriangleMesh { obj_file lumps.obj } }";
    let lights = [
        "PointLight { position 2 3 2 color 0.5 0.2 0.2 }",
        "DirectionalLight { direction 1 -1 -0.3 color 0.1 0.2 0.3 }",
        "SphereLight { center -2 3 1 radius 0.4 color 0.2 0.2 0.3 }",
    ];
    let materials = [
        "diffuseColor 0.7 0.6 0.5 specularColor 0.2 0.2 0.2 exponent 30",
        "diffuseColor 0 0 0 transparentColor 1 0.95 0.9 indexOfRefraction 1.5 absorption 0.3 0.1 0.5",
        "diffuseColor 0.1 0.1 0.2 reflectiveColor 0.8 0.8 0.7",
        "diffuseColor 0 0 0 emissiveColor 6 5 4",
        "diffuseColor 0.3 0.6 0.4",
    ];
    scene(camera, "0.1 0.15 0.2", &lights, &materials, objects)
}

/// Its mesh.
pub fn lumps() -> Vec<u8> {
    obj(&lumpy_sphere(3, 7)).into_bytes()
}
