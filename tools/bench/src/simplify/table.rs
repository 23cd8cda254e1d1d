//! What was measured, as tables for people and rows for programs.

use super::Row;
use crate::report::{Better, Cell, Curve, Figure, Table, front};
use a9_simplification::measure::Comparison;

/// Distances are shown in this share of the diagonal.
const UNIT: f64 = 1e4;
/// The method of the headline, which is what `a9_simplification` does unless told otherwise.
const DEFAULT: &str = "memoryless";
/// The share of the triangles that the headline is about.
const WANTED: f64 = 0.1;

/// Names of the columns of [`csv`].
pub const CSV_HEAD: &str = "mesh,triangles,ratio,method,faces,cpu_ms,cpu_ms_low,cpu_ms_high,rms,rms_forward,\
    rms_backward,hausdorff,hausdorff_forward,hausdorff_backward,bound,quality_min,quality_mean,flipped,turned,\
    pareto_rms,pareto_hausdorff,faults";

/// The rows of one ratio; marks stand where nothing whole beats a result in both time and distance.
pub fn of_ratio(mesh: &str, triangles: usize, ratio: f64, rows: &[Row]) -> Table {
    let columns = [
        ("faces", Better::Neither),
        ("processor ms", Better::Less),
        ("rms", Better::Less),
        ("hausdorff", Better::Less),
        ("vouched", Better::Less),
        ("shape", Better::More),
        ("against", Better::Less),
        ("faults", Better::Neither),
    ];
    let title = format!("{mesh}, {triangles} triangles, ratio {ratio}");
    let mut table = Table::of_rivals(title, "method", &columns);
    for row in rows {
        let d = &row.comparison.distance;
        let cells = [
            Cell::from(row.faces),
            Cell::from(&row.cpu),
            Cell::from(d.rms() * UNIT),
            Cell::from(d.hausdorff() * UNIT),
            Cell::from(row.bound.map(|bound| bound * UNIT)),
            Cell::from(row.comparison.quality.mean),
            Cell::from(row.comparison.flips.faces),
            Cell::from(row.faults.join("; ")),
        ];
        table.row(row.name, cells);
    }
    let whole = |name: &str| rows.iter().any(|row| row.name == name && row.faults.is_empty());
    for quality in ["rms", "hausdorff"] {
        table.mark_front("processor ms", quality, |row| whole(&row.label));
    }
    table
}

/// Time and distance of the default method at the ratio that is nearest to a tenth.
pub fn headline(mesh: &str, ratios: &[f64], rows: &[Vec<Row>]) -> Vec<(String, Cell)> {
    let far = |ratio: &f64| (ratio / WANTED).ln().abs();
    let nearest = ratios.iter().zip(rows).min_by(|a, b| far(a.0).total_cmp(&far(b.0)));
    let Some((ratio, row)) =
        nearest.and_then(|(ratio, rows)| Some((ratio, rows.iter().find(|row| row.name == DEFAULT)?)))
    else {
        return Vec::new();
    };
    let what = |figure: &str| format!("{mesh} to {ratio}, {}, {figure}", row.name);
    vec![
        (what("processor ms"), Cell::from(&row.cpu)),
        (what("RMS distance, 1/10,000 of the diagonal"), Cell::from(rms(row) * UNIT)),
    ]
}

/// Distance against time: a curve for each method, a point for each ratio, and rings around what
/// nothing whole beats among the results of one ratio.
pub fn figure(mesh: &str, ratios: &[Vec<Row>]) -> Figure {
    let point = |row: &Row| (row.cpu.median(), rms(row) * UNIT);
    let names = ratios.first().into_iter().flatten().map(|row| row.name);
    let curve = |name: &'static str| {
        let of_name = move |row: &&Row| row.name == name;
        Curve::new(name, ratios.iter().flatten().filter(of_name).map(point))
    };
    let curves = names.map(curve).collect();
    let front = ratios
        .iter()
        .flat_map(|rows| rows.iter().filter(|row| is_on_front(row, rows, rms)).map(point))
        .collect();
    let title = format!("{mesh}: distance against time, a point for each ratio");
    let up = "RMS distance, 1/10,000 of the diagonal";
    Figure { front, ..Figure::new(title, "ms of processor time", up, curves) }
}

/// A line for each row.
pub fn csv<'a>(
    mesh: &'a str,
    triangles: usize,
    ratio: f64,
    rows: &'a [Row],
) -> impl Iterator<Item = String> + 'a {
    rows.iter().map(move |row| {
        let Comparison { distance: d, quality, flips, .. } = &row.comparison;
        let [median, low, high] = [0.5, 0.25, 0.75].map(|q| row.cpu.quantile(q));
        let numbers = [
            d.rms(),
            d.forward.rms,
            d.backward.rms,
            d.hausdorff(),
            d.forward.max,
            d.backward.max,
            row.bound.unwrap_or(f64::NAN),
            quality.min,
            quality.mean,
        ];
        let numbers = numbers.map(|x| format!("{x:e}")).join(",");
        let fronts = [is_on_front(row, rows, rms), is_on_front(row, rows, hausdorff)].map(u8::from);
        format!(
            "{mesh},{triangles},{ratio},{},{},{median:.3},{low:.3},{high:.3},{numbers},{},{},{},{},{}",
            row.name,
            row.faces,
            flips.faces,
            flips.turned,
            fronts[0],
            fronts[1],
            row.faults.join("; ").replace(',', " ")
        )
    })
}

fn rms(row: &Row) -> f64 {
    row.comparison.distance.rms()
}

fn hausdorff(row: &Row) -> f64 {
    row.comparison.distance.hausdorff()
}

/// Whether no other result is as quick and as near, and better in one of them. What is not whole
/// beats nothing.
fn is_on_front(row: &Row, rows: &[Row], distance: fn(&Row) -> f64) -> bool {
    let point = |r: &Row| if r.faults.is_empty() { (r.cpu.median(), distance(r)) } else { (f64::NAN, 0.0) };
    let marks = front(&rows.iter().map(point).collect::<Vec<_>>(), Better::Less);
    rows.iter().zip(marks).any(|(other, mark)| other.name == row.name && mark)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample::Sample;

    fn row(name: &'static str, time: f64, rms: f64, faults: &[&str]) -> Row {
        let mut cpu = Sample::default();
        cpu.add(time);
        let mut comparison = Comparison::default();
        comparison.distance.forward.rms = rms;
        let faults = faults.iter().map(|f| (*f).to_owned()).collect();
        Row { name, faces: 1, cpu, comparison, bound: None, faults }
    }

    #[test]
    fn the_front_is_what_nothing_whole_beats() {
        let rows = [
            row("a", 1.0, 3.0, &[]),
            row("b", 2.0, 2.0, &[]),
            row("c", 2.5, 2.0, &[]),
            row("d", 0.5, 0.5, &["broken"]),
            row("e", 9.0, 1.0, &[]),
        ];
        let front: Vec<bool> = rows.iter().map(|r| is_on_front(r, &rows, rms)).collect();
        assert_eq!(front, [true, true, false, false, true]);
        let table = of_ratio("mesh", 7, 0.1, &rows);
        assert!(table.rows.iter().zip(front).all(|(row, mark)| row.marks[2] == mark));
        let figure = figure("mesh", &[rows.into()]);
        assert_eq!((figure.curves.len(), figure.front.len()), (5, 3));
    }

    #[test]
    fn rows_have_as_many_columns_as_the_head() {
        let rows = [row("it", 1.0, 2.0, &["two, faults", "here"])];
        let line = csv("m", 7, 0.1, &rows).next().unwrap();
        assert_eq!(line.split(',').count(), CSV_HEAD.split(',').count(), "{line}");
    }
}
