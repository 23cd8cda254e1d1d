//! What was measured, as tables for people and rows for programs.

use super::Row;
use a9_simplification::measure::Comparison;
use common::cli::say;

/// Names of the columns of [`csv`].
pub const CSV_HEAD: &str = "mesh,triangles,ratio,method,faces,cpu_ms,cpu_ms_low,cpu_ms_high,rms,rms_forward,\
    rms_backward,hausdorff,hausdorff_forward,hausdorff_backward,bound,quality_min,quality_mean,flipped,turned,\
    pareto_rms,pareto_hausdorff,faults";

/// Prints the rows of one ratio; a star marks what nothing beats in both time and distance, and
/// `against` are faces that look against the nearest of the original, turned over or not.
pub fn print(ratio: f64, rows: &[Row]) {
    say(&format!(
        "{:<16} {:>8} {:>26} {:>10} {:>10} {:>10} {:>7} {:>7}",
        format!("ratio {ratio}"),
        "faces",
        "CPU ms",
        "rms",
        "hausdorff",
        "vouched",
        "shape",
        "against"
    ));
    for row in rows {
        let d = &row.comparison.distance;
        let mark = |yes: bool| if yes { "*" } else { " " };
        let bound = row.bound.map_or("-".to_owned(), |bound| format!("{:.2}", bound * 1e4));
        let times = [0.5, 0.25, 0.75].map(|q| row.cpu.quantile(q));
        say(&format!(
            "{:<16} {:>8} {:>26} {:>9.3}{} {:>9.2}{} {bound:>10} {:>7.3} {:>7} {}",
            row.name,
            row.faces,
            format!("{:.2} ({:.2}-{:.2})", times[0], times[1], times[2]),
            d.rms() * 1e4,
            mark(is_on_front(row, rows, rms)),
            d.hausdorff() * 1e4,
            mark(is_on_front(row, rows, hausdorff)),
            row.comparison.quality.mean,
            row.comparison.flips.faces,
            row.faults.join("; ")
        ));
    }
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
    let beats = |other: &Row| {
        let (quicker, nearer) = (other.cpu.median() - row.cpu.median(), distance(other) - distance(row));
        quicker <= 0.0 && nearer <= 0.0 && (quicker < 0.0 || nearer < 0.0)
    };
    row.faults.is_empty() && !rows.iter().any(|other| other.faults.is_empty() && beats(other))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample::Sample;

    fn row(time: f64, rms: f64, faults: &[&str]) -> Row {
        let mut cpu = Sample::default();
        cpu.add(time);
        let mut comparison = Comparison::default();
        comparison.distance.forward.rms = rms;
        let faults = faults.iter().map(|f| (*f).to_owned()).collect();
        Row { name: "it", faces: 1, cpu, comparison, bound: None, faults }
    }

    #[test]
    fn the_front_is_what_nothing_whole_beats() {
        let rows = [
            row(1.0, 3.0, &[]),
            row(2.0, 2.0, &[]),
            row(2.5, 2.0, &[]),
            row(0.5, 0.5, &["broken"]),
            row(9.0, 1.0, &[]),
        ];
        let front: Vec<bool> = rows.iter().map(|r| is_on_front(r, &rows, rms)).collect();
        assert_eq!(front, [true, true, false, false, true]);
    }

    #[test]
    fn rows_have_as_many_columns_as_the_head() {
        let rows = [row(1.0, 2.0, &["two, faults", "here"])];
        let line = csv("m", 7, 0.1, &rows).next().unwrap();
        assert_eq!(line.split(',').count(), CSV_HEAD.split(',').count(), "{line}");
    }
}
