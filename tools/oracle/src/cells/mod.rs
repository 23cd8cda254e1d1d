//! The picture of `-visualize_grid`: which cells of a uniform grid hold an object, and the
//! first such cell along a ray (course rules §6.1 and §6.2). By brute force: every cell is
//! compared with every object, every ray with every occupied cell.

mod aabb;
mod colour;
mod occupant;
mod overlap;
mod walk;

pub use colour::cell_colour;
pub use walk::CellHit;

use crate::{CellPicture, World};
use aabb::Aabb;
use common::math::DVec3;
use occupant::occupants;
use rayon::prelude::*;

/// A grid over the finite objects of a scene, with the number of objects in each cell.
#[derive(Clone, Debug)]
pub struct CellGrid {
    occupied: Vec<Cell>,
}

/// A cell that holds something.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Cell {
    /// Position in the grid along each axis, from 0.
    index: [u32; 3],
    bounds: Aabb,
    /// Per axis: is it the last one, and so owns its upper face?
    last: [bool; 3],
    count: u32,
}

impl CellGrid {
    /// Sorts the finite objects of `world` into cells. A mesh counts triangle by triangle;
    /// planes and discs are left out. Without finite objects no cell is occupied.
    pub fn new(world: &World, picture: CellPicture) -> Self {
        let occupants = occupants(world);
        let Some(bounds) = occupants.iter().map(|o| o.bounds).reduce(Aabb::around) else {
            return Self { occupied: Vec::new() };
        };
        let [nx, ny, nz] = picture.cells;
        let layer = |k| (0..ny).flat_map(move |j| (0..nx).map(move |i| [i, j, k]));
        let indices = (0..nz).into_par_iter().flat_map_iter(layer);
        let fill = |index: [u32; 3]| {
            let last = std::array::from_fn(|a| index[a] + 1 == picture.cells[a]);
            let bounds = cell_bounds(&bounds, picture.cells, index);
            let count = occupants.iter().filter(|o| o.fills(&bounds, picture.fit)).count();
            Cell { index, bounds, last, count: count as u32 }
        };
        Self { occupied: indices.map(fill).filter(|cell| cell.count > 0).collect() }
    }

    /// How many objects the cell at `index` holds; 0 outside the grid.
    pub fn count(&self, index: [u32; 3]) -> u32 {
        self.occupied.iter().find(|cell| cell.index == index).map_or(0, |cell| cell.count)
    }

    /// The number of cells that hold at least one object.
    pub fn occupied(&self) -> usize {
        self.occupied.len()
    }
}

/// From min + size·i/n to min + size·(i+1)/n along each axis; the last cell ends exactly where
/// the grid does, so that rounding leaves no object outside.
fn cell_bounds(grid: &Aabb, cells: [u32; 3], index: [u32; 3]) -> Aabb {
    let face = |axis: usize, i: u32| {
        if i == cells[axis] {
            return grid.max[axis];
        }
        let size = grid.max[axis] - grid.min[axis];
        grid.min[axis] + size * f64::from(i) / f64::from(cells[axis])
    };
    let faces = |above: u32| DVec3::from_array(std::array::from_fn(|a| face(a, index[a] + above)));
    Aabb { min: faces(0), max: faces(1) }
}
