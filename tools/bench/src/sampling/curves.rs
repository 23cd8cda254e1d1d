//! Error against the number of samples.

use super::csv::Csv;
use super::measure::{Outcome, Recipe, truth};
use super::scene::Lit;
use super::{Effort, kernels};
use crate::report::{Better, Cell, Curve, Figure, Section, Table};
use crate::sample::Sample;
use crate::statistics::{Mean, price_at, slope};
use a7_sampling::Kernel;
use a7_sampling::sampler::Pattern;
use common::cli::AppError;
use common::picture::Film;

/// Samples from which on slopes are fitted: fewer are not yet a pattern.
const FROM: u32 = 4;

const PATTERNS: [Pattern; 8] = [
    Pattern::Random,
    Pattern::Uniform,
    Pattern::Jittered,
    Pattern::MultiJittered,
    Pattern::Halton,
    Pattern::R2,
    Pattern::Sobol,
    Pattern::BlueNoise,
];

/// One pattern and filter, with what is measured: for each number of samples one outcome a seed.
struct Series {
    name: String,
    pattern: Pattern,
    filter: &'static str,
    kernel: Option<Kernel>,
    outcomes: Vec<Vec<Outcome>>,
}

impl Series {
    fn new(name: String, pattern: Pattern, filter: &'static str, kernel: Option<Kernel>) -> Self {
        Self { name, pattern, filter, kernel, outcomes: Vec::new() }
    }

    /// The curve of one seed, as far as slopes are fitted.
    fn fitted(&self, counts: &[u32], seed: usize) -> Vec<(f64, f64)> {
        let points = counts.iter().zip(&self.outcomes).filter(|(n, _)| **n >= FROM);
        points.map(|(n, seeds)| (f64::from(*n), seeds[seed].rmse)).collect()
    }

    fn mean(&self, count: usize) -> Mean {
        Mean::of(&self.outcomes[count].iter().map(|o| o.rmse).collect::<Vec<_>>())
    }

    /// Milliseconds of processor time.
    fn cpu(&self, count: usize) -> Sample {
        self.outcomes[count].iter().map(|o| o.cpu).collect()
    }

    /// (milliseconds, error) for every number of samples.
    fn curve(&self) -> Curve {
        let point = |i| (self.cpu(i).median(), self.mean(i).value);
        Curve::new(&self.name, (0..self.outcomes.len()).map(point))
    }

    /// Milliseconds of processor time until the error is `rmse`, if it ever is.
    fn time_until(&self, rmse: f64) -> Option<f64> {
        let curve: Vec<_> = self.curve().points.into_iter().map(|(ms, rmse)| (rmse, ms)).collect();
        price_at(&curve, rmse)
    }
}

/// Square numbers, so that grids can take part.
fn counts(most: u32) -> Vec<u32> {
    (0..).map(|k| 4u32.pow(k)).take_while(|n| *n <= most).collect()
}

/// All patterns without a filter: a table, error against samples, error against time.
///
/// # Errors
/// If the clock cannot be read.
pub fn compare_patterns(
    lit: &Lit,
    effort: &Effort,
    csv: &mut Csv,
    section: &mut Section,
) -> Result<(), AppError> {
    let truth = truth(lit, None, effort.truth)?;
    let series = PATTERNS.map(|p| Series::new(format!("{p:?}"), p, "none", None));
    let mut series: Vec<(Series, &Film)> = series.into_iter().map(|s| (s, &truth)).collect();
    let counts = counts(effort.most);
    measure(lit, effort, &counts, &mut series, csv)?;
    section.tables.push(table("patterns, no filter", lit, effort, &counts, &series));
    let curve = |s: &Series| {
        Curve::new(&s.name, counts.iter().enumerate().map(|(i, n)| (f64::from(*n), s.mean(i).value)))
    };
    let curves: Vec<Curve> = series.iter().map(|(s, _)| curve(s)).collect();
    let title = format!("Error of pictures of \"{}\"", lit.name());
    section.figures.push(Figure::new(title, "samples per pixel", "RMSE", curves));
    section.figures.push(against_time("patterns", lit, &series));
    Ok(())
}

fn against_time(what: &str, lit: &Lit, series: &[(Series, &Film)]) -> Figure {
    let curves = series.iter().map(|(s, _)| s.curve()).collect();
    let title = format!("Error against time, {what}, \"{}\"", lit.name());
    Figure::new(title, "ms of processor time", "RMSE", curves).with_front(Better::Less)
}

/// All filters, with independent samples and with Sobol's.
///
/// # Errors
/// If the clock cannot be read.
pub fn compare_filters(
    lit: &Lit,
    effort: &Effort,
    csv: &mut Csv,
    section: &mut Section,
) -> Result<(), AppError> {
    let kernels = kernels()?;
    let truths = kernels.iter().map(|(_, kernel)| truth(lit, *kernel, effort.truth));
    let truths = truths.collect::<Result<Vec<_>, _>>()?;
    let mut series = Vec::new();
    for pattern in [Pattern::Random, Pattern::Sobol] {
        for ((filter, kernel), truth) in kernels.iter().zip(&truths) {
            series.push((Series::new(format!("{pattern:?}, {filter}"), pattern, filter, *kernel), truth));
        }
    }
    let counts = counts(effort.most);
    measure(lit, effort, &counts, &mut series, csv)?;
    section.tables.push(table("filters", lit, effort, &counts, &series));
    section.figures.push(against_time("filters", lit, &series));
    Ok(())
}

fn measure(
    lit: &Lit,
    effort: &Effort,
    counts: &[u32],
    series: &mut [(Series, &Film)],
    csv: &mut Csv,
) -> Result<(), AppError> {
    series.iter_mut().for_each(|(s, _)| s.outcomes = vec![Vec::new(); counts.len()]);
    for (seed, (i, samples)) in
        (1..=effort.seeds).flat_map(|seed| counts.iter().enumerate().map(move |c| (seed, c)))
    {
        for (s, truth) in series.iter_mut() {
            let recipe = Recipe { pattern: s.pattern, kernel: s.kernel, samples: *samples, error: None };
            let outcome = recipe.measure(lit, seed, truth)?;
            csv.add(lit.name(), &recipe, s.filter, seed, outcome);
            s.outcomes[i].push(outcome);
        }
    }
    Ok(())
}

fn table(what: &str, lit: &Lit, effort: &Effort, counts: &[u32], series: &[(Series, &Film)]) -> Table {
    let heads: Vec<String> = counts.iter().map(|n| format!("{n} samples")).collect();
    let columns: Vec<_> = (heads.iter().map(String::as_str))
        .chain(["slope", "us a sample", "time to the first row's error"])
        .map(|name| (name, Better::Less))
        .collect();
    let mut table = Table::of_rivals(format!("{}: {what}, {}", lit.name(), lit.size()), "", &columns);
    let last = counts.len() - 1;
    let samples = f64::from(counts[last]) * lit.size().pixels() as f64;
    // What independent samples, the first row, take to get as far as they get.
    let (rmse, longest) = (series[0].0.mean(last).value, series[0].0.cpu(last).median());
    for (s, _) in series {
        let seeds: Vec<_> = (0..effort.seeds as usize).map(|seed| s.fitted(counts, seed)).collect();
        let price = s.cpu(last).map(|ms| ms * 1e3 / samples);
        let time = s.time_until(rmse).map_or(Cell::None, |time| Cell::derived(time / longest));
        let errors = (0..counts.len()).map(|i| s.mean(i).cell(1e3));
        table.row(&s.name, errors.chain([slope(&seeds).cell(1.0), Cell::from(&price), time]));
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::scene::Place;
    use common::picture::Size;

    /// The slopes that theory promises, roughly: a small picture and few seeds.
    #[test]
    fn slopes_of_a_smooth_picture() {
        let effort = Effort { size: Size::new(20, 20).unwrap(), truth: 4096, most: 64, seeds: 3 };
        let place = Place::named("gradient", effort.size).unwrap();
        let lit = place.lit().unwrap();
        let truth = truth(&lit, None, effort.truth).unwrap();
        let new = |p| (Series::new(String::new(), p, "none", None), &truth);
        let mut series = [new(Pattern::Random), new(Pattern::Jittered), new(Pattern::Sobol)];
        let counts = counts(effort.most);
        measure(&lit, &effort, &counts, &mut series, &mut Csv::default()).unwrap();
        let slopes = series.map(|(s, _)| slope(&[0, 1, 2].map(|seed| s.fitted(&counts, seed))).value);
        assert!((slopes[0] + 0.5).abs() < 0.1, "{slopes:?}");
        assert!(slopes[1] < -0.8 && slopes[2] < -1.0, "{slopes:?}");
    }
}
