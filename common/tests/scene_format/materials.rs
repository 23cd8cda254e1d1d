//! What good texts mean: textures and our extensions of the format.

use crate::parse;
use common::math::{DVec3, Vec3};
use common::scene::{Disc, LightKind, Material, NodeKind, Screen, ShapeSpec, SolidTextureKind};

#[test]
fn textures_blend_earlier_materials_and_may_be_flat() {
    let scene = parse(
        "OrthographicCamera { center 0 0 5 direction 0 0 -1 up 0 1 0 size 2 }
         Materials { numMaterials 5 Material { } Material { diffuseColor 0 0 0 }
            Checkerboard { Transform { Scale 1 0 1 YRotate 45 } materialIndex 1 materialIndex 0 }
            Noise { materialIndex 2 materialIndex 2 octaves 0 }
            Wood { amplitude 3 frequency 2 octaves 4 materialIndex 0 materialIndex 3 } }
         Group { numObjects 0 }",
    )
    .expect("a good scene");
    let solid = |index: usize| match &scene.materials[index] {
        Material::Solid(texture) => texture.clone(),
        other => panic!("a texture, not {other:?}"),
    };
    assert_eq!((solid(2).children, solid(2).transform.len()), ([1, 0], 2));
    assert_eq!(solid(3).kind, SolidTextureKind::Noise { octaves: 0 });
    let wood = SolidTextureKind::Wood { octaves: 4, frequency: 2.0, amplitude: 3.0 };
    assert_eq!((solid(4).kind, solid(4).children), (wood, [0, 3]));
}

#[test]
fn our_extensions_are_read() {
    let scene = parse(
        "PerspectiveCamera { center 0 0 5 direction 0 0 -1 up 0 1 0 angle 40
            aperture 0.5 focalDistance 7 blades 6 screen curved }
         Background { environment sky.hdr }
         Lights { numLights 1 SphereLight { center 0 9 0 radius 2 color 1 1 1 } }
         Materials { numMaterials 1 Material { emissiveColor 5 5 5 absorption 0 1 0
            ImageTexture { file brick.png scale 2 3 } } }
         Group { numObjects 1 MaterialIndex 0
            Plane { normal 0 1 0 offset 0 center 1 0 1 radius 4 } }",
    )
    .expect("a good scene");
    let lens = scene.camera.lens.expect("a lens");
    assert_eq!((lens.aperture, lens.focal_distance, scene.camera.screen), (0.5, 7.0, Screen::Curved));
    assert_eq!(lens.blades, Some(6));
    assert_eq!(scene.background.environment.as_deref(), Some("sky.hdr".as_ref()));
    assert!(matches!(scene.lights[0].kind, LightKind::Sphere { radius: 2.0, .. }));
    let Material::Phong(material) = &scene.materials[0] else {
        panic!("a plain material");
    };
    assert_eq!((material.emissive, material.absorption), (Vec3::splat(5.0), Vec3::Y));
    assert_eq!(material.image.as_ref().map(|image| image.scale), Some([2.0, 3.0]));
    let NodeKind::Shape { shape: ShapeSpec::Plane { disc, .. }, .. } = scene.nodes[1].kind else {
        panic!("a plane");
    };
    assert_eq!(disc, Some(Disc { center: DVec3::new(1.0, 0.0, 1.0), radius: 4.0 }));
}
