//! The flags of assignment 5, on top of those of assignments 1 to 4.

use crate::{Cells, Fit, Grid, MAX_CELLS, Structure};
use a1_ray_casting::{CastArgs, Studio};
use a4_whitted::WhittedArgs;
use common::accel::List;
use common::cli::{self, AppError};
use common::geometry::Geometry;
use std::path::Path;

/// A uniform grid: its cells as a picture, and ray tracing through it.
#[derive(clap::Parser)]
#[command(
    name = "a5_grid",
    version,
    rename_all = "snake_case",
    after_help = "Example:\n  a5_grid -input scenes/scene5_09_bunny_mesh_40k.txt -size 200 200 -output out.tga -grid 40 40 33 -visualize_grid"
)]
pub struct Program {
    /// All flags.
    #[command(flatten)]
    pub args: GridArgs,
}

/// The grid.
#[derive(Clone, Debug, clap::Args)]
#[command(rename_all = "snake_case", next_help_heading = "Assignment 5: the grid")]
pub struct GridArgs {
    /// Cut the scene's box into cells and send every ray through them
    #[arg(long, num_args = 3, value_names = ["NX", "NY", "NZ"])]
    pub grid: Option<Vec<i64>>,

    /// Show the first occupied cell along every ray instead of the scene; white holds one
    /// primitive, then blue over green to red for 2 to 16 and more
    #[arg(long)]
    pub visualize_grid: bool,

    /// The same as -visualize_grid, whose colours show the counts already
    #[arg(long)]
    pub visualize_grid_count: bool,

    /// How closely cells follow a primitive; bounds for the picture of cells, exact for tracing
    #[arg(long, value_name = "RULE", value_enum)]
    pub grid_fit: Option<Fit>,

    /// Flags of assignments 1 to 4.
    #[command(flatten)]
    pub whitted: WhittedArgs,
}

impl GridArgs {
    /// Flags of assignment 1.
    pub fn cast(&self) -> &CastArgs {
        self.whitted.cast()
    }

    /// The files that this step and those before write.
    pub fn outputs(&self) -> Vec<&Path> {
        self.whitted.outputs()
    }

    /// Whether the colour picture shows cells.
    pub fn shows_cells(&self) -> bool {
        self.visualize_grid || self.visualize_grid_count
    }

    /// Refuses impossible and empty tasks, warns of flags without effect.
    ///
    /// # Errors
    /// A grid without cells or with too many, a picture of cells without a grid.
    pub fn check(&self) -> Result<(), AppError> {
        self.whitted.check()?;
        if self.shows_cells() && self.grid.is_none() {
            return Err(AppError::Usage("-visualize_grid needs -grid NX NY NZ".to_owned()));
        }
        if self.grid_fit.is_some() && self.grid.is_none() {
            cli::warn("-grid_fit has no effect without -grid");
        }
        let lit = self.whitted.shadows || self.whitted.bounces.is_some();
        if self.shows_cells() && lit {
            cli::warn("-shadows and -bounces have no effect on the picture of cells");
        }
        self.counts().map(|_| ())
    }

    /// Cells along each axis.
    fn counts(&self) -> Result<Option<[u32; 3]>, AppError> {
        let Some(asked) = &self.grid else { return Ok(None) };
        let side = |n: &i64| u128::try_from(*n).unwrap_or(0);
        let product = asked.iter().map(side).fold(1u128, u128::saturating_mul);
        let text = || asked.iter().map(i64::to_string).collect::<Vec<_>>().join(" x ");
        if product == 0 {
            let what = format!("a grid of {} has no cells; every side must be at least 1", text());
            return Err(AppError::Usage(what));
        }
        if product > u128::from(MAX_CELLS) {
            let what = format!("a grid of {} cells is too large; at most {MAX_CELLS} in all", text());
            return Err(AppError::Usage(what));
        }
        Ok(Some([asked[0] as u32, asked[1] as u32, asked[2] as u32]))
    }

    /// The cells that these flags ask for; `None` without `-grid`, or if the scene has no
    /// finite object that a box could be put around.
    ///
    /// # Errors
    /// As [`GridArgs::check`].
    pub fn cells(&self, studio: &Studio) -> Result<Option<Cells>, AppError> {
        let counts = self.counts()?;
        Ok(counts.zip(studio.geometry.bounds()).map(|(n, b)| Cells::new(n, &b)))
    }

    /// The structure that finds hits.
    ///
    /// # Errors
    /// If the grid would hold too many references.
    pub fn structure<'g>(
        &self,
        geometry: &'g Geometry,
        cells: Option<Cells>,
    ) -> Result<Structure<'g>, AppError> {
        let Some(cells) = cells else { return Ok(Structure::List(List::new(geometry))) };
        let grid =
            Grid::new(geometry, cells, self.grid_fit.unwrap_or(Fit::Exact)).map_err(AppError::Usage)?;
        Ok(Structure::Grid(Box::new(grid)))
    }
}
