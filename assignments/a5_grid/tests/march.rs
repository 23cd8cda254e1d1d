//! A5T2: the cells along a ray, where they can be told by hand.

use a5_grid::{Cells, March, Step};
use common::math::{Bounds, Interval, Vec3};
use common::ray::Ray;
use proptest::prelude::*;

/// n³ cells of side 1 from the origin.
fn unit_cells(n: u32) -> Cells {
    Cells::new([n; 3], &Bounds { min: Vec3::ZERO, max: Vec3::splat(n as f32) })
}

fn march(cells: &Cells, o: [f32; 3], d: [f32; 3]) -> Vec<Step> {
    March::new(cells, &Ray::new(o.into(), d.into()), Interval::FORWARD).into_iter().flatten().collect()
}

fn visited(steps: &[Step]) -> Vec<[usize; 3]> {
    steps.iter().map(|s| s.cell).collect()
}

#[test]
fn a5t2_a_row_from_outside() {
    let steps = march(&unit_cells(3), [-1.0, 1.5, 1.5], [0.5, 0.0, 0.0]);
    assert_eq!(visited(&steps), [[0, 1, 1], [1, 1, 1], [2, 1, 1]]);
    let ends: Vec<_> = steps.iter().map(|s| (s.enter, s.exit, s.axis)).collect();
    assert_eq!(ends, [(2.0, 4.0, Some(0)), (4.0, 6.0, Some(0)), (6.0, 8.0, Some(0))]);
}

#[test]
fn a5t2_from_inside_the_march_starts_at_the_origin() {
    let steps = march(&unit_cells(3), [1.5, 1.5, 1.5], [0.0, -1.0, 0.0]);
    assert_eq!(visited(&steps), [[1, 1, 1], [1, 0, 1]]);
    assert_eq!((steps[0].enter, steps[0].axis), (0.0, None));
}

/// Through an edge of cells, or a corner, the step is diagonal: nothing beside is visited.
#[test]
fn a5t2_edges_and_corners_are_crossed_diagonally() {
    let steps = march(&unit_cells(3), [-1.0, -1.0, 0.5], [1.0, 1.0, 0.0]);
    assert_eq!(visited(&steps), [[0, 0, 0], [1, 1, 0], [2, 2, 0]]);
    let steps = march(&unit_cells(4), [5.0, 5.0, 5.0], [-1.0, -1.0, -1.0]);
    assert_eq!(visited(&steps), [[3; 3], [2; 3], [1; 3], [0; 3]]);
}

#[test]
fn a5t2_what_lies_behind_or_beside_is_not_visited() {
    let cells = unit_cells(2);
    assert!(march(&cells, [3.0, 0.5, 0.5], [1.0, 0.0, 0.0]).is_empty());
    assert!(march(&cells, [-1.0, 2.5, 0.5], [1.0, 0.0, 0.0]).is_empty());
    assert!(march(&cells, [0.5; 3], [f32::NAN, 0.0, 1.0]).is_empty());
    assert!(march(&cells, [0.5; 3], [0.0; 3]).is_empty());
}

/// Orthographic cameras see what is behind their centre.
#[test]
fn a5t2_the_whole_line_starts_behind_the_origin() {
    let ray = Ray::new(Vec3::new(1.5, 0.5, 0.5), Vec3::X);
    let steps: Vec<_> = March::new(&unit_cells(3), &ray, Interval::ALL).into_iter().flatten().collect();
    assert_eq!(visited(&steps), [[0, 0, 0], [1, 0, 0], [2, 0, 0]]);
    assert_eq!(steps[0].enter, -1.5);
}

#[test]
fn a5t2_a_flat_box_has_one_layer() {
    let flat = Cells::new([2, 2, 1], &Bounds { min: Vec3::ZERO, max: Vec3::new(2.0, 2.0, 0.0) });
    assert_eq!(visited(&march(&flat, [0.5, 1.5, 1.0], [0.0, 0.0, -1.0])), [[0, 1, 0]]);
}

fn coordinate() -> impl Strategy<Value = f32> {
    prop_oneof![-2.0f32..10.0, (-2i8..10).prop_map(f32::from)]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    /// Steps follow each other without gap, and consecutive cells are neighbours.
    #[test]
    fn a5t2_steps_are_a_connected_path(
        o in prop::array::uniform3(coordinate()),
        d in prop::array::uniform3(coordinate()),
    ) {
        let cells = Cells::new([10, 7, 3], &Bounds { min: Vec3::ZERO, max: Vec3::new(7.0, 10.0, 3.0) });
        let steps = march(&cells, o, d);
        for pair in steps.windows(2) {
            prop_assert_eq!(pair[0].exit, pair[1].enter);
            let apart = (0..3).map(|a| pair[0].cell[a].abs_diff(pair[1].cell[a]));
            prop_assert_eq!(apart.max(), Some(1));
        }
        for step in &steps {
            prop_assert!((0..3).all(|a| step.cell[a] < cells.count[a]) && step.enter <= step.exit);
        }
    }
}
