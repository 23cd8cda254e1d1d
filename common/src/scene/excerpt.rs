//! The few characters of a scene text that an error message shows.
//!
//! Only the lines of interest are copied, and of a long line only the part around the span, so
//! that an error in a file of one 100 MB line prints a line of terminal width.

use super::lexer::Span;
use super::line_counter::{bom_length, position_of};
use std::ops::Range;

/// A line of no more bytes than this is shown whole.
const SHORT: usize = 120;
/// Characters shown before the marked place of a longer line.
const BEFORE: usize = 60;
/// Characters shown of it from the start of the marked place on.
const AFTER: usize = 60;
/// Two places at most this many lines apart are shown in one excerpt.
const TOGETHER: usize = 200;

/// Consecutive lines with the byte ranges to mark in them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Excerpt {
    /// The lines, joined with line feeds; those left out of a long stretch are empty.
    pub text: String,
    /// Line number of the first one, from 1.
    pub first_line: usize,
    /// Where the caret belongs.
    pub primary: Option<Range<usize>>,
    /// Where the explanation belongs.
    pub context: Option<Range<usize>>,
}

impl Excerpt {
    /// One excerpt if the two places are near each other, else one each, the caret's first.
    pub fn around(text: &str, primary: Span, context: Option<Span>) -> Vec<Self> {
        let Some(context) = context else {
            return vec![Self::single(text, primary)];
        };
        let lines_between = count_line_ends(between(text, primary, context));
        match lines_between {
            0 => vec![Self::same_line(text, primary, context)],
            n if n <= TOGETHER => vec![Self::joined(text, primary, context)],
            _ => {
                let mut second = Self::single(text, context);
                second.context = second.primary.take();
                vec![Self::single(text, primary), second]
            }
        }
    }

    fn single(text: &str, span: Span) -> Self {
        let (line, range) = clipped_line(text, span);
        Self {
            text: line,
            first_line: position_of(text, span.start).line as usize,
            primary: Some(range),
            context: None,
        }
    }

    /// Both marks on one line; the explanation is dropped if the clipping hides its place.
    fn same_line(text: &str, primary: Span, context: Span) -> Self {
        let clip = Clip::new(text, primary);
        Self { context: clip.visible(context), ..Self::single(text, primary) }
    }

    fn joined(text: &str, primary: Span, context: Span) -> Self {
        let context_first = context.start < primary.start;
        let (first, last) = match context_first {
            true => (context, primary),
            false => (primary, context),
        };
        let (first_line, first_range) = clipped_line(text, first);
        let (last_line, last_range) = clipped_line(text, last);
        let joint = format!("{first_line}\n{}", middle_lines(text, first, last));
        let shifted = last_range.start + joint.len()..last_range.end + joint.len();
        let (primary, context) = match context_first {
            true => (shifted, first_range),
            false => (first_range, shifted),
        };
        Self {
            text: joint + &last_line,
            first_line: position_of(text, first.start).line as usize,
            primary: Some(primary),
            context: Some(context),
        }
    }
}

/// The lines strictly between two spans, each with its line feed. Of many lines the renderer
/// shows none, so they stay empty; of few it may show all.
fn middle_lines(text: &str, first: Span, last: Span) -> String {
    let bounds = line_bounds(text, first.start).end..line_bounds(text, last.start).start;
    let normalised = text[bounds].replace("\r\n", "\n").replace('\r', "\n");
    let lines: Vec<&str> = normalised.split('\n').collect();
    let inner = &lines[1..lines.len() - 1];
    let shown = inner.len() <= 4;
    let keep = |line: &&str| match shown {
        true => Clip::new(line, Span::from(0..0)).line(line) + "\n",
        false => "\n".to_owned(),
    };
    inner.iter().map(keep).collect()
}

fn between(text: &str, a: Span, b: Span) -> &str {
    &text[a.start.min(b.start)..a.start.max(b.start)]
}

fn count_line_ends(text: &str) -> usize {
    position_of(text, text.len()).line as usize - 1
}

/// The line around a span, clipped, and the span's range in it (at least one byte wide).
fn clipped_line(text: &str, span: Span) -> (String, Range<usize>) {
    let clip = Clip::new(text, span);
    (clip.line(text), clip.marked(span))
}

fn line_bounds(text: &str, offset: usize) -> Range<usize> {
    let is_end = |b: &u8| matches!(b, b'\n' | b'\r');
    let bytes = text.as_bytes();
    let start = bytes[..offset].iter().rposition(is_end).map_or(0, |i| i + 1);
    let end = bytes[offset..].iter().position(is_end).map_or(bytes.len(), |i| offset + i);
    start.max(bom_length(text).min(end))..end
}

/// The neighbourhood of a span in its line, as offsets into the text.
struct Clip {
    shown: Range<usize>,
    cut_before: bool,
    cut_after: bool,
}

impl Clip {
    fn new(text: &str, span: Span) -> Self {
        let line = line_bounds(text, span.start);
        let (start, end) = match line.len() <= SHORT {
            true => (line.start, line.end),
            false => (back(text, line.start, span.start), forward(text, span.start, line.end)),
        };
        Self { cut_before: start > line.start, cut_after: end < line.end, shown: start..end }
    }

    /// The part that is shown, three dots marking each cut. The blank at the end is for a mark
    /// behind the last character to stand under.
    fn line(&self, text: &str) -> String {
        let (head, tail) = (dots(self.cut_before), dots(self.cut_after));
        format!("{head}{}{tail} ", &text[self.shown.clone()])
    }

    fn marked(&self, span: Span) -> Range<usize> {
        let shift =
            |offset: usize| offset.min(self.shown.end) - self.shown.start + dots(self.cut_before).len();
        let start = shift(span.start);
        start..shift(span.end).max(start + 1)
    }

    fn visible(&self, span: Span) -> Option<Range<usize>> {
        let inside = self.shown.start <= span.start && span.end <= self.shown.end;
        inside.then(|| self.marked(span))
    }
}

fn dots(cut: bool) -> &'static str {
    if cut { "..." } else { "" }
}

/// The offset [`BEFORE`] characters before `offset`, but not before `limit`.
fn back(text: &str, limit: usize, offset: usize) -> usize {
    let mut starts = text[limit..offset].char_indices().rev();
    starts.nth(BEFORE - 1).map_or(limit, |(i, _)| limit + i)
}

/// The offset [`AFTER`] characters behind `offset`, but not behind `limit`.
fn forward(text: &str, offset: usize, limit: usize) -> usize {
    let mut starts = text[offset..limit].char_indices();
    starts.nth(AFTER).map_or(limit, |(i, _)| offset + i)
}
