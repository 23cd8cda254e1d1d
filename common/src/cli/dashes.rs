//! One dash outside, two inside: the course's long flags and clap's.

use super::numbers::plain_negative;
use std::ffi::OsString;

/// Turns the course's arguments into clap's: `-size` becomes `--size`, a negative number is
/// written plainly, and everything after a bare `--` stays as it is.
pub fn doubled(args: impl IntoIterator<Item = OsString>) -> Vec<OsString> {
    let mut literal = false;
    let double = |arg: OsString| {
        literal |= arg == "--";
        match arg.to_str() {
            Some(text) if !literal => doubled_word(text).map_or(arg, OsString::from),
            _ => arg,
        }
    };
    let mut args = args.into_iter();
    let program = args.next();
    program.into_iter().chain(args.map(double)).collect()
}

/// The changed argument, or `None` if it can stay.
fn doubled_word(text: &str) -> Option<String> {
    let word = text.strip_prefix('-')?;
    if let Some(number) = plain_negative(text) {
        return Some(number);
    }
    let is_short = matches!(word, "h" | "V");
    let is_word = word.starts_with(|c: char| c.is_alphabetic() || c == '_');
    (is_word && !is_short).then(|| format!("--{word}"))
}

/// Turns clap's texts into the course's: `--size` becomes `-size`, and in lists of flags the
/// columns stay aligned.
pub fn singled(text: &str) -> String {
    text.split_inclusive('\n').map(singled_line).collect()
}

fn singled_line(line: &str) -> String {
    let entry = line.trim_start();
    let indent = &line[..line.len() - entry.len()];
    if indent.is_empty() || !is_list_entry(entry) {
        return single_dashes(line);
    }
    // clap indents a flag without a one-letter form by four more columns.
    let shorter = indent.strip_prefix("    ").filter(|rest| !rest.is_empty());
    let (flag, description) = match entry.find("  ") {
        Some(gap) => entry.split_at(gap),
        None => (entry, ""),
    };
    let single = format!("{}{}", shorter.unwrap_or(indent), single_dashes(flag));
    if description.is_empty() {
        return single;
    }
    let width = indent.len() + flag.len();
    format!("{single:width$}{}", single_dashes(description))
}

/// Whether a line of a help text begins with a flag.
fn is_list_entry(entry: &str) -> bool {
    let is_pair = |text: &str| text.starts_with("-h, --") || text.starts_with("-V, --");
    starts_flag(entry) || is_pair(entry)
}

/// Takes one dash from every `--word` that is not in the middle of a word.
fn single_dashes(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut before = ' ';
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        let in_word = before.is_alphanumeric() || before == '-';
        if !in_word && starts_flag(rest) {
            rest = &rest[1..];
        }
        out.push(c);
        before = c;
        rest = &rest[c.len_utf8()..];
    }
    out
}

fn starts_flag(text: &str) -> bool {
    text.strip_prefix("--").is_some_and(|word| word.starts_with(char::is_alphabetic))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(text: &str) -> Vec<OsString> {
        text.split(' ').map(OsString::from).collect()
    }

    #[test]
    fn flags_are_doubled_and_values_are_not() {
        for (course, clap) in [
            ("rt -input a.txt", "rt --input a.txt"),
            ("rt --input a.txt", "rt --input a.txt"),
            ("rt -input=-a.txt", "rt --input=-a.txt"),
            ("rt -depth -2 2 d.tga", "rt --depth -2 2 d.tga"),
            ("rt -depth -.5 -2e-1 d.tga", "rt --depth -0.5 -0.2 d.tga"),
            ("rt -h -help -V -version", "rt -h --help -V --version"),
            ("rt -x -inf", "rt --x --inf"),
            ("rt - -- -input", "rt - -- -input"),
            ("-rt -input -5", "-rt --input -5"),
        ] {
            assert_eq!(doubled(words(course)), words(clap));
        }
    }

    #[test]
    fn texts_show_one_dash() {
        for (clap, course) in [
            ("error: '--size <W> <H>' is", "error: '-size <W> <H>' is"),
            ("Usage: rt [OPTIONS] --input <F>", "Usage: rt [OPTIONS] -input <F>"),
            ("use '-- --foo'", "use '-- -foo'"),
            ("a--b stays, -- too, ---x too", "a--b stays, -- too, ---x too"),
            ("[--a|--b]", "[-a|-b]"),
        ] {
            assert_eq!(singled(clap), course);
        }
    }

    #[test]
    fn columns_stay_aligned() {
        let clap = "Options:\n      --size <W> <H>  Size, or --big\n\
                    \x20                     in pixels\n  -h, --help          Help\n";
        let course = "Options:\n  -size <W> <H>       Size, or -big\n\
                      \x20                     in pixels\n  -h, -help           Help\n";
        assert_eq!(singled(clap), course);
    }
}
