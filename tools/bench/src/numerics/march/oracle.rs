//! The cells that a ray truly passes through, by whole numbers.
//!
//! Origins, directions and planes are multiples of fixed powers of two (planes: of a seventh of
//! one), so that the crossing of plane k, (plane − origin) / direction, is a fraction of whole
//! numbers, and two of them are ordered by products that 128 bits hold.

use std::cmp::Ordering;

/// Parts that a length is counted in: 2¹² to the unit, and the seventh part of that.
pub const PARTS: i128 = 7 << 12;
/// Parts that a component of a direction is counted in.
pub const STEPS: i128 = 1 << 23;

/// A grid of equal cells, the first corner at 0, in [`PARTS`].
#[derive(Clone, Copy, Debug)]
pub struct Lattice {
    /// Side of a cell.
    pub side: i128,
    /// Cells along each axis.
    pub count: i128,
}

/// A ray in whole numbers.
#[derive(Clone, Copy, Debug)]
pub struct Line {
    /// In [`PARTS`].
    pub origin: [i128; 3],
    /// In [`STEPS`].
    pub direction: [i128; 3],
}

/// A moment on the way as a fraction; `over` is above zero.
#[derive(Clone, Copy)]
struct Moment {
    way: i128,
    over: i128,
}

impl Moment {
    fn order(&self, other: &Self) -> Ordering {
        (self.way * other.over).cmp(&(other.way * self.over))
    }
}

impl Line {
    /// When it crosses a plane across an axis along which it moves.
    fn crossing(&self, axis: usize, plane: i128) -> Moment {
        let (way, over) = (plane - self.origin[axis], self.direction[axis]);
        if over < 0 { Moment { way: -way, over: -over } } else { Moment { way, over } }
    }
}

/// The cells whose interior the ray passes through from t = 0 on, in order. The ray must move
/// along every axis.
pub fn cells(lattice: &Lattice, line: &Line) -> Vec<[usize; 3]> {
    let n = lattice.count;
    let forward = line.direction.map(|d| d > 0);
    // The next plane of each axis, and the cell before it; before the first plane there is none.
    let mut plane: [i128; 3] = std::array::from_fn(|axis| if forward[axis] { 0 } else { n });
    let mut crossed = Vec::new();
    loop {
        let moments: [Option<Moment>; 3] = std::array::from_fn(|axis| {
            let ahead = (0..=n).contains(&plane[axis]);
            ahead.then(|| line.crossing(axis, plane[axis] * lattice.side))
        });
        let earlier = |a: Moment, b: Moment| if b.order(&a) == Ordering::Less { b } else { a };
        let Some(first) = moments.into_iter().flatten().reduce(earlier) else { return crossed };
        let cell: [i128; 3] = std::array::from_fn(|a| if forward[a] { plane[a] - 1 } else { plane[a] });
        if first.way > 0 && cell.iter().all(|c| (0..n).contains(c)) {
            crossed.push(cell.map(|c| c as usize));
        }
        for axis in 0..3 {
            if moments[axis].is_some_and(|m| m.order(&first) == Ordering::Equal) {
                plane[axis] += if forward[axis] { 1 } else { -1 };
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LATTICE: Lattice = Lattice { side: PARTS, count: 3 };

    fn crossed(origin: [i128; 3], direction: [i128; 3]) -> Vec<[usize; 3]> {
        cells(&LATTICE, &Line { origin: origin.map(|x| x * PARTS / 2), direction })
    }

    #[test]
    fn straight_diagonal_and_from_within() {
        let row = crossed([-2, 1, 1], [STEPS, 1, 1]);
        assert_eq!(row, [[0, 0, 0], [1, 0, 0], [2, 0, 0]]);
        let diagonal = crossed([8, 8, 8], [-STEPS, -STEPS, -STEPS]);
        assert_eq!(diagonal, [[2, 2, 2], [1, 1, 1], [0, 0, 0]]);
        let inside = crossed([3, 1, 1], [STEPS, 2, 3]);
        assert_eq!(inside, [[1, 0, 0], [2, 0, 0]]);
        assert!(crossed([8, 8, 8], [STEPS, 1, 1]).is_empty(), "the grid lies behind");
        assert!(crossed([-2, 9, 1], [STEPS, 1, 1]).is_empty(), "it passes the grid by");
    }

    #[test]
    fn an_edge_is_crossed_in_one_step() {
        let around = crossed([-1, 1, 1], [STEPS, STEPS, 1]);
        assert_eq!(around, [[0, 1, 0], [1, 2, 0]]);
    }
}
