//! The seam between passes and what follows paths.

use crate::path::{self, Found, PathTracer};
use a7_sampling::sampler::Pixel;
use common::counters::Counters;
use std::ops::Range;

/// Something that knows what a sample of a pixel finds.
pub trait Estimator: Sync {
    /// Memory that a thread works in; holds nothing that a sample depends on.
    type Scratch: Default + Send;

    /// Finds samples of pixels of the whole picture. What is found for a sample depends on pixel
    /// and sample only. `found` holds the samples of the first pixel, then those of the second, ….
    fn trace(
        &self,
        scratch: &mut Self::Scratch,
        pixels: &[Pixel],
        samples: Range<u32>,
        counters: &mut Counters,
        found: &mut [Found],
    );
}

impl Estimator for PathTracer<'_> {
    type Scratch = path::Scratch;

    fn trace(
        &self,
        scratch: &mut Self::Scratch,
        pixels: &[Pixel],
        samples: Range<u32>,
        counters: &mut Counters,
        found: &mut [Found],
    ) {
        PathTracer::trace(self, scratch, pixels, samples, counters, found);
    }
}
