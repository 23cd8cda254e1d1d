//! Which parts there are, and how much of each is measured.

use crate::part::Part;
use clap::Parser;
use common::cli::AppError;

/// A part with its flags.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// The part's name on the command line.
    pub name: &'static str,
    /// Its flags, with spaces between them.
    pub flags: String,
}

/// Name, flags of a quick run, flags of a full one. All quick ones together are to take less than
/// two minutes on two cores.
const ALL: [(&str, &str, &str); 12] = [
    ("pictures", "--rounds 7", ""),
    ("startup", "--rounds 5", ""),
    ("kernels", "--rounds 7", ""),
    ("numerics", "--quick", ""),
    (
        "rays",
        "--meshes bunny --sets primary,bounce,random --side 192 --threads 1 --rounds 3 --timed 16384",
        "",
    ),
    ("trees", "--mesh sphere20k --side 100 --rounds 3", ""),
    ("growth", "--meshes sphere1k,sphere10k,sphere100k --side 160 --rounds 3", ""),
    ("sampling", "--quick --scenes disc --adaptive-scenes few", ""),
    ("path", "--side 32 --truth 1024 --spp 4,16 --seeds 3", ""),
    (
        "simplify",
        "--meshes sphere8k,terrain10k --sizes sphere1k,sphere4k,sphere16k --rounds 3 --samples 20000",
        "",
    ),
    ("skips", "--quick", ""),
    ("stress", "--only p01_grid p02_places p07_spheres p10_meshes p11_random p18_ifs", "--full"),
];

/// All parts, or those of these names in the order of the list.
///
/// # Errors
/// If a name is unknown.
pub fn chosen(quick: bool, names: &[String]) -> Result<Vec<Entry>, AppError> {
    let known = || ALL.iter().map(|(name, ..)| *name);
    if let Some(name) = names.iter().find(|name| !known().any(|k| k == *name)) {
        let known: Vec<&str> = known().collect();
        return Err(AppError::Usage(format!("there is no part `{name}`; there are {}", known.join(", "))));
    }
    let wanted = |name: &str| names.is_empty() || names.iter().any(|n| n == name);
    let entry = |(name, few, many): &(&'static str, &str, &str)| {
        let flags = if quick { *few } else { *many };
        Entry { name, flags: flags.to_owned() }
    };
    Ok(ALL.iter().filter(|(name, ..)| wanted(name)).map(entry).collect())
}

#[derive(Parser)]
struct Line {
    #[command(subcommand)]
    part: Part,
}

impl Entry {
    /// The part as if it had been asked for by itself.
    ///
    /// # Errors
    /// If it does not know its flags.
    pub fn part(&self) -> Result<Part, AppError> {
        let words = ["bench", self.name].into_iter().chain(self.flags.split_whitespace());
        Ok(Line::try_parse_from(words)?.part)
    }

    /// What measures this part alone.
    pub fn command(&self) -> String {
        format!("cargo run --release -p bench -- {} {}", self.name, self.flags).trim_end().to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_part_knows_its_flags() {
        for quick in [false, true] {
            let all = chosen(quick, &[]).unwrap();
            assert_eq!(all.len(), ALL.len());
            assert!(all.iter().all(|entry| entry.part().is_ok()));
        }
        let some = ["path", "rays"].map(str::to_owned);
        let names: Vec<_> = chosen(true, &some).unwrap().iter().map(|e| e.name).collect();
        assert_eq!(names, ["rays", "path"]);
        let error = chosen(true, &["ray".to_owned()]).unwrap_err();
        assert!(matches!(&error, AppError::Usage(text) if text.contains("startup")));
        let wrong = Entry { name: "rays", flags: "--no-such-flag".to_owned() };
        assert!(wrong.part().is_err());
    }
}
