//! What was measured, as tables for people and as JSON lines for programs.

use super::timing::{Build, Question, Rate};
use super::verdict::Verdict;
use crate::sample::Sample;
use crate::world::World;
use common::cli::say;
use std::fmt::Write;

/// One structure's figures for one set.
pub struct Row<'a> {
    /// The structure.
    pub name: &'a str,
    /// In the order of the questions.
    pub rates: &'a [Rate],
    /// What was wrong.
    pub verdict: Verdict,
}

/// Prints what building cost.
pub fn print_builds(world: &World, builds: &[(&str, &Build, Option<usize>)]) {
    say(&format!("\n{}: {} triangles", world.name, world.triangles()));
    say(&format!(
        "{:<12} {:>25} {:>25} {:>10}",
        "build", "wall ms (quartiles)", "CPU ms (quartiles)", "bytes/tri"
    ));
    for (name, cost, bytes) in builds {
        let per = bytes.map_or("-".to_owned(), |b| format!("{:.1}", b as f64 / world.triangles() as f64));
        say(&format!("{name:<12} {:>25} {:>25} {per:>10}", spread(&cost.wall), spread(&cost.cpu)));
    }
}

/// The median with its quartiles; small ones with more decimals.
fn spread(s: &Sample) -> String {
    let (median, low, high) = (s.median(), s.quantile(0.25), s.quantile(0.75));
    let decimals = if median < 0.2 { 4 } else { 2 };
    format!("{median:.decimals$} ({low:.decimals$}-{high:.decimals$})")
}

/// Prints what asking cost, and what was wrong.
pub fn print_rows(set: &str, questions: &[Question], rows: &[Row]) {
    let mut head = format!("{set:<12}");
    for q in questions {
        let what = format!("{} x{}", if q.any { "any" } else { "nearest" }, q.threads);
        let _ = write!(head, " {what:>22}");
    }
    say(&format!("{head} {:>7} {:>7} {:>7} {:>7}   relative error of t", "missed", "false", "wrong", "any"));
    let all = rows.iter().map(|row| row.verdict.asked).max().unwrap_or(0);
    for row in rows {
        let mut line = format!("{:<12}", row.name);
        for rate in row.rates {
            let _ = write!(line, " {:>22}", spread(&rate.mrays));
        }
        let v = &row.verdict;
        let [half, most, worst] = [0.5, 0.999, 1.0].map(|q| v.error.quantile(q));
        let _ = write!(line, " {:>7} {:>7} {:>7} {:>7}", v.missed, v.false_hits, v.wrong, v.any_wrong);
        let _ = write!(line, "   {half:.1e} {most:.1e} {worst:.1e}");
        say(&(line + &remark(row, all)));
    }
}

/// What must be known to read a row: that it is an estimate from a part of the rays.
fn remark(row: &Row, all: usize) -> String {
    let (timed, judged) = (row.rates.first().map_or(0, |r| r.rays), row.verdict.asked);
    if judged == all { String::new() } else { format!("   (estimated from {timed} rays, {judged} judged)") }
}

/// One JSON object: what building cost.
pub fn build_json(world: &World, name: &str, cost: &Build, bytes: Option<usize>) -> String {
    let bytes = bytes.map_or("null".to_owned(), |b| b.to_string());
    format!(
        "{{\"mesh\":{:?},\"triangles\":{},\"structure\":{name:?},\"build_wall_ms\":{},\"build_cpu_ms\":{},\"bytes\":{bytes}}}",
        world.name,
        world.triangles(),
        quartiles(&cost.wall),
        quartiles(&cost.cpu)
    )
}

/// One JSON object: what asking cost, and what was wrong.
pub fn row_json(world: &World, set: &str, questions: &[Question], row: &Row) -> String {
    let mut text = format!("{{\"mesh\":{:?},\"set\":{set:?},\"structure\":{:?}", world.name, row.name);
    for (q, rate) in questions.iter().zip(row.rates) {
        let what = if q.any { "any" } else { "nearest" };
        let _ = write!(text, ",\"{what}_x{}_mrays\":{}", q.threads, quartiles(&rate.mrays));
    }
    let timed = row.rates.first().map_or(0, |r| r.rays);
    let v = &row.verdict;
    let _ = write!(text, ",\"timed\":{timed},\"judged\":{},\"missed\":{}", v.asked, v.missed);
    let _ = write!(text, ",\"false\":{},\"wrong\":{},\"any_wrong\":{}", v.false_hits, v.wrong, v.any_wrong);
    let [half, most, worst] = [0.5, 0.999, 1.0].map(|q| number(v.error.quantile(q)));
    let _ = write!(text, ",\"error\":[{half},{most},{worst}]}}");
    text
}

/// First quartile, median, third quartile.
fn quartiles(s: &Sample) -> String {
    let [a, b, c] = [0.25, 0.5, 0.75].map(|q| number(s.quantile(q)));
    format!("[{a},{b},{c}]")
}

/// JSON has no NaN.
fn number(x: f64) -> String {
    if x.is_finite() { format!("{x:e}") } else { "null".to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn json_is_well_formed_also_without_figures() {
        let world = World::named("sphere100").unwrap();
        let questions = [Question { any: false, threads: 1 }, Question { any: true, threads: 2 }];
        let mut rates = vec![Rate::default(), Rate::default()];
        rates[0].mrays.add(2.5);
        let row = Row { name: "bvh", rates: &rates, verdict: Verdict::default() };
        let text = row_json(&world, "random", &questions, &row);
        assert!(
            text.starts_with("{\"mesh\":\"sphere100\",\"set\":\"random\",\"structure\":\"bvh\""),
            "{text}"
        );
        assert!(text.contains("\"nearest_x1_mrays\":[2.5e0,2.5e0,2.5e0]"), "{text}");
        assert!(
            text.contains("\"any_x2_mrays\":[null,null,null]") && text.ends_with("[null,null,null]}"),
            "{text}"
        );
        let text = build_json(&world, "list", &Build::default(), None);
        assert!(text.ends_with("\"bytes\":null}"), "{text}");
        assert_eq!(text.matches('{').count(), text.matches('}').count());
    }
}
