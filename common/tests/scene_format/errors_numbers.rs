//! Reports on numbers that are none, or none that can be used: the whole report, word for word.

use crate::behind_prelude;
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
