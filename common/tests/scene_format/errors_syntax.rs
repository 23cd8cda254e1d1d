//! Reports on texts that break the grammar: the whole report, word for word.

use crate::{behind_prelude, report};
use insta::assert_snapshot;

#[test]
fn number_missing() {
    let text = r"Group {
    numObjects 1
    MaterialIndex 0
    Sphere { center 0 0 0 radius }
}";
    assert_snapshot!(behind_prelude(text), @r"
    error: expected a number for `radius`, found `}`
     --> scene.txt:6:34
      |
    6 |     Sphere { center 0 0 0 radius }
      |                                  ^
    ");
}

#[test]
fn number_misspelt() {
    let text = r"Group { numObjects 1 MaterialIndex 0
    Sphere { center 0 1O 0 radius 1 }
}";
    assert_snapshot!(behind_prelude(text), @r"
    error: expected a number for `center` (second of 3), found `1O`
     --> scene.txt:4:23
      |
    4 |     Sphere { center 0 1O 0 radius 1 }
      |                       ^^
    ");
}

#[test]
fn commas_between_numbers() {
    let text = r"Background { color 0.1, 0.2, 0.3 }";
    assert_snapshot!(behind_prelude(text), @r"
    error: expected a number for `color` (first of 3), found `0.1,`
     --> scene.txt:3:20
      |
    3 | Background { color 0.1, 0.2, 0.3 }
      |                    ^^^^
      |
      = help: numbers are separated by blanks, not by commas
    ");
}

#[test]
fn infinite_number() {
    let text = r"Background { color 0 inf 0 }";
    assert_snapshot!(behind_prelude(text), @r"
    error: expected a number for `color` (second of 3), found `inf`
     --> scene.txt:3:22
      |
    3 | Background { color 0 inf 0 }
      |                      ^^^
      |
      = help: numbers must be finite
    ");
}

#[test]
fn hexadecimal_number() {
    let text = r"Background { color 0 0x1p3 0 }";
    assert_snapshot!(behind_prelude(text), @r"
    error: expected a number for `color` (second of 3), found `0x1p3`
     --> scene.txt:3:22
      |
    3 | Background { color 0 0x1p3 0 }
      |                      ^^^^^
      |
      = help: numbers are decimal
    ");
}

#[test]
fn number_too_large() {
    let text = r"Background { color 0 1e39 0 }";
    assert_snapshot!(behind_prelude(text), @r"
    error: `1e39` is too large for a 32-bit float
     --> scene.txt:3:22
      |
    3 | Background { color 0 1e39 0 }
      |                      ^^^^
    ");
}

#[test]
fn keyword_misspelt() {
    let text = r"Group {
    numobjects 1
}";
    assert_snapshot!(behind_prelude(text), @r"
    error: expected `numObjects` at the start of `Group`, found `numobjects`
     --> scene.txt:4:5
      |
    4 |     numobjects 1
      |     ^^^^^^^^^^
      |
      = help: did you mean `numObjects`?
    ");
}

#[test]
fn block_misspelt() {
    let text = r"Lihgts { numLights 0 }";
    assert_snapshot!(behind_prelude(text), @r"
    error: expected a block, found `Lihgts`
     --> scene.txt:3:1
      |
    3 | Lihgts { numLights 0 }
      | ^^^^^^
      |
      = help: did you mean `Lights`?
    ");
}

#[test]
fn field_of_another_block() {
    let text = r"Group { numObjects 1 MaterialIndex 0
    Sphere { center 0 0 0 size 1 }
}";
    assert_snapshot!(behind_prelude(text), @r"
    error: expected a field of `Sphere`, found `size`
     --> scene.txt:4:27
      |
    4 |     Sphere { center 0 0 0 size 1 }
      |     ------ in this block  ^^^^
      |
      = help: expected one of `center`, `radius`
    ");
}

#[test]
fn count_not_whole() {
    let text = r"Group { numObjects 1.5 }";
    assert_snapshot!(behind_prelude(text), @r"
    error: expected a whole number for `numObjects`, found `1.5`
     --> scene.txt:3:20
      |
    3 | Group { numObjects 1.5 }
      |                    ^^^
    ");
}

#[test]
fn count_negative() {
    let text = r"Group { numObjects -1 }";
    assert_snapshot!(behind_prelude(text), @r"
    error: `numObjects` must not be negative, found `-1`
     --> scene.txt:3:20
      |
    3 | Group { numObjects -1 }
      |                    ^^
    ");
}

#[test]
fn count_too_large() {
    let text = r"Group { numObjects 99999999999 }";
    assert_snapshot!(behind_prelude(text), @r"
    error: `99999999999` is too large for `numObjects`
     --> scene.txt:3:20
      |
    3 | Group { numObjects 99999999999 }
      |                    ^^^^^^^^^^^
    ");
}

#[test]
fn brace_never_closed() {
    let text = r"Group {
    numObjects 1
    Transform {
        Scale 1 2 1";
    assert_snapshot!(behind_prelude(text), @r"
    error: the file ends inside of this `Transform`
     --> scene.txt:6:20
      |
    5 |     Transform {
      |     --------- block opened here
    6 |         Scale 1 2 1
      |                    ^ expected `}`
    ");
}

#[test]
fn field_given_twice() {
    let text = r"Group { numObjects 1 MaterialIndex 0
    Sphere { radius 1 center 0 0 0 radius 2 }
}";
    assert_snapshot!(behind_prelude(text), @r"
    error: `radius` is given twice
     --> scene.txt:4:36
      |
    4 |     Sphere { radius 1 center 0 0 0 radius 2 }
      |              ------                ^^^^^^
      |              |
      |              first given here
    ");
}

#[test]
fn field_missing() {
    let text = r"Group { numObjects 1 MaterialIndex 0
    Sphere {
        center 0 0 0
    }
}";
    assert_snapshot!(behind_prelude(text), @r"
    error: this `Sphere` has no `radius`
     --> scene.txt:6:5
      |
    4 |     Sphere {
      |     ------ block opened here
    5 |         center 0 0 0
    6 |     }
      |     ^ expected `radius` before this
    ");
}

#[test]
fn name_not_closed() {
    let text = r#"Group { numObjects 1 MaterialIndex 0
    TriangleMesh { obj_file "teapot.obj }
}"#;
    assert_snapshot!(behind_prelude(text), @r#"
    error: this quoted file name is not closed on its line
     --> scene.txt:4:29
      |
    4 |     TriangleMesh { obj_file "teapot.obj }
      |                             ^^^^^^^^^^^^^
    "#);
}

#[test]
fn text_after_the_last_block() {
    let text = r"Group { numObjects 0 } }";
    assert_snapshot!(behind_prelude(text), @r"
    error: expected a block, found `}`
     --> scene.txt:3:24
      |
    3 | Group { numObjects 0 } }
      |                        ^
      |
      = help: expected one of `OrthographicCamera`, `PerspectiveCamera`, `Background`, `Lights`, `Materials`, `Group`
    ");
}

#[test]
fn empty_file() {
    let text = r"";
    assert_snapshot!(report(text), @r"
    error: this file has no camera
     --> scene.txt:1:1
      |
    1 |
      | ^
      |
      = help: add a `PerspectiveCamera { … }` or an `OrthographicCamera { … }`
    ");
}
