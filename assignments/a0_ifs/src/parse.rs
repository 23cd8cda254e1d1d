//! Reading an IFS file (A0T1).
//!
//! ```text
//! 2            # how many maps; comments begin with # or //
//! 0.5          // probability of the first
//! .5  0  0     # 3 x 3 matrix, row by row, the last row 0 0 1
//!  0 .5  0
//!  0  0  1
//! 0.5   .5 0 .5   0 .5 .5   0 0 1
//! ```

use crate::{Affine2, Ifs, IfsError, WeightedMap};
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// Longest file that is read, in bytes; `/dev/zero` has no end.
const LONGEST_FILE: u64 = 64 << 20;

/// Reads an IFS file; see [`parse`].
///
/// # Errors
/// [`IfsError`] if the file cannot be read or is no IFS file.
pub fn load(path: &Path) -> Result<Ifs, IfsError> {
    let bytes = read_bytes(path)
        .map_err(|error| IfsError::of_file(path, format!("cannot read the file: {error}")))?;
    let text = String::from_utf8(bytes)
        .map_err(|_| IfsError::of_file(path, "the file is not a text file (UTF-8)"))?;
    parse(path, &text)
}

fn read_bytes(path: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let read = File::open(path)?.take(LONGEST_FILE + 1).read_to_end(&mut bytes)?;
    if read as u64 > LONGEST_FILE {
        return Err(io::Error::other("it is longer than 64 MiB"));
    }
    Ok(bytes)
}

/// Parses the text of an IFS file; `path` is used in error texts. Numbers are separated by white
/// space; comments begin with `#` or `//` and end with the line.
///
/// # Errors
/// [`IfsError`] with line and column of the first thing that is wrong.
pub fn parse(path: &Path, text: &str) -> Result<Ifs, IfsError> {
    let mut reader = Reader::new(path, text);
    let count = reader.count()?;
    // Nothing is allocated for maps that are only promised.
    let mut maps = Vec::new();
    for number in 1..=count {
        maps.push(reader.map(&format!("map {number} of {count}"))?);
    }
    reader.end(count)?;
    Ifs::new(maps).map_err(|sum| {
        let message = format!("the probabilities must add up to 1, but they add up to {sum:.4}");
        reader.fault(reader.probability, message)
    })
}

/// A word of the text and where it begins, in bytes; empty at the end.
#[derive(Clone, Copy)]
struct Word<'a> {
    text: &'a str,
    offset: usize,
}

struct Reader<'a> {
    path: &'a Path,
    text: &'a str,
    /// Where to go on reading, in bytes.
    offset: usize,
    /// The last probability read, which is where a wrong sum is reported.
    probability: Word<'a>,
}

impl<'a> Reader<'a> {
    fn new(path: &'a Path, text: &'a str) -> Self {
        const BYTE_ORDER_MARK: char = '\u{feff}';
        Self {
            path,
            text,
            offset: text.len() - text.trim_start_matches(BYTE_ORDER_MARK).len(),
            probability: Word { text: "", offset: 0 },
        }
    }

    /// The next word, or the empty one at the end of the text.
    fn word(&mut self) -> Word<'a> {
        self.skip_blanks();
        let rest = &self.text[self.offset..];
        let length = rest
            .char_indices()
            .find(|&(i, c)| c.is_whitespace() || starts_comment(&rest[i..]))
            .map_or(rest.len(), |(i, _)| i);
        let word = Word { text: &rest[..length], offset: self.offset };
        self.offset += length;
        word
    }

    fn skip_blanks(&mut self) {
        loop {
            let rest = &self.text[self.offset..];
            let trimmed = rest.trim_start();
            self.offset += rest.len() - trimmed.len();
            if !starts_comment(trimmed) {
                return;
            }
            self.offset += trimmed.find('\n').unwrap_or(trimmed.len());
        }
    }

    fn count(&mut self) -> Result<u32, IfsError> {
        let word = self.word();
        match word.text.parse() {
            Ok(0) => Err(self.fault(word, "a system needs at least one map")),
            Ok(count) => Ok(count),
            Err(_) => Err(self.expected("the number of maps", word)),
        }
    }

    fn map(&mut self, name: &str) -> Result<WeightedMap, IfsError> {
        let probability = self.probability(name)?;
        let mut rows = [[0.0; 3]; 2];
        for (r, row) in rows.iter_mut().enumerate() {
            for (c, entry) in row.iter_mut().enumerate() {
                let what = format!("row {}, column {} of {name}", r + 1, c + 1);
                (*entry, _) = self.number(&what)?;
            }
        }
        for expected in [0.0, 0.0, 1.0] {
            self.last_row(expected, name)?;
        }
        Ok(WeightedMap { probability, map: Affine2 { rows } })
    }

    fn probability(&mut self, name: &str) -> Result<f64, IfsError> {
        let (value, word) = self.number(&format!("the probability of {name}"))?;
        self.probability = word;
        if value < 0.0 {
            return Err(self.fault(word, "a probability cannot be negative"));
        }
        Ok(value)
    }

    fn last_row(&mut self, expected: f64, name: &str) -> Result<(), IfsError> {
        let what = format!("the last row of {name}, which is 0 0 1");
        let (value, word) = self.number(&what)?;
        if value == expected {
            return Ok(());
        }
        Err(self.expected(&format!("{expected}, from {what}"), word))
    }

    /// A finite number within the range of single precision, as C's `scanf` reads it.
    fn number(&mut self, what: &str) -> Result<(f64, Word<'a>), IfsError> {
        let word = self.word();
        let is_decimal = !word.text.contains(|c: char| c.is_alphabetic() && !matches!(c, 'e' | 'E'));
        let value: f64 = match word.text.parse() {
            Ok(value) if is_decimal => value,
            _ => return Err(self.expected(what, word)),
        };
        if value.abs() <= f64::from(f32::MAX) {
            return Ok((value, word));
        }
        Err(self.fault(word, format!("{} is out of range for {what}", word.text)))
    }

    fn end(&mut self, count: u32) -> Result<(), IfsError> {
        let word = self.word();
        if word.text.is_empty() {
            return Ok(());
        }
        let what = format!("the end of the file after {count} maps, as its first number says");
        Err(self.expected(&what, word))
    }

    fn expected(&self, what: &str, found: Word) -> IfsError {
        let found_text = match found.text {
            "" => "the file ends here".to_owned(),
            text => format!("found '{}'", shortened(text)),
        };
        self.fault(found, format!("expected {what}, but {found_text}"))
    }

    fn fault(&self, at: Word, message: impl Into<String>) -> IfsError {
        IfsError::at(self.path, self.text, at.offset, at.text.len(), message)
    }
}

fn starts_comment(text: &str) -> bool {
    text.starts_with('#') || text.starts_with("//")
}

fn shortened(word: &str) -> String {
    const LONGEST: usize = 40;
    match word.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}...", &word[..end]),
        None => word.to_owned(),
    }
}

#[cfg(test)]
mod tests;
