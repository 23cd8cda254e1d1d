//! Reports on objects that cannot be: the whole report, word for word.

use crate::behind_prelude;
use insta::assert_snapshot;

#[test]
fn too_few_objects() {
    let text = r"Group {
    numObjects 3
    MaterialIndex 0
    Sphere { center 0 0 0 radius 1 }
    Sphere { center 1 0 0 radius 1 }
}";
    assert_snapshot!(behind_prelude(text), @r"
    error: `numObjects` says 3, but the block ends after 2 objects
     --> scene.txt:8:1
      |
    4 |     numObjects 3
      |                - announced here
    ...
    8 | }
      | ^
    ");
}

#[test]
fn too_many_objects() {
    let text = r"Group {
    numObjects 1
    MaterialIndex 0
    Sphere { center 0 0 0 radius 1 }
    Sphere { center 1 0 0 radius 1 }
}";
    assert_snapshot!(behind_prelude(text), @r"
    error: `numObjects` says 1, but here is object number 2
     --> scene.txt:7:5
      |
    4 |     numObjects 1
      |                - announced here
    ...
    7 |     Sphere { center 1 0 0 radius 1 }
      |     ^^^^^^
    ");
}

#[test]
fn material_out_of_range() {
    let text = r"Group { numObjects 1 MaterialIndex 2
}";
    assert_snapshot!(behind_prelude(text), @r"
    error: there is no material 2
     --> scene.txt:3:36
      |
    3 | Group { numObjects 1 MaterialIndex 2
      |                                    ^
      |
      = help: the file has 2 materials, with indices 0 to 1
    ");
}

#[test]
fn shape_without_material() {
    let text = r"Group { numObjects 1
    Sphere { center 0 0 0 radius 1 }
}";
    assert_snapshot!(behind_prelude(text), @r"
    error: this `Sphere` has no material
     --> scene.txt:4:5
      |
    4 |     Sphere { center 0 0 0 radius 1 }
      |     ^^^^^^
      |
      = help: put a `MaterialIndex` before the first shape
    ");
}

#[test]
fn radius_zero() {
    let text = r"Group { numObjects 1 MaterialIndex 0
    Sphere { center 0 0 0 radius 0 }
}";
    assert_snapshot!(behind_prelude(text), @r"
    error: `radius` must be above zero, found `0`
     --> scene.txt:4:34
      |
    4 |     Sphere { center 0 0 0 radius 0 }
      |                                  ^
    ");
}

#[test]
fn normal_zero() {
    let text = r"Group { numObjects 1 MaterialIndex 0
    Plane { normal 0 0 0 offset 0 }
}";
    assert_snapshot!(behind_prelude(text), @r"
    error: `normal` must not be the zero vector
     --> scene.txt:4:13
      |
    4 |     Plane { normal 0 0 0 offset 0 }
      |             ^^^^^^
    ");
}

#[test]
fn singular_scale() {
    let text = r"Group { numObjects 1 MaterialIndex 0
    Transform {
        Translate 1 2 3
        Scale 1 0 1
        Sphere { center 0 0 0 radius 1 }
    }
}";
    assert_snapshot!(behind_prelude(text), @r"
    error: this `Scale` is singular: it flattens what it transforms
     --> scene.txt:6:9
      |
    6 |         Scale 1 0 1
      |         ^^^^^
      |
      = help: a transform must be invertible; use a small factor instead of zero
    ");
}

#[test]
fn matrix_not_affine() {
    let text = r"Group { numObjects 1 MaterialIndex 0
    Transform {
        Matrix4f {
            1 0 0 0
            0 1 0 0
            0 0 1 0
            4 5 6 1
        }
    }
}";
    assert_snapshot!(behind_prelude(text), @r"
    error: the last row of this `Matrix4f` must be 0 0 0 1
     --> scene.txt:5:9
      |
    5 |         Matrix4f {
      |         ^^^^^^^^
      |
      = help: the matrix is listed row by row; the translation is the 4th, 8th and 12th number
    ");
}

#[test]
fn object_not_last() {
    let text = r"Group { numObjects 1 MaterialIndex 0
    Transform {
        Sphere { center 0 0 0 radius 1 }
        Scale 1 2 1
    }
}";
    assert_snapshot!(behind_prelude(text), @r"
    error: expected `}` after the one object of `Transform`, found `Scale`
     --> scene.txt:6:9
      |
    5 |         Sphere { center 0 0 0 radius 1 }
      |         ------ this is its object
    6 |         Scale 1 2 1
      |         ^^^^^
    ");
}

#[test]
fn transform_without_object() {
    let text = r"Group { numObjects 1 MaterialIndex 0
    Transform { Scale 1 2 1 }
}";
    assert_snapshot!(behind_prelude(text), @r"
    error: this `Transform` has no object
     --> scene.txt:4:29
      |
    4 |     Transform { Scale 1 2 1 }
      |     ---------               ^ expected an object before this
      |     |
      |     block opened here
    ");
}

#[test]
fn mesh_not_found() {
    let text = r"Group { numObjects 1 MaterialIndex 0
    TriangleMesh { obj_file teapot.obj }
}";
    assert_snapshot!(behind_prelude(text), @r"
    error: cannot use this mesh: there is no file `teapot.obj`
     --> scene.txt:4:29
      |
    4 |     TriangleMesh { obj_file teapot.obj }
      |                             ^^^^^^^^^^
    ");
}

#[test]
fn disc_without_center() {
    let text = r"Group { numObjects 1 MaterialIndex 0 Plane { normal 0 1 0 offset 0 radius 2 } }";
    assert_snapshot!(behind_prelude(text), @r"
    error: this `Plane` has no `center`
     --> scene.txt:3:77
      |
    3 | Group { numObjects 1 MaterialIndex 0 Plane { normal 0 1 0 offset 0 radius 2 } }
      |                                      ----- block opened here                ^ expected `center` before this
    ");
}
