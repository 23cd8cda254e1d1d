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

/// A middle, and how far around it.
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
    /// A time or a rate: it moves from run to run, and with the machine.
    Measured(Measured),
    /// The same in every run of the same program, and no nearer to the truth than its interval.
    Estimate(Measured),
    /// Made of other figures, times among them, such as the ratio of two: shown, but not compared.
    Derived(Measured),
}

fn quartiles(sample: &Sample) -> Option<Measured> {
    let [low, median, high] = [0.25, 0.5, 0.75].map(|q| sample.quantile(q));
    (!median.is_nan()).then_some(Measured { median, low, high })
}

impl From<&Sample> for Cell {
    fn from(sample: &Sample) -> Self {
        quartiles(sample).map_or(Self::None, Self::Measured)
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

impl<T: Into<Self>> From<Option<T>> for Cell {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::None, Into::into)
    }
}

impl Cell {
    /// A figure made of others, without an interval of its own; none if it is NaN.
    pub fn derived(value: f64) -> Self {
        match value.is_nan() {
            true => Self::None,
            false => Self::Derived(Measured { median: value, low: value, high: value }),
        }
    }

    /// A figure made of others, with its quartiles.
    pub fn derived_from(sample: &Sample) -> Self {
        quartiles(sample).map_or(Self::None, Self::Derived)
    }

    /// A mean and half the width of its interval; exact if that is NaN.
    pub fn estimate(value: f64, within: f64) -> Self {
        match within.is_nan() {
            true => Self::from(value),
            false => Self::Estimate(Measured { median: value, low: value - within, high: value + within }),
        }
    }

    /// The one figure to plot or compare, if there is one.
    pub fn value(&self) -> Option<f64> {
        match self {
            Self::Count(count) => Some(*count as f64),
            Self::Exact(value) => Some(*value),
            Self::Measured(m) | Self::Estimate(m) | Self::Derived(m) => Some(m.median),
            Self::None | Self::Text(_) => None,
        }
    }
}
