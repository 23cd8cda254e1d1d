//! Going through the registry.

use crate::registry::{Property, properties};
use crate::row::{Failure, Row};
use crate::stress::{Single, Stress, guarded};
use crate::tier::Tier;

/// Whether a property is meant by one of some names: its own, or a beginning of it such as `p01`;
/// no names mean all.
pub fn is_chosen(property: &Property, only: &[String]) -> bool {
    only.is_empty() || only.iter().any(|name| property.name.starts_with(name.as_str()))
}

/// Runs the properties that are chosen, one after the other, each on all cores; `progress` is
/// shown every row when its property is done.
pub fn survey(tier: Tier, seed: u64, only: &[String], mut progress: impl FnMut(&Row)) -> Vec<Row> {
    let chosen = properties().iter().filter(|property| is_chosen(property, only));
    let mut all = Vec::new();
    for property in chosen {
        let rows = examine(property, Stress::new(property.number, property.name, tier, seed));
        rows.iter().for_each(&mut progress);
        all.extend(rows);
    }
    all
}

/// Runs one property. A panic of the check, or nothing to show, is a row that failed.
pub fn examine(property: &Property, stress: Stress) -> Vec<Row> {
    let (seed, alone) = (stress.seed(), stress.is_single());
    let ended = guarded(|| {
        (property.check)(&stress);
        Ok(())
    });
    let mut rows = stress.into_rows();
    let ended = ended.and_then(|()| match rows.is_empty() && !alone {
        true => Err("nothing was checked".to_owned()),
        false => Ok(()),
    });
    if let Err(text) = ended {
        rows.push(failed(property, seed, text));
    }
    rows
}

fn failed(property: &Property, seed: u64, text: String) -> Row {
    Row {
        property: property.number,
        check: property.name,
        name: format!("{} as a whole", property.name),
        trials: 1,
        failures: 1,
        worst: 0.0,
        seed,
        seconds: 0.0,
        first: Some(Failure { trial: None, text }),
    }
}

/// Runs what failed once more: the very trial if it has a number, else the whole check. Returns
/// the row, or `None` if the property has no such row any more.
pub fn again(property: &Property, tier: Tier, seed: u64, row: &str, trial: Option<u64>) -> Option<Row> {
    let stress = Stress::new(property.number, property.name, tier, seed);
    let stress = match trial {
        Some(trial) => stress.only(Single { row: row.to_owned(), trial }),
        None => stress,
    };
    examine(property, stress).into_iter().find(|found| found.name == row)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn property(check: fn(&Stress)) -> Property {
        Property { number: 1, name: "p01_made_up", promise: "none", check }
    }

    #[test]
    fn what_breaks_or_does_nothing_has_failed() {
        let rows = |check| examine(&property(check), Stress::new(1, "p01_made_up", Tier::Quick, 0));
        let broken = rows(|stress| {
            stress.case("before", || Ok(0.0));
            panic!("boom");
        });
        assert_eq!(broken.iter().map(|r| r.failures).collect::<Vec<_>>(), [0, 1]);
        assert_eq!(broken[1].first.as_ref().map(|f| f.text.as_str()), Some("panic: boom"));
        assert_eq!(rows(|_| ()).iter().map(|r| r.failures).collect::<Vec<_>>(), [1]);
    }

    #[test]
    fn names_choose_by_their_beginning() {
        let made_up = property(|_| ());
        let chosen = |name: &str| is_chosen(&made_up, &[name.to_owned()]);
        assert!(chosen("p01") && chosen("p01_made_up") && !chosen("p02") && is_chosen(&made_up, &[]));
    }
}
