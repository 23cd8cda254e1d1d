//! Reports on texts whose blocks keep the grammar but make no scene: the whole report, word for word.

use crate::{behind_prelude, report};
use insta::assert_snapshot;

#[test]
fn block_given_twice() {
    let text = r"Background { color 0 0 0 }
Background { color 1 1 1 }";
    assert_snapshot!(behind_prelude(text), @r"
    error: a second `Background` block
     --> scene.txt:4:1
      |
    3 | Background { color 0 0 0 }
      | ---------- first given here
    4 | Background { color 1 1 1 }
      | ^^^^^^^^^^
    ");
}

#[test]
fn second_camera() {
    let text = r"OrthographicCamera { center 0 0 5 direction 0 0 -1 up 0 1 0 size 2 }";
    assert_snapshot!(behind_prelude(text), @r"
    error: a second camera
     --> scene.txt:3:1
      |
    1 | PerspectiveCamera { center 0 0 5 direction 0 0 -1 up 0 1 0 angle 40 }
      | ----------------- first given here
    2 | Materials { numMaterials 2 Material { } Material { } }
    3 | OrthographicCamera { center 0 0 5 direction 0 0 -1 up 0 1 0 size 2 }
      | ^^^^^^^^^^^^^^^^^^
    ");
}

#[test]
fn no_group() {
    let text = r"Background { color 0 0 0 }";
    assert_snapshot!(behind_prelude(text), @r"
    error: this file has no `Group`, so there is nothing to see
     --> scene.txt:3:27
      |
    3 | Background { color 0 0 0 }
      |                           ^
      |
      = help: add `Group { numObjects … }` with the objects
    ");
}

#[test]
fn no_camera() {
    let text = r"Group { numObjects 0 }";
    assert_snapshot!(report(text), @r"
    error: this file has no camera
     --> scene.txt:1:23
      |
    1 | Group { numObjects 0 }
      |                       ^
      |
      = help: add a `PerspectiveCamera { … }` or an `OrthographicCamera { … }`
    ");
}

#[test]
fn up_parallel_to_direction() {
    let text = r"OrthographicCamera {
    center 0 0 5
    direction 0 -2 0
    up 0 1 0
    size 2
}";
    assert_snapshot!(report(text), @r"
    error: `up` must not be parallel to `direction`
     --> scene.txt:4:5
      |
    3 |     direction 0 -2 0
      |     --------- direction given here
    4 |     up 0 1 0
      |     ^^
    ");
}

#[test]
fn angle_out_of_range() {
    let text = r"PerspectiveCamera { center 0 0 5 direction 0 0 -1 up 0 1 0 angle 180 }";
    assert_snapshot!(report(text), @r"
    error: `angle` must be between 0 and 180 degrees (both excluded), found `180`
     --> scene.txt:1:66
      |
    1 | PerspectiveCamera { center 0 0 5 direction 0 0 -1 up 0 1 0 angle 180 }
      |                                                                  ^^^
    ");
}

#[test]
fn materials_after_group() {
    let text = r"Group { numObjects 1
    MaterialIndex 0
}
Materials { numMaterials 0 }";
    assert_snapshot!(report(text), @r"
    error: `MaterialIndex` before the `Materials` block
     --> scene.txt:2:5
      |
    2 |     MaterialIndex 0
      |     ^^^^^^^^^^^^^
      |
      = help: the `Materials` block must stand before the `Group` that uses it
    ");
}

#[test]
fn texture_of_a_later_material() {
    let text = r"Materials {
    numMaterials 2
    Checkerboard { materialIndex 0 materialIndex 1 }
    Material { }
}";
    assert_snapshot!(report(text), @r"
    error: this texture is material 0, so it cannot blend material 0
     --> scene.txt:3:34
      |
    3 |     Checkerboard { materialIndex 0 materialIndex 1 }
      |                                  ^
      |
      = help: a texture blends materials that stand before it in the file
    ");
}

#[test]
fn too_many_octaves() {
    let text = r"Materials {
    numMaterials 2
    Material { }
    Noise { materialIndex 0 materialIndex 0 octaves 33 }
}";
    assert_snapshot!(report(text), @r"
    error: `octaves` must be at most 32, found `33`
     --> scene.txt:4:53
      |
    4 |     Noise { materialIndex 0 materialIndex 0 octaves 33 }
      |                                                     ^^
    ");
}
