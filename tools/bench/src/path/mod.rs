//! Error of path-traced pictures against processor time.

mod reference;
mod subject;

use crate::clock;
use a7_sampling::Pattern;
use a8_path_tracing::{Integrator, Rules};
use common::cli::{self, AppError};
use common::picture::{Film, Size};
use std::path::PathBuf;
use subject::Subject;

/// What to measure.
#[derive(clap::Args)]
pub struct Options {
    /// Scene file
    #[arg(long)]
    scene: PathBuf,
    /// Converged picture of it, .exr .pfm or .npy
    #[arg(long)]
    reference: PathBuf,
    /// Paths per pixel
    #[arg(long, value_delimiter = ',', default_value = "16,64")]
    spp: Vec<u32>,
    /// Where samples lie
    #[arg(long, value_enum, value_delimiter = ',', default_value = "random,sobol")]
    sampler: Vec<Pattern>,
    /// How light is looked for
    #[arg(long, value_enum, value_delimiter = ',', default_value = "mis")]
    integrator: Vec<Integrator>,
    /// Most surfaces that send a path on before the one that a light shines on
    #[arg(long, default_value_t = 6)]
    bounces: u32,
    /// Surfaces before roulette
    #[arg(long, default_value_t = 1)]
    rr_depth: u32,
    /// What finds hits, as for a6_kdtree
    #[arg(long, default_value = "auto")]
    accel: String,
    /// Writes the last picture
    #[arg(long, value_name = "PICTURE")]
    write: Option<PathBuf>,
    /// Independent pictures
    #[arg(long, default_value_t = 1)]
    seeds: u64,
}

/// Measures and prints.
///
/// # Errors
/// A scene or a picture that cannot be read.
pub fn run(options: &Options) -> Result<(), AppError> {
    let truth = reference::load(&options.reference)?;
    let size: Size = truth.size();
    let subject = Subject::open(&options.scene, size, &options.accel)?;
    cli::say(&format!("{}: {size}", subject.name));
    cli::say(
        "integrator sampler    spp     cpu s  Mpaths/s  rays/path      RMSE   RMSE*sqrt(s)  sqrt(relMSE*s)  mean",
    );
    subject.with(|world, accel| {
        for &integrator in &options.integrator {
            for &pattern in &options.sampler {
                for &spp in &options.spp {
                    for seed in 0..options.seeds {
                        let rules = Rules {
                            integrator,
                            bounces: Some(options.bounces),
                            roulette_depth: options.rr_depth,
                            ..Rules::default()
                        };
                        let ((film, counters), span) =
                            clock::time(|| subject.picture(world, accel, (pattern, seed), rules, spp))?;
                        if let Some(file) = &options.write {
                            common::picture::write(file, &film, common::picture::Transfer::Linear)?;
                        }
                        let paths = size.pixels() as f64 * f64::from(spp);
                        let seconds = span.cpu / 1e3;
                        let (rmse, relative) = errors(&film, &truth);
                        let mean = film.pixels().iter().sum::<common::math::Vec3>() / film.pixels().len() as f32;
                        let rays = (counters.rays + counters.shadow_rays) as f64 / paths;
                        let per_ray = |n: u64| n as f64 / (counters.rays + counters.shadow_rays) as f64;
                        eprintln!("exact {:.2} cells {:.2} tests {:.2}", per_ray(counters.exact_tests), per_ray(counters.cells), per_ray(counters.intersections));
                        cli::say(&format!(
                            "{:<10} {:<9} {spp:>5} {seconds:>9.2} {:>9.3} {rays:>9.2} {rmse:>10.5} {:>13.4} {:>13.4}   {:.5} {:.5} {:.5}",
                            format!("{integrator:?}"),
                            format!("{pattern:?}"),
                            paths / seconds / 1e6,
                            rmse * seconds.sqrt(),
                            (relative * seconds).sqrt(),
                            mean.x,
                            mean.y,
                            mean.z
                        ));
                    }
                }
            }
        }
        Ok(())
    })?
}

/// Root mean square error, and mean of squared error relative to the squared truth.
fn errors(film: &Film, truth: &Film) -> (f64, f64) {
    let (mut square, mut relative) = (0.0, 0.0);
    for (a, b) in film.pixels().iter().zip(truth.pixels()) {
        for c in 0..3 {
            let (a, b) = (f64::from(a[c]), f64::from(b[c]));
            square += (a - b).powi(2);
            relative += (a - b).powi(2) / (b * b + 1e-2);
        }
    }
    let count = (truth.pixels().len() * 3) as f64;
    ((square / count).sqrt(), relative / count)
}
