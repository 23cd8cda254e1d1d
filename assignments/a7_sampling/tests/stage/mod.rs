//! Scenes given as text, drawn by the program's own `run`.

use a7_sampling::Program;
use common::picture::{Film, Transfer, read};
use tests::program::parsed_words;

/// The picture of a scene with further flags, in linear light without loss.
pub fn picture(scene: &str, flags: &str) -> Film {
    let folder = tempfile::tempdir().expect("a folder for scratch");
    let place = |name: &str| folder.path().join(name).display().to_string();
    std::fs::write(place("scene.txt"), scene).expect("the folder can be written to");
    let (input, output) = (place("scene.txt"), place("out.pfm"));
    let words = ["a7_sampling", "-quiet", "-input", &input, "-output", &output];
    let words: Vec<String> = words.into_iter().chain(flags.split_whitespace()).map(str::to_owned).collect();
    let args = parsed_words::<Program>(&words).args;
    a7_sampling::run(&args).unwrap_or_else(|error| panic!("{flags}\n{}", error.report()));
    read(place("out.pfm").as_ref(), Transfer::Linear).expect("a picture was written")
}
