//! Words of an OBJ file, statement by statement.
//!
//! A statement ends with its line, unless a backslash at the end continues it. `#` begins a
//! comment. Lines end with LF, CR LF or CR.

use super::super::MeshError;
use super::decimal::fast_f32;

/// A place in an OBJ file.
pub(super) struct Tokens<'a> {
    bytes: &'a [u8],
    at: usize,
    /// Line of `at`, from 1.
    pub line: usize,
}

impl<'a> Tokens<'a> {
    pub fn new(bytes: &'a [u8]) -> Self {
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        Self { bytes, at: 0, line: 1 }
    }

    /// Goes to the next statement and gives its keyword; `None` at the end of the file.
    #[inline]
    pub fn keyword(&mut self) -> Option<&'a [u8]> {
        loop {
            self.skip_blanks();
            match self.bytes.get(self.at)? {
                b'\n' | b'\r' => self.skip_line_end(),
                b'#' => self.skip_statement(),
                _ => return self.word(),
            }
        }
    }

    /// The next word of this statement, if there is one.
    #[inline]
    pub fn word(&mut self) -> Option<&'a [u8]> {
        self.skip_blanks();
        let rest = &self.bytes[self.at..];
        let length = rest.iter().position(|&b| ends_word(b)).unwrap_or(rest.len());
        self.at += length;
        (length > 0).then(|| &rest[..length])
    }

    /// The next word as a finite number; `None` at the end of the statement.
    #[inline]
    pub fn number(&mut self) -> Result<Option<f32>, MeshError> {
        self.skip_blanks();
        if let Some((value, length)) = fast_f32(&self.bytes[self.at..])
            && self.word_ends_at(self.at + length)
        {
            self.at += length;
            return Ok(Some(value));
        }
        self.slow_number()
    }

    fn slow_number(&mut self) -> Result<Option<f32>, MeshError> {
        let Some(word) = self.word() else {
            return Ok(None);
        };
        let text = str::from_utf8(word).unwrap_or_default();
        match text.parse::<f32>() {
            Ok(value) if value.is_finite() => Ok(Some(value)),
            Ok(_) if word.iter().any(u8::is_ascii_digit) => {
                Err(self.error(format!("{} is too large for a 32-bit float", quoted(word))))
            }
            Ok(_) => Err(self.error(format!("{} is not a finite number", quoted(word)))),
            Err(_) => Err(self.error(format!("expected a number, found {}", quoted(word)))),
        }
    }

    /// The next word as a vertex index without texture coordinate and normal, if it is one.
    #[inline]
    pub fn plain_index(&mut self) -> Option<i64> {
        self.skip_blanks();
        let (value, length) = integer(&self.bytes[self.at..])?;
        if !self.word_ends_at(self.at + length) {
            return None;
        }
        self.at += length;
        Some(value)
    }

    /// Skips what is left of this statement. A comment is not continued by a backslash, but
    /// other statements are.
    pub fn skip_statement(&mut self) {
        while self.word().is_some() {}
        let rest = &self.bytes[self.at..];
        let is_end = |b: &u8| matches!(b, b'\n' | b'\r');
        self.at += rest.iter().position(is_end).unwrap_or(rest.len());
    }

    /// An error in this line.
    pub fn error(&self, message: impl Into<String>) -> MeshError {
        MeshError::at_line(self.line, message)
    }

    #[inline]
    fn word_ends_at(&self, offset: usize) -> bool {
        self.bytes.get(offset).is_none_or(|&b| ends_word(b))
    }

    /// Skips blanks, and line ends behind a backslash.
    #[inline]
    fn skip_blanks(&mut self) {
        while let Some(&byte) = self.bytes.get(self.at) {
            match byte {
                b' ' | b'\t' | b'\x0b' | b'\x0c' => self.at += 1,
                b'\\' if self.continues() => {
                    self.at += 1;
                    self.skip_line_end();
                }
                b'\\' => self.at += 1,
                _ => return,
            }
        }
    }

    fn continues(&self) -> bool {
        matches!(self.bytes.get(self.at + 1), Some(b'\n' | b'\r'))
    }

    #[inline]
    fn skip_line_end(&mut self) {
        let carriage_return = self.bytes.get(self.at) == Some(&b'\r');
        self.at += 1;
        if carriage_return && self.bytes.get(self.at) == Some(&b'\n') {
            self.at += 1;
        }
        self.line += 1;
    }
}

#[inline]
fn ends_word(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t'..=b'\r' | b'#' | b'\\')
}

/// A signed whole number of at most 18 digits at the front, with its length.
#[inline]
pub(super) fn integer(bytes: &[u8]) -> Option<(i64, usize)> {
    let negative = bytes.first() == Some(&b'-');
    let start = usize::from(negative || bytes.first() == Some(&b'+'));
    let mut value = 0_i64;
    let mut at = start;
    while let Some(digit) = bytes.get(at).map(|b| b.wrapping_sub(b'0')).filter(|d| *d < 10) {
        value = value.wrapping_mul(10).wrapping_add(i64::from(digit));
        at += 1;
    }
    let good = (1..=18).contains(&(at - start));
    good.then_some((if negative { -value } else { value }, at))
}

/// A word in backquotes, as text, cut after 40 characters.
pub(super) fn quoted(word: &[u8]) -> String {
    let text = String::from_utf8_lossy(&word[..word.len().min(160)]);
    let mut shown: String = text.chars().take(40).collect();
    if shown.len() < word.len() {
        shown.push('…');
    }
    format!("`{}`", shown.escape_debug())
}
