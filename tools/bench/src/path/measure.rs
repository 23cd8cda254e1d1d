//! One picture, its error and its price.

use super::subject::Subject;
use crate::clock;
use a6_kdtree::Tracer;
use a6_kdtree::texture::TexturedScene;
use a7_sampling::Pattern;
use a8_path_tracing::Rules;
use common::cli::AppError;
use common::picture::Film;

/// Side of the squares whose means are compared.
const BLOCK: u32 = 32;

/// Added to the squared truth that errors are relative to, so that black pixels do not decide.
const DARK: f64 = 0.01;

/// How a picture is taken.
#[derive(Clone, Copy, Debug)]
pub struct Recipe {
    /// What paths may do.
    pub rules: Rules,
    /// Where samples lie.
    pub pattern: Pattern,
    /// Paths per pixel.
    pub spp: u32,
}

/// What came of it.
#[derive(Clone, Copy, Debug)]
pub struct Shot {
    /// Processor time.
    pub seconds: f64,
    /// Rays of all kinds.
    pub rays: f64,
    /// Root mean square error over pixels and channels.
    pub rmse: f64,
    /// Mean of the squared error over the squared truth plus 0.01.
    pub relative: f64,
    /// How far the mean of the picture is off, relative to the truth's.
    pub mean_off: f64,
    /// The same of the square of 32 × 32 pixels that is worst.
    pub block_off: f64,
}

impl Recipe {
    /// Takes the picture of a seed and compares it.
    ///
    /// # Errors
    /// If the system tells no processor time.
    pub fn shoot(
        &self,
        subject: &Subject,
        (world, accel): (&TexturedScene, &Tracer),
        seed: u64,
        truth: &Film,
    ) -> Result<(Shot, Film), AppError> {
        let (made, span) = clock::time(|| subject.picture(world, accel, self, seed))?;
        let (film, counters) = made?;
        let (mut square, mut relative) = (0.0, 0.0);
        for (a, b) in film.pixels().iter().zip(truth.pixels()) {
            for c in 0..3 {
                let (a, b) = (f64::from(a[c]), f64::from(b[c]));
                square += (a - b).powi(2);
                relative += (a - b).powi(2) / (b * b + DARK);
            }
        }
        let count = (truth.pixels().len() * 3) as f64;
        let (mean_off, block_off) = means_off(&film, truth);
        let shot = Shot {
            seconds: span.cpu / 1e3,
            rays: (counters.rays + counters.shadow_rays) as f64,
            rmse: (square / count).sqrt(),
            relative: relative / count,
            mean_off,
            block_off,
        };
        Ok((shot, film))
    }
}

impl Shot {
    /// As a line of comma-separated values.
    pub fn line(&self, scene: &str, recipe: &Recipe, seed: u64) -> String {
        let Recipe { rules, pattern, spp } = recipe;
        let integrator = rules.integrator;
        let Self { seconds, rmse, relative, .. } = self;
        format!("{scene},{integrator:?},{pattern:?},{spp},{seed},{seconds},{rmse},{relative}\n")
    }
}

/// How far the means of brightness are off, relative to the truth's: of the whole, and of the worst
/// block.
fn means_off(film: &Film, truth: &Film) -> (f64, f64) {
    let off = |columns: std::ops::Range<u32>, rows: std::ops::Range<u32>| {
        let sum = |picture: &Film| -> f64 {
            let row = |y: u32| &picture.row(y)[columns.start as usize..columns.end as usize];
            rows.clone().flat_map(|y| row(y).iter().map(|p| f64::from(p.element_sum()))).sum()
        };
        let (a, b) = (sum(film), sum(truth));
        if b == 0.0 { a.abs() } else { (a / b - 1.0).abs() }
    };
    let (width, height) = (truth.width(), truth.height());
    let mut worst: f64 = 0.0;
    for y in (0..height).step_by(BLOCK as usize) {
        for x in (0..width).step_by(BLOCK as usize) {
            worst = worst.max(off(x..(x + BLOCK).min(width), y..(y + BLOCK).min(height)));
        }
    }
    (off(0..width, 0..height), worst)
}
