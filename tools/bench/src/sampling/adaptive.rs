//! Adaptive sampling against the same pattern with as many samples for all pixels.

use super::Effort;
use super::csv::Csv;
use super::measure::{Outcome, Recipe, truth};
use super::scene::Lit;
use super::statistics::{Mean, price_at};
use crate::growth::plot::{self, Curve, Upward};
use a7_sampling::sampler::Pattern;
use common::cli::{AppError, say};
use std::path::PathBuf;

/// The errors asked for.
const ERRORS: [f64; 4] = [0.04, 0.02, 0.01, 0.005];

/// A recipe with what came of it, seed after seed.
type Measured = (Recipe, Vec<Outcome>);

/// The table's head.
pub fn print_head() {
    say(
        "\nadaptive against as many samples for all (Sobol, no filter), at equal RMSE: mean over the seeds with 95 % interval",
    );
    say(&format!(
        "{:<30} {:>7} {:>9} {:>8} {:>9} {:>17} {:>17}",
        "", "asked", "RMSE", "samples", "CPU ms", "time ratio", "sample ratio"
    ));
}

/// Measures one scene and prints its lines.
///
/// # Errors
/// If the clock cannot be read, or a file cannot be written.
pub fn compare(lit: &Lit, effort: &Effort, csv: &mut Csv, svg: Option<&PathBuf>) -> Result<(), AppError> {
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
    adaptive.iter().for_each(|measured| print_line(lit, &uniform, measured));
    let Some(file) = svg else { return Ok(()) };
    let curve = |name: &str, all: &[Measured]| {
        let points = all.iter().map(|(_, o)| (mean(o, |o| o.cpu), mean(o, |o| o.rmse))).collect();
        Curve { name: name.to_owned(), points }
    };
    let curves = [curve("as many for all", &uniform), curve("adaptive", &adaptive)];
    let title = format!("Error of pictures of \"{}\"", lit.name());
    plot::draw(file, [&title, "ms of processor time", "RMSE"], Upward::Logarithmic, &curves)
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

fn print_line(lit: &Lit, uniform: &[Measured], (recipe, outcomes): &Measured) {
    let ratio = |price: fn(&Outcome) -> f64| {
        let ratios = ratios(uniform, outcomes, price);
        if ratios.is_empty() {
            return "out of range".to_owned();
        }
        let mean = Mean::of(&ratios);
        format!("{:.3} ± {:.3}", mean.value, mean.within)
    };
    let (rmse, samples) = (mean(outcomes, |o| o.rmse), mean(outcomes, |o| o.mean));
    say(&format!(
        "{:<30} {:>7} {rmse:>9.5} {samples:>8.2} {:>9.1} {:>17} {:>17}",
        lit.name(),
        recipe.error.unwrap_or(f64::NAN),
        mean(outcomes, |o| o.cpu),
        ratio(|o| o.cpu),
        ratio(|o| o.mean),
    ));
}
