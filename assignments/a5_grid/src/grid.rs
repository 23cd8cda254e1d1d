//! A5T3: the grid as a structure that finds hits.

use crate::voxelise::{solid_cells, triangle_cells};
use crate::{Cells, Fit, March, Step};
use common::accel::{Accel, Job};
use common::counters::Counters;
use common::geometry::{Geometry, Hit};
use common::math::{Bounds, Interval, Vec3};
use common::ray::Ray;
use common::shape::ExactRay;
use common::shape::filter::Filter;
use common::shape::triangle_block::{LANES, TriangleBlock};
use common::simd::{self, Simd, dispatch};

/// Most references to primitives that all cells together may hold.
const MAX_REFERENCES: usize = 1 << 27;

/// Primitives sorted into cells; planes are kept beside it, for they belong to no box.
pub struct Grid<'g> {
    geometry: &'g Geometry,
    cells: Cells,
    triangle_bounds: Bounds,
    /// Where the blocks and the solids of cell i begin; those of cell i + 1 follow.
    start: Vec<[u32; 2]>,
    blocks: Vec<TriangleBlock>,
    solids: Vec<u32>,
    /// One bit per cell: set if it holds anything. Most cells on a ray's way are empty, and the
    /// bits stay in the nearest cache where `start` does not.
    occupied: Vec<u64>,
}

/// Pairs (cell, primitive) sorted by cell: where each cell begins, and the primitives.
fn sort_by_cell(cells: usize, pairs: &[(u32, u32)]) -> (Vec<u32>, Vec<u32>) {
    let mut start = vec![0u32; cells + 1];
    for (cell, _) in pairs {
        start[*cell as usize + 1] += 1;
    }
    for i in 1..start.len() {
        start[i] += start[i - 1];
    }
    let (mut next, mut sorted) = (start.clone(), vec![0; pairs.len()]);
    for (cell, item) in pairs {
        let place = &mut next[*cell as usize];
        sorted[*place as usize] = *item;
        *place += 1;
    }
    (start, sorted)
}

impl<'g> Grid<'g> {
    /// Sorts the finite primitives into cells.
    ///
    /// # Errors
    /// If the cells together would hold too many references.
    pub fn new(geometry: &'g Geometry, cells: Cells, fit: Fit) -> Result<Self, String> {
        // Triangles are decided exactly and need no margin.
        let cells = if geometry.solids().is_empty() { cells } else { cells.padded() };
        let (mut triangles, mut solids) = (Vec::new(), Vec::new());
        for (i, vertices) in geometry.triangles().iter().enumerate() {
            triangle_cells(&cells, vertices, fit, |c| triangles.push((cells.index(c) as u32, i as u32)));
            limit(triangles.len())?;
        }
        for (i, solid) in geometry.solids().iter().enumerate() {
            solid_cells(&cells, solid, fit, |c| solids.push((cells.index(c) as u32, i as u32)));
            limit(solids.len())?;
        }
        let (triangle_start, triangles) = sort_by_cell(cells.len(), &triangles);
        let (solid_start, solids) = sort_by_cell(cells.len(), &solids);
        let (block_start, blocks) = pack(geometry, &triangle_start, &triangles);
        let start = block_start.into_iter().zip(solid_start).map(|(b, s)| [b, s]).collect::<Vec<_>>();
        let occupied = occupancy(&start);
        let triangle_bounds = Bounds::of_points(geometry.triangles().iter().flatten().copied());
        Ok(Self { geometry, cells, triangle_bounds, start, blocks, solids, occupied })
    }

    /// How the box is cut.
    pub fn cells(&self) -> &Cells {
        &self.cells
    }

    /// Bytes that it takes.
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.blocks) + size_of_val(&*self.start) + size_of_val(&*self.solids)
    }

    /// References to primitives in all cells together.
    pub fn references(&self) -> usize {
        self.blocks.iter().map(|b| b.len()).sum::<usize>() + self.solids.len()
    }

    #[inline]
    fn is_empty_cell(&self, cell: usize) -> bool {
        self.occupied[cell / 64] >> (cell % 64) & 1 == 0
    }

    #[inline]
    fn held(&self, cell: usize) -> (&[TriangleBlock], &[u32]) {
        let ([b0, s0], [b1, s1]) = (self.start[cell], self.start[cell + 1]);
        (&self.blocks[b0 as usize..b1 as usize], &self.solids[s0 as usize..s1 as usize])
    }

    #[inline(always)]
    fn nearest_in<S: Simd>(
        &self,
        simd: S,
        query: &Query,
        mut best: Option<Hit>,
        c: &mut Counters,
    ) -> Option<Hit> {
        let Some(march) = March::new(&self.cells, query.ray, query.interval) else { return best };
        let job = Job { filter: &query.filter, ray: query.ray, interval: query.interval };
        for step in march {
            c.cells += 1;
            let cell = self.cells.index(step.cell);
            if self.is_empty_cell(cell) {
                if query.is_over(&step, best.as_ref()) {
                    break;
                }
                continue;
            }
            let (blocks, solids) = self.held(cell);
            let solids = solids.iter().copied();
            best = job.nearest(simd, blocks, best, c);
            best = self.geometry.nearest_solid(solids, &query.exact, query.interval, best, c);
            if query.is_over(&step, best.as_ref()) {
                break;
            }
        }
        best
    }

    #[inline(always)]
    fn any_in<S: Simd>(&self, simd: S, query: &Query, c: &mut Counters) -> bool {
        let Some(march) = March::new(&self.cells, query.ray, query.interval) else { return false };
        let job = Job { filter: &query.filter, ray: query.ray, interval: query.interval };
        for step in march {
            c.cells += 1;
            let cell = self.cells.index(step.cell);
            if self.is_empty_cell(cell) {
                if query.is_over(&step, None) {
                    break;
                }
                continue;
            }
            let (blocks, solids) = self.held(cell);
            let solids = solids.iter().copied();
            if job.any(simd, blocks, c) || self.geometry.any_solid(solids, &query.exact, query.interval, c) {
                return true;
            }
            if query.is_over(&step, None) {
                break;
            }
        }
        false
    }
}

fn occupancy(start: &[[u32; 2]]) -> Vec<u64> {
    let mut bits = vec![0; start.len().div_ceil(64)];
    for (cell, ends) in start.windows(2).enumerate() {
        bits[cell / 64] |= u64::from(ends[0] != ends[1]) << (cell % 64);
    }
    bits
}

fn limit(references: usize) -> Result<(), String> {
    if references <= MAX_REFERENCES {
        return Ok(());
    }
    Err(format!("the grid's cells would hold more than {MAX_REFERENCES} references; use fewer cells"))
}

fn pack(geometry: &Geometry, start: &[u32], triangles: &[u32]) -> (Vec<u32>, Vec<TriangleBlock>) {
    let corners = |&i: &u32| -> (u32, [Vec3; 3]) {
        (geometry.triangle_numbers()[i as usize], geometry.triangles()[i as usize])
    };
    let (mut block_start, mut blocks) = (Vec::with_capacity(start.len()), Vec::new());
    for cell in start.windows(2) {
        block_start.push(blocks.len() as u32);
        let held = &triangles[cell[0] as usize..cell[1] as usize];
        blocks.extend(held.chunks(LANES).map(|chunk| TriangleBlock::pack(chunk.iter().map(corners))));
    }
    block_start.push(blocks.len() as u32);
    (block_start, blocks)
}

/// One ray on its way through the grid.
struct Query<'r> {
    ray: &'r Ray,
    interval: Interval,
    exact: ExactRay,
    filter: Filter,
    /// See [`ExactRay::margin`].
    margin: f64,
}

impl<'r> Query<'r> {
    fn new(grid: &Grid, ray: &'r Ray, interval: Interval) -> Self {
        let exact = ExactRay::new(ray);
        let filter = Filter::new(ray, &grid.triangle_bounds);
        let margin = grid.geometry.bounds().map_or(0.0, |b| exact.margin(&b));
        Self { ray, interval, exact, filter, margin }
    }

    /// Whether nothing in later cells can matter.
    #[inline]
    fn is_over(&self, step: &Step, best: Option<&Hit>) -> bool {
        let last = best.map_or(self.interval.max, |hit| hit.t);
        f64::from(last) + self.margin < step.exit
    }
}

impl Accel for Grid<'_> {
    fn nearest(&self, ray: &Ray, interval: Interval, counters: &mut Counters) -> Option<Hit> {
        if !ray.is_usable() {
            return None;
        }
        let query = Query::new(self, ray, interval);
        let best = self.geometry.nearest_sheet(ray, interval, counters);
        dispatch!(simd::level(), s => self.nearest_in(s, &query, best, counters))
    }

    fn any(&self, ray: &Ray, interval: Interval, counters: &mut Counters) -> bool {
        if !ray.is_usable() {
            return false;
        }
        let query = Query::new(self, ray, interval);
        if self.geometry.any_sheet(ray, interval, counters) {
            return true;
        }
        dispatch!(simd::level(), s => self.any_in(s, &query, counters))
    }

    fn geometry(&self) -> &Geometry {
        self.geometry
    }

    fn validate(&self) -> Result<(), String> {
        let mut missing = Ok(());
        for (i, vertices) in self.geometry.triangles().iter().enumerate() {
            let number = self.geometry.triangle_numbers()[i];
            triangle_cells(&self.cells, vertices, Fit::Exact, |cell| {
                // Numbers increase from block to block; a search keeps this from being quadratic.
                let held = self.held(self.cells.index(cell)).0;
                let at = held.partition_point(|b| b.index[b.len() - 1] < number);
                if !held.get(at).is_some_and(|b| b.index[..b.len()].contains(&number)) {
                    missing = Err(format!("triangle {i} is missing in cell {cell:?}"));
                }
            });
        }
        for (i, solid) in self.geometry.solids().iter().enumerate() {
            solid_cells(&self.cells, solid, Fit::Exact, |cell| {
                if !self.held(self.cells.index(cell)).1.contains(&(i as u32)) {
                    missing = Err(format!("solid {i} is missing in cell {cell:?}"));
                }
            });
        }
        missing
    }
}
