//! What good scene texts mean.

use crate::{PRELUDE, parse, scene};
use common::math::{DMat4, DVec3, DVec4, Vec3};
use common::scene::{CameraKind, LightKind, Material, NodeKind, Scene, ShapeSpec};
use insta::assert_snapshot;

/// One line per node: indentation by depth, kind, material, position.
fn outline(scene: &Scene) -> String {
    let mut depths: Vec<usize> = Vec::new();
    let mut lines = Vec::new();
    for node in &scene.nodes {
        let depth = node.parent.map_or(0, |parent| depths[parent as usize] + 1);
        depths.push(depth);
        let (line, column) = (node.position.line, node.position.column);
        let what = match &node.kind {
            NodeKind::Group => "group".to_owned(),
            NodeKind::Transform(list) => format!("transform {list:?}"),
            NodeKind::Shape { shape, material } => format!("m{material} {shape:?}"),
        };
        lines.push(format!("{}{what} @{line}:{column}", "  ".repeat(depth)));
    }
    lines.join("\n")
}

#[test]
fn the_tree_is_flat_in_file_order_and_the_material_stays_in_force() {
    let scene = scene(
        "Group {
    numObjects 3
    MaterialIndex 1
    Sphere { center 0 0 0 radius 1 }
    Transform {
        XRotate 90  Scale 1 2 1
        Group { numObjects 1 MaterialIndex 0 Plane { normal 0 1 0 offset -2 } }
    }
    TriangleMesh { obj_file one.obj }
}",
    );
    assert_snapshot!(outline(&scene), @r"
    group @3:1
      m1 Sphere { center: DVec3(0.0, 0.0, 0.0), radius: 1.0 } @6:5
      transform [Rotate(DVec3(1.0, 0.0, 0.0), 90.0), Scale(DVec3(1.0, 2.0, 1.0))] @7:5
        group @9:9
          m0 Plane { normal: DVec3(0.0, 1.0, 0.0), offset: -2.0, disc: None } @9:46
      m0 Mesh { mesh: 0, smooth: false } @11:5
    ");
}

#[test]
fn defaults_are_those_of_the_course() {
    let scene = scene("Group { numObjects 0 }");
    assert_eq!(scene.background.color, Vec3::splat(0.5));
    assert_eq!(scene.background.ambient_light, Vec3::ONE);
    let Material::Phong(material) = &scene.materials[0] else {
        panic!("a plain material");
    };
    assert_eq!(material.diffuse, Vec3::ONE);
    assert_eq!((material.exponent, material.index_of_refraction), (1.0, 1.0));
    assert_eq!(material.specular + material.reflective + material.transparent, Vec3::ZERO);
}

#[test]
fn ambient_light_is_black_by_default_only_if_there_are_lights() {
    let light = "Lights { numLights 1 DirectionalLight { direction 0 0 -1 color 1 1 1 } }";
    let ambient = |text: &str| scene(&format!("{text} Group {{ numObjects 0 }}")).background.ambient_light;
    assert_eq!(ambient("Lights { numLights 0 }"), Vec3::ONE);
    assert_eq!(ambient(light), Vec3::ZERO);
    assert_eq!(ambient("Background { ambientLight 0.25 0 0 }"), Vec3::X * 0.25);
    assert_eq!(ambient(&format!("{light} Background {{ color 0 0 0 }}")), Vec3::ZERO);
}

#[test]
fn blocks_come_in_any_order_and_fields_too() {
    let scene = parse(
        "Materials{numMaterials 1 PhongMaterial{exponent 5}}
         Group{numObjects 1 MaterialIndex 0 Sphere{radius 1 center 1 2 3}}
         Lights { numLights 1 PointLight { attenuation 0 1 0 color 1 -1 1 position 4 5 6 } }
         OrthographicCamera { size 2 up 0 1 0 direction 0 0 -1 center 0 0 5 } # the end",
    )
    .expect("a good scene");
    assert_eq!(scene.camera.kind, CameraKind::Orthographic { size: 2.0 });
    assert_eq!(scene.lights[0].color, Vec3::new(1.0, -1.0, 1.0));
    let position = DVec3::new(4.0, 5.0, 6.0);
    let attenuation = [0.0, 1.0, 0.0];
    assert_eq!(scene.lights[0].kind, LightKind::Point { position, attenuation });
}

#[test]
fn line_ends_marks_and_comments_change_nothing() {
    let text = format!(
        "{PRELUDE}Group {{ numObjects 1 # one\nMaterialIndex 1 // the second\nSphere {{ center 0 0 0 radius 1 }} }}\n"
    );
    let expected = parse(&text).expect("a good scene");
    for variant in [text.replace('\n', "\r\n"), text.replace('\n', "\r"), format!("\u{feff}{text}")] {
        let read = parse(&variant).expect("a good scene");
        assert_eq!(read.nodes, expected.nodes);
        assert_eq!(read.camera, expected.camera);
    }
}

#[test]
fn numbers_are_read_as_scanf_reads_them() {
    let scene = scene("Group { numObjects +1 MaterialIndex 00 Sphere { center 1. .5 -2e-3 radius +3E0 } }");
    let NodeKind::Shape { shape, .. } = &scene.nodes[1].kind else {
        panic!("a shape");
    };
    let center = DVec3::new(1.0, 0.5, -0.002);
    assert_eq!(*shape, ShapeSpec::Sphere { center, radius: 3.0 });
}

#[test]
fn a_matrix_is_row_major_and_acts_on_columns() {
    let scene = scene(
        "Group { numObjects 1 MaterialIndex 0 Transform {
            Matrix4f { 0 -1 0 5  1 0 0 6  0 0 2 7  0 0 0 1 }
            Sphere { center 0 0 0 radius 1 } } }",
    );
    let NodeKind::Transform(list) = &scene.nodes[1].kind else {
        panic!("a transform");
    };
    let moved = list[0].matrix() * DVec4::new(1.0, 0.0, 1.0, 1.0);
    assert_eq!(moved, DVec4::new(5.0, 7.0, 9.0, 1.0));
}

#[test]
fn tiny_transforms_are_not_singular() {
    let scene = scene(
        "Group { numObjects 1 MaterialIndex 0 Transform { UniformScale 1e-6
            Matrix { 1e-20 0 0 0  0 1 0 0  0 0 1e20 0  0 0 0 1 }
            Sphere { center 0 0 0 radius 1 } } }",
    );
    let NodeKind::Transform(list) = &scene.nodes[1].kind else {
        panic!("a transform");
    };
    assert_eq!(list[0].matrix(), DMat4::from_scale(DVec3::splat(1e-6)));
}

#[test]
fn a_mesh_named_twice_is_stored_once() {
    let scene = scene(
        "Group { numObjects 2 MaterialIndex 0
            TriangleMesh { obj_file one.obj }
            TriangleMesh { smooth 1 obj_file \"one.obj\" } }",
    );
    assert_eq!(scene.meshes.len(), 1);
    let kinds: Vec<_> = scene.nodes[1..].iter().map(|node| &node.kind).collect();
    let mesh = |smooth| NodeKind::Shape { shape: ShapeSpec::Mesh { mesh: 0, smooth }, material: 0 };
    assert_eq!(kinds, [&mesh(false), &mesh(true)]);
}
