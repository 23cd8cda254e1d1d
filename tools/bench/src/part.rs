//! The parts: what can be measured by itself.

use crate::report::{Section, csv};
use crate::{
    growth, kernels, numerics, path, pictures, rays, sampling, simplify, skips, startup, stress, trees,
};
use common::cli::{self, AppError};
use std::path::Path;

/// A part and what it is to measure.
#[derive(clap::Subcommand)]
pub enum Part {
    /// Whole command lines, from process start to the written picture
    Pictures(pictures::Options),
    /// From process start to the first pixel: every program, and meshes of growing size
    Startup(startup::Options),
    /// Reading meshes, building grids, tracing rays, one part at a time
    Kernels(kernels::Options),
    /// Tests, offsets and marches of others beside ours: what is wrong with them, what they cost
    Numerics(numerics::Options),
    /// Rays per second of every structure, beside what is wrong with its answers
    Rays(rays::Options),
    /// Build time against render time on five views: no tree, kd-trees, hierarchy
    Trees(trees::Options),
    /// Cost of a ray from a thousand to ten million triangles, with a plot
    Growth(growth::Options),
    /// Processor time of simplification against its error, on meshes of every kind
    Simplify(simplify::Options),
    /// Error of pictures against samples and against time: patterns, filters, adaptive sampling
    Sampling(sampling::Options),
    /// Error of path-traced pictures against processor time: integrators, samplers
    Path(path::Options),
    /// The promises of accuracy, tried: what, how often, how near to what is allowed
    Stress(stress::Options),
    /// What a scene does not need, and what leaving it out saves
    Skips(skips::Options),
}

impl Part {
    /// Measures it.
    ///
    /// # Errors
    /// Those of the part.
    pub fn measure(&self) -> Result<Section, AppError> {
        match self {
            Self::Pictures(options) => pictures::measure(options),
            Self::Startup(options) => startup::measure(options),
            Self::Kernels(options) => kernels::measure(options),
            Self::Numerics(options) => numerics::measure(options),
            Self::Rays(options) => rays::measure(options),
            Self::Trees(options) => trees::measure(options),
            Self::Growth(options) => growth::measure(options),
            Self::Simplify(options) => simplify::measure(options),
            Self::Sampling(options) => sampling::measure(options),
            Self::Path(options) => path::measure(options),
            Self::Stress(options) => stress::measure(options),
            Self::Skips(options) => skips::measure(options),
        }
    }
}

/// Measures one part and prints it.
///
/// # Errors
/// Those of the part, a file that cannot be written, or [`AppError::CheckFailed`] if a result is
/// wrong.
pub fn run(part: &Part, results: Option<&Path>) -> Result<(), AppError> {
    let section = part.measure()?;
    cli::say(section.to_string().trim_end());
    if let Some(file) = results {
        common::atomic::replace(file, csv::write(&csv::records(&section)).as_bytes())?;
    }
    if let Part::Growth(options) = part {
        growth::draw(options, &section)?;
    }
    section.verdict()
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[derive(Parser)]
    struct Line {
        #[command(subcommand)]
        part: Part,
    }

    #[test]
    fn a_part_by_itself_writes_its_results_and_its_plot() {
        let folder = std::env::temp_dir().join(format!("raysteps-part-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let (plot, results) = (folder.join("plot.svg"), folder.join("results.csv"));
        let words = "bench growth --meshes sphere500,sphere2k --side 8 --rounds 1 --svg".split(' ');
        let line = Line::parse_from(words.chain([plot.to_str().unwrap()]));
        run(&line.part, Some(&results)).unwrap();
        assert!(std::fs::read_to_string(&plot).unwrap().contains("kd SAH, bounce"));
        let records = csv::load(&results).unwrap();
        assert_eq!(
            records.iter().filter(|r| r.place[1] == "cost of a ray" && r.place[3] == "ns").count(),
            12
        );
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
