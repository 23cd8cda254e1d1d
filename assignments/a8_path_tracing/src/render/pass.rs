//! One pass: some samples of every pixel that is to have more.

use super::Estimator;
use crate::film::{Patch, Sums};
use crate::path::Found;
use a7_sampling::sampler::Pixel;
use common::counters::Counters;
use common::picture::Size;
use common::tiles::{Tile, TileOptions, for_each_tile};
use std::ops::Range;

/// Paths that are traced together, as far as a tile has so many.
const TOGETHER: usize = 2048;

/// Tiles that there should be at least, for all cores to get some.
const ENOUGH_TILES: usize = 32;

/// What a thread works with.
struct Worker<S> {
    scratch: S,
    counters: Counters,
    patches: Vec<Patch>,
    numbers: Vec<usize>,
    pixels: Vec<Pixel>,
    found: Vec<Found>,
}

/// What a pass has found.
pub struct Passed {
    /// What is to be added.
    pub patches: Vec<Patch>,
    /// What was counted.
    pub counters: Counters,
}

/// Takes these samples of all active pixels; `None` if it was stopped before the last. `progress`
/// is told how many paths have been traced.
pub fn pass<E: Estimator>(
    estimator: &E,
    sums: &Sums,
    samples: Range<u32>,
    options: &TileOptions,
    progress: &(dyn Fn(usize) + Sync),
) -> Option<Passed> {
    let size = sums.frame.crop_size();
    let options = TileOptions { tile: Some(options.tile.unwrap_or(side(size))), label: None, ..*options };
    let make_worker = || Worker {
        scratch: E::Scratch::default(),
        counters: Counters::default(),
        patches: Vec::new(),
        numbers: Vec::new(),
        pixels: Vec::new(),
        found: Vec::new(),
    };
    let finished = for_each_tile(size, &options, make_worker, |worker, tile| {
        let paths = trace_tile(estimator, sums, &samples, tile, worker);
        progress(paths);
    });
    if !finished.complete {
        return None;
    }
    let mut passed = Passed { patches: Vec::new(), counters: Counters::default() };
    for worker in finished.states {
        passed.patches.extend(worker.patches);
        passed.counters += worker.counters;
    }
    Some(passed)
}

/// Side of a tile: large enough for many paths at a time even if each pixel has but one.
fn side(size: Size) -> u32 {
    let sides = [32u32, 16, 8];
    sides.into_iter().find(|side| size.pixels() >= (side * side) as usize * ENOUGH_TILES).unwrap_or(4)
}

/// Traces the active pixels of a tile, and returns how many paths that were.
fn trace_tile<E: Estimator>(
    estimator: &E,
    sums: &Sums,
    samples: &Range<u32>,
    tile: Tile,
    worker: &mut Worker<E::Scratch>,
) -> usize {
    let width = sums.frame.crop.width() as usize;
    let number = |(x, y): Pixel| y as usize * width + x as usize;
    let active = tile.pixels().enumerate().filter(|(_, pixel)| sums.is_active(number(*pixel)));
    worker.numbers.clear();
    worker.pixels.clear();
    for (in_tile, pixel) in active {
        worker.numbers.push(in_tile);
        worker.pixels.push(sums.frame.pixel(number(pixel)));
    }
    if worker.pixels.is_empty() {
        return 0;
    }
    let (layout, each) = (sums.layout, samples.len());
    let stride = layout.stride();
    let mut patch = Patch { tile, values: vec![0; tile.area() * stride], dropped: 0 };
    let at_a_time = (TOGETHER / each).max(1);
    for (numbers, pixels) in worker.numbers.chunks(at_a_time).zip(worker.pixels.chunks(at_a_time)) {
        // Whatever is in there is written over.
        worker.found.resize(pixels.len() * each, Found::default());
        let (scratch, counters) = (&mut worker.scratch, &mut worker.counters);
        estimator.trace(scratch, pixels, samples.clone(), counters, &mut worker.found);
        for (number, found) in numbers.iter().zip(worker.found.chunks_exact(each)) {
            let values = &mut patch.values[number * stride..][..stride];
            patch.dropped += layout.add(values, found);
        }
    }
    worker.patches.push(patch);
    worker.pixels.len() * each
}
