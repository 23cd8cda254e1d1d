//! What the samples of one pixel tell.

use crate::exposure::Sample;
use common::math::{DVec3, Vec3};

/// What a pixel's samples tell. Squares are means over the three channels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Look {
    /// Samples so far.
    pub count: u32,
    /// Their mean colour.
    pub mean: Vec3,
    /// Sum of squared distances of the samples from their mean.
    pub scatter: f32,
    /// Squared error of the mean, judged by how far its first and second half lie apart.
    pub change: f32,
}

/// Some samples of a pixel.
#[derive(Clone, Copy, Debug)]
pub struct Part {
    count: f64,
    mean: DVec3,
    scatter: f64,
}

impl Part {
    /// What they come to by themselves.
    pub fn of(samples: &[Sample]) -> Self {
        let count = samples.len() as f64;
        let mean = samples.iter().map(|s| s.color.as_dvec3()).sum::<DVec3>() / count.max(1.0);
        let square = |s: &Sample| (s.color.as_dvec3() - mean).length_squared() / 3.0;
        Self { count, mean, scatter: samples.iter().map(square).sum() }
    }
}

impl Look {
    /// Adds samples as the second half, all before being the first (Chan, Golub & LeVeque,
    /// "Updating formulae and a pairwise algorithm for computing sample variances", 1979).
    pub fn add(&mut self, part: Part) {
        if part.count == 0.0 {
            return;
        }
        let (old, new) = (f64::from(self.count), part.count);
        let (all, apart) = (old + new, part.mean - self.mean.as_dvec3());
        let apart_squared = apart.length_squared() / 3.0;
        self.scatter += (part.scatter + apart_squared * old * new / all) as f32;
        // Independent halves differ by σ²(1/old + 1/new), their common mean errs by σ²/all.
        self.change = (apart_squared * old * new / (all * all)) as f32;
        self.mean = (self.mean.as_dvec3() + apart * (new / all)).as_vec3();
        self.count += new as u32;
    }

    /// Variance of a single sample.
    pub fn variance(&self) -> f64 {
        f64::from(self.scatter) / f64::from(self.count.saturating_sub(1).max(1))
    }
}
