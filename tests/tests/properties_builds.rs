//! accuracy.md, property 12: structures can be built for anything, and are valid.

use a5_grid::Fit;
use common::accel::{Accel, List};
use common::counters::Counters;
use common::geometry::Geometry;
use common::math::{Interval, Vec3};
use common::mesh::Mesh;
use common::ray::Ray;
use tests::property::{Named, agree, build, geometry_of, run, structures};

/// Worlds that break structures: nothing, one thing, everything in one place, no volume.
fn odd_worlds() -> Vec<(&'static str, Geometry)> {
    let point = [Vec3::ONE; 3];
    let flat = |i: usize| [Vec3::X * i as f32, Vec3::X * (i + 1) as f32, Vec3::Y + Vec3::X * i as f32];
    let one = [Vec3::ZERO, Vec3::X, Vec3::Y];
    vec![
        ("nothing", build("Group { numObjects 0 }", Mesh::default())),
        ("one sphere", build("Sphere { center 1 2 3 radius 4 }", Mesh::default())),
        ("one triangle", geometry_of(&[one])),
        ("a point", geometry_of(&[point])),
        ("coincident", geometry_of(&[one; 17])),
        ("flat", geometry_of(&(0..100).map(flat).collect::<Vec<_>>())),
        ("20000 equal", geometry_of(&[one; 20_000])),
        (
            "only planes",
            build(
                "Group { numObjects 2 Plane { normal 0 1 0 offset 0 } Plane { normal 1 0 0 offset 2 } }",
                Mesh::default(),
            ),
        ),
        (
            "huge and tiny",
            build(
                "Group { numObjects 2 Sphere { center 0 0 0 radius 1e30 } Sphere { center 1e-30 0 0 radius 1e-30 } }",
                Mesh::default(),
            ),
        ),
    ]
}

#[test]
fn p12_structures_are_built_and_valid_for_odd_worlds() {
    for (name, geometry) in odd_worlds() {
        let list = List::new(&geometry);
        list.validate().unwrap_or_else(|e| panic!("{name}: {e}"));
        let others = structures(&geometry, &[[1, 1, 1], [5, 6, 7]].map(|n| (n, Fit::Exact)));
        run(&format!("p12 {name}"), 1201, 1_000, |draw| {
            let origin = (draw.cube() * 5.0).as_vec3();
            let ray = Ray::new(origin, (draw.cube() * 2.0).as_vec3() - origin);
            agree(&list, &others, &ray, Interval::ALL)
        });
    }
}

/// Of equal hits the lowest number wins, in every structure.
#[test]
fn p12_ties_go_to_the_lowest_number() {
    let geometry = geometry_of(&[[Vec3::ZERO, Vec3::X, Vec3::Y]; 2000]);
    let ray = Ray::new(Vec3::new(0.2, 0.2, 1.0), -Vec3::Z);
    for Named { name, accel } in structures(&geometry, &[([3, 3, 1], Fit::Exact)]) {
        let hit = accel.nearest(&ray, Interval::FORWARD, &mut Counters::default()).expect("a hit");
        assert_eq!((hit.primitive, hit.t), (0, 1.0), "{name}");
    }
}

#[test]
fn p12_a_hundred_thousand_nested_groups_and_transforms_are_prepared_and_hit() {
    const DEPTH: usize = 100_000;
    let wrap = |open: &str| {
        format!("{} Sphere {{ center 0 0 0 radius 1 }} {}", open.repeat(DEPTH), "}".repeat(DEPTH))
    };
    for open in
        ["Group { numObjects 1 ", "Transform { Translate 0 0 1e-6 ", "Transform { Rotate { 1 2 3 0.01 } "]
    {
        let geometry = build(&wrap(open), Mesh::default());
        let list = List::new(&geometry);
        let others = structures(&geometry, &[([5, 5, 5], Fit::Exact)]);
        let ray = Ray::new(Vec3::Z * 5.0, -Vec3::Z);
        let hit = agree(&list, &others, &ray, Interval::FORWARD).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(hit, 1.0, "{open}");
        let t = list.nearest(&ray, Interval::FORWARD, &mut Counters::default()).map(|h| h.t);
        let expected = if open.contains("Translate") { 3.9 } else { 4.0 };
        assert!(t.is_some_and(|t| (t - expected).abs() < 1e-4), "{open}: {t:?}");
    }
}
