//! One picture, its error and its price.

use super::scene::{Lit, Taste};
use crate::clock;
use a7_sampling::sampler::Pattern;
use a7_sampling::{Adaptive, Kernel};
use common::cli::AppError;
use common::picture::Film;

/// Seed of converged pictures, which no other picture has.
const OTHER_SEED: u64 = 1 << 40;

/// How a picture is taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Recipe {
    /// Where samples lie.
    pub pattern: Pattern,
    /// How they add up.
    pub kernel: Option<Kernel>,
    /// Samples of a pixel; of an adaptive picture, most of them.
    pub samples: u32,
    /// The error asked for, of an adaptive picture.
    pub error: Option<f64>,
}

/// What came of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// Root mean square error over all pixels and channels.
    pub rmse: f64,
    /// Milliseconds of processor time.
    pub cpu: f64,
    /// Samples per pixel, on average.
    pub mean: f64,
}

impl Recipe {
    /// The picture, milliseconds of processor time, samples per pixel.
    fn shoot(&self, lit: &Lit, seed: u64) -> Result<(Film, f64, f64), AppError> {
        let side = lit.size().width().max(lit.size().height());
        let sampler = || self.pattern.sampler(self.samples, side, seed);
        let taste = Taste { sampler: &*sampler(), of_lights: sampler(), kernel: self.kernel };
        lit.with(taste, |exposure| match self.error {
            None => {
                let ((film, _), span) = clock::time(|| exposure.picture(self.samples, None))?;
                Ok((film, span.cpu, f64::from(self.samples)))
            }
            Some(error) => {
                let plan = Adaptive { error, most: self.samples };
                let (made, span) = clock::time(|| plan.picture(exposure, None))?;
                let (film, survey, _) = made?;
                let counts = survey.counts();
                let total: f64 = counts.iter().map(|n| f64::from(*n)).sum();
                Ok((film, span.cpu, total / counts.len() as f64))
            }
        })
    }

    /// Takes the picture and compares it with the truth.
    ///
    /// # Errors
    /// If the clock cannot be read, or the picture is too large.
    pub fn measure(&self, lit: &Lit, seed: u64, truth: &Film) -> Result<Outcome, AppError> {
        let (film, cpu, mean) = self.shoot(lit, seed)?;
        Ok(Outcome { rmse: rmse(&film, truth), cpu, mean })
    }
}

/// The picture that all of one filter tend to: Sobol's samples, of another seed.
///
/// # Errors
/// As [`Recipe::measure`].
pub fn truth(lit: &Lit, kernel: Option<Kernel>, samples: u32) -> Result<Film, AppError> {
    let recipe = Recipe { pattern: Pattern::Sobol, kernel, samples, error: None };
    Ok(recipe.shoot(lit, OTHER_SEED)?.0)
}

/// Root mean square difference of two films, over pixels and channels.
fn rmse(a: &Film, b: &Film) -> f64 {
    let squares = a.pixels().iter().zip(b.pixels()).map(|(a, b)| (*a - *b).as_dvec3().length_squared());
    (squares.sum::<f64>() / (3 * a.pixels().len()) as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::scene::Place;
    use common::math::Vec3;
    use common::picture::Size;

    #[test]
    fn error_is_per_channel() {
        let size = Size::new(2, 1).unwrap();
        let (a, mut b) = (Film::new(size), Film::new(size));
        b.set(1, 0, Vec3::new(3.0, 0.0, 3.0));
        assert!((rmse(&a, &b) - 3.0f64.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn more_samples_are_nearer_to_the_truth() {
        let place = Place::named("disc", Size::new(24, 24).unwrap()).unwrap();
        let lit = place.lit().unwrap();
        let truth = truth(&lit, None, 1024).unwrap();
        let recipe = |samples, error| Recipe { pattern: Pattern::Sobol, kernel: None, samples, error };
        let [few, many, adaptive] = [recipe(4, None), recipe(256, None), recipe(256, Some(0.01))]
            .map(|recipe| recipe.measure(&lit, 1, &truth).unwrap());
        assert!(few.rmse > 4.0 * many.rmse, "{few:?} {many:?}");
        assert!(adaptive.mean < 128.0 && adaptive.rmse < 0.01, "{adaptive:?}");
    }
}
