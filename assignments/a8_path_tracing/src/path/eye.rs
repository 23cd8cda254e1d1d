//! Where paths begin.

use super::caustic::Chain;
use super::{Path, PathTracer, Scratch};
use crate::numbers::{Rows, Use};
use a7_sampling::sampler::Pixel;
use common::camera::screen_position;
use common::math::Vec3;
use common::math::lanes::LANES;
use common::simd::{self, Simd, dispatch};
use std::ops::Range;

impl PathTracer<'_> {
    /// The rays from the eye.
    pub(super) fn begin(&self, scratch: &mut Scratch, pixels: &[Pixel], samples: Range<u32>) {
        self.numbers.prepare(samples.clone(), &mut scratch.rows);
        scratch.rays.clear();
        scratch.paths.clear();
        let (mut slot, each) = (0, samples.len() as u32);
        for &pixel in pixels {
            let first = Path {
                throughput: Vec3::ONE,
                slot,
                stream: self.numbers.stream(pixel, samples.start),
                normal: Vec3::ZERO,
                pdf: f32::INFINITY,
                left: 1.0,
                chain: Chain::None,
            };
            let path = |row| Path { slot: slot + row, stream: first.stream.after(row), ..first };
            scratch.paths.extend((0..each).map(path));
            slot += each;
        }
        self.camera_rays(scratch);
    }

    fn camera_rays(&self, scratch: &mut Scratch) {
        let Scratch { rays, paths, rows, on_screen, .. } = scratch;
        let Some(aperture) = self.aperture else {
            on_screen.clear();
            dispatch!(simd::level(), s => s.vectorize(
                #[inline(always)]
                || self.points_on_screen(paths, rows, on_screen),
            ));
            return self.studio.camera.rays(on_screen, rays);
        };
        rays.extend(paths.iter().map(|Path { stream, .. }| {
            let on_lens = aperture.point(self.numbers.pair(stream, rows, Use::Lens));
            let on_screen = self.on_screen(stream.pixel(), self.numbers.pair(stream, rows, Use::Pixel));
            self.studio.camera.ray_through_lens(on_screen, on_lens)
        }));
    }

    #[inline(always)]
    fn points_on_screen(&self, paths: &[Path], rows: &Rows, on_screen: &mut Vec<(f64, f64)>) {
        for paths in paths.chunks(LANES) {
            let mut streams = [paths[0].stream; LANES];
            for (stream, path) in streams.iter_mut().zip(paths) {
                *stream = path.stream;
            }
            let [u, v] = self.numbers.pairs(&streams, rows, Use::Pixel);
            for lane in 0..paths.len() {
                on_screen.push(self.on_screen(streams[lane].pixel(), [u[lane], v[lane]]));
            }
        }
    }

    /// A point of a pixel on the unit screen square.
    #[inline(always)]
    fn on_screen(&self, (x, y): Pixel, [u, v]: [f64; 2]) -> (f64, f64) {
        screen_position(self.studio.size, f64::from(x) + u, f64::from(y) + v)
    }
}
