//! What a part found, before anybody decides how it is shown: on the terminal, as CSV, or as a
//! section of the page.

mod cell;
mod text;

pub use cell::{Better, Cell, Measured};

use crate::growth::plot::{Curve, Upward};

/// All that one part found.
#[derive(Clone, Debug, Default)]
pub struct Section {
    /// The part's name on the command line.
    pub part: &'static str,
    /// What the part asks, in a line.
    pub title: String,
    /// What must be known to read the figures.
    pub remarks: Vec<String>,
    /// In the order in which they are to be read.
    pub tables: Vec<Table>,
    /// In the order in which they are to be looked at.
    pub figures: Vec<Figure>,
}

/// Rows of equal kind.
#[derive(Clone, Debug, Default)]
pub struct Table {
    /// Short and unlike that of any other table of the part: figures of two runs are matched by it.
    pub title: String,
    /// The first one is that of the rows' labels.
    pub columns: Vec<Column>,
    /// Each with as many cells as there are columns after the first.
    pub rows: Vec<Row>,
}

/// What stands below each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// With the unit, if there is one.
    pub name: String,
    /// Which way is progress.
    pub better: Better,
}

/// What stands beside each other.
#[derive(Clone, Debug)]
pub struct Row {
    /// Unlike that of any other row of the table.
    pub label: String,
    /// One for each column after the first.
    pub cells: Vec<Cell>,
}

/// Curves in one picture.
#[derive(Clone, Debug)]
pub struct Figure {
    /// Above it.
    pub title: String,
    /// What is across, which is logarithmic.
    pub across: String,
    /// What is up.
    pub up: String,
    /// How far up is how much.
    pub upward: Upward,
    /// Curves.
    pub curves: Vec<Curve>,
}

impl Table {
    /// A table without rows; the columns are given as name and direction, the first as a name.
    pub fn new(title: impl Into<String>, labels: &str, columns: &[(&str, Better)]) -> Self {
        let first = Column { name: labels.to_owned(), better: Better::Neither };
        let rest = columns.iter().map(|&(name, better)| Column { name: name.to_owned(), better });
        Self { title: title.into(), columns: std::iter::once(first).chain(rest).collect(), rows: Vec::new() }
    }

    /// Adds a row.
    ///
    /// # Panics
    /// If it has not one cell for each column after the first, or a label that is there already.
    pub fn row(&mut self, label: impl Into<String>, cells: impl IntoIterator<Item = Cell>) {
        let row = Row { label: label.into(), cells: cells.into_iter().collect() };
        assert_eq!(row.cells.len() + 1, self.columns.len(), "{}: {row:?}", self.title);
        assert!(self.rows.iter().all(|r| r.label != row.label), "{}: {} twice", self.title, row.label);
        self.rows.push(row);
    }
}
