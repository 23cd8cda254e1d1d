//! A0T1: good files, and what is said about bad ones.

use super::*;
use proptest::prelude::*;

const SIERPINSKI: &str = "# three corners\n3\n\
    0.33 .5 0 0   0 .5 0   0 0 1 // lower left\n\
    0.33 .5 0 .5  0 .5 0   0 0 1\n\
    0.34 .5 0 0   0 .5 .5  0 0 1\n";

fn parse_text(text: &str) -> Result<Ifs, IfsError> {
    parse(Path::new("a.txt"), text)
}

#[test]
fn a0t1_reads_what_the_course_writes() {
    let ifs = parse_text(SIERPINSKI).unwrap();
    let rows: Vec<_> = ifs.maps().iter().map(|entry| entry.map.rows).collect();
    assert_eq!(
        rows,
        [
            [[0.5, 0.0, 0.0], [0.0, 0.5, 0.0]],
            [[0.5, 0.0, 0.5], [0.0, 0.5, 0.0]],
            [[0.5, 0.0, 0.0], [0.0, 0.5, 0.5]],
        ]
    );
    assert!((ifs.maps()[2].probability - 0.34).abs() < 1e-15);
}

#[test]
fn a0t1_numbers_may_be_spelt_as_scanf_reads_them() {
    let text = "\u{feff}1\r\n+1.\t1e-1 -2E+0 3#x\r\n.5 0 0//y\r\n-0 0.0 1e0";
    let ifs = parse_text(text).unwrap();
    assert_eq!(ifs.maps()[0].map.rows, [[0.1, -2.0, 3.0], [0.5, 0.0, 0.0]]);
}

/// Text, line and column of the error, and a part of what is said.
const BAD: [(&str, (usize, usize), &str); 18] = [
    ("", (1, 1), "expected the number of maps, but the file ends here"),
    ("# nothing", (1, 10), "the file ends here"),
    ("two", (1, 1), "expected the number of maps, but found 'two'"),
    ("2.5 1", (1, 1), "found '2.5'"),
    ("-1", (1, 1), "found '-1'"),
    ("0", (1, 1), "at least one map"),
    ("99999999999", (1, 1), "the number of maps"),
    ("1000000000\n1 1 0 0 0 1 0 0 0 1", (2, 20), "the probability of map 2 of 1000000000"),
    ("1\nhalf", (2, 1), "the probability of map 1 of 1, but found 'half'"),
    ("1\n-0.5", (2, 1), "cannot be negative"),
    ("1\n1 1 0 0 0 1", (2, 12), "row 2, column 3 of map 1 of 1"),
    ("1\n1 1 nan 0", (2, 5), "row 1, column 2 of map 1 of 1, but found 'nan'"),
    ("1\n1 inf 0 0", (2, 3), "found 'inf'"),
    ("1\n1 1 0 1e39", (2, 7), "1e39 is out of range for row 1, column 3"),
    (
        "1\n1 1 0 0 0 1 0 0 0 2",
        (2, 19),
        "expected 1, from the last row of map 1 of 1, which is 0 0 1, but found '2'",
    ),
    ("1\n1 1 0 0 0 1 0 0 0", (2, 18), "the last row"),
    ("1\n.9 1 0 0 0 1 0 0 0 1", (2, 1), "they add up to 0.9000"),
    ("1\n1 1 0 0 0 1 0 0 0 1\n  extra", (3, 3), "expected the end of the file after 1 maps"),
];

#[test]
fn a0t1_errors_say_where_and_what() {
    for (text, position, message) in BAD {
        let error = parse_text(text).unwrap_err();
        assert_eq!(error.position(), Some(position), "{error}");
        assert!(error.message().contains(message), "{error}");
        let place = format!("a.txt:{}:{}", position.0, position.1);
        assert!(error.to_string().contains(&place), "{error}");
    }
}

#[test]
fn a0t1_every_prefix_is_read_or_refused() {
    let mut good = 0;
    for end in 0..=SIERPINSKI.len() {
        match parse_text(&SIERPINSKI[..end]) {
            Ok(_) => good += 1,
            Err(error) => assert!(error.position().is_some(), "{error}"),
        }
    }
    // Complete with and without the final line end.
    assert_eq!(good, 2);
}

proptest! {
    #[test]
    fn a0t1_no_text_makes_the_parser_panic(text in "[0-9. e\\-+#/\n\r\tä\u{0}]{0,60}") {
        if let Err(error) = parse_text(&text) {
            prop_assert!(error.to_string().starts_with("error: "));
        }
    }

    #[test]
    fn a0t1_one_changed_byte_is_read_or_refused(at in 0..SIERPINSKI.len(), byte in 0..128_u8) {
        let mut bytes = SIERPINSKI.as_bytes().to_vec();
        bytes[at] = byte;
        let text = String::from_utf8(bytes).unwrap();
        if let Err(error) = parse_text(&text) {
            prop_assert!(error.position().is_some());
        }
    }
}

#[test]
fn a0t1_files_that_cannot_be_read_are_named() {
    let error = load(Path::new("no/such/file.txt")).unwrap_err();
    assert!(error.to_string().contains(" --> no/such/file.txt"), "{error}");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("latin1.txt");
    std::fs::write(&path, b"1 # h\xe4lfte").unwrap();
    let error = load(&path).unwrap_err();
    assert!(error.message().contains("not a text file"), "{error}");
    std::fs::write(&path, SIERPINSKI).unwrap();
    assert_eq!(load(&path), parse_text(SIERPINSKI));
}
