//! Errors of IFS files: file, line, column, and the line itself with a caret.

use std::fmt::Write;
use std::path::Path;

/// An error in an IFS file. Its text is the whole report:
///
/// ```text
/// error: expected the probability of map 1, found 'half'
///  --> fern.txt:3:1
///   |
/// 3 | half
///   | ^^^^
/// ```
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{rendered}")]
pub struct IfsError {
    message: String,
    /// Line and column from 1, if the error is in the text.
    position: Option<(usize, usize)>,
    rendered: String,
}

impl IfsError {
    /// An error of the file as a whole.
    pub(crate) fn of_file(path: &Path, message: impl Into<String>) -> Self {
        let message = message.into();
        Self { rendered: format!("error: {message}\n --> {}", path.display()), position: None, message }
    }

    /// An error at `length` bytes of `text`, from byte `offset` on.
    pub(crate) fn at(
        path: &Path,
        text: &str,
        offset: usize,
        length: usize,
        message: impl Into<String>,
    ) -> Self {
        let message = message.into();
        let place = Place::of(text, offset, length);
        Self { rendered: place.render(&message, path), position: Some((place.line, place.column)), message }
    }

    /// What is wrong, without the place.
    pub fn message(&self) -> &str {
        &self.message
    }

    /// Line and column, both from 1, the column in characters; `None` if the error concerns the
    /// file as a whole.
    pub fn position(&self) -> Option<(usize, usize)> {
        self.position
    }
}

/// Where in a text, and what to show of it.
struct Place<'a> {
    line: usize,
    column: usize,
    before: &'a str,
    marked: &'a str,
    after: &'a str,
}

impl<'a> Place<'a> {
    fn of(text: &'a str, offset: usize, length: usize) -> Self {
        let start = text[..offset].rfind('\n').map_or(0, |newline| newline + 1);
        let rest = &text[start..];
        let shown = rest.split(['\n', '\r']).next().unwrap_or_default();
        let caret = (offset - start).min(shown.len());
        let end = (caret + length).min(shown.len());
        Self {
            line: text[..start].matches('\n').count() + 1,
            column: shown[..caret].chars().count() + 1,
            before: &shown[..caret],
            marked: &shown[caret..end],
            after: &shown[end..],
        }
    }

    fn render(&self, message: &str, path: &Path) -> String {
        let number = self.line.to_string();
        let margin = " ".repeat(number.len());
        let before = last(self.before);
        let marked = first(self.marked);
        let blank = " ".repeat(before.chars().count());
        let carets = "^".repeat(marked.chars().count().max(1));
        let line = format!("{before}{marked}{}", first(self.after));
        let mut text = format!("error: {message}\n");
        let _ = writeln!(text, "{margin}--> {}:{}:{}", path.display(), self.line, self.column);
        let _ = writeln!(text, "{margin} |");
        let _ = writeln!(text, "{}", format!("{number} | {line}").trim_end());
        let _ = write!(text, "{margin} | {blank}{carets}");
        text
    }
}

/// Most characters shown on either side of an error, and of the error itself.
const MOST_SHOWN: usize = 60;

/// The first characters, each one column wide.
fn first(text: &str) -> String {
    text.chars().take(MOST_SHOWN).map(one_column).collect()
}

/// The last characters, each one column wide.
fn last(text: &str) -> String {
    let skipped = text.chars().count().saturating_sub(MOST_SHOWN);
    text.chars().skip(skipped).map(one_column).collect()
}

/// Tabs and control characters would put the caret in the wrong place, or worse.
fn one_column(c: char) -> char {
    match c {
        '\t' => ' ',
        c if c.is_control() => char::REPLACEMENT_CHARACTER,
        c => c,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn report(text: &str, offset: usize, length: usize) -> String {
        IfsError::at(Path::new("a.txt"), text, offset, length, "wrong").to_string()
    }

    #[test]
    fn a0t1_the_caret_is_below_the_word() {
        let text = "3\r\n\t0.5 häls x\r\n1";
        assert_eq!(
            report(text, text.find('x').unwrap(), 1),
            "error: wrong\n --> a.txt:2:11\n  |\n2 |  0.5 häls x\n  |           ^"
        );
        assert_eq!(report(text, text.len(), 0), "error: wrong\n --> a.txt:3:2\n  |\n3 | 1\n  |  ^");
        assert_eq!(report("", 0, 0), "error: wrong\n --> a.txt:1:1\n  |\n1 |\n  | ^");
    }

    #[test]
    fn a0t1_long_lines_are_cut() {
        let text = format!("{}bad{}", "1 ".repeat(100_000), " 2".repeat(100_000));
        let report = report(&text, 200_000, 3);
        assert!(report.len() < 400, "{report}");
        let lines: Vec<_> = report.lines().collect();
        assert_eq!(lines[3].find("bad"), lines[4].find("^^^"));
        assert!(report.contains("a.txt:1:200001"));
    }
}
