//! Where a thread keeps its samples until they are added up.

use super::{Sample, Watch};
use crate::film::Shares;
use crate::filter::Kernel;
use crate::sampler::Pixel;
use common::counters::Counters;
use common::geometry::Hit;
use common::math::{DVec4, Vec3};
use common::ray::Ray;
use common::simd::{self, Simd, dispatch};
use std::ops::Range;

/// What a thread works with.
pub struct Desk {
    /// Samples that are worked out together.
    pub samples: Vec<Sample>,
    /// Where they are on the screen …
    pub points: Vec<(f64, f64)>,
    /// … their rays …
    pub rays: Vec<Ray>,
    /// … what these met …
    pub hits: Vec<Option<Hit>>,
    /// … which sample of which pixel they are …
    pub names: Vec<(Pixel, u32)>,
    /// … and the light that they bring.
    pub radiances: Vec<Vec3>,
    /// Where they are in their pixels.
    pub places: Vec<[f64; 2]>,
    /// What those of one pixel give.
    pub shares: Shares,
    /// Of all pixels of a tile that have samples: whose they are, and the sums of one after the
    /// other.
    pub given: (Vec<Pixel>, Vec<DVec4>),
    /// What was done.
    pub counters: Counters,
}

impl Desk {
    /// Nothing yet; samples add up as the kernel says.
    pub fn new(kernel: Option<Kernel>) -> Self {
        Self {
            samples: Vec::new(),
            places: Vec::new(),
            points: Vec::new(),
            rays: Vec::new(),
            hits: Vec::new(),
            names: Vec::new(),
            radiances: Vec::new(),
            shares: Shares::new(kernel),
            given: (Vec::new(), Vec::new()),
            counters: Counters::default(),
        }
    }
}

/// Adds up the samples on the desk, pixel by pixel.
pub fn collect(wanted: &mut Vec<(Pixel, Range<u32>)>, watch: Option<Watch>, desk: &mut Desk) {
    let mut samples = &desk.samples[..];
    for (pixel, range) in wanted.drain(..) {
        let (own, rest) = samples.split_at(range.len());
        samples = rest;
        desk.shares.clear();
        let shares = &mut desk.shares;
        dispatch!(simd::level(), s => s.vectorize(
            #[inline(always)]
            || shares.add_all(own),
        ));
        if let Some(watch) = watch {
            watch(own);
        }
        desk.given.0.push(pixel);
        desk.given.1.extend_from_slice(desk.shares.sums());
    }
}
