//! Sections and tables as text for the terminal.

use super::{Cell, Measured, Row, Section, Table};
use std::fmt::{self, Write};

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
        let rows = self.rows.iter().map(|row| words(self, row));
        let lines: Vec<Vec<String>> = std::iter::once(head).chain(rows).collect();
        let widths: Vec<usize> = (0..self.columns.len())
            .map(|c| lines.iter().map(|line| line[c].chars().count()).max().unwrap_or(0))
            .collect();
        writeln!(f, "{}", self.title)?;
        for line in &lines {
            let mut text = format!("{:<1$}", line[0], widths[0]);
            for (cell, width) in line.iter().zip(&widths).skip(1) {
                let _ = write!(text, "  {cell:>width$}");
            }
            writeln!(f, "{}", text.trim_end())?;
        }
        Ok(())
    }
}

/// A row's label and cells; in a column with marks, each has one or the room for it.
fn words(table: &Table, row: &Row) -> Vec<String> {
    let marked = |c: usize| table.rows.iter().any(|row| row.marks[c]);
    let mark = |c: usize| if row.marks[c] { "*" } else { " " };
    let cell = |(c, cell): (usize, &Cell)| format!("{cell}{}", if marked(c) { mark(c) } else { "" });
    std::iter::once(row.label.clone()).chain(row.cells.iter().enumerate().map(cell)).collect()
}

impl fmt::Display for Cell {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::None => f.write_str("-"),
            Self::Text(text) => f.write_str(text),
            Self::Count(count) => write!(f, "{count}"),
            Self::Exact(value) => f.write_str(&short(*value)),
            _ => {
                let (middle, around) = self.parts();
                write!(f, "{middle}{}{around}", if around.is_empty() { "" } else { " " })
            }
        }
    }
}

impl Cell {
    /// The middle and what stands beside it: quartiles, or half the width of an interval.
    pub fn parts(&self) -> (String, String) {
        match self {
            Self::Measured(m) | Self::Derived(m) if m.low == m.high => (short(m.median), String::new()),
            Self::Measured(Measured { median, low, high })
            | Self::Derived(Measured { median, low, high }) => {
                (short(*median), format!("({}-{})", short(*low), short(*high)))
            }
            Self::Estimate(m) => (short(m.median), format!("± {}", short((m.high - m.low) / 2.0))),
            plain => (plain.to_string(), String::new()),
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
        table.row("rate", [Cell::estimate(2.0, 0.5), Cell::derived(0.25)]);
        table.mark_front("wrong", "ms", |_| true);
        let text = "things\n\
            name                        ms  wrong\n\
            a long name  1.50 (1.25-12.0)*      0\n\
            it                          -    none\n\
            rate             2.00 ± 0.500   0.250\n";
        assert_eq!(table.to_string().replace(" \n", "\n"), text);
    }

    #[test]
    fn numbers_keep_three_digits() {
        let shown = [0.0, 0.012345, 1.0, 999.4, 12_345.6, 6.1e-8, -2.5].map(super::short);
        assert_eq!(shown, ["0", "0.0123", "1.00", "999", "12346", "6.10e-8", "-2.50"]);
    }
}
