//! The faults, as `faults.txt` lists them.

use common::cli::AppError;
use std::fmt;
use std::path::Path;

/// Where the list is, from the repository's root.
const LIST: &str = "tools/faults/faults.txt";

/// A change that breaks something.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// What is wrong then.
    pub name: String,
    /// The file, from the repository's root.
    pub file: String,
    /// What stands there once.
    pub from: String,
    /// What stands there instead.
    pub to: String,
    /// What must notice.
    pub test: Test,
}

/// One test of the workspace.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Test {
    /// The package.
    pub package: String,
    /// `lib`, or the name of a file or folder in its `tests/`.
    pub target: String,
    /// With the modules that it is in.
    pub name: String,
}

impl fmt::Display for Test {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{} {} {}", self.package, self.target, self.name)
    }
}

/// All faults.
///
/// # Errors
/// If the list cannot be read, or a line of it cannot be understood.
pub fn read(root: &Path) -> Result<Vec<Fault>, AppError> {
    parse(&std::fs::read_to_string(root.join(LIST))?)
}

/// A fault is `= name`, `in file`, `by package target test`, then lines that begin with `-` and are
/// replaced by those that begin with `+`. Lines that begin with `#` say why.
fn parse(text: &str) -> Result<Vec<Fault>, AppError> {
    let mut faults: Vec<Fault> = Vec::new();
    for (number, line) in (1..).zip(text.lines()) {
        let wrong = || AppError::Usage(format!("{LIST}:{number}: cannot understand `{line}`"));
        let fault = faults.last_mut().ok_or_else(wrong);
        match line.split_at_checked(1) {
            None | Some(("#", _)) => {}
            Some(("=", name)) => faults.push(Fault {
                name: name.trim().to_owned(),
                file: String::new(),
                from: String::new(),
                to: String::new(),
                test: Test { package: String::new(), target: String::new(), name: String::new() },
            }),
            Some(("-", line)) => add_line(&mut fault?.from, line),
            Some(("+", line)) => add_line(&mut fault?.to, line),
            _ => match *line.split_whitespace().collect::<Vec<_>>() {
                ["in", file] => fault?.file = file.to_owned(),
                ["by", package, target, name] => {
                    let [package, target, name] = [package, target, name].map(str::to_owned);
                    fault?.test = Test { package, target, name };
                }
                _ => return Err(wrong()),
            },
        }
    }
    Ok(faults)
}

/// Lines are joined by line breaks, with none at the end: a fault may be within a line.
fn add_line(text: &mut String, line: &str) {
    if !text.is_empty() {
        text.push('\n');
    }
    text.push_str(line);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all() -> Vec<Fault> {
        read(&crate::root()).unwrap_or_else(|error| panic!("{}", error.report()))
    }

    #[test]
    fn every_fault_can_still_be_planted() {
        let faults = all();
        assert!(faults.len() >= 25, "{}", faults.len());
        for (i, fault) in faults.iter().enumerate() {
            assert!(faults[..i].iter().all(|other| other.name != fault.name), "{} twice", fault.name);
            let text = std::fs::read_to_string(crate::root().join(&fault.file))
                .unwrap_or_else(|error| panic!("{}: {}: {error}", fault.name, fault.file));
            assert_eq!(text.matches(&fault.from).count(), 1, "{}: {}", fault.name, fault.from);
            assert_ne!(fault.from, fault.to, "{}", fault.name);
        }
    }

    /// Tests of `stress` are made from the list of properties, where their names stand alone.
    #[test]
    fn every_test_that_is_named_exists() {
        for fault in all() {
            let test = &fault.test;
            let copy = crate::copy::Copy { root: crate::root(), target: crate::root() };
            let folder = copy.package(test).unwrap_or_else(|error| panic!("{}", error.report()));
            let last = test.name.rsplit("::").next().unwrap_or_default();
            assert!(mentions(&folder, last), "{}: no test {}", fault.name, test.name);
        }
    }

    fn mentions(folder: &Path, name: &str) -> bool {
        let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
        entries.into_iter().any(|path| match path.is_dir() {
            true => !path.ends_with("target") && mentions(&path, name),
            false => {
                path.extension().is_some_and(|e| e == "rs")
                    && std::fs::read_to_string(&path).is_ok_and(|text| text.contains(name))
            }
        })
    }

    #[test]
    fn a_list_is_understood_or_its_line_is_named() {
        let text = "# why\n= it lies\nin a.rs\nby p lib m::t\n-one\n-two\n+three\n";
        let [fault] = &parse(text).unwrap()[..] else { panic!("one fault") };
        assert_eq!((&*fault.name, &*fault.from, &*fault.to), ("it lies", "one\ntwo", "three"));
        assert_eq!(fault.test.to_string(), "p lib m::t");
        for (text, line) in [("in a.rs", ":1:"), ("= a\nby x", ":2:"), ("-x", ":1:")] {
            let error = parse(text).unwrap_err().report();
            assert!(error.contains(line), "{error}");
        }
    }
}
