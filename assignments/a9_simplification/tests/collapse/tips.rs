//! Where a thin sheet ends, nothing is cut off.

use crate::shapes::{mesh, one};
use a9_simplification::measure::Original;
use a9_simplification::{Goal, Method};
use common::math::Vec3;
use common::mesh::Mesh;

/// Segments around a star, and rings from its middle to its edge.
const AROUND: u32 = 200;
const RINGS: u32 = 30;

/// A star with five points, two sheets that meet in a sharp edge; a fiftieth as thick as wide.
fn blade() -> Mesh {
    let ring = |j: u32, side: f32| {
        (0..AROUND).map(move |i| {
            let angle = i as f32 / AROUND as f32 * std::f32::consts::TAU;
            let share = j as f32 / RINGS as f32;
            let r = share * (0.6 + 0.4 * (5.0 * angle).cos());
            Vec3::new(r * angle.cos(), r * angle.sin(), side * 0.02 * (1.0 - share * share))
        })
    };
    let mut positions: Vec<Vec3> = ring(RINGS, 0.0).collect();
    let mut triangles = Vec::new();
    for side in [1.0f32, -1.0] {
        let middle = positions.len() as u32;
        positions.push(Vec3::new(0.0, 0.0, side * 0.02));
        positions.extend((1..RINGS).flat_map(|j| ring(j, side)));
        let number = |j: u32, i: u32| match j {
            0 => middle,
            RINGS => i % AROUND,
            j => middle + 1 + (j - 1) * AROUND + i % AROUND,
        };
        for (j, i) in (0..RINGS).flat_map(|j| (0..AROUND).map(move |i| (j, i))) {
            let [a, b, c, d] = [number(j, i), number(j + 1, i), number(j + 1, i + 1), number(j, i + 1)];
            let both = if j == 0 { vec![[a, b, c]] } else { vec![[a, b, c], [a, c, d]] };
            triangles
                .extend(both.into_iter().map(|[a, b, c]| if side > 0.0 { [a, b, c] } else { [a, c, b] }));
        }
    }
    mesh(positions, triangles)
}

#[test]
fn tips_of_thin_sheets_stay() {
    let blade = blade();
    let original = Original::new(&blade);
    assert!(original.topology().is_manifold() && original.topology().euler == 2);
    for method in [Method::Qem, Method::Memoryless] {
        // Without a price for tips it is several times as much.
        for (ratio, most) in [(0.1, 4e-4), (0.03, 1.5e-3)] {
            let result = one(&blade, Goal::Ratio(ratio), method);
            let farthest = original.compare(&result.mesh, 1000).distance.forward.max;
            assert!(farthest < most, "{method:?} {ratio}: {farthest}");
        }
    }
}
