//! The program as the course's command lines call it: picture bytes, exit codes, messages.

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

const SIERPINSKI: &str = "3\n\
    0.33 .5 0 0   0 .5 0   0 0 1\n\
    0.33 .5 0 .5  0 .5 0   0 0 1\n\
    0.34 .5 0 0   0 .5 .5  0 0 1\n";

fn ifs(folder: &Path, line: &str) -> Output {
    fs::write(folder.join("s.txt"), SIERPINSKI).unwrap();
    Command::new(env!("CARGO_BIN_EXE_ifs"))
        .current_dir(folder)
        .args(line.split_whitespace())
        .output()
        .unwrap()
}

/// Standard error of a run that ends with exit code 2 and leaves no output behind.
fn refusal(line: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    let output = ifs(folder.path(), line);
    assert_eq!(output.status.code(), Some(2), "{line}");
    assert!(output.stdout.is_empty(), "{line}");
    let entries = fs::read_dir(folder.path()).unwrap().count();
    assert_eq!(entries, 1, "{line} left a file");
    String::from_utf8(output.stderr).unwrap()
}

/// 3 iterations at 8 pixels: every pixel is known, whatever the seed.
#[test]
fn a0t3_picture_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let line = "-input s.txt -points 10000 -iters 3 -size 8 -output s.tga";
    let output = ifs(folder.path(), line);
    assert!(output.status.success());
    assert!(output.stdout.is_empty() && output.stderr.is_empty());
    let bytes = fs::read(folder.path().join("s.tga")).unwrap();
    assert_eq!(bytes[..18], [0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 8, 0, 8, 0, 24, 0x20]);
    let pixels: Vec<[u8; 3]> = (0..64)
        .map(|i| {
            let (x, y) = (i % 8, 7 - i / 8);
            if x & y == 0 { [0; 3] } else { [255; 3] }
        })
        .collect();
    assert_eq!(bytes[18..], *pixels.as_flattened());
}

#[test]
fn a0t3_the_same_command_makes_the_same_picture() {
    let folder = tempfile::tempdir().unwrap();
    let mut pictures = Vec::new();
    for flags in ["", "-seed 0", "-threads 1", "--threads 3", "-seed 1"] {
        let line = format!("-input s.txt -size 50 -output s.png -iters 30 {flags}");
        assert!(ifs(folder.path(), &line).status.success(), "{line}");
        pictures.push(fs::read(folder.path().join("s.png")).unwrap());
    }
    assert!(pictures[1..4].iter().all(|picture| *picture == pictures[0]));
    assert_ne!(pictures[4], pictures[0]);
}

#[test]
fn a0t3_defaults_are_the_course_s() {
    let folder = tempfile::tempdir().unwrap();
    let output = ifs(folder.path(), "-input s.txt -output s.tga -verbose -stats");
    let echo = String::from_utf8(output.stderr).unwrap();
    for line in ["-points 10000", "-iters 10", "-size 100", "-seed 0"] {
        assert!(echo.contains(&format!("  {line}  (default)")), "{echo}");
    }
    let stats = String::from_utf8(output.stdout).unwrap();
    assert!(stats.contains("points 10000"), "{stats}");
    assert!(stats.contains("pixels 10000"), "{stats}");
}

#[test]
fn a0t1_bad_command_lines_and_files_are_refused() {
    for (line, part) in [
        ("-output a.tga", "-input <FILE>"),
        ("-input s.txt", "-output <FILE>"),
        ("-input s.txt -output a.tga -size 0", "at least 1"),
        ("-input s.txt -output a.tga -size -5", "at least 1"),
        ("-input s.txt -output a.tga -size 1000000000000", "too large"),
        ("-input s.txt -output a.tga -points -1", "'-1'"),
        ("-input s.txt -output a.tga -iters 1.5", "'1.5'"),
        ("-input s.txt -output a.tga -point 5", "'-points'"),
        ("-input s.txt -output a.tag", "did you mean .tga?"),
        ("-input s.txt -output no/such/a.tga", "no folder 'no/such'"),
        ("-input nothing.txt -output a.tga", " --> nothing.txt"),
        ("-input /dev/null -output a.tga", "/dev/null:1:1"),
    ] {
        let text = refusal(line);
        assert!(text.contains(part), "{line}\n{text}");
        assert!(!text.contains("panicked") && !text.contains("--size"), "{text}");
        assert_eq!(text.matches("error:").count(), 1, "{text}");
    }
}

#[test]
fn a0t3_an_empty_picture_is_warned_about() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("away.txt"), "1\n1  1 0 5  0 1 0  0 0 1").unwrap();
    let line = "-input away.txt -output a.tga -iters 1";
    let output = ifs(folder.path(), line);
    assert!(output.status.success());
    let text = String::from_utf8(output.stderr).unwrap();
    assert!(text.starts_with("warning: "), "{text}");
    let quiet = ifs(folder.path(), &format!("{line} -quiet"));
    assert!(quiet.status.success() && quiet.stderr.is_empty());
}

#[test]
fn a0t3_help_shows_the_course_s_spelling() {
    let folder = tempfile::tempdir().unwrap();
    for flag in ["-h", "-help", "--help"] {
        let output = ifs(folder.path(), flag);
        assert_eq!(output.status.code(), Some(0));
        let text = String::from_utf8(output.stdout).unwrap();
        assert!(text.contains("Assignment 0:") && text.contains("-iters <K>"), "{text}");
        assert!(text.contains("Example:") && !text.contains("--"), "{text}");
    }
}

#[test]
fn a0t3_a_reader_that_goes_away_is_no_error() {
    for flag in ["-help", "-V"] {
        let mut child = Command::new(env!("CARGO_BIN_EXE_ifs"))
            .arg(flag)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        assert!(output.status.success());
        assert!(output.stderr.is_empty(), "{output:?}");
    }
}
