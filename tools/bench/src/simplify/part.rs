//! A machine part: sharp edges, flat and curved faces, a hole through it.

use common::cli::AppError;
use common::math::Vec3;
use common::mesh::Mesh;
use modeller::generated::wave::{cosine, sine};
use std::collections::HashMap;

/// Blocks along each axis of the plan.
const PLAN: [i32; 3] = [8, 8, 8];
/// Triangles of the part if every block has one square on a side: twice its squares.
const LEAST: usize = 2 * SQUARES;
/// Squares of the surface of the plan; a test counts them.
const SQUARES: usize = 344;

/// `part20k` and its like; `None` if the name is another's.
pub fn named(name: &str) -> Option<Result<Mesh, AppError>> {
    let (number, factor) = match name.strip_prefix("part")? {
        count if count.ends_with('k') => (&count[..count.len() - 1], 1_000),
        count => (count, 1),
    };
    let triangles = number.parse::<usize>().ok().map(|n| n * factor);
    let wrong =
        || AppError::Usage(format!("`{name}` is no part: want {LEAST} triangles or more, as in part20k"));
    let triangles = triangles.filter(|n| (LEAST..=10_000_000).contains(n));
    Some(triangles.map(part).ok_or_else(wrong))
}

/// Whether a block of the plan is solid: a plate, a tower on it, and a hole through the tower.
fn is_solid([x, y, z]: [i32; 3]) -> bool {
    let within = |v: i32, low: i32, high: i32| (low..high).contains(&v);
    let inside = [x, y, z].iter().zip(PLAN).all(|(v, n)| within(*v, 0, n));
    let plate = y < 2;
    let tower = within(x, 1, 6) && within(z, 2, 7);
    let hole = within(y, 4, 6) && within(x, 3, 5);
    inside && (plate || tower) && !hole
}

/// The part with about that many triangles.
pub fn part(triangles: usize) -> Mesh {
    let cuts = ((triangles as f64 / LEAST as f64).sqrt().round() as i32).max(1);
    let (mut mesh, mut numbers) = (Mesh::default(), HashMap::new());
    let blocks = (0..PLAN[0]).flat_map(|x| (0..PLAN[1]).map(move |y| [x, y]));
    for block in blocks.flat_map(|[x, y]| (0..PLAN[2]).map(move |z| [x, y, z])).filter(|b| is_solid(*b)) {
        for (axis, step) in [(0, 1), (0, -1), (1, 1), (1, -1), (2, 1), (2, -1)] {
            let mut beyond = block;
            beyond[axis] += step;
            if !is_solid(beyond) {
                face(&mut mesh, &mut numbers, block, axis, step, cuts);
            }
        }
    }
    mesh
}

/// One side of a block, cut into squares.
fn face(
    mesh: &mut Mesh,
    numbers: &mut HashMap<[i32; 3], u32>,
    block: [i32; 3],
    axis: usize,
    step: i32,
    cuts: i32,
) {
    let mut vertex = |u: i32, v: i32| {
        let mut at = block.map(|b| b * cuts);
        at[axis] += if step > 0 { cuts } else { 0 };
        at[(axis + 1) % 3] += u;
        at[(axis + 2) % 3] += v;
        *numbers.entry(at).or_insert_with(|| {
            mesh.positions.push(place(at.map(|x| f64::from(x) / f64::from(cuts))));
            mesh.positions.len() as u32 - 1
        })
    };
    let squares = (0..cuts).flat_map(|u| (0..cuts).map(move |v| (u, v)));
    for (u, v) in squares {
        let [a, b, c, d] = [vertex(u, v), vertex(u + 1, v), vertex(u + 1, v + 1), vertex(u, v + 1)];
        let front = if step > 0 { [[a, b, c], [a, c, d]] } else { [[a, c, b], [a, d, c]] };
        mesh.triangles.extend(front);
    }
}

/// Twists the plan about its upright axis and lets it bulge, so that sharp edges have curved
/// faces beside them; the plate's underside stays flat.
fn place([x, y, z]: [f64; 3]) -> Vec3 {
    let (x, z, height) = (x / 4.0 - 1.0, z / 4.0 - 1.0, y / 4.0);
    let above = (y - 2.0).max(0.0) / 6.0;
    let (turn, wide) = (0.12 * above, 1.0 + 0.15 * sine(0.5 * above));
    let (s, c) = (sine(turn), cosine(turn));
    Vec3::new(((c * x - s * z) * wide) as f32, height as f32, ((s * x + c * z) * wide) as f32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use a9_simplification::measure::Original;

    #[test]
    fn the_part_is_whole_at_every_fineness() {
        assert_eq!(part(1).triangles.len(), LEAST);
        for wanted in [3_000, 20_000] {
            let made = part(wanted);
            assert!(made.triangles.len().abs_diff(wanted) * 4 < wanted, "{}", made.triangles.len());
            let topology = *Original::new(&made).topology();
            assert!(topology.is_manifold());
            assert_eq!((topology.euler, topology.components, topology.boundary_edges), (0, 1, 0));
            assert_eq!((topology.zero_area_faces, topology.folded_edges), (0, 0));
        }
    }
}
