//! Counts, closedness, shape and bits of the generated meshes.

use super::*;
use crate::check;
use std::collections::HashMap;

fn made(name: &str) -> Generated {
    name.parse::<Recipe>().unwrap().make()
}

#[test]
fn names_are_read_and_nonsense_is_refused() {
    let recipe = |kind, triangles| Ok(Recipe { kind, triangles });
    assert_eq!("sphere200k".parse(), recipe(Kind::Sphere, 200_000));
    assert_eq!("gyroid1m".parse(), recipe(Kind::Gyroid, 1_000_000));
    assert_eq!("terrain5000".parse(), recipe(Kind::Terrain, 5_000));
    for bad in ["", "sphere", "cube1k", "sphere1x", "sphere-5", "sphere99", "sphere21m", "1k", "spherek"] {
        assert!(bad.parse::<Recipe>().unwrap_err().contains("sphere200k"), "{bad}");
    }
}

#[test]
fn counts_are_the_nearest_that_there_are() {
    for wanted in [1_000, 20_000, 150_000, 1_000_000] {
        let count = sphere(wanted).triangles.len();
        let n = (count / 20).isqrt();
        assert_eq!(count, 20 * n * n);
        let others = [20 * (n - 1) * (n - 1), 20 * (n + 1) * (n + 1)];
        assert!(
            others.into_iter().all(|o| o.abs_diff(wanted) >= count.abs_diff(wanted)),
            "{wanted}: {count}"
        );
        let columns = (wanted as f64 / 2.0).sqrt();
        assert!(terrain(wanted).triangles.len().abs_diff(wanted) as f64 <= columns + 1.0);
    }
    for wanted in [1_000, 50_000, 700_000] {
        let count = gyroid(wanted).triangles.len();
        assert!(count.abs_diff(wanted) * 100 <= wanted * 12, "{wanted}: {count}");
    }
}

#[test]
fn balls_are_closed_and_star_shaped_at_every_fineness() {
    for wanted in [100, 1_000, 30_000] {
        let mesh = sphere(wanted).to_mesh();
        check::closed_manifold(&mesh).unwrap();
        assert_eq!(check::euler_characteristic(&mesh), 2);
        let outwards = |t: usize| {
            let [a, b, c] = mesh.corners(t);
            a.dot(b.cross(c)) > 0.0
        };
        assert!((0..mesh.triangles.len()).all(outwards), "{wanted}");
        assert!(mesh.positions.iter().all(|p| (0.6..1.4).contains(&p.length())));
    }
}

#[test]
fn gyroids_are_closed_have_handles_and_lie_on_the_surface() {
    for (name, most) in [("gyroid2k", f64::INFINITY), ("gyroid30k", 0.15), ("gyroid200k", 1e-4)] {
        let mesh = made(name).to_mesh();
        check::closed_manifold(&mesh).unwrap();
        assert!(check::euler_characteristic(&mesh) <= -10, "{name}: {}", check::euler_characteristic(&mesh));
        assert!(check::volume(&mesh) > 1.0, "{name}: {}", check::volume(&mesh));
        let off = |p: &DVec3| level_distance(*p);
        let worst = mesh.positions.iter().map(off).fold(0.0, f64::max);
        assert!(worst < most, "{name}: {worst}");
        assert!(check::flattest(&mesh) > 0.0, "{name}: a triangle without area");
    }
}

/// How far a point is from the surface, to first order.
fn level_distance(p: DVec3) -> f64 {
    let (value, gradient) = gyroid_level(p);
    (value / gradient.length()).abs()
}

#[test]
fn terrains_have_one_rim_and_face_upwards() {
    let mesh = terrain(5_000).to_mesh();
    let mut uses: HashMap<(u32, u32), i32> = HashMap::new();
    for &[a, b, c] in &mesh.triangles {
        for edge in [(a, b), (b, c), (c, a)] {
            *uses.entry(edge).or_default() += 1;
        }
    }
    assert!(uses.values().all(|&n| n == 1));
    let rim = uses.keys().filter(|(a, b)| !uses.contains_key(&(*b, *a)));
    assert_eq!(rim.count(), 4 * 50);
    let up = |t: usize| {
        let [a, b, c] = mesh.corners(t);
        (b - a).cross(c - a).y > 0.0
    };
    assert!((0..mesh.triangles.len()).all(up));
    assert!(mesh.positions.iter().all(|p| p.y.abs() < 0.65));
}

/// Bits of all coordinates and indices (FNV-1a, 64 bits).
fn fingerprint(mesh: &Generated) -> u64 {
    let bits = mesh.positions.iter().flatten().map(|x| x.to_bits());
    let words = bits.chain(mesh.triangles.iter().flatten().copied());
    words.fold(0xcbf2_9ce4_8422_2325, |hash, word| (hash ^ u64::from(word)).wrapping_mul(0x0100_0000_01b3))
}

/// If this fails on some machine, benchmarks there are not on the same work.
#[test]
fn the_bits_are_the_same_everywhere() {
    let found = ["sphere20k", "gyroid20k", "gyroid100k", "terrain20k"].map(|name| fingerprint(&made(name)));
    assert_eq!(
        found,
        [0x3be6_09e3_0c63_0f6e, 0x029b_884b_ff25_8099, 0x6da2_a465_1c84_f68b, 0x408f_33d6_0904_10db],
        "{found:#018x?}"
    );
}
