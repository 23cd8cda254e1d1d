//! Lines and columns of byte offsets.

use super::Position;

/// Line and column of a byte offset, counted from the start of the text.
pub(super) fn position_of(text: &str, offset: usize) -> Position {
    LineCounter::starting_at(bom_length(text)).advance(text, offset)
}

/// Length of the byte-order mark at the start of the text: 3 or 0.
pub(super) fn bom_length(text: &str) -> usize {
    if text.starts_with('\u{feff}') { 3 } else { 0 }
}

/// Counts lines (ended by LF, CR LF or CR) and characters, always forwards, so that a file of
/// one very long line costs no more than any other.
pub(super) struct LineCounter {
    offset: usize,
    at: Position,
}

impl LineCounter {
    /// Line 1, column 1 is at this offset.
    pub fn starting_at(offset: usize) -> Self {
        Self { offset, at: Position { line: 1, column: 1 } }
    }

    /// Line and column of `target`, which must not be before the last one asked for.
    pub fn advance(&mut self, text: &str, target: usize) -> Position {
        let bytes = text.as_bytes();
        while self.offset < target {
            let byte = bytes[self.offset];
            self.offset += 1;
            let followed_by_lf = bytes.get(self.offset) == Some(&b'\n');
            if byte == b'\n' || (byte == b'\r' && !followed_by_lf) {
                self.at.line += 1;
                self.at.column = 1;
            } else if !is_continuation(byte) {
                self.at.column += 1;
            }
        }
        self.at
    }
}

/// Is this a second or later byte of a UTF-8 character?
fn is_continuation(byte: u8) -> bool {
    byte & 0b1100_0000 == 0b1000_0000
}
