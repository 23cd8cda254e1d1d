//! The files that sums are written to.

use crate::args::FileArgs;
use crate::film::{Aov, Identity, Sums, checkpoint, develop};
use common::atomic::{self, Target};
use common::cli::{self, AppError};
use common::picture::{Transfer, write};
use std::path::PathBuf;

/// The files that sums are written to.
pub struct Outputs {
    /// The picture.
    pub picture: Option<PathBuf>,
    /// Pictures of what was met first.
    pub aovs: Vec<(Aov, PathBuf)>,
    /// The sums themselves.
    pub checkpoint: Option<PathBuf>,
    /// How light is coded in 8-bit pictures.
    pub transfer: Transfer,
}

impl Outputs {
    /// What these flags name.
    ///
    /// # Errors
    /// Kinds of AOVs that are none.
    pub fn new(picture: Option<&PathBuf>, files: &FileArgs) -> Result<Self, AppError> {
        Ok(Self {
            picture: picture.cloned(),
            aovs: files.aovs()?,
            checkpoint: files.checkpoint.clone(),
            transfer: files.transfer(),
        })
    }

    /// Whether there is any file.
    pub fn any(&self) -> bool {
        self.picture.is_some() || !self.aovs.is_empty() || self.checkpoint.is_some()
    }

    /// Writes all files.
    ///
    /// # Errors
    /// If one cannot be written.
    pub fn write(&self, identity: &Identity, sums: &Sums) -> Result<(), AppError> {
        self.write_checkpoint(identity, sums)?;
        self.write_picture(sums)?;
        for (aov, path) in &self.aovs {
            if let Some(film) = develop::aov(sums, *aov, path) {
                write(path, &film, develop::transfer(*aov, self.transfer))?;
            }
        }
        Ok(())
    }

    /// Writes the picture as it is now, unless it goes to a stream, which could not take it back.
    /// What goes wrong is only told: the end is still to come.
    pub fn refresh_picture(&self, sums: &Sums) {
        let is_file = |path: &PathBuf| matches!(atomic::target(path), Ok(Target::File(_)));
        if self.picture.as_ref().is_some_and(is_file) {
            tell(self.write_picture(sums));
        }
    }

    /// Writes the checkpoint as it is now. What goes wrong is only told.
    pub fn refresh_checkpoint(&self, identity: &Identity, sums: &Sums) {
        tell(self.write_checkpoint(identity, sums));
    }

    fn write_picture(&self, sums: &Sums) -> Result<(), AppError> {
        match &self.picture {
            Some(path) => Ok(write(path, &develop::radiance(sums), self.transfer)?),
            None => Ok(()),
        }
    }

    fn write_checkpoint(&self, identity: &Identity, sums: &Sums) -> Result<(), AppError> {
        match &self.checkpoint {
            Some(path) => Ok(checkpoint::write(path, identity, sums)?),
            None => Ok(()),
        }
    }
}

fn tell(outcome: Result<(), AppError>) {
    if let Err(error) = outcome {
        cli::warn(&format!("while rendering goes on: {}", error.report()));
    }
}
