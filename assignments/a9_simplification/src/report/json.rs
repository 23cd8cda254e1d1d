//! The report as JSON.

use super::{Before, Level, Report, counts, method};
use crate::goal::{Goal, Irregular, Stopped};
use crate::measure::{Comparison, OneWay, Quality, Topology};
use std::fmt::Write;

/// An object, member by member.
#[derive(Default)]
struct Object(String);

impl Object {
    /// Adds a member whose value is JSON already.
    fn with(mut self, name: &str, value: impl std::fmt::Display) -> Self {
        let comma = if self.0.is_empty() { "" } else { "," };
        let _ = write!(self.0, "{comma}{}:{value}", text(name));
        self
    }

    /// Adds a number.
    fn number(self, name: &str, value: f64) -> Self {
        self.with(name, number(value))
    }

    fn end(self) -> String {
        format!("{{{}}}", self.0)
    }
}

impl Report {
    /// One object; distances are shares of the diagonal, times are seconds.
    pub fn json(&self) -> String {
        let mut times = Object::default();
        for (name, time) in &self.times {
            times = times.number(name, time.as_secs_f64());
        }
        let levels: Vec<String> = self.levels.iter().map(|level| self.level(level)).collect();
        Object::default()
            .with("input", text(&self.input))
            .with("method", text(method(self.method)))
            .with("seconds", times.end())
            .with("original", self.original.as_ref().map_or("null".to_owned(), before))
            .with("levels", format!("[{}]", levels.join(",")))
            .end()
    }

    fn level(&self, level: &Level) -> String {
        let diagonal = self.original.map_or(f64::NAN, |before| before.diagonal);
        let broken: Vec<String> = self.broken(level).iter().map(|what| text(what)).collect();
        let goal = level.goal.map_or("null".to_owned(), goal);
        let object = Object::default()
            .with("goal", goal)
            .with("faces", level.faces)
            .with("stopped", text(if level.stopped == Stopped::Stuck { "stuck" } else { "reached" }))
            .with("why", text(&level.why()))
            .number("error_bound", level.bound / diagonal)
            .with("irregular", irregular(&level.irregular));
        let object = match &level.comparison {
            Some(comparison) => measured(object, comparison),
            None => object,
        };
        object.with("broken", format!("[{}]", broken.join(","))).end()
    }
}

fn irregular(found: &Irregular) -> String {
    let Irregular { collapsed, repeated, held } = found;
    Object::default().with("collapsed", collapsed).with("repeated", repeated).with("held", held).end()
}

fn goal(goal: Goal) -> String {
    let (name, value) = match goal {
        Goal::Faces(n) => ("faces", n as f64),
        Goal::Ratio(r) => ("ratio", r),
        Goal::Error(e) => ("error", e),
    };
    Object::default().number(name, value).end()
}

fn before(before: &Before) -> String {
    Object::default()
        .number("diagonal", before.diagonal)
        .with("samples", before.samples)
        .with("topology", topology(&before.topology))
        .with("quality", quality(&before.quality))
        .end()
}

fn measured(object: Object, comparison: &Comparison) -> Object {
    let Comparison { distance, flips, .. } = comparison;
    object
        .number("rms", distance.rms())
        .number("hausdorff", distance.hausdorff())
        .with("forward", one_way(&distance.forward))
        .with("backward", one_way(&distance.backward))
        .with("boundary", comparison.boundary.as_ref().map_or("null".to_owned(), one_way))
        .with("flipped_faces", flips.faces)
        .with("turned_faces", flips.turned)
        .number("flipped_area", flips.area)
        .with("topology", topology(&comparison.topology))
        .with("quality", quality(&comparison.quality))
}

fn one_way(way: &OneWay) -> String {
    Object::default().number("rms", way.rms).number("mean", way.mean).number("max", way.max).end()
}

fn topology(topology: &Topology) -> String {
    counts(topology).into_iter().fold(Object::default(), |object, (name, n)| object.with(name, n)).end()
}

fn quality(quality: &Quality) -> String {
    Object::default()
        .number("min", quality.min)
        .number("percentile", quality.percentile)
        .number("mean", quality.mean)
        .with("histogram", format!("{:?}", quality.histogram))
        .end()
}

/// JSON has neither NaN nor infinity.
fn number(x: f64) -> String {
    if x.is_finite() { format!("{x:?}") } else { "null".to_owned() }
}

/// A string in quotes.
fn text(s: &str) -> String {
    let mut quoted = String::from("\"");
    for c in s.chars() {
        match c {
            '"' | '\\' => quoted.extend(['\\', c]),
            c if u32::from(c) < 0x20 => quoted.push_str(&format!("\\u{:04x}", u32::from(c))),
            c => quoted.push(c),
        }
    }
    quoted.push('"');
    quoted
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a9t7_strings_and_numbers_are_json() {
        assert_eq!(text("a \"b\" \\ \n é"), "\"a \\\"b\\\" \\\\ \\u000a é\"");
        assert_eq!([0.1, 1e-9, 1e300].map(number), ["0.1", "1e-9", "1e300"]);
        assert_eq!([f64::NAN, f64::INFINITY].map(number), ["null", "null"]);
    }
}
