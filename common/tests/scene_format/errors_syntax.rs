//! Reports on texts that break the grammar: the whole report, word for word.

use crate::{behind_prelude, report};
use insta::assert_snapshot;

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
fn name_missing() {
    let text = r"Group { numObjects 1 MaterialIndex 0 TriangleMesh { obj_file } }";
    assert_snapshot!(behind_prelude(text), @r"
    error: expected a file name for `obj_file`, found `}`
     --> scene.txt:3:62
      |
    3 | Group { numObjects 1 MaterialIndex 0 TriangleMesh { obj_file } }
      |                                                              ^
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

#[test]
fn an_explanation_far_away_has_an_excerpt_of_its_own() {
    let text = format!("Group {{ numObjects 2{}MaterialIndex 0", "\n".repeat(1000));
    assert_snapshot!(behind_prelude(&text), @r"
    error: the file ends inside of this `Group`
        --> scene.txt:1003:16
         |
    1003 | MaterialIndex 0
         |                ^ expected `}`
         |
        :::
       3 | Group { numObjects 2
         | ----- block opened here
    ");
}
