//! What was measured, as tables and a figure for people and as JSON lines for programs.

use super::timing::{Build, Question, Rate};
use super::verdict::Verdict;
use crate::report::{Better, Cell, Curve, Figure, Section, Table};
use crate::sample::Sample;
use crate::world::World;
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

/// A structure's name, what building it cost, and its bytes.
pub type Built<'a> = (&'a str, &'a Build, Option<usize>);

/// The section before anything was measured.
pub fn section() -> Section {
    let mut remarks = vec![
        "million rays per second of all threads together, by processor time: median (quartiles)".to_owned(),
        "error: how far t is off, relative to it: median, 99.9 %, worst".to_owned(),
    ];
    if !cfg!(feature = "peers") {
        remarks.push(
            "the crates obvhs, parry3d and bvh are absent: `cargo run --release -p bench --features peers -- rays`"
                .to_owned(),
        );
    }
    let title = "Rays per second of every structure, and what is wrong with its answers".to_owned();
    Section { part: "rays", title, remarks, ..Section::default() }
}

/// What building cost.
pub fn of_builds(world: &World, builds: &[Built]) -> Table {
    let columns = [
        ("build, wall ms", Better::Less),
        ("build, processor ms", Better::Less),
        ("bytes per triangle", Better::Less),
    ];
    let title = format!("{}, {} triangles: building", world.name, world.triangles());
    let mut table = Table::of_rivals(title, "structure", &columns);
    for (name, cost, bytes) in builds {
        let per = bytes.map(|b| b as f64 / world.triangles() as f64);
        table.row(*name, [Cell::from(&cost.wall), Cell::from(&cost.cpu), Cell::from(per)]);
    }
    table
}

/// What asking cost, and what was wrong.
pub fn of_answers(world: &World, set: &str, questions: &[Question], rows: &[Row]) -> Table {
    let names: Vec<String> = questions
        .iter()
        .map(|q| format!("{} x{}, Mrays/s", if q.any { "any" } else { "nearest" }, q.threads))
        .collect();
    let rates = names.iter().map(|name| (name.as_str(), Better::More));
    let wrongs = ["missed", "false", "wrong", "any wrong", "error 50 %", "error 99.9 %", "error 100 %"];
    let columns: Vec<_> = rates
        .chain(wrongs.map(|name| (name, Better::Less)))
        .chain([("rays timed", Better::Neither), ("rays judged", Better::Neither)])
        .collect();
    let mut table = Table::of_rivals(format!("{}: {set} rays", world.name), "structure", &columns);
    for row in rows {
        let v = &row.verdict;
        let wrongs = [v.missed, v.false_hits, v.wrong, v.any_wrong].map(Cell::from);
        let errors = [0.5, 0.999, 1.0].map(|q| Cell::from(v.error.quantile(q)));
        let timed = row.rates.first().map_or(0, |r| r.rays);
        let rates = row.rates.iter().map(|rate| Cell::from(&rate.mrays));
        table
            .row(row.name, rates.chain(wrongs).chain(errors).chain([Cell::from(timed), Cell::from(v.asked)]));
    }
    table
}

/// The house's best structure and its rate for the first set of rays, which has that name.
pub fn headline(
    world: &World,
    set: &str,
    builds: &[Built],
    rates: &[Vec<Vec<Rate>>],
) -> Option<(String, Cell)> {
    let place = builds.iter().position(|(name, ..)| *name == "bvh")?;
    let rate = rates.first()?.get(place)?.first()?;
    Some((format!("bvh, {}, {set} rays, nearest hit, Mrays/s", world.name), Cell::from(&rate.mrays)))
}

/// Build time against rate, with what nothing beats. The rate is the first question's for a mix of
/// all sets with as many rays of each.
pub fn figure(world: &World, builds: &[Built], rates: &[Vec<Vec<Rate>>]) -> Option<Figure> {
    let mixed = |structure: usize| {
        let times = rates.iter().map(|set| 1.0 / set[structure].first().map_or(0.0, |r| r.mrays.median()));
        rates.len() as f64 / times.sum::<f64>()
    };
    let point = |(i, (name, cost, _)): (usize, &Built)| Curve::new(*name, [(cost.cpu.median(), mixed(i))]);
    let curves: Vec<Curve> = builds.iter().enumerate().map(point).collect();
    let title = format!("{}: building against asking", world.name);
    (!rates.is_empty()).then(|| {
        Figure::new(title, "build, processor ms", "Mrays/s, nearest hit, all kinds of rays", curves)
            .with_front(Better::More)
    })
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

    #[test]
    fn the_figure_holds_the_mean_of_all_kinds_of_rays() {
        let world = World::named("sphere100").unwrap();
        let rate = |x: f64| vec![Rate { mrays: [x].into_iter().collect(), rays: 1 }];
        let build = |ms: f64| Build { wall: Sample::default(), cpu: [ms].into_iter().collect() };
        let (slow, quick) = (build(4.0), build(2.0));
        let builds = [("bvh", &slow, None), ("list", &quick, Some(3))];
        let rates = [vec![rate(3.0), rate(1.0)], vec![rate(6.0), rate(1.0)]];
        let figure = figure(&world, &builds, &rates).unwrap();
        assert_eq!(figure.curves[0].points, [(4.0, 4.0)]);
        assert_eq!(figure.front.len(), 2, "one is quick to build, the other to ask");
        assert_eq!(headline(&world, "primary", &builds, &rates).unwrap().1.value(), Some(3.0));
        assert!(super::figure(&world, &builds, &[]).is_none());
    }
}
