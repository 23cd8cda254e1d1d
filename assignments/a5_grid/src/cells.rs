//! A box cut into cells by planes.

use common::math::{Bounds, DVec3};

/// Most cells of a grid: 2²⁷, half a gigabyte of counters.
pub const MAX_CELLS: u64 = 1 << 27;

/// nx × ny × nz cells. A cell is what lies between neighbouring planes, its sides included; a
/// flat box has cells without thickness.
#[derive(Clone, Debug, PartialEq)]
pub struct Cells {
    /// Cells along each axis, at least 1.
    pub count: [usize; 3],
    /// count + 1 planes across each axis, not decreasing.
    pub planes: [Vec<f64>; 3],
}

impl Cells {
    /// Cuts a box evenly.
    pub fn new(count: [u32; 3], bounds: &Bounds) -> Self {
        let planes = std::array::from_fn(|a| {
            let (min, max) = (f64::from(bounds.min[a]), f64::from(bounds.max[a]));
            let n = count[a];
            let inner = |i: u32| min + (max - min) * f64::from(i) / f64::from(n);
            // The last plane is the box's own side, without rounding.
            (0..n).map(inner).chain([max]).collect()
        });
        Self { count: count.map(|n| n as usize), planes }
    }

    /// The same with the box's sides moved outward by 2⁻⁴⁰ of their distance from the origin.
    /// Spheres are hit by rays that pass them by within the rounding of `f64`, and such a ray
    /// may pass the box by, too.
    #[must_use]
    pub fn padded(mut self) -> Self {
        let sides = self.planes.iter().flat_map(|p| [p[0], p[p.len() - 1]]);
        let slack = sides.fold(0.0, |reach: f64, p| reach.max(p.abs())) * 2f64.powi(-40);
        for planes in &mut self.planes {
            let last = planes.len() - 1;
            planes[0] -= slack;
            planes[last] += slack;
        }
        self
    }

    /// How many cells there are.
    pub fn len(&self) -> usize {
        self.count.iter().product()
    }

    /// Never: every axis has at least one cell.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Position of a cell in an array, x varying fastest.
    #[inline]
    pub fn index(&self, [x, y, z]: [usize; 3]) -> usize {
        (z * self.count[1] + y) * self.count[0] + x
    }

    /// The smallest and largest corner of a cell.
    pub fn corners(&self, cell: [usize; 3]) -> (DVec3, DVec3) {
        let at = |a: usize, up: usize| self.planes[a][cell[a] + up];
        (DVec3::new(at(0, 0), at(1, 0), at(2, 0)), DVec3::new(at(0, 1), at(1, 1), at(2, 1)))
    }

    /// Half the diagonal of a cell.
    pub fn half_diagonal(&self) -> f64 {
        let side = |a: usize| (self.planes[a][self.count[a]] - self.planes[a][0]) / self.count[a] as f64;
        DVec3::new(side(0), side(1), side(2)).length() / 2.0
    }

    /// First and last cell along an axis that share a point with [low, high]; touching counts.
    /// Outside the box the nearest cell is meant.
    pub fn span(&self, axis: usize, low: f64, high: f64) -> (usize, usize) {
        let (planes, last_cell) = (&self.planes[axis], self.count[axis] - 1);
        let scale = (last_cell + 1) as f64 / (planes[last_cell + 1] - planes[0]);
        // Guessed by proportion (a flat box guesses 0), then put right by the planes themselves.
        let guess = |x: f64| (((x - planes[0]) * scale) as usize).min(last_cell);
        let (mut first, mut last) = (guess(low), guess(high));
        while first > 0 && planes[first] >= low {
            first -= 1;
        }
        while first < last_cell && planes[first + 1] < low {
            first += 1;
        }
        while last < last_cell && planes[last + 1] <= high {
            last += 1;
        }
        while last > 0 && planes[last] > high {
            last -= 1;
        }
        (first, last.max(first))
    }

    /// The spans along all axes of the cells that share a point with a box.
    pub fn spans(&self, min: DVec3, max: DVec3) -> [(usize, usize); 3] {
        std::array::from_fn(|a| self.span(a, min[a], max[a]))
    }
}

/// Calls `visit` with every cell of three spans, x varying fastest.
pub fn for_each_cell([x, y, z]: [(usize, usize); 3], mut visit: impl FnMut([usize; 3])) {
    for k in z.0..=z.1 {
        for j in y.0..=y.1 {
            for i in x.0..=x.1 {
                visit([i, j, k]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use common::math::Vec3;

    #[test]
    fn a5t1_spans_include_touching_cells() {
        let cells = Cells::new([4, 1, 1], &Bounds { min: Vec3::ZERO, max: Vec3::new(4.0, 1.0, 0.0) });
        assert_eq!(cells.span(0, 1.5, 2.5), (1, 2));
        assert_eq!(cells.span(0, 1.0, 2.0), (0, 2));
        assert_eq!(cells.span(0, -5.0, -4.0), (0, 0));
        assert_eq!(cells.span(0, 9.0, 9.0), (3, 3));
        assert_eq!(cells.span(2, 0.0, 0.0), (0, 0), "a flat box has its one layer");
    }
}
