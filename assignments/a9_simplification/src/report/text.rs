//! The report as text: one column for the original, one for each level.

use super::{Report, counts, method};
use crate::goal::Irregular;
use crate::measure::{BINS, Comparison, Quality, Topology};
use std::fmt::{Display, Formatter, Result};

/// Columns that names take.
const NAMES: usize = 26;
/// Columns that a figure takes.
const FIGURES: usize = 14;

impl Display for Report {
    fn fmt(&self, f: &mut Formatter) -> Result {
        writeln!(f, "{}, method {}", self.input, method(self.method))?;
        if let Some(before) = &self.original {
            let samples = before.samples;
            writeln!(f, "distances are shares of the diagonal {:.6e}, at {samples} points", before.diagonal)?;
            writeln!(f, "of either surface, all vertices and the middles of all edges")?;
            self.table(f)?;
        }
        let first = self.levels.first().and_then(|level| irregular(&level.irregular));
        first.into_iter().try_for_each(|text| writeln!(f, "{text}"))?;
        for level in &self.levels {
            writeln!(f, "{}", level.summary())?;
            let broken = self.broken(level);
            broken.iter().try_for_each(|what| writeln!(f, "  broken: {what}"))?;
            level.notes.iter().try_for_each(|note| writeln!(f, "  {note}"))?;
        }
        let times = self.times.iter().map(|(name, time)| format!("{name} {:.3} s", time.as_secs_f64()));
        write!(f, "time: {}", times.collect::<Vec<_>>().join(", "))
    }
}

impl Report {
    fn table(&self, f: &mut Formatter) -> Result {
        let Some(before) = &self.original else { return Ok(()) };
        let after: Vec<&Comparison> = self.levels.iter().filter_map(|l| l.comparison.as_ref()).collect();
        row(f, "", ["before".to_owned()].into_iter().chain(self.levels.iter().map(|l| l.heading())))?;
        let topologies = || [&before.topology].into_iter().chain(after.iter().map(|c| &c.topology));
        for k in 0..counts(&Topology::default()).len() {
            let name = counts(&Topology::default())[k].0.replace('_', " ");
            row(f, &name, topologies().map(|t| counts(t)[k].1.to_string()))?;
        }
        let measured = |name: &str, f: &mut Formatter, value: &dyn Fn(&Comparison) -> String| {
            row(f, name, ["-".to_owned()].into_iter().chain(after.iter().map(|c| value(c))))
        };
        measured("faces against the nearest", f, &|c| c.flips.faces.to_string())?;
        measured("faces turned over", f, &|c| c.flips.turned.to_string())?;
        let bounds = self.levels.iter().map(|level| short(level.bound / before.diagonal));
        row(f, "error vouched for", ["-".to_owned()].into_iter().chain(bounds))?;
        measured("rms", f, &|c| short(c.distance.rms()))?;
        measured("rms, before to after", f, &|c| short(c.distance.forward.rms))?;
        measured("rms, after to before", f, &|c| short(c.distance.backward.rms))?;
        measured("hausdorff", f, &|c| short(c.distance.hausdorff()))?;
        measured("largest, before to after", f, &|c| short(c.distance.forward.max))?;
        measured("largest, after to before", f, &|c| short(c.distance.backward.max))?;
        if after.iter().any(|c| c.boundary.is_some()) {
            measured("rms of the boundary", f, &|c| short(c.boundary.map_or(f64::NAN, |b| b.rms)))?;
            measured("largest of the boundary", f, &|c| short(c.boundary.map_or(f64::NAN, |b| b.max)))?;
        }
        let qualities: Vec<&Quality> =
            [&before.quality].into_iter().chain(after.iter().map(|c| &c.quality)).collect();
        shapes(f, &qualities)
    }
}

impl super::Level {
    fn heading(&self) -> String {
        self.goal.map_or("given".to_owned(), |_| format!("{} faces", self.faces))
    }
}

/// What is no part of a surface in a mesh, and what was done with it; `None` if nothing is.
pub(super) fn irregular(found: &Irregular) -> Option<String> {
    let Irregular { collapsed, repeated, held } = *found;
    let parts = [
        (collapsed, "triangles with two corners at one place, left out"),
        (repeated, "triangles that are there twice, left out"),
        (held, "points where this is no surface, held in place"),
    ];
    let parts = parts.into_iter().filter(|(count, _)| *count > 0);
    let texts: Vec<String> = parts.map(|(count, what)| format!("{count} {what}")).collect();
    (!texts.is_empty()).then(|| texts.join("; "))
}

fn shapes(f: &mut Formatter, all: &[&Quality]) -> Result {
    row(f, "shape, worst", all.iter().map(|q| format!("{:.4}", q.min)))?;
    row(f, "shape, 1st percentile", all.iter().map(|q| format!("{:.4}", q.percentile)))?;
    row(f, "shape, mean", all.iter().map(|q| format!("{:.4}", q.mean)))?;
    for bin in 0..BINS {
        let name = format!("shape {:.1} to {:.1}", bin as f64 / 10.0, (bin + 1) as f64 / 10.0);
        row(f, &name, all.iter().map(|q| q.histogram[bin].to_string()))?;
    }
    Ok(())
}

fn row(f: &mut Formatter, name: &str, values: impl Iterator<Item = String>) -> Result {
    write!(f, "  {name:<NAMES$}")?;
    for value in values {
        write!(f, " {value:>FIGURES$}")?;
    }
    writeln!(f)
}

/// A distance in four digits; `-` for none.
fn short(x: f64) -> String {
    if x.is_nan() { "-".to_owned() } else { format!("{x:.3e}") }
}
