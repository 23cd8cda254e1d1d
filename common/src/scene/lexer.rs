//! Tokens of the scene format, with their positions.
//!
//! ```text
//! Sphere{ center 0 -.5 1e2   # a comment ends with its line, and so does
//!         radius 1 }         // this one
//! ```
//!
//! A word ends at white space, at a brace or where a comment begins. File names are read by a
//! rule of their own ([`Lexer::name`]), because `meshes//cube#2.obj` is a good file name.
//! Tokens borrow from the text; each byte is looked at a fixed number of times.

use super::Position;
use super::line_counter::{LineCounter, bom_length, position_of};
use std::ops::Range;

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum TokenKind {
    /// `{`
    Open,
    /// `}`
    Close,
    /// A keyword, a number or a file name.
    Word,
    /// The end of the file.
    End,
}

/// One token; `text` is without the quotes of a quoted file name, `span` is with them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Token<'a> {
    pub kind: TokenKind,
    pub text: &'a str,
    pub span: Span,
    pub position: Position,
}

/// A range of bytes of the scene text, on character boundaries and within one line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Span {
    pub start: usize,
    pub end: usize,
}

impl From<Range<usize>> for Span {
    fn from(range: Range<usize>) -> Self {
        Self { start: range.start, end: range.end }
    }
}

/// Cuts a scene text into tokens.
pub(super) struct Lexer<'a> {
    text: &'a str,
    /// Offset of the next byte to read.
    offset: usize,
    /// Where lines and columns have been counted up to.
    counted: LineCounter,
}

impl<'a> Lexer<'a> {
    /// Starts behind the byte-order mark, if there is one.
    pub fn new(text: &'a str) -> Self {
        let offset = bom_length(text);
        Self { text, offset, counted: LineCounter::starting_at(offset) }
    }

    /// The next token; [`TokenKind::End`] again and again at the end.
    pub fn next(&mut self) -> Token<'a> {
        self.skip_blanks();
        let start = self.offset;
        let (kind, length) = match self.text.as_bytes().get(start) {
            None => return self.end(),
            Some(b'{') => (TokenKind::Open, 1),
            Some(b'}') => (TokenKind::Close, 1),
            Some(_) => (TokenKind::Word, word_length(&self.text[start..])),
        };
        self.take(kind, length)
    }

    /// The next token, read as a file name: up to white space or a brace, or in double quotes
    /// (then it may hold anything but a line end). A quote that is never closed is `Err`.
    pub fn name(&mut self) -> Result<Token<'a>, Token<'a>> {
        self.skip_blanks();
        let rest = &self.text[self.offset..];
        match rest.as_bytes().first() {
            None | Some(b'{' | b'}') => Ok(self.next()),
            Some(b'"') => self.quoted_name(rest),
            Some(_) => {
                let length = rest
                    .bytes()
                    .position(|byte| is_blank(byte) || matches!(byte, b'{' | b'}'))
                    .unwrap_or(rest.len());
                Ok(self.take(TokenKind::Word, length))
            }
        }
    }

    fn quoted_name(&mut self, rest: &'a str) -> Result<Token<'a>, Token<'a>> {
        let stop = rest[1..].bytes().position(|b| matches!(b, b'"' | b'\n' | b'\r'));
        match stop.map(|index| (index, rest.as_bytes()[index + 1])) {
            Some((index, b'"')) => {
                let token = self.take(TokenKind::Word, index + 2);
                Ok(Token { text: &rest[1..=index], ..token })
            }
            other => {
                let length = other.map_or(rest.len(), |(index, _)| index + 1);
                Err(self.take(TokenKind::Word, length))
            }
        }
    }

    fn take(&mut self, kind: TokenKind, length: usize) -> Token<'a> {
        let span = Span::from(self.offset..self.offset + length);
        let position = self.counted.advance(self.text, span.start);
        self.offset = span.end;
        Token { kind, text: &self.text[span.start..span.end], span, position }
    }

    /// The end is reported just behind the last thing written, not on the empty lines after it.
    fn end(&self) -> Token<'a> {
        let offset = self.text.trim_end().len().max(bom_length(self.text));
        Token {
            kind: TokenKind::End,
            text: "",
            span: Span::from(offset..offset),
            position: position_of(self.text, offset),
        }
    }

    fn skip_blanks(&mut self) {
        let bytes = self.text.as_bytes();
        while let Some(&byte) = bytes.get(self.offset) {
            if is_blank(byte) {
                self.offset += 1;
            } else if starts_comment(&bytes[self.offset..]) {
                self.offset += bytes[self.offset..]
                    .iter()
                    .position(|b| matches!(b, b'\n' | b'\r'))
                    .unwrap_or(bytes.len() - self.offset);
            } else {
                return;
            }
        }
    }
}

/// White space as C's `isspace` has it.
fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t'..=b'\r')
}

fn starts_comment(bytes: &[u8]) -> bool {
    bytes.starts_with(b"#") || bytes.starts_with(b"//")
}

fn word_length(rest: &str) -> usize {
    let bytes = rest.as_bytes();
    (0..bytes.len())
        .find(|&i| is_blank(bytes[i]) || matches!(bytes[i], b'{' | b'}') || starts_comment(&bytes[i..]))
        .unwrap_or(bytes.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(text: &str) -> Vec<(&str, u32, u32)> {
        let mut lexer = Lexer::new(text);
        std::iter::from_fn(|| {
            let token = lexer.next();
            (token.kind != TokenKind::End).then_some((token.text, token.position.line, token.position.column))
        })
        .collect()
    }

    #[test]
    fn braces_need_no_blanks_and_comments_end_with_their_line() {
        assert_eq!(
            words("a{b}# x {\n1//y\r\n2 / 3"),
            [
                ("a", 1, 1),
                ("{", 1, 2),
                ("b", 1, 3),
                ("}", 1, 4),
                ("1", 2, 1),
                ("2", 3, 1),
                ("/", 3, 3),
                ("3", 3, 5)
            ]
        );
    }

    #[test]
    fn columns_count_characters_and_a_byte_order_mark_counts_nothing() {
        assert_eq!(words("\u{feff}äö x"), [("äö", 1, 1), ("x", 1, 4)]);
    }

    #[test]
    fn a_lone_carriage_return_ends_a_line() {
        assert_eq!(words("a # c\rb"), [("a", 1, 1), ("b", 2, 1)]);
    }

    #[test]
    fn the_end_is_behind_the_last_thing_written() {
        let mut lexer = Lexer::new("ab c\n\n");
        let end = [lexer.next(), lexer.next(), lexer.next()][2];
        assert_eq!(end.kind, TokenKind::End);
        assert_eq!((end.position.line, end.position.column), (1, 5));
        assert_eq!(end.span, Span::from(4..4));
    }

    #[test]
    fn names_may_hold_what_begins_a_comment() {
        let name = |text| Lexer::new(text).name().map(|t| t.text).map_err(|t| t.text);
        assert_eq!(name(" a//b#c.obj}"), Ok("a//b#c.obj"));
        assert_eq!(name("\"my {mesh}.obj\" x"), Ok("my {mesh}.obj"));
        assert_eq!(name("\"\""), Ok(""));
        assert_eq!(name("\"open\nb\""), Err("\"open"));
        assert_eq!(name("# comment\n}"), Ok("}"));
    }
}
