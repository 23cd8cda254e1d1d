//! What all blocks have in common: braces, fields in any order, none twice, and the words for
//! what was found instead.
//!
//! ```text
//! Keyword { field value…  field value… }
//! ```

use super::Parser;
use crate::scene::diagnostic::{Fault, Parsed};
use crate::scene::lexer::{Span, Token, TokenKind};
use crate::scene::suggest::nearest;

/// A block being read.
pub(super) struct Block<'a> {
    /// The keyword in front of the brace.
    pub keyword: Token<'a>,
    /// The closing brace, once it has been read.
    pub close: Span,
    seen: Vec<(&'a str, Span)>,
}

impl<'a> Parser<'a> {
    /// Reads the opening brace that follows `keyword`.
    pub(super) fn open(&mut self, keyword: Token<'a>) -> Parsed<Block<'a>> {
        let token = self.lexer.next();
        if token.kind != TokenKind::Open {
            let message = format!("expected `{{` after `{}`, found {}", keyword.text, found(token));
            return Fault::new(token.span, message).fail();
        }
        Ok(Block { keyword, close: token.span, seen: Vec::new() })
    }

    /// The next field keyword, or `None` at the closing brace. A field may be given only once.
    pub(super) fn field(&mut self, block: &mut Block<'a>, allowed: &[&str]) -> Parsed<Option<Token<'a>>> {
        let field = self.item(block, allowed)?;
        if let Some(field) = field {
            block.reject_repeated(field)?;
        }
        Ok(field)
    }

    /// The next keyword of those allowed, as often as it likes, or `None` at the closing brace.
    pub(super) fn item(&mut self, block: &mut Block<'a>, allowed: &[&str]) -> Parsed<Option<Token<'a>>> {
        let token = self.lexer.next();
        match token.kind {
            TokenKind::Close => {
                block.close = token.span;
                Ok(None)
            }
            TokenKind::Word if allowed.contains(&token.text) => Ok(Some(token)),
            _ => self
                .unexpected(token, &format!("a field of `{}`", block.keyword.text), allowed)
                .context(block.keyword.span, "in this block")
                .fail(),
        }
    }

    /// Says that `token` is none of the `allowed` words.
    pub(super) fn unexpected(&self, token: Token<'a>, what: &str, allowed: &[&str]) -> Fault {
        let message = format!("expected {what}, found {}", found(token));
        let list = || match allowed {
            [one] => format!("expected `{one}`"),
            _ => format!("expected one of {}", quoted_list(allowed)),
        };
        let help = nearest(token.text, allowed.iter().copied())
            .map(|name| format!("did you mean `{name}`?"))
            .unwrap_or_else(list);
        Fault::new(token.span, message).help(help)
    }
}

impl<'a> Block<'a> {
    pub fn reject_repeated(&mut self, field: Token<'a>) -> Parsed<()> {
        match self.place_of(field.text) {
            None => {
                self.seen.push((field.text, field.span));
                Ok(())
            }
            Some(first) => Fault::new(field.span, format!("`{}` is given twice", field.text))
                .context(first, "first given here")
                .fail(),
        }
    }

    /// Where a field was given, if it was.
    pub fn place_of(&self, field: &str) -> Option<Span> {
        let found = self.seen.iter().find(|(name, _)| *name == field);
        found.map(|(_, span)| *span)
    }

    /// The value of a field that must be there; asked for after the closing brace.
    pub fn require<T>(&self, value: Option<T>, field: &str) -> Parsed<T> {
        value.ok_or_else(|| {
            let name = self.keyword.text;
            let message = format!("this `{name}` has no `{field}`");
            Box::new(
                Fault::new(self.close, message)
                    .label(format!("expected `{field}` before this"))
                    .context(self.keyword.span, "block opened here"),
            )
        })
    }
}

/// How an error message calls a token; long words are cut.
pub(super) fn found(token: Token) -> String {
    match token.kind {
        TokenKind::End => "the end of the file".to_owned(),
        _ => quoted(token.text),
    }
}

/// A word in backquotes, control characters escaped, cut after 40 characters.
pub(super) fn quoted(word: &str) -> String {
    let mut shown: String = word.chars().take(40).collect();
    if shown.len() < word.len() {
        shown.push('…');
    }
    format!("`{}`", shown.escape_debug())
}

fn quoted_list(names: &[&str]) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    quoted.join(", ")
}
