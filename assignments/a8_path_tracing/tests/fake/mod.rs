//! An estimator that knows what every sample finds without a scene.

use a7_sampling::sampler::Pixel;
use a7_sampling::sampler::hash::{hash, unit};
use a8_path_tracing::film::{Frame, Sums};
use a8_path_tracing::render::{End, Goal, Rendering, Tally};
use a8_path_tracing::{Estimator, Found, Layout};
use common::counters::Counters;
use common::math::Vec3;
use common::picture::Size;
use common::tiles::{Tile, TileOptions};
use std::ops::Range;
use std::time::Duration;

/// Numbers of very different size, by pixel and sample.
#[derive(Clone, Copy, Default)]
pub struct Fake {
    /// Greatest power of two by which samples differ in size; above 60, some are no numbers.
    pub spread: u32,
    /// How long a sample takes.
    pub nap: Duration,
}

impl Fake {
    pub fn found(&self, (x, y): Pixel, sample: u32) -> Found {
        let word = hash(u64::from(sample), u64::from(x), u64::from(y));
        let part = |shift: u32| unit((word >> shift) as u32) as f32 - 0.25;
        let size = 2f32.powi((word % u64::from(self.spread + 1)) as i32 - self.spread as i32 / 2);
        let radiance = match word % 97 {
            0 if self.spread > 60 => Vec3::new(1.0, f32::NAN, 0.0),
            1 if self.spread > 60 => Vec3::splat(f32::INFINITY),
            _ => Vec3::new(part(0), part(11), part(23)) * size,
        };
        Found { radiance, albedo: Vec3::splat(part(7)), normal: Vec3::new(part(3), 0.5, -1.0), depth: size }
    }
}

impl Estimator for Fake {
    /// Must not matter.
    type Scratch = u64;

    fn trace(
        &self,
        scratch: &mut u64,
        pixels: &[Pixel],
        samples: Range<u32>,
        counters: &mut Counters,
        found: &mut [Found],
    ) {
        assert_eq!(found.len(), pixels.len() * samples.len());
        *scratch += 1;
        counters.rays += found.len() as u64;
        if !self.nap.is_zero() {
            std::thread::sleep(self.nap * found.len() as u32);
        }
        for (pixel, found) in pixels.iter().zip(found.chunks_exact_mut(samples.len())) {
            for (sample, found) in samples.clone().zip(found) {
                *found = self.found(*pixel, sample);
            }
        }
    }
}

pub const ALL: Layout = Layout { halves: false, aovs: [true; 3] };

pub fn size(width: u32, height: u32) -> Size {
    Size::new(i64::from(width), i64::from(height)).unwrap()
}

pub fn frame(size: Size, crop: [u32; 4]) -> Frame {
    let [x0, y0, x1, y1] = crop;
    Frame { size, crop: Tile { x0, y0, x1, y1 } }
}

pub fn goal(end: u32) -> Goal {
    Goal { end, time: None, error: None }
}

/// Goes on with sums up to a sample.
pub fn go_on(fake: &Fake, sums: &mut Sums, goal: Goal, options: TileOptions) -> Tally {
    Rendering { goal, options }.run(fake, sums, |_| {})
}

/// Samples of a part.
pub fn part(fake: &Fake, frame: Frame, samples: Range<u32>) -> Sums {
    let mut sums = Sums::new(frame, ALL, samples.start).unwrap();
    let tally = go_on(fake, &mut sums, goal(samples.end), TileOptions::default());
    assert_eq!((tally.end, sums.samples.end), (End::Samples, samples.end));
    sums
}
