//! One figure of a table.

use crate::sample::Sample;

/// Which way is progress, for whoever compares two runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Better {
    /// Times, errors, bytes.
    Less,
    /// Rates.
    More,
    /// Names, sizes of the work.
    Neither,
}

/// A figure that moves from run to run: the middle and how far it moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// The middle.
    pub median: f64,
    /// The lower quartile, or the lower end of an interval that the part's remarks explain.
    pub low: f64,
    /// The upper one.
    pub high: f64,
}

/// What stands where a row and a column meet.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// Does not apply.
    None,
    /// A word.
    Text(String),
    /// A count, which is the same in every run.
    Count(u64),
    /// A figure that is the same in every run of the same program.
    Exact(f64),
    /// A figure that is not.
    Measured(Measured),
}

impl From<&Sample> for Cell {
    fn from(sample: &Sample) -> Self {
        let [low, median, high] = [0.25, 0.5, 0.75].map(|q| sample.quantile(q));
        if median.is_nan() { Self::None } else { Self::Measured(Measured { median, low, high }) }
    }
}

impl From<u64> for Cell {
    fn from(count: u64) -> Self {
        Self::Count(count)
    }
}

impl From<usize> for Cell {
    fn from(count: usize) -> Self {
        Self::Count(count as u64)
    }
}

impl From<f64> for Cell {
    fn from(value: f64) -> Self {
        if value.is_nan() { Self::None } else { Self::Exact(value) }
    }
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<String> for Cell {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl Cell {
    /// The one figure to plot or compare, if there is one.
    pub fn value(&self) -> Option<f64> {
        match self {
            Self::Count(count) => Some(*count as f64),
            Self::Exact(value) => Some(*value),
            Self::Measured(m) => Some(m.median),
            Self::None | Self::Text(_) => None,
        }
    }
}
