//! The program itself, from the repository's root as a user would start it: one small part of
//! everything becomes a page, and the page of a second run compares the two.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};
use tempfile::tempdir;

fn all_quick(folder: &Path, more: &[&str]) -> Output {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).expect("the repository");
    let mut command = Command::new(env!("CARGO_BIN_EXE_bench"));
    command.current_dir(root).args(["all", "--quick", "--parts", "kernels", "--out"]).arg(folder);
    command.args(more).output().expect("the program starts")
}

#[test]
fn a_part_becomes_a_page_and_a_second_run_is_compared() {
    let folder = tempdir().expect("a folder");
    let (first, second) = (folder.path().join("first"), folder.path().join("second"));
    let output = all_quick(&first, &[]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let page = fs::read_to_string(first.join("index.html")).expect("a page");
    assert!(page.contains("kernels") && page.trim_end().ends_with("</html>"), "{page}");
    assert!(!page.contains("src=\"http") && !page.contains("<link"), "a page stands by itself");

    let saved = first.join("results.csv");
    let records = fs::read_to_string(&saved).expect("records");
    assert!(records.lines().count() > 5, "{records}");
    let output = all_quick(&second, &["--compare", &saved.to_string_lossy()]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let page = fs::read_to_string(second.join("index.html")).expect("a page");
    assert!(page.contains("What moved since"), "nothing is compared: {page}");
}

#[test]
fn a_run_that_cannot_be_compared_does_not_begin() {
    let folder = tempdir().expect("a folder");
    let output = all_quick(folder.path(), &["--compare", "no such file.csv"]);
    let complaint = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{complaint}");
    assert!(complaint.contains("no such file.csv"), "{complaint}");
    assert!(!folder.path().join("results.csv").exists());
}
