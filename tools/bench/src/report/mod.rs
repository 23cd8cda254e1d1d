//! What a part found, before anybody decides how it is shown: on the terminal, as CSV, or as a
//! section of the page.

mod cell;
pub mod csv;
mod figure;
mod front;
mod plot;
mod table;
mod text;

pub use cell::{Better, Cell, Measured};
pub use figure::{Curve, Figure, Upward};
pub use front::front;
pub use table::{Row, Table};

use common::cli::AppError;

/// All that one part found.
#[derive(Clone, Debug, Default)]
pub struct Section {
    /// The part's name on the command line.
    pub part: &'static str,
    /// What the part asks, in a line.
    pub title: String,
    /// What must be known to read the figures.
    pub remarks: Vec<String>,
    /// The few figures that the head of the page shows, each with what it is and its unit.
    pub headline: Vec<(String, Cell)>,
    /// In the order in which they are to be read.
    pub tables: Vec<Table>,
    /// In the order in which they are to be looked at.
    pub figures: Vec<Figure>,
    /// Results that are wrong, one in a line: they fail the run, after all else was measured.
    pub faults: Vec<String>,
}

impl Section {
    /// Whether all results are right.
    ///
    /// # Errors
    /// [`AppError::CheckFailed`] with all faults.
    pub fn verdict(&self) -> Result<(), AppError> {
        let wrong = || AppError::CheckFailed(self.faults.join("\n"));
        if self.faults.is_empty() { Ok(()) } else { Err(wrong()) }
    }

    /// The table of a title.
    #[cfg(test)]
    pub fn table(&self, title: &str) -> &Table {
        let found = self.tables.iter().find(|t| t.title == title);
        found.unwrap_or_else(|| panic!("{} has no table {title}", self.part))
    }
}
