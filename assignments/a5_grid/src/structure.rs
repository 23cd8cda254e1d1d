//! What the programs trace through.

use crate::Grid;
use common::accel::{Accel, List};

/// What finds hits: the grid if one was asked for, else the list.
pub enum Structure<'g> {
    /// Brute force.
    List(List<'g>),
    /// The grid.
    Grid(Box<Grid<'g>>),
}

impl Structure<'_> {
    /// The structure behind the common seam.
    pub fn as_accel(&self) -> &dyn Accel {
        match self {
            Self::List(list) => list,
            Self::Grid(grid) => &**grid,
        }
    }

    /// How many structures were built: a list is none.
    pub fn built(&self) -> u64 {
        u64::from(matches!(self, Self::Grid(_)))
    }

    /// What was built, for `-stats`.
    pub fn describe(&self) -> String {
        match self {
            Self::List(_) => "structure: list of all primitives".to_owned(),
            Self::Grid(g) => {
                let kib = g.bytes().div_ceil(1024);
                format!("structure: grid, {} references, {kib} KiB", g.references())
            }
        }
    }
}
