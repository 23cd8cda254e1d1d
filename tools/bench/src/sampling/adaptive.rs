//! Adaptive sampling against the same pattern with as many samples for all pixels.

use super::Effort;
use super::csv::Csv;
use super::measure::{Outcome, Recipe, truth};
use super::scene::Lit;
use crate::report::{Better, Cell, Curve, Figure, Table};
use crate::sample::Sample;
use crate::statistics::{Mean, price_at};
use a7_sampling::sampler::Pattern;
use common::cli::AppError;

/// The errors asked for.
const ERRORS: [f64; 4] = [0.04, 0.02, 0.01, 0.005];

/// A recipe with what came of it, seed after seed.
type Measured = (Recipe, Vec<Outcome>);

/// The table before anything was measured.
pub fn table() -> Table {
    let columns = [
        ("RMSE", Better::Less),
        ("samples", Better::Less),
        ("processor ms", Better::Less),
        ("time ratio", Better::Less),
        ("sample ratio", Better::Less),
    ];
    Table::new("adaptive against as many samples for all, at equal RMSE", "scene, error asked for", &columns)
}

/// Measures one scene: adds rows to the table, returns the curves.
///
/// # Errors
/// If the clock cannot be read.
pub fn compare(lit: &Lit, effort: &Effort, csv: &mut Csv, table: &mut Table) -> Result<Figure, AppError> {
    let truth = truth(lit, None, effort.truth)?;
    let recipe = |samples, error| Recipe { pattern: Pattern::Sobol, kernel: None, samples, error };
    let uniform = (1..).map(|k| 1u32 << k).take_while(|n| *n <= effort.most);
    let mut uniform: Vec<Measured> = uniform.map(|n| (recipe(n, None), Vec::new())).collect();
    // As many as the converged picture has would be too near to it.
    let mut adaptive = ERRORS.map(|error| (recipe(effort.truth / 4, Some(error)), Vec::new()));
    for seed in 1..=effort.seeds {
        for (recipe, outcomes) in uniform.iter_mut().chain(&mut adaptive) {
            let outcome = recipe.measure(lit, seed, &truth)?;
            csv.add(lit.name(), recipe, "none", seed, outcome);
            outcomes.push(outcome);
        }
    }
    adaptive.iter().for_each(|measured| add_row(table, lit, &uniform, measured));
    let curve = |name: &str, all: &[Measured]| {
        Curve::new(name, all.iter().map(|(_, o)| (mean(o, |o| o.cpu), mean(o, |o| o.rmse))))
    };
    let curves = vec![curve("as many for all", &uniform), curve("adaptive", &adaptive)];
    let title = format!("Adaptive sampling of \"{}\"", lit.name());
    Ok(Figure::new(title, "ms of processor time", "RMSE", curves).with_front(Better::Less))
}

fn mean(outcomes: &[Outcome], of: impl Fn(&Outcome) -> f64) -> f64 {
    outcomes.iter().map(of).sum::<f64>() / outcomes.len() as f64
}

/// For each seed, what adaptive costs over what the same error costs without; seeds whose error
/// nobody has are left out.
fn ratios(uniform: &[Measured], adaptive: &[Outcome], price: impl Fn(&Outcome) -> f64) -> Vec<f64> {
    let ratio = |(seed, own): (usize, &Outcome)| {
        let curve: Vec<_> = uniform.iter().map(|(_, o)| (o[seed].rmse, price(&o[seed]))).collect();
        Some(price(own) / price_at(&curve, own.rmse)?)
    };
    adaptive.iter().enumerate().filter_map(ratio).collect()
}

fn add_row(table: &mut Table, lit: &Lit, uniform: &[Measured], (recipe, outcomes): &Measured) {
    let of = |value: fn(&Outcome) -> f64| Mean::of(&outcomes.iter().map(value).collect::<Vec<_>>()).cell(1.0);
    let ratio = |price: fn(&Outcome) -> f64| ratios(uniform, outcomes, price);
    let cpu: Sample = outcomes.iter().map(|o| o.cpu).collect();
    let samples = ratio(|o| o.mean);
    // The mean of no seed at all would be NaN.
    let samples = if samples.is_empty() { Cell::None } else { Mean::of(&samples).cell(1.0) };
    let cells = [
        of(|o| o.rmse),
        of(|o| o.mean),
        Cell::from(&cpu),
        Cell::derived_from(&ratio(|o| o.cpu).into_iter().collect()),
        samples,
    ];
    table.row(format!("{}, {}", lit.name(), recipe.error.unwrap_or(f64::NAN)), cells);
}
