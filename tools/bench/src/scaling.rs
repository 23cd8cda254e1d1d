//! How a time grows with the size of the problem: one curve for each way to do it.

use crate::fit::power;
use crate::report::{Better, Cell, Curve, Figure, Section, Table};
use crate::sample::Sample;

/// Milliseconds of processor time, size after size.
pub struct Scaling {
    what: String,
    table: Table,
    curves: Vec<Curve>,
}

impl Scaling {
    /// Before anything was measured: what takes the time, and the ways to do it.
    pub fn new(what: &str, ways: &[&str]) -> Self {
        let triangles = std::iter::once(("triangles", Better::Neither));
        let columns: Vec<_> = triangles.chain(ways.iter().map(|way| (*way, Better::Less))).collect();
        let table = Table::new(format!("{what}: ms of processor time"), "mesh", &columns);
        let curves = ways.iter().map(|way| Curve::new(*way, [])).collect();
        Self { what: what.to_owned(), table, curves }
    }

    /// Adds a mesh: its name and size, and what each of the ways took.
    pub fn add(&mut self, mesh: &str, triangles: usize, times: &[Sample]) {
        self.table.row(mesh, std::iter::once(Cell::from(triangles)).chain(times.iter().map(Cell::from)));
        for (curve, time) in self.curves.iter_mut().zip(times) {
            curve.points.push((triangles as f64, time.median()));
        }
    }

    /// Adds to a section, if there were two sizes or more: the times, the exponents that fit them,
    /// and a figure of both.
    pub fn show(self, section: &mut Section) {
        if self.table.rows.len() < 2 {
            return;
        }
        let columns = [("b", Better::Less), ("explained", Better::Neither)];
        let mut exponents = Table::new(format!("{}: ms = a triangles^b", self.what), "", &columns);
        let mut fits = Vec::new();
        for curve in &self.curves {
            let fit = power(&curve.points);
            exponents.row(&curve.name, [fit.b, fit.explained].map(Cell::derived));
            fits.push(Curve::new("", fit.ends(&curve.points)));
        }
        section.tables.extend([self.table, exponents]);
        let title = format!("{} against triangles", self.what);
        let figure = Figure::new(title, "triangles", "ms of processor time", self.curves);
        section.figures.push(Figure { fits, ..figure });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponents_are_found_and_shown() {
        let mut scaling = Scaling::new("sorting", &["slow", "quick"]);
        let mut section = Section::default();
        for n in [10usize, 100, 1000] {
            let times = [(n * n) as f64, n as f64].map(|ms| [ms].into_iter().collect());
            scaling.add(&format!("mesh{n}"), n, &times);
        }
        scaling.show(&mut section);
        let exponents = section.table("sorting: ms = a triangles^b");
        let found: Vec<f64> = exponents.rows.iter().filter_map(|row| row.cells[0].value()).collect();
        assert!((found[0] - 2.0).abs() < 1e-9 && (found[1] - 1.0).abs() < 1e-9, "{found:?}");
        assert_eq!((section.tables[0].rows.len(), section.figures[0].fits.len()), (3, 2));
        let mut single = Scaling::new("sorting", &["slow"]);
        single.add("mesh1", 1, &[[1.0].into_iter().collect()]);
        let mut empty = Section::default();
        single.show(&mut empty);
        assert!(empty.tables.is_empty() && empty.figures.is_empty());
    }
}
