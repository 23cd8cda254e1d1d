//! Every check of the registry at quick numbers, a test for each; and textures for every input.

mod corpus;
mod textures;

use stress::{Property, Row, Stress, Tier, examine, properties, seed_of_environment};

/// Runs a check and prints its rows.
///
/// # Panics
/// If a row failed; the message has what is needed to run the trial again.
fn quick(name: &str) {
    let property = properties().iter().find(|p| p.name == name).expect("it is in the registry");
    let stress = Stress::new(property.number, property.name, Tier::Quick, seed_of_environment());
    let rows = examine(property, stress);
    for Row { name, trials, worst, seconds, .. } in &rows {
        println!("property | {name} | {trials} trials | worst {worst:.4} | {seconds:.2} s");
    }
    let failed: Vec<String> = rows.iter().filter(|row| row.failures > 0).map(explained).collect();
    assert!(failed.is_empty(), "{name}: {}\n{}", property.promise, failed.join("\n\n"));
}

fn explained(row: &Row) -> String {
    let Row { name, trials, failures, seed, first, .. } = row;
    let (trial, text) = first.as_ref().map_or((None, ""), |f| (f.trial, f.text.as_str()));
    let trial = trial.map_or(String::new(), |number| format!(", first is trial {number}"));
    format!("{name}: {failures} of {trials} fail, seed {seed}{trial}:\n{text}")
}

macro_rules! tests {
    ($($number:literal $name:ident $promise:literal => $($check:ident)::+;)*) => {
        $(
            #[test]
            fn $name() {
                quick(stringify!($name));
            }
        )*
    };
}

stress::all_properties!(tests);

#[test]
fn every_property_is_there_and_has_a_name_of_its_own() {
    let mut names: Vec<&str> = properties().iter().map(|p| p.name).collect();
    for number in 1..=18 {
        let prefix = format!("p{number:02}_");
        let named = |p: &&Property| p.number == number && p.name.starts_with(&prefix);
        assert!(properties().iter().any(|p| named(&p)), "property {number} has no check");
        assert!(properties().iter().all(|p| p.number != number || named(&p)), "{prefix}");
    }
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), properties().len());
}
