//! Every measurement, for other programs to read.

use super::measure::{Outcome, Recipe};
use common::cli::AppError;
use std::path::Path;

/// Lines of comma-separated values.
pub struct Csv {
    text: String,
}

impl Default for Csv {
    fn default() -> Self {
        let text = "scene,sampler,filter,samples,adaptive_error,seed,rmse,cpu_ms,mean_samples\n".to_owned();
        Self { text }
    }
}

impl Csv {
    /// Adds one measurement.
    pub fn add(&mut self, scene: &str, recipe: &Recipe, filter: &str, seed: u64, outcome: Outcome) {
        let error = recipe.error.map_or(String::new(), |error| error.to_string());
        let (pattern, samples, Outcome { rmse, cpu, mean }) = (recipe.pattern, recipe.samples, outcome);
        let line = format!("{scene},{pattern:?},{filter},{samples},{error},{seed},{rmse},{cpu},{mean}\n");
        self.text.push_str(&line);
    }

    /// Writes all of them.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), AppError> {
        Ok(std::fs::write(path, &self.text)?)
    }
}
