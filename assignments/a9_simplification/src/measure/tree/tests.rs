//! Against asking every triangle.

use super::*;
use proptest::prelude::*;

fn brute(corners: &[[DVec3; 3]], p: DVec3) -> f64 {
    let squared = |t: &[DVec3; 3]| nearest_on_triangle(p, *t).distance_squared(p);
    corners.iter().map(squared).fold(f64::INFINITY, f64::min)
}

/// Corners on a coarse lattice, so that there are ties, flat triangles and coincident ones.
fn triangles() -> impl Strategy<Value = Vec<[DVec3; 3]>> {
    let point = prop::array::uniform3(-4_i8..=4).prop_map(|p| DVec3::from_array(p.map(f64::from)));
    prop::collection::vec(prop::array::uniform3(point), 1..200)
}

proptest! {
    #[test]
    fn a9t4_agrees_with_asking_all(
        corners in triangles(),
        points in prop::collection::vec(prop::array::uniform3(-6.0..6.0), 20),
        hint: u32,
    ) {
        let tree = Tree::new(&corners);
        for p in points.into_iter().map(DVec3::from_array) {
            let (found, least) = (tree.nearest(p, None).unwrap(), brute(&corners, p));
            prop_assert_eq!(found.squared, least);
            prop_assert_eq!(found.point.distance_squared(p), least);
            let at = |t: usize| nearest_on_triangle(p, corners[t]).distance_squared(p);
            let first = (0..corners.len()).find(|&t| at(t) == least).unwrap();
            prop_assert_eq!(found.triangle as usize, first, "ties go to the lowest number");
            let hinted = tree.nearest(p, Some(hint % corners.len() as u32));
            prop_assert_eq!(hinted, Some(found), "a hint changed the answer");
            prop_assert_eq!(tree.nearest_beyond(p, least, Some(0)), None);
            prop_assert_eq!(tree.nearest_beyond(p, least * 0.999 - 1e-9, None), Some(found));
            prop_assert!(tree.any_within(p, least, |t| t == found.triangle));
            prop_assert!(!tree.any_within(p, least * 0.999 - 1e-9, |_| true));
        }
    }
}

#[test]
fn a9t4_nothing_has_no_nearest() {
    let tree = Tree::new(&[]);
    assert_eq!(tree.nearest(DVec3::ZERO, Some(3)), None);
    assert_eq!(tree.nearest_beyond(DVec3::ZERO, 0.0, None), None);
    assert!(!tree.any_within(DVec3::ZERO, 1.0, |_| true));
}

#[test]
fn a9t4_twenty_thousand_equal_triangles_are_a_tree_too() {
    let tree = Tree::new(&vec![[DVec3::ZERO, DVec3::X, DVec3::Y]; 20_000]);
    assert_eq!(tree.nearest(DVec3::Z, None).unwrap().triangle, 0);
}
