//! Error against the number of samples.

use super::csv::Csv;
use super::measure::{Outcome, Recipe, truth};
use super::scene::Lit;
use super::statistics::{Mean, price_at, slope};
use super::{Effort, kernels};
use crate::growth::plot::{self, Curve, Upward};
use crate::sample::Sample;
use a7_sampling::Kernel;
use a7_sampling::sampler::Pattern;
use common::cli::{AppError, say};
use common::picture::Film;
use std::path::PathBuf;

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

    /// Median milliseconds of processor time.
    fn cpu(&self, count: usize) -> f64 {
        let mut cpu = Sample::default();
        self.outcomes[count].iter().for_each(|o| cpu.add(o.cpu));
        cpu.median()
    }

    /// Milliseconds of processor time until the error is `rmse`, if it ever is.
    fn time_until(&self, rmse: f64) -> Option<f64> {
        let curve: Vec<_> = (0..self.outcomes.len()).map(|i| (self.mean(i).value, self.cpu(i))).collect();
        price_at(&curve, rmse)
    }
}

/// Square numbers, so that grids can take part.
fn counts(most: u32) -> Vec<u32> {
    (0..).map(|k| 4u32.pow(k)).take_while(|n| *n <= most).collect()
}

/// All patterns without a filter.
///
/// # Errors
/// If the clock cannot be read, or the plot cannot be written.
pub fn compare_patterns(
    lit: &Lit,
    effort: &Effort,
    csv: &mut Csv,
    svg: Option<&PathBuf>,
) -> Result<(), AppError> {
    let truth = truth(lit, None, effort.truth)?;
    let series = PATTERNS.map(|p| Series::new(format!("{p:?}"), p, "none", None));
    let mut series: Vec<(Series, &Film)> = series.into_iter().map(|s| (s, &truth)).collect();
    let counts = counts(effort.most);
    measure(lit, effort, &counts, &mut series, csv)?;
    print("patterns, no filter", lit, effort, &counts, &series);
    let Some(file) = svg else { return Ok(()) };
    let curve = |s: &Series| {
        let points = counts.iter().enumerate().map(|(i, n)| (f64::from(*n), s.mean(i).value)).collect();
        Curve { name: s.name.clone(), points }
    };
    let curves: Vec<Curve> = series.iter().map(|(s, _)| curve(s)).collect();
    let title = format!("Error of pictures of \"{}\"", lit.name());
    plot::draw(file, [&title, "samples per pixel", "RMSE"], Upward::Logarithmic, &curves)
}

/// All filters, with independent samples and with Sobol's.
///
/// # Errors
/// If the clock cannot be read.
pub fn compare_filters(lit: &Lit, effort: &Effort, csv: &mut Csv) -> Result<(), AppError> {
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
    print("filters", lit, effort, &counts, &series);
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

fn print(what: &str, lit: &Lit, effort: &Effort, counts: &[u32], series: &[(Series, &Film)]) {
    let heads: Vec<String> = counts.iter().map(|n| format!("{:>17}", format!("{n} samples"))).collect();
    say(&format!(
        "\n{}: {what}; RMSE in thousandths with 95 % intervals of {} seeds, {};\nslope from {FROM} samples on; time until the last error of the first row, over the time that takes",
        lit.name(),
        effort.seeds,
        lit.size(),
    ));
    say(&format!("{:<28}{}   {:<16} {:>12} {:>10}", "", heads.join(""), "slope", "us a sample", "time"));
    let last = counts.len() - 1;
    let samples = f64::from(counts[last]) * lit.size().pixels() as f64;
    // What independent samples, the first row, take to get as far as they get.
    let (rmse, longest) = (series[0].0.mean(last).value, series[0].0.cpu(last));
    for (s, _) in series {
        let cells: Vec<String> = (0..counts.len())
            .map(|i| {
                let mean = s.mean(i);
                format!("{:>17}", format!("{:.3} ± {:.3}", 1e3 * mean.value, 1e3 * mean.within))
            })
            .collect();
        let seeds: Vec<_> = (0..effort.seeds as usize).map(|seed| s.fitted(counts, seed)).collect();
        let slope = slope(&seeds);
        let price = s.cpu(last) * 1e3 / samples;
        let time = s.time_until(rmse).map_or("-".to_owned(), |time| format!("{:.3}", time / longest));
        let slope = format!("{:.3} ± {:.3}", slope.value, slope.within);
        say(&format!("{:<28}{}   {slope:<16} {price:>12.3} {time:>10}", s.name, cells.join("")));
    }
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
