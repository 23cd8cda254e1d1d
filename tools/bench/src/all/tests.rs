//! A tiny run of everything that `bench all` does.

use super::*;
use crate::page::check;

fn options(name: &str) -> Options {
    let out = std::env::temp_dir().join(format!("raysteps-all-{name}-{}", std::process::id()));
    let _ = fs::remove_dir_all(&out);
    Options { quick: true, out, compare: None, external: None, parts: Vec::new() }
}

fn kernels() -> Entry {
    let scenes = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes");
    Entry { name: "kernels", flags: format!("--rounds 1 --scenes {scenes}") }
}

fn trees() -> Entry {
    Entry { name: "trees", flags: "--mesh sphere500 --side 16 --rounds 1".to_owned() }
}

#[test]
fn a_run_leaves_a_page_results_and_figures() {
    let mut options = options("good");
    perform(&options, &[kernels(), trees()]).unwrap();
    let read = |name: &str| fs::read_to_string(options.out.join(name)).unwrap();
    let page = read("index.html");
    check::assert_self_contained(&page);
    assert!(
        page.contains("id=\"kernels\"") && page.contains("id=\"trees\"") && page.matches("<svg").count() == 1
    );
    assert!(read("trees-1.svg").contains("</svg>"));
    let records = csv::load(&options.out.join("results.csv")).unwrap();
    let rates = records.iter().filter(|r| r.place[0] == "kernels" && r.place[3].starts_with("rate"));
    assert_eq!(rates.filter(|r| r.cell.value().is_some_and(|v| v > 0.0)).count(), 4);
    assert!(records.iter().any(|r| r.place == ["run", "machine", "command", ""]));
    // Again, beside what was just measured.
    let (old, text) = (options.out.join("results.csv"), read("results.csv"));
    (options.compare, options.external) = (Some(old.clone()), Some(old));
    perform(&options, &[kernels()]).unwrap();
    assert_eq!(fs::read_to_string(options.out.join("previous.csv")).unwrap(), text);
    let page = fs::read_to_string(options.out.join("index.html")).unwrap();
    check::assert_self_contained(&page);
    assert!(page.contains("id=\"compared\"") && page.contains("id=\"external\""));
    fs::remove_dir_all(&options.out).unwrap();
}

#[test]
fn a_part_that_fails_is_shown_and_the_rest_still_runs() {
    let options = options("bad");
    let bad = Entry { name: "rays", flags: "--meshes no-such-<mesh>".to_owned() };
    let error = perform(&options, &[bad, trees()]).unwrap_err();
    assert!(error.code() == 1 && error.report().contains("rays: error"), "{}", error.report());
    let page = fs::read_to_string(options.out.join("index.html")).unwrap();
    check::assert_self_contained(&page);
    assert!(page.contains("class=\"error\"") && page.contains("no-such-&lt;mesh&gt;"));
    assert!(page.contains("<svg"), "the trees are missing");
    fs::remove_dir_all(&options.out).unwrap();
}

#[test]
fn an_unknown_part_is_refused_before_anything_is_measured() {
    let options = Options { parts: vec!["nothing".to_owned()], ..options("none") };
    assert!(matches!(run(&options), Err(AppError::Usage(_))));
    assert!(!options.out.exists());
}
