//! The course's command lines through the real program, and IFS files that are wrong.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

fn workspace_file(path: &str) -> String {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(path).display().to_string()
}

fn ifs(folder: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_ifs")).args(args).current_dir(folder).output().unwrap()
}

/// Every line of `tests/commands/A0.txt` writes its picture, a TGA of the size it says, and
/// something is in it but not everywhere; more iterations leave fewer places to be.
#[test]
fn course_command_lines_run() {
    let lines = fs::read_to_string(workspace_file("tests/commands/A0.txt")).unwrap();
    let mut dots = Vec::new();
    for line in lines.lines() {
        let folder = tempfile::tempdir().unwrap();
        let mut words: Vec<&str> = line.split_whitespace().skip(1).collect();
        let value =
            |words: &[&str], flag| words[words.iter().position(|w| *w == flag).unwrap() + 1].to_owned();
        let (input, output) = (value(&words, "-input"), value(&words, "-output"));
        let size: u16 = value(&words, "-size").parse().unwrap();
        let scene = workspace_file(&input);
        words.iter_mut().filter(|word| **word == input).for_each(|word| *word = &scene);
        let run = ifs(folder.path(), &words);
        assert!(run.status.success() && run.stderr.is_empty(), "{line}\n{run:?}");
        let bytes = fs::read(folder.path().join(output)).unwrap();
        let [low, high] = size.to_le_bytes();
        let header = [0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, low, high, low, high, 24, 0x20];
        assert_eq!((&bytes[..18], bytes.len()), (&header[..], 18 + 3 * usize::from(size).pow(2)), "{line}");
        dots.push(bytes[18..].chunks(3).filter(|pixel| **pixel == [0; 3]).count());
    }
    assert_eq!(dots.len(), 7);
    // Sierpinski's triangle after 0, 1, 2, 3, 4 and 30 steps; the points are 10,000.
    assert!(dots[..6].windows(2).all(|pair| pair[0] > pair[1] && pair[1] > 500), "{dots:?}");
    assert!(dots[0] <= 10_000 && dots[6] > 5_000, "{dots:?}");
}

/// Texts, where they are wrong, and what must be said.
const WRONG: &[(&str, &str, &str)] = &[
    ("", ":1:1", "number of maps"),
    ("two\n", ":1:1", "'two'"),
    ("-1\n", ":1:1", "'-1'"),
    ("1\n1 1 0 0 0 1 0 0 0\n", ":3:1", "the file ends here"),
    ("1\nhalf 1 0 0 0 1 0 0 0 1\n", ":2:1", "'half'"),
    ("1\n1 nan 0 0 0 1 0 0 0 1\n", ":2:3", "'nan'"),
    ("1\n0.5 1 0 0 0 1 0 0 0 1\n", ":", "0.5"),
    ("1\n1 1 0 0 0 1 0 0 0 2\n", ":2:", "0 0 1"),
    ("1\n1 1 0 0 0 1 0 0 0 1 7\n", ":2:", "'7'"),
    ("1000000000\n1 1 0 0 0 1 0 0 0 1\n", ":", "expected"),
];

#[test]
fn wrong_files_are_refused() {
    for (text, place, needle) in WRONG {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("w.txt"), text).unwrap();
        fs::write(folder.path().join("old.tga"), "old").unwrap();
        let run = ifs(folder.path(), &["-input", "w.txt", "-output", "old.tga"]);
        let stderr = String::from_utf8(run.stderr).unwrap();
        assert_eq!((run.status.code(), run.stdout.len()), (Some(2), 0), "{text}{stderr}");
        assert_eq!(stderr.matches("error:").count(), 1, "{stderr}");
        assert!(stderr.contains(&format!("w.txt{place}")) && stderr.contains(needle), "{text}{stderr}");
        assert!(!stderr.contains("panicked"), "{stderr}");
        let old = fs::read_to_string(folder.path().join("old.tga")).unwrap();
        assert_eq!((old.as_str(), fs::read_dir(folder.path()).unwrap().count()), ("old", 2), "{text}");
    }
}
