//! Command lines as users of the course type them, and the texts they get back.

use super::*;
use clap::Parser;

/// Renders things.
#[derive(Debug, Parser)]
#[command(name = "rt", version, rename_all = "snake_case")]
struct Options {
    #[command(flatten, next_help_heading = "Assignment 2")]
    second: Second,
    #[command(flatten)]
    general: GeneralArgs,
}

#[derive(Debug, clap::Args)]
#[command(rename_all = "snake_case")]
struct Second {
    /// Light both sides
    #[arg(long)]
    shade_back: bool,
    #[command(flatten, next_help_heading = "Assignment 1")]
    first: First,
}

#[derive(Debug, clap::Args)]
#[command(rename_all = "snake_case")]
struct First {
    /// Scene to read
    #[arg(long, value_name = "FILE")]
    input: String,
    /// Width and height in pixels
    #[arg(long, num_args = 2, value_names = ["W", "H"], default_values_t = [100, 100])]
    size: Vec<i64>,
    /// Nearest and farthest distance, and a file
    #[arg(long, num_args = 3, value_names = ["MIN", "MAX", "FILE"])]
    depth: Vec<String>,
}

fn parse_line(line: &str) -> Result<Parsed<Options>, Stop> {
    try_parse_from(line.split_whitespace())
}

fn usage_error(line: &str) -> String {
    let stop = parse_line(line).unwrap_err();
    assert_eq!(stop.code, 2, "{}", stop.text);
    assert!(!stop.text.contains("--"), "{}", stop.text);
    stop.text
}

#[test]
fn one_dash_and_two_mean_the_same() {
    for line in [
        "rt -input a.txt -size 3 4 -shade_back -depth -2 2 d.tga",
        "rt --depth -2 2 d.tga --shade_back --size 3 4 --input=a.txt",
        "rt -input=a.txt -depth -2 2 d.tga -shade_back -size 3 4",
    ] {
        let options = parse_line(line).unwrap().options;
        assert_eq!(options.second.first.input, "a.txt");
        assert_eq!(options.second.first.size, [3, 4]);
        assert_eq!(options.second.first.depth, ["-2", "2", "d.tga"]);
        assert!(options.second.shade_back);
    }
}

#[test]
fn negative_numbers_of_every_spelling_are_values() {
    let options = parse_line("rt -input -7 -size -5 0 -depth -.5 -1e-3 d.tga").unwrap();
    let first = options.options.second.first;
    assert_eq!((first.input.as_str(), first.size), ("-7", vec![-5, 0]));
    assert_eq!(first.depth, ["-0.5", "-0.001", "d.tga"]);
}

#[test]
fn the_last_of_two_counts_with_a_warning() {
    let parsed = parse_line("rt -input a -size 1 1 -size 2 3 -shade_back -shade_back").unwrap();
    assert_eq!(parsed.options.second.first.size, [2, 3]);
    assert_eq!(
        parsed.warnings,
        ["-shade_back is given 2 times; the last one counts", "-size is given 2 times; the last one counts"]
    );
    let repeatable = parse_line("rt -input a -noskip tile -noskip dark").unwrap();
    assert_eq!(repeatable.warnings, [""; 0]);
    let general = repeatable.options.general;
    let skips = [Skip::Tile, Skip::Behind, Skip::Dark, Skip::Inside, Skip::Black].map(|s| general.skips(s));
    assert_eq!(skips, [false, true, false, true, true]);
}

#[test]
fn usage_errors_speak_the_course_s_language() {
    for (line, parts) in [
        ("rt -input a -shade_bakc", vec!["'-shade_bakc'", "'-shade_back'"]),
        ("rt", vec!["-input <FILE>"]),
        ("rt -input a -size 3", vec!["-size <W> <H>", "2 values"]),
        ("rt -input a -size 3 -shade_back", vec!["-size <W> <H>"]),
        ("rt -input a -size 3 x", vec!["'x'", "-size <W> <H>"]),
        ("rt -input a -size 3 99999999999999999999", vec!["99999999999999999999"]),
        ("rt -input a -threads 0", vec!["-threads <N>", "1..=1024"]),
        ("rt -input a -tile -3", vec!["-3"]),
        ("rt -input a -noskip tiel", vec!["'tile'", "behind"]),
        ("rt -input a -simd avx1024", vec!["auto", "avx512"]),
        ("rt -input a -quiet -verbose", vec!["-quiet", "-verbose"]),
        ("rt -input a stray.txt", vec!["'stray.txt'"]),
        ("rt -input a -s", vec!["'-s'"]),
    ] {
        let text = usage_error(line);
        for part in parts {
            assert!(text.contains(part), "{line}: {part}\n{text}");
        }
    }
}

#[test]
fn help_is_grouped_and_aligned() {
    let stop = parse_line("rt -h").unwrap_err();
    assert_eq!(stop.code, 0);
    assert!(!stop.text.contains("--"), "{}", stop.text);
    let column = |word: &str| {
        let line = stop.text.lines().find(|line| line.contains(word));
        line.and_then(|line| line.find(word))
    };
    println!("{}", stop.text);
    let place = |text: &str| stop.text.find(text);
    let order = [
        "Assignment 2:",
        "Light both sides",
        "Assignment 1:",
        "Scene to read",
        "General:",
        "Print this help",
    ];
    assert!(order.map(place).is_sorted_by(|a, b| a.is_some() && a < b));
    assert!(column("Scene to read").is_some());
    assert_eq!(column("Scene to read"), column("Width and height"));
    assert_eq!(column("Print this help"), column("No warnings"));
    for long in ["rt -help", "rt --help"] {
        assert!(parse_line(long).unwrap_err().text.contains("-shade_back"));
    }
    assert!(parse_line("rt -V").unwrap_err().text.starts_with("rt 0."));
}

#[test]
fn verbose_echoes_defaults_and_choices() {
    let parsed = parse_line("rt -input a.txt -verbose -depth -2 2 d.tga").unwrap();
    let echo = parsed.echo.unwrap();
    for line in [
        "  -input a.txt",
        "  -size 100 100  (default)",
        "  -depth -2 2 d.tga",
        "  -simd auto  (default)",
        "  -verbose",
    ] {
        assert!(echo.lines().any(|l| l == line), "{line}\n{echo}");
    }
    assert!(!echo.contains("shade_back"), "{echo}");
    assert_eq!(parse_line("rt -input a").unwrap().echo, None);
    assert!(parse_line("rt -input a -quiet").unwrap().quiet);
}
