//! What rays cost, as tables and as a figure, with fitted lines.

use super::{Point, SERIES, SETS, STRUCTURES};
use crate::fit::fit;
use crate::report::{Better, Cell, Curve, Figure, Section, Table, Upward};

/// Everything about the cost of rays; the figure is the section's first.
pub fn section(points: &[Point]) -> Section {
    Section {
        part: "growth",
        title: "Cost of a ray from a thousand to ten million triangles".to_owned(),
        remarks: vec![
            "a ray of one thread: processor time, median (quartiles); nodes; tested triangles".to_owned(),
            "fits of rays: a + b log2 n, and the share of the variance that they explain".to_owned(),
        ],
        tables: vec![table(points), fits(points)],
        figures: vec![figure(points)],
        ..Section::default()
    }
}

fn table(points: &[Point]) -> Table {
    let columns = ["ns", "nodes", "tests"].map(|name| (name, Better::Less));
    let mut table = Table::new("cost of a ray", "structure, rays, triangles", &columns);
    for p in points {
        let cells = [Cell::from(&p.time), p.nodes.into(), p.tests.into()];
        table.row(format!("{}, {}", series(p.series), p.triangles), cells);
    }
    table
}

fn figure(points: &[Point]) -> Figure {
    let time = |p: &Point| (p.triangles as f64, p.time.median());
    let curves: Vec<Curve> = (0..SERIES).map(|s| Curve::new(series(s), curve(points, s, time))).collect();
    let line = |c: &Curve| {
        let f = fit(&c.points.iter().map(|(n, ns)| (n.log2(), *ns)).collect::<Vec<_>>());
        let ends = [c.points.first(), c.points.last()];
        Curve::new("", ends.into_iter().flatten().map(|(n, _)| (*n, (f.a + f.b * n.log2()).max(0.0))))
    };
    let fits = if points.len() > SERIES { curves.iter().map(line).collect() } else { Vec::new() };
    let figure = Figure::new("Cost of a ray on ever finer meshes", "triangles", "ns per ray", curves);
    Figure { upward: Upward::Linear, fits, ..figure }
}

fn series(number: usize) -> String {
    format!("{}, {}", STRUCTURES[number / SETS.len()], SETS[number % SETS.len()])
}

fn curve(points: &[Point], series: usize, of: impl Fn(&Point) -> (f64, f64)) -> Vec<(f64, f64)> {
    points.iter().filter(|p| p.series == series).map(of).collect()
}

fn fits(points: &[Point]) -> Table {
    let names: Vec<String> = ["ns", "nodes", "tests"]
        .iter()
        .flat_map(|what| ["a", "b", "explained"].map(|number| format!("{what}: {number}")))
        .collect();
    let columns: Vec<_> = names.iter().map(|name| (name.as_str(), Better::Neither)).collect();
    let mut table = Table::new("fits", "structure, rays", &columns);
    for s in 0..SERIES {
        let line = |of: fn(&Point) -> f64| {
            let f = fit(&curve(points, s, |p| ((p.triangles as f64).log2(), of(p))));
            [f.a, f.b, f.explained]
        };
        let times = line(|p| p.time.median()).map(Cell::derived);
        let work = [line(|p| p.nodes), line(|p| p.tests)].concat();
        table.row(series(s), times.into_iter().chain(work.into_iter().map(Cell::from)));
    }
    table
}
