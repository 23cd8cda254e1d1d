//! Pictures of figures, before they are drawn.

use super::{Better, front, plot};
use common::cli::AppError;
use std::path::Path;

/// Curves in one picture.
#[derive(Clone, Debug, Default)]
pub struct Figure {
    /// Above it.
    pub title: String,
    /// What is across, which is logarithmic.
    pub across: String,
    /// What is up.
    pub up: String,
    /// How far up is how much.
    pub upward: Upward,
    /// What was measured.
    pub curves: Vec<Curve>,
    /// What was fitted to it: drawn as thin lines without points.
    pub fits: Vec<Curve>,
    /// Points that are ringed, since nothing beats them.
    pub front: Vec<(f64, f64)>,
}

/// One curve.
#[derive(Clone, Debug)]
pub struct Curve {
    /// What it is called in the legend.
    pub name: String,
    /// x above zero.
    pub points: Vec<(f64, f64)>,
}

/// The upward axis; the other one is logarithmic.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Upward {
    /// From 0, in equal steps.
    Linear,
    /// From the least value, in equal factors; all values above zero.
    #[default]
    Logarithmic,
}

impl Curve {
    /// A curve of that name.
    pub fn new(name: impl Into<String>, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self { name: name.into(), points: points.into_iter().collect() }
    }
}

impl Figure {
    /// Curves of which both axes are logarithmic.
    pub fn new(title: impl Into<String>, across: &str, up: &str, curves: Vec<Curve>) -> Self {
        let (across, up) = (across.to_owned(), up.to_owned());
        Self { title: title.into(), across, up, curves, ..Self::default() }
    }

    /// Rings the points of all curves that nothing beats: less across is better, and up what
    /// `quality` says.
    pub fn with_front(mut self, quality: Better) -> Self {
        let points: Vec<_> = self.curves.iter().flat_map(|c| c.points.iter().copied()).collect();
        let marks = front(&points, quality);
        self.front = points.into_iter().zip(marks).filter_map(|(p, mark)| mark.then_some(p)).collect();
        self
    }

    /// Its text as SVG.
    ///
    /// # Errors
    /// If there is no point that the axes have a place for.
    pub fn svg(&self) -> Result<String, AppError> {
        plot::svg(self)
    }

    /// Draws it into a file.
    ///
    /// # Errors
    /// As [`Self::svg`], or if the file cannot be written; a failure leaves no half file.
    pub fn draw(&self, file: &Path) -> Result<(), AppError> {
        Ok(common::atomic::replace(file, self.svg()?.as_bytes())?)
    }
}
