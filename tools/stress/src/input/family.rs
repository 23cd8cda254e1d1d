//! Kinds of input.

/// An input that is as it should be, or as bad as it should be.
pub struct Sample {
    /// What it is called; a file's suffix tells its kind.
    pub name: String,
    /// What is in it.
    pub bytes: Vec<u8>,
}

/// How many cases are made of the samples of a family.
#[derive(Clone, Copy)]
pub struct Numbers {
    /// Prefixes of each sample, at most; the shortest and longest ones, and some between.
    pub prefixes: usize,
    /// Edits of single bytes, of all samples together.
    pub edits: usize,
    /// Swaps of words, of all samples together.
    pub swaps: usize,
}

/// Inputs of one kind.
pub struct Family {
    /// What they are called.
    pub name: &'static str,
    /// The repository's own, and some that promise more than they hold.
    pub samples: fn() -> Vec<Sample>,
    /// Reads one, by its name and content; an error says why the answer was not acceptable.
    pub read: fn(&str, &[u8]) -> Result<(), String>,
    /// How many cases, by whether there is time.
    pub numbers: fn(bool) -> Numbers,
}

/// What a refusal must be: said, and short enough to be read.
pub fn refusal(text: &str) -> Result<(), String> {
    match text.len() {
        0 => Err("it is refused without a word".to_owned()),
        1..=8192 => Ok(()),
        many => Err(format!("the refusal has {many} bytes")),
    }
}
