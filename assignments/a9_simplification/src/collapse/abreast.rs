//! Prices of eight edges side by side: the arithmetic of [`minimum`](crate::collapse::cost), step by step, so that each
//! has the bits that it would have alone.

use crate::collapse::surface::{Surface, next};
use common::math::lanes::{LANES, Vectors, add, dot, load_wide, scale, subtract};
use common::simd::{Select, Simd, SimdBase, f64x8};

/// Eight symmetric 3×3 matrices: the entries as in [`Symmetric`](crate::collapse::quadric::Symmetric).
#[derive(Clone, Copy)]
pub(super) struct Symmetrics<S: Simd>(pub [f64x8<S>; 6]);

/// Eight rows of numbers, turned: what is alike stands side by side.
#[derive(Clone, Copy)]
pub(super) struct Columns<T, const N: usize>(pub [[T; LANES]; N]);

impl<T: Copy + Default, const N: usize> Columns<T, N> {
    pub(super) fn new() -> Self {
        Self([[T::default(); LANES]; N])
    }

    #[inline(always)]
    pub(super) fn set(&mut self, lane: usize, row: &[T; N]) {
        for (column, &entry) in self.0.iter_mut().zip(row) {
            column[lane] = entry;
        }
    }
}

impl Columns<f64, 6> {
    /// As matrices.
    #[inline(always)]
    pub(super) fn matrices<S: Simd>(&self, simd: S) -> Symmetrics<S> {
        let of = |i: usize| f64x8::from_slice(simd, &self.0[i]);
        Symmetrics([of(0), of(1), of(2), of(3), of(4), of(5)])
    }
}

/// Eight edges, seen from their starts.
pub(super) struct Edges {
    /// Start and end of each.
    ends: [[u32; 2]; LANES],
    along: Columns<f64, 3>,
}

impl Edges {
    #[inline(always)]
    pub(super) fn new(surface: &Surface, half_edges: &[u32; LANES]) -> Self {
        let mut along = Columns::new();
        let mut ends = [[0; 2]; LANES];
        for lane in 0..LANES {
            let h = half_edges[lane];
            ends[lane] = [surface.start(h), surface.start(next(h))];
            let [from, to] = [surface.at(ends[lane][0]), surface.at(ends[lane][1])];
            along.set(lane, &(to - from).to_array());
        }
        Self { ends, along }
    }

    /// What is known of the starts and of the ends.
    #[inline(always)]
    pub(super) fn of_ends<'a, T: Copy + Default + 'a, const N: usize>(
        &self,
        of: impl Fn(u32) -> &'a [T; N],
    ) -> [Columns<T, N>; 2] {
        let (mut starts, mut ends) = (Columns::new(), Columns::new());
        for (lane, [start, end]) in self.ends.into_iter().enumerate() {
            starts.set(lane, of(start));
            ends.set(lane, of(end));
        }
        [starts, ends]
    }

    /// From start to end.
    #[inline(always)]
    pub(super) fn along<S: Simd>(&self, simd: S) -> Vectors<f64x8<S>> {
        load_wide(simd, &self.along.0)
    }
}

impl<S: Simd> Symmetrics<S> {
    #[inline(always)]
    pub(super) fn plus(&self, other: &Self) -> Self {
        let sum = |i: usize| self.0[i] + other.0[i];
        Self([sum(0), sum(1), sum(2), sum(3), sum(4), sum(5)])
    }

    #[inline(always)]
    pub(super) fn times(&self, v: Vectors<f64x8<S>>) -> Vectors<f64x8<S>> {
        let [xx, xy, xz, yy, yz, zz] = self.0;
        [dot([xx, xy, xz], v), dot([xy, yy, yz], v), dot([xz, yz, zz], v)]
    }

    #[inline(always)]
    pub(super) fn square(&self, v: Vectors<f64x8<S>>) -> f64x8<S> {
        dot(v, self.times(v))
    }

    #[inline(always)]
    fn trace(&self) -> f64x8<S> {
        self.0[0] + self.0[3] + self.0[5]
    }

    /// See [`Symmetric::solve`](crate::collapse::quadric::Symmetric::solve).
    #[inline(always)]
    fn solve(&self, simd: S, r: Vectors<f64x8<S>>) -> Vectors<f64x8<S>> {
        let one = f64x8::splat(simd, 1.0);
        let [xx, xy, xz, yy, yz, zz] = self.0;
        let inverse_x = one / xx;
        let (yx, zx) = (xy * inverse_x, xz * inverse_x);
        let inverse_y = one / (yy - yx * xy);
        let yz_left = yz - yx * xz;
        let zy = yz_left * inverse_y;
        let inverse_z = one / (zz - zx * xz - zy * yz_left);
        let ry = r[1] - yx * r[0];
        let rz = r[2] - zx * r[0] - zy * ry;
        let z = rz * inverse_z;
        let y = ry * inverse_y - zy * z;
        [r[0] * inverse_x - yx * y - zx * z, y, z]
    }

    /// Where yᵀ·A·y − 2·r·y is least; see [`minimum`](crate::collapse::cost).
    #[inline(always)]
    pub(super) fn least(
        &self,
        simd: S,
        r: Vectors<f64x8<S>>,
        edge: Vectors<f64x8<S>>,
        least_rank: f64,
    ) -> Vectors<f64x8<S>> {
        let weight = f64x8::splat(simd, least_rank) * self.trace();
        let mut regular = *self;
        for i in [0, 3, 5] {
            regular.0[i] += weight;
        }
        let half = f64x8::splat(simd, 0.5) * weight;
        regular.solve(simd, add(r, scale(edge, half)))
    }

    /// What steps cost whose error at `y` is known; no number for those whose minimum is too far away to be believed.
    #[inline(always)]
    pub(super) fn costs(
        &self,
        simd: S,
        edge: Vectors<f64x8<S>>,
        y: Vectors<f64x8<S>>,
        error: f64x8<S>,
        shape: f64,
    ) -> [f64; LANES] {
        let length2 = dot(edge, edge);
        let far = f64x8::splat(simd, 4.0) * length2;
        let beyond = subtract(y, edge);
        let is_near = dot(y, y).simd_lt(far) & dot(beyond, beyond).simd_lt(far);
        let cost = error + f64x8::splat(simd, shape) * self.trace() * length2;
        let mut costs = [0.0; LANES];
        is_near.select(cost, f64x8::splat(simd, f64::NAN)).store_slice(&mut costs);
        costs
    }
}

/// Calls `what` with every edge and its price; `eight` tells those of eight, and where it tells no number `alone` does.
#[inline(always)]
pub(super) fn price_all(
    surface: &Surface,
    eight: impl Fn(&[u32; LANES]) -> [f64; LANES],
    alone: impl Fn(u32) -> f64,
    mut what: impl FnMut(u32, f64),
) {
    let (mut edges, mut count) = ([0; LANES], 0);
    let mut price = |edges: &[u32; LANES], count: usize| {
        for (&h, cost) in edges.iter().zip(eight(edges)).take(count) {
            what(h, if cost.is_nan() { alone(h) } else { cost });
        }
    };
    // Not by `for`: nested iterators are quicker from within.
    surface.edges().for_each(|h| {
        edges[count] = h;
        count += 1;
        if count == LANES {
            price(&edges, count);
            count = 0;
        }
    });
    // What is left over stands beside edges that are priced already.
    if count > 0 {
        price(&edges, count);
    }
}

#[cfg(test)]
mod tests {
    use crate::collapse::accumulated::Accumulated;
    use crate::collapse::build::build;
    use crate::collapse::cost::Cost;
    use crate::collapse::memoryless::Memoryless;
    use crate::collapse::surface::Surface;
    use common::math::Vec3;

    /// A sheet with hills, flat parts, a boundary, and a vertex that is far away.
    fn surface() -> Surface {
        let n = 20u32;
        let height = |i: u32| if i % n < 6 { 0.0 } else { ((i % 7) * (i % 11)) as f32 / 90.0 };
        let mut places: Vec<Vec3> =
            (0..n * n).map(|i| Vec3::new((i % n) as f32, height(i), (i / n) as f32 + 1e3)).collect();
        places[77].y = 1e5;
        let square = |i: u32| [[i, i + n, i + 1], [i + 1, i + n, i + n + 1]];
        let triangles = (0..n * (n - 1)).filter(|i| i % n < n - 1).flat_map(square);
        build(&places, triangles).surface
    }

    fn compare(surface: &Surface, cost: &impl Cost) {
        let mut priced = Vec::new();
        cost.price_all(surface, |h, price| priced.push((h, price.to_bits())));
        let alone: Vec<_> = surface.edges().map(|h| (h, cost.price(surface, h).cost.to_bits())).collect();
        assert!(alone.len() > 900 && alone.len() % 8 != 0);
        assert_eq!(priced, alone);
    }

    #[test]
    fn eight_side_by_side_cost_what_each_costs_alone() {
        let surface = surface();
        compare(&surface, &Accumulated::new(&surface));
        compare(&surface, &Memoryless::new(&surface));
    }
}
