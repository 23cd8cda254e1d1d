//! What was measured, as a table and a figure for each scene.

use super::measure::{Recipe, Shot};
use crate::report::{Better, Cell, Curve, Figure, Section, Table};
use crate::sample::Sample;
use crate::statistics::Mean;
use common::picture::Size;

const COLUMNS: [(&str, Better); 9] = [
    ("s", Better::Less),
    ("Mpaths/s", Better::More),
    ("rays/path", Better::Neither),
    ("RMSE", Better::Less),
    ("relative RMSE", Better::Less),
    ("RMSE*sqrt(s)", Better::Less),
    ("sqrt(relMSE*s)", Better::Less),
    ("mean off, %", Better::Less),
    ("worst block off, %", Better::Less),
];

/// The column that the headline is about.
const EFFICIENCY: usize = 6;

/// The section before anything was measured.
pub fn section() -> Section {
    Section {
        part: "path",
        title: "Error of path-traced pictures against processor time: integrators, samplers".to_owned(),
        remarks: vec![
            "one thread; s: processor seconds; intervals of 95 % over the seeds, quartiles of Mpaths/s"
                .to_owned(),
            "RMSE*sqrt(s) does not change with the number of paths as long as error falls with its root: less is more efficient"
                .to_owned(),
        ],
        ..Section::default()
    }
}

/// Adds a scene: its table, its figure, and its most efficient way to the headline.
pub fn add(section: &mut Section, name: &str, size: Size, recipes: &[Recipe], shots: &[Vec<Shot>]) {
    let mut table = Table::of_rivals(format!("{name}, {size}"), "integrator, sampler, paths", &COLUMNS);
    for (recipe, shots) in recipes.iter().zip(shots) {
        table.row(label(recipe), cells(recipe, size, shots));
    }
    table.mark_front("s", "relative RMSE", |_| true);
    let price = |row: usize| table.rows[row].cells[EFFICIENCY].value().unwrap_or(f64::NAN);
    let best = (0..table.rows.len()).min_by(|a, b| price(*a).total_cmp(&price(*b)));
    if let (true, Some(row)) = (section.headline.is_empty(), best.map(|b| &table.rows[b])) {
        let what = format!("{name}: efficiency, least sqrt(relMSE*s), by {}", row.label);
        section.headline.push((what, row.cells[EFFICIENCY].clone()));
    }
    section.tables.push(table);
    section.figures.push(figure(name, recipes, shots));
}

fn label(recipe: &Recipe) -> String {
    format!("{:?}, {:?}, {}", recipe.rules.integrator, recipe.pattern, recipe.spp)
}

fn cells(recipe: &Recipe, size: Size, shots: &[Shot]) -> [Cell; 9] {
    let of = |value: fn(&Shot) -> f64| Mean::of(&shots.iter().map(value).collect::<Vec<_>>());
    let paths = size.pixels() as f64 * f64::from(recipe.spp);
    let seconds: Sample = shots.iter().map(|s| s.seconds).collect();
    [
        Cell::from(&seconds),
        Cell::from(&seconds.map(|s| paths / s / 1e6)),
        Cell::from(of(|s| s.rays).value / paths),
        of(|s| s.rmse).cell(1.0),
        of(|s| s.relative.sqrt()).cell(1.0),
        of(|s| s.rmse * s.seconds.sqrt()).derived(),
        of(|s| (s.relative * s.seconds).sqrt()).derived(),
        of(|s| s.mean_off).cell(100.0),
        of(|s| s.block_off).cell(100.0),
    ]
}

/// Relative error against time: a curve for each integrator with each sampler.
fn figure(name: &str, recipes: &[Recipe], shots: &[Vec<Shot>]) -> Figure {
    let mut curves: Vec<Curve> = Vec::new();
    for (recipe, shots) in recipes.iter().zip(shots) {
        let name = format!("{:?}, {:?}", recipe.rules.integrator, recipe.pattern);
        let seconds: Sample = shots.iter().map(|s| s.seconds).collect();
        let errors: Vec<f64> = shots.iter().map(|s| s.relative.sqrt()).collect();
        let point = (seconds.median(), Mean::of(&errors).value);
        match curves.last_mut() {
            Some(curve) if curve.name == name => curve.points.push(point),
            _ => curves.push(Curve::new(name, [point])),
        }
    }
    let title = format!("{name}: error against time");
    Figure::new(title, "s of processor time", "relative RMSE", curves).with_front(Better::Less)
}

#[cfg(test)]
mod tests {
    use super::*;
    use a7_sampling::Pattern;
    use a8_path_tracing::{Integrator, Rules};

    #[test]
    fn a_scene_has_a_table_a_curve_for_each_way_and_the_best_in_the_headline() {
        let recipe = |integrator, spp| Recipe {
            rules: Rules { integrator, ..Rules::default() },
            pattern: Pattern::Sobol,
            spp,
        };
        let recipes = [
            recipe(Integrator::Naive, 4),
            recipe(Integrator::Naive, 16),
            recipe(Integrator::Mis, 4),
            recipe(Integrator::Mis, 16),
        ];
        let shot = |seconds: f64, relative: f64| {
            let rmse = relative.sqrt();
            vec![Shot { seconds, rays: 640.0, rmse, relative, mean_off: 0.0, block_off: 0.0 }; 2]
        };
        let shots = [shot(1.0, 4.0), shot(4.0, 1.0), shot(2.0, 0.04), shot(8.0, 0.02)];
        let mut section = section();
        add(&mut section, "box", Size::new(4, 4).unwrap(), &recipes, &shots);
        assert_eq!(section.tables[0].rows[1].cells[2].value(), Some(2.5));
        let marked: Vec<bool> = section.tables[0].rows.iter().map(|row| row.marks[4]).collect();
        assert_eq!(marked, [true, false, true, true]);
        let figure = &section.figures[0];
        assert_eq!(figure.curves.iter().map(|c| c.points.len()).collect::<Vec<_>>(), [2, 2]);
        assert_eq!(figure.front.len(), 3, "the second is dearer and worse than the third");
        assert!(section.headline[0].0.contains("Mis, Sobol, 4"), "{:?}", section.headline);
    }
}
