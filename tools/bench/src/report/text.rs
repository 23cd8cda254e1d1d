//! Sections and tables as text for the terminal.

use super::{Cell, Measured, Section, Table};
use std::fmt;

impl fmt::Display for Section {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        writeln!(f, "{}", self.title)?;
        for remark in &self.remarks {
            writeln!(f, "{remark}")?;
        }
        self.tables.iter().try_for_each(|table| write!(f, "\n{table}"))
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let head: Vec<String> = self.columns.iter().map(|c| c.name.clone()).collect();
        let rows = self.rows.iter().map(|row| {
            std::iter::once(row.label.clone()).chain(row.cells.iter().map(ToString::to_string)).collect()
        });
        let lines: Vec<Vec<String>> = std::iter::once(head).chain(rows).collect();
        let widths: Vec<usize> = (0..self.columns.len())
            .map(|c| lines.iter().map(|line| line[c].chars().count()).max().unwrap_or(0))
            .collect();
        writeln!(f, "{}", self.title)?;
        for line in &lines {
            write!(f, "{:<1$}", line[0], widths[0])?;
            for (cell, width) in line.iter().zip(&widths).skip(1) {
                write!(f, "  {cell:>width$}")?;
            }
            writeln!(f)?;
        }
        Ok(())
    }
}

impl fmt::Display for Cell {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::None => f.write_str("-"),
            Self::Text(text) => f.write_str(text),
            Self::Count(count) => write!(f, "{count}"),
            Self::Exact(value) => f.write_str(&short(*value)),
            Self::Measured(Measured { median, low, high }) => {
                write!(f, "{} ({}-{})", short(*median), short(*low), short(*high))
            }
        }
    }
}

/// Three digits that count, without an exponent where a reader needs none.
pub fn short(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    match value.abs().log10().floor() as i32 {
        digits @ -3..=2 => format!("{value:.*}", (2 - digits) as usize),
        3..=6 => format!("{value:.0}"),
        _ => format!("{value:.2e}"),
    }
}

#[cfg(test)]
mod tests {
    use crate::report::{Better, Cell, Measured, Table};

    #[test]
    fn columns_stand_below_each_other() {
        let mut table = Table::new("things", "name", &[("ms", Better::Less), ("wrong", Better::Less)]);
        let measured = Measured { median: 1.5, low: 1.25, high: 12.0 };
        table.row("a long name", [Cell::Measured(measured), Cell::Count(0)]);
        table.row("it", [Cell::from(f64::NAN), Cell::from("none")]);
        let text = "things\n\
            name                       ms  wrong\n\
            a long name  1.50 (1.25-12.0)      0\n\
            it                          -   none\n";
        assert_eq!(table.to_string(), text);
    }

    #[test]
    fn numbers_keep_three_digits() {
        let shown = [0.0, 0.012345, 1.0, 999.4, 12_345.6, 6.1e-8, -2.5].map(super::short);
        assert_eq!(shown, ["0", "0.0123", "1.00", "999", "12346", "6.10e-8", "-2.50"]);
    }
}
