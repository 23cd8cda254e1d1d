//! What is known of the tests, as counts.

use super::*;

fn by_name<'v>(contenders: &[Box<dyn Contender + '_>], verdicts: &'v [Verdict], name: &str) -> &'v Verdict {
    let place = contenders.iter().position(|c| c.name() == name).expect("a known name");
    &verdicts[place]
}

#[test]
fn all_find_the_walls_in_the_middle_of_triangles() {
    let body = &bodies().unwrap()[0];
    agree(body, &contenders(body)).unwrap();
}

#[test]
fn every_known_fault_shows_and_ours_has_none() {
    for body in bodies().unwrap() {
        let contenders = contenders(&body);
        let verdicts = judge(&body, &contenders, 400);
        let of = |name| by_name(&contenders, &verdicts, name);
        for name in ["ours, scalar exact", "ours, filter + exact (8 lanes)"] {
            let v = of(name);
            assert_eq!((v.missed, v.even, v.astray), ([0; 4], [0; 4], 0), "{name}, {}", body.world.name);
        }
        let strict = of("plane + strict Cramer, f32");
        assert!(strict.missed[0] > 20 && strict.even[0] > strict.missed[0] && strict.even[1] > 0);
        for name in ["Möller–Trumbore, f32", "Möller–Trumbore, f64", "Baldwin–Weber, f32"] {
            assert!(of(name).even[0] > 0, "{name} hits no wall twice, {}", body.world.name);
        }
        // It never leaks, but counts what it meets on an edge for both sides.
        for name in ["Woop et al., f32, then f64", "Woop et al., f32 only"] {
            assert_eq!(of(name).missed, [0; 4], "{name} leaks, {}", body.world.name);
        }
    }
    let body = &bodies().unwrap()[0];
    let contenders = contenders(body);
    let verdicts = judge(body, &contenders, 2000);
    let missed = |name| by_name(&contenders, &verdicts, name).missed[0];
    assert!(missed("Möller–Trumbore, f32") > 0 && missed("Möller–Trumbore, f64") > 0);
}

#[test]
fn both_forms_of_a_test_agree() {
    let body = &bodies().unwrap()[0];
    let contenders = contenders(body);
    let verdicts = judge(body, &contenders, 200);
    let of = |name| by_name(&contenders, &verdicts, name);
    let (scalar, filtered) = (of("ours, scalar exact"), of("ours, filter + exact (8 lanes)"));
    assert_eq!(scalar.error.quantile(1.0), filtered.error.quantile(1.0));
    assert!(scalar.error.quantile(0.5) <= 0.5, "t is rounded once");
    assert!(of("Möller–Trumbore, f32").error.quantile(0.5) > 0.0);
}

#[test]
fn costs_are_those_of_every_test() {
    let table = costs(&bodies().unwrap()[0], 1);
    assert_eq!(table.rows.len(), 9);
    assert!(table.rows.iter().all(|row| row.cells[0].value().is_some()));
}
