//! Tables: rows of equal kind.

use super::{Better, Cell, front};

/// Rows of equal kind.
#[derive(Clone, Debug, Default)]
pub struct Table {
    /// Short and unlike that of any other table of the part: figures of two runs are matched by it.
    pub title: String,
    /// The first one is that of the rows' labels.
    pub columns: Vec<Column>,
    /// Each with as many cells as there are columns after the first.
    pub rows: Vec<Row>,
    /// Whether rows do the same work in different ways, so that the best of a column means something.
    pub rivals: bool,
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
    /// For each cell, whether nothing beats it: see [`Table::mark_front`].
    pub marks: Vec<bool>,
}

impl Table {
    /// A table without rows; the columns are given as name and direction, the first as a name.
    pub fn new(title: impl Into<String>, labels: &str, columns: &[(&str, Better)]) -> Self {
        let first = Column { name: labels.to_owned(), better: Better::Neither };
        let rest = columns.iter().map(|&(name, better)| Column { name: name.to_owned(), better });
        let columns = std::iter::once(first).chain(rest).collect();
        Self { title: title.into(), columns, ..Self::default() }
    }

    /// The same, of rows that do the same work in different ways.
    pub fn of_rivals(title: impl Into<String>, labels: &str, columns: &[(&str, Better)]) -> Self {
        Self { rivals: true, ..Self::new(title, labels, columns) }
    }

    /// Adds a row. A label that is there already gets a number, so that rows stay unlike each other.
    ///
    /// # Panics
    /// If it has not one cell for each column after the first.
    pub fn row(&mut self, label: impl Into<String>, cells: impl IntoIterator<Item = Cell>) {
        let (label, cells): (_, Vec<Cell>) = (label.into(), cells.into_iter().collect());
        let label = self.unlike(label);
        let row = Row { label, marks: vec![false; cells.len()], cells };
        assert_eq!(row.cells.len() + 1, self.columns.len(), "{}: {row:?}", self.title);
        self.rows.push(row);
    }

    fn unlike(&self, label: String) -> String {
        let is_new = |label: &String| self.rows.iter().all(|row| row.label != *label);
        let numbered = (2..).map(|n| format!("{label} ({n})"));
        std::iter::once(label.clone()).chain(numbered).find(is_new).unwrap_or(label)
    }

    /// Puts a figure where a row and a column meet, both of which are added if need be.
    pub fn set(&mut self, row: &str, column: &str, better: Better, cell: Cell) {
        let place = self.columns[1..].iter().position(|c| c.name == column).unwrap_or_else(|| {
            self.columns.push(Column { name: column.to_owned(), better });
            self.columns.len() - 2
        });
        let number = self.rows.iter().position(|r| r.label == row).unwrap_or_else(|| {
            self.rows.push(Row { label: row.to_owned(), cells: Vec::new(), marks: Vec::new() });
            self.rows.len() - 1
        });
        for row in &mut self.rows {
            row.cells.resize(self.columns.len() - 1, Cell::None);
            row.marks.resize(self.columns.len() - 1, false);
        }
        self.rows[number].cells[place] = cell;
    }

    /// Marks the cells of a column in which no row is as good for as little as another column says;
    /// rows in which `counts` is false beat nothing.
    ///
    /// # Panics
    /// If there is no column of these names.
    pub fn mark_front(&mut self, price: &str, quality: &str, counts: impl Fn(&Row) -> bool) {
        let place = |name: &str| self.columns.iter().skip(1).position(|c| c.name == name);
        let (Some(price), Some(quality)) = (place(price), place(quality)) else {
            panic!("{}: no column {price} or {quality}", self.title)
        };
        let value = |row: &Row, c: usize| row.cells[c].value().filter(|_| counts(row)).unwrap_or(f64::NAN);
        let points: Vec<_> = self.rows.iter().map(|row| (value(row, price), value(row, quality))).collect();
        let marks = front(&points, self.columns[quality + 1].better);
        self.rows.iter_mut().zip(marks).for_each(|(row, mark)| row.marks[quality] = mark);
    }

    /// For each row, whether its cell is the best of a column (0 is the one after the labels); if
    /// all are alike, or rows are not rivals, none is.
    pub fn best(&self, column: usize) -> Vec<bool> {
        let better = self.columns[column + 1].better;
        let values: Vec<Option<f64>> = self.rows.iter().map(|row| row.cells[column].value()).collect();
        let known = || values.iter().flatten().copied();
        let (least, most) =
            (known().fold(f64::INFINITY, f64::min), known().fold(f64::NEG_INFINITY, f64::max));
        let best = match better {
            Better::Less => least,
            Better::More => most,
            Better::Neither => f64::NAN,
        };
        values.iter().map(|v| self.rivals && least < most && *v == Some(best)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(rivals: bool) -> Table {
        let mut table = Table::new("t", "it", &[("ms", Better::Less), ("rays", Better::More)]);
        table.rivals = rivals;
        for (name, ms, rays) in [("a", 1.0, 1.0), ("b", 2.0, 3.0), ("c", 3.0, 2.0)] {
            table.row(name, [ms.into(), rays.into()]);
        }
        table
    }

    #[test]
    fn the_best_is_by_the_columns_direction_and_among_rivals_only() {
        assert_eq!(table(true).best(0), [true, false, false]);
        assert_eq!(table(true).best(1), [false, true, false]);
        assert_eq!(table(false).best(0), [false; 3]);
    }

    #[test]
    fn marks_are_those_of_the_front() {
        let mut table = table(true);
        table.mark_front("ms", "rays", |row| row.label != "a");
        let marks: Vec<_> = table.rows.iter().map(|r| r.marks.clone()).collect();
        assert_eq!(marks, [[false, false], [false, true], [false, false]]);
    }

    #[test]
    fn labels_are_unlike_each_other() {
        let mut table = table(true);
        (0..2).for_each(|_| table.row("a", [Cell::None, Cell::None]));
        let labels: Vec<_> = table.rows.iter().map(|row| row.label.as_str()).collect();
        assert_eq!(labels, ["a", "b", "c", "a (2)", "a (3)"]);
    }
}
