//! Our kernels beside the well-known ones: what is wrong with their answers, next to what they
//! cost.
//!
//! Every alternative is a short implementation of our own after its paper, and lives only here.
//! Where nothing is difficult all must agree before anything is timed.

mod double_double;
mod draw;
mod march;
mod offset;
mod real;
mod sphere;
mod timing;
mod triangle;

use crate::report::Section;
use common::cli::AppError;

/// What to measure.
#[derive(clap::Args)]
pub struct Options {
    /// Trials of each kind against a mesh of 448 triangles; other tables take shares of it
    #[arg(long, default_value_t = 20_000)]
    trials: usize,
    /// Rounds; every round times everything once
    #[arg(long, default_value_t = 15)]
    rounds: usize,
    /// A tenth of the trials and five rounds, done within seconds
    #[arg(long)]
    quick: bool,
}

/// How much is done.
pub(crate) struct Effort {
    trials: usize,
    rounds: usize,
}

/// Measures all tables.
///
/// # Errors
/// If two kernels disagree where they must not.
pub fn measure(options: &Options) -> Result<Section, AppError> {
    let effort = match options.quick {
        true => Effort { trials: (options.trials / 10).max(1), rounds: options.rounds.min(5) },
        false => Effort { trials: options.trials.max(1), rounds: options.rounds },
    };
    let mut tables = triangle::measure(&effort)?;
    tables.extend(sphere::measure(&effort)?);
    tables.extend(offset::measure(&effort)?);
    tables.extend(march::measure(&effort)?);
    let remarks = [
        "eps is 2⁻²³; times are processor time: median (quartiles)",
        "triangles: rays from inside; missed: no wall ahead, even: an even number of walls ahead",
        "what works in f64 and does not round t to f32 may be off by less than half an eps",
        "offsets: rays leave outward; lost: what covers the body at 64 eps·S is not met",
        "marches: planes and rays are such that whole numbers say which cells are passed through",
    ];
    Ok(Section {
        part: "numerics",
        title: "Kernels: what is wrong with their answers, and what they cost".to_owned(),
        remarks: remarks.map(str::to_owned).to_vec(),
        figures: vec![sphere::figure(&tables)],
        tables,
        ..Section::default()
    })
}
