//! No text brings the parser down: accuracy.md, property 18.

use crate::{PRELUDE, parse, report};
use common::scene::SceneError;
use proptest::prelude::*;
use std::time::{Duration, Instant};

const SCENES: [&str; 3] = [
    "PerspectiveCamera { center 0 0 10 direction 0 0 -1 up 0 1 0 angle 30 }
Lights { numLights 2
    DirectionalLight { direction -0.5 -.5 -1. color 0.9 0.9 0.9 } # key
    PointLight { position 0 5 0 color 1 1 1 attenuation 1 0 0 } }
Background { color 0.2 0 6e-1 ambientLight 0.1 0.1 0.1 }
Materials { numMaterials 3
    PhongMaterial { diffuseColor 1 0 0 specularColor 1 1 1 exponent 32 }
    Material { reflectiveColor 0.5 0.5 0.5 transparentColor 1 1 1 indexOfRefraction 1.5 }
    Marble { Transform { UniformScale 2 } materialIndex 0 materialIndex 1 octaves 3 frequency 1 amplitude 2 } }
Group { numObjects 2
    MaterialIndex 2
    Sphere { center 0 0 0 radius 1 }
    Transform { Translate 0 1 0 Rotate { 0 1 0 45 } Group { numObjects 1
        MaterialIndex 0 Triangle { vertex0 0 0 0 vertex1 1 0 0 vertex2 0 1 0 } } } }",
    "\u{feff}OrthographicCamera{center 0 0 5 direction 0 0 -1 up 0 1 0 size 2 screen flat}\r\n\
Materials{numMaterials 1 Material{}}// ü\r\nGroup{numObjects 1 MaterialIndex 0\r\n\
Transform{Matrix4f{1 0 0 5 0 1 0 0 0 0 1 0 0 0 0 1}TriangleMesh{obj_file one.obj smooth 1}}}",
    "OrthographicCamera { center 0 0 5 direction 0 0 -1 up 0 1 0 size 2 }
Materials { numMaterials 1 Material { emissiveColor 1 1 1 } }
Group { numObjects 1 MaterialIndex 0 Plane { normal 0 1 0 offset -2 center 0 0 0 radius 3 } }",
];

/// The property: a scene, or an error that says where, in words of a reasonable number.
fn check(text: &str) -> Result<(), TestCaseError> {
    if let Err(error) = parse(text) {
        let lines = text.bytes().filter(|b| matches!(b, b'\n' | b'\r')).count() as u32 + 1;
        let at = error.position().expect("a position");
        prop_assert!((1..=lines).contains(&at.line) && at.column >= 1, "{}", error);
        prop_assert!(error.to_string().len() < 4096, "{}", error);
        prop_assert!(!error.message().is_empty() && !error.message().contains('\n'));
    }
    Ok(())
}

fn swapped(text: &str, a: usize, b: usize) -> String {
    let mut words: Vec<&str> = text.split_inclusive(char::is_whitespace).collect();
    let count = words.len();
    words.swap(a % count, b % count);
    words.concat()
}

#[test]
fn every_prefix_is_read_or_refused() {
    for text in SCENES {
        parse(text).expect("a good scene");
        for end in (0..text.len()).filter(|&end| text.is_char_boundary(end)) {
            check(&text[..end]).expect("the property");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 500, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn every_byte_edit_is_read_or_refused(which in 0..SCENES.len(), at: prop::sample::Index, byte: u8) {
        let mut bytes = SCENES[which].as_bytes().to_vec();
        let index = at.index(bytes.len());
        bytes[index] = byte;
        check(&String::from_utf8_lossy(&bytes))?;
    }

    #[test]
    fn every_swap_of_words_is_read_or_refused(which in 0..SCENES.len(), a: usize, b: usize) {
        check(&swapped(SCENES[which], a, b))?;
    }

    #[test]
    fn any_text_is_read_or_refused(text in r"(\PC|[{}#/\r\n\t]|Group|numObjects ){0,40}") {
        check(&text)?;
    }
}

/// Runs `work` and asks that it is done within two seconds, slow shared machines included.
fn quickly<T>(work: impl FnOnce() -> T) -> T {
    let start = Instant::now();
    let result = work();
    let elapsed = start.elapsed();
    assert!(elapsed < Duration::from_secs(2), "took {elapsed:?}");
    result
}

#[test]
fn a_hundred_thousand_nested_groups_and_transforms() {
    const DEPTH: usize = 100_000;
    for (open, close) in [("Group { numObjects 1\n", "}"), ("Transform { Scale 2 1 1\n", "}")] {
        let text = format!(
            "{PRELUDE}Group {{ numObjects 1 MaterialIndex 0\n{}Sphere {{ center 0 0 0 radius 1 }}{}}}",
            open.repeat(DEPTH),
            close.repeat(DEPTH)
        );
        let nodes = quickly(|| {
            let scene = parse(&text).unwrap_or_else(|error| panic!("{error}"));
            let count = scene.nodes.len();
            drop(scene);
            count
        });
        assert_eq!(nodes, DEPTH + 2);
    }
}

#[test]
fn unclosed_nesting_and_half_a_million_braces_are_errors_soon() {
    quickly(|| report(&format!("{PRELUDE}Group {{ numObjects 1 {}", "Transform { ".repeat(100_000))));
    quickly(|| report(&format!("{PRELUDE}{}", "}\n".repeat(500_000))));
}

#[test]
fn a_declared_count_allocates_nothing() {
    for text in ["Group { numObjects 4294967295 }", "Lights { numLights 4000000000 }"] {
        let error = quickly(|| parse(&format!("{PRELUDE}{text}")).expect_err("an error"));
        assert!(error.message().contains("says 4"), "{error}");
    }
    let material = quickly(|| report("Materials { numMaterials 4294967295 }"));
    assert!(material.contains("ends after 0 materials"), "{material}");
}

#[test]
fn an_error_in_a_line_of_ten_megabytes_prints_a_hundred_characters() {
    let good = "MaterialIndex 0 ".repeat(600_000);
    let text = format!("{PRELUDE}Group {{ numObjects 1 {good}Spheer {{ }} {good}}}");
    let error: SceneError = quickly(|| parse(&text).expect_err("an error"));
    let column = "Group { numObjects 1 ".len() + good.len() + 1;
    assert_eq!(error.position().map(|at| at.column as usize), Some(column));
    assert!(error.to_string().len() < 1000, "{error}");
    assert!(error.to_string().contains("did you mean `Sphere`?"));
}

#[test]
fn a_word_of_ten_megabytes_is_cut() {
    let error = quickly(|| report(&"x".repeat(10_000_000)));
    assert!(error.len() < 1000);
}
