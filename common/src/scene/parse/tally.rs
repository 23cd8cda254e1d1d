//! Announced numbers of things, against the things that follow.
//!
//! ```text
//! numObjects 3
//! ```
//!
//! The number is only compared, never used to reserve memory.

use super::Parser;
use super::block::{Block, found};
use super::numbers::Count;
use crate::scene::diagnostic::{Fault, Parsed};
use crate::scene::lexer::Span;
use crate::scene::suggest::nearest;

/// How many things were announced and how many have come.
pub(super) struct Tally {
    field: &'static str,
    thing: &'static str,
    announced: Count,
    come: u32,
}

impl<'a> Parser<'a> {
    /// Reads `field` and its count, which must come first in the block.
    pub(super) fn tally(
        &mut self,
        block: &Block<'a>,
        field: &'static str,
        thing: &'static str,
    ) -> Parsed<Tally> {
        let token = self.lexer.next();
        if token.text != field {
            let name = block.keyword.text;
            let message = format!("expected `{field}` at the start of `{name}`, found {}", found(token));
            let help = nearest(token.text, [field]);
            return Fault::new(token.span, message)
                .help_if_any(help.map(|name| format!("did you mean `{name}`?")))
                .fail();
        }
        Ok(Tally { field, thing, announced: self.count(token)?, come: 0 })
    }
}

impl Tally {
    /// Counts one thing, whose keyword is at `span`, and refuses it if it is one too many.
    pub fn one_more(&mut self, span: Span) -> Parsed<()> {
        self.come += 1;
        if self.come <= self.announced.value {
            return Ok(());
        }
        let Self { field, thing, announced, come } = self;
        let message = format!("`{field}` says {}, but here is {thing} number {come}", announced.value);
        Fault::new(span, message).context(announced.span, "announced here").fail()
    }

    /// Complains at the closing brace if things are missing.
    pub fn finish(&self, close: Span) -> Parsed<()> {
        if self.come == self.announced.value {
            return Ok(());
        }
        let Self { field, thing, announced, come } = self;
        let plural = if *come == 1 { "" } else { "s" };
        let message =
            format!("`{field}` says {}, but the block ends after {come} {thing}{plural}", announced.value);
        Fault::new(close, message).context(announced.span, "announced here").fail()
    }
}
