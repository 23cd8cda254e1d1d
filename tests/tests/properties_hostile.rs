//! accuracy.md, property 18, on the repository's own scenes: every prefix, and a hundred
//! thousand damaged texts, are a scene or a located error. (`common/tests/scene_format` asks the
//! same of short texts, and of what no editor would write.)

use common::mesh::{Mesh, MeshError};
use common::scene::{MeshSource, parse_str};
use rayon::prelude::*;
use std::sync::Arc;
use std::time::Instant;
use tests::property::{repository, run, tally};

/// Any name is the same small mesh: reading files is not what is tested here.
struct AnyMesh(Arc<Mesh>);

impl MeshSource for AnyMesh {
    fn mesh(&mut self, _: &str) -> Result<Arc<Mesh>, MeshError> {
        Ok(Arc::clone(&self.0))
    }
}

fn texts() -> Vec<(String, String)> {
    let folder = repository().join("scenes");
    let entries = std::fs::read_dir(folder).expect("the scenes of the repository");
    let paths = entries
        .map(|e| e.expect("a folder entry").path())
        .filter(|p| p.extension().is_some_and(|e| e == "txt"));
    let mut texts: Vec<_> =
        paths.map(|p| (p.display().to_string(), std::fs::read_to_string(&p).expect("a text"))).collect();
    texts.sort();
    texts
}

/// A scene, or an error with a place in the text and a message of a reasonable length.
fn survives(text: &str) -> Result<f64, String> {
    let Err(error) = parse_str("hostile.txt", text, &mut AnyMesh(Arc::default())) else { return Ok(1.0) };
    let lines = text.bytes().filter(|b| matches!(b, b'\n' | b'\r')).count() as u32 + 1;
    let located = error.position().is_some_and(|at| (1..=lines).contains(&at.line) && at.column >= 1);
    let short = !error.message().is_empty() && error.to_string().len() < 4096;
    if located && short { Ok(0.0) } else { Err(format!("{error}\nof\n{text}")) }
}

#[test]
fn p18_every_prefix_of_every_scene() {
    let started = Instant::now();
    let texts = texts();
    assert!(texts.len() > 50);
    let count: u64 = texts
        .par_iter()
        .map(|(name, text)| {
            let ends = (0..text.len()).filter(|&end| text.is_char_boundary(end));
            ends.map(|end| survives(&text[..end]).map_or_else(|e| panic!("{name} cut at {end}: {e}"), |_| 1))
                .sum::<u64>()
        })
        .sum();
    tally("p18 prefixes", count, 0.0, started);
}

#[test]
fn p18_a_hundred_thousand_damaged_scenes() {
    let texts = texts();
    run("p18 byte edits", 1801, 60_000, |draw| {
        let mut bytes = texts[draw.below(texts.len())].1.as_bytes().to_vec();
        let at = draw.below(bytes.len());
        match draw.below(3) {
            0 => bytes[at] = draw.bits() as u8,
            1 => {
                bytes.remove(at);
            }
            _ => bytes.insert(at, draw.pick(b"{}#0-.eE \n\x00")),
        }
        survives(&String::from_utf8_lossy(&bytes))
    });
    run("p18 swapped words", 1802, 40_000, |draw| {
        let text = &texts[draw.below(texts.len())].1;
        let mut words: Vec<&str> = text.split_inclusive(char::is_whitespace).collect();
        let (a, b) = (draw.below(words.len()), draw.below(words.len()));
        words.swap(a, b);
        survives(&words.concat())
    });
}
