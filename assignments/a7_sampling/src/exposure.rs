//! A7T3: from patterns and rays to a film.

mod desk;

use crate::aperture::Aperture;
use crate::film::{Negative, Shares};
use crate::filter::Kernel;
use crate::sampler::{Pixel, Sampler, pair};
use a1_ray_casting::{CastArgs, Sight, Studio};
use common::accel::Accel;
use common::camera::screen_position;
use common::counters::Counters;
use common::math::Vec3;
use common::picture::{Film, Size};
use common::tiles::{Tile, for_each_tile};
use desk::{Desk, collect};
use std::ops::Range;
use std::sync::Mutex;

/// Rays that are traced together: enough for structures that follow many at a time, few enough
/// for the caches.
const TOGETHER: usize = 256;

/// The light that camera rays find.
pub trait Shade: Sync {
    /// Radiance along rays, each of one sample of a pixel. It must not depend on which rays are
    /// asked for together.
    fn radiances(
        &self,
        sights: &[Sight],
        samples: &[(Pixel, u32)],
        counters: &mut Counters,
        radiances: &mut [Vec3],
    );
}

/// A sample as it comes back.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// Whose it is.
    pub pixel: Pixel,
    /// Its place from the pixel's lower left corner, in pixels.
    pub at: [f64; 2],
    /// What was seen there.
    pub color: Vec3,
}

/// All that decides a sample's colour.
pub struct Exposure<'a> {
    /// Scene, camera and size.
    pub studio: &'a Studio,
    /// Flags that all programs have.
    pub cast: &'a CastArgs,
    /// What finds hits.
    pub accel: &'a dyn Accel,
    /// What is made of hits.
    pub shade: &'a dyn Shade,
    /// Where samples lie.
    pub sampler: &'a dyn Sampler,
    /// The lens's opening; without one rays pass its middle.
    pub aperture: Option<Aperture>,
    /// How samples add up; without one a pixel is the average of its own.
    pub kernel: Option<Kernel>,
}

/// What else looks at the samples while they are there.
pub type Watch<'a> = &'a (dyn Fn(&[Sample]) + Sync);

impl Exposure<'_> {
    /// A picture of so many samples in every pixel. `watch` is shown the samples of one pixel
    /// after the other, in no order of pixels, if anyone wants to see them.
    pub fn picture(&self, samples: u32, watch: Option<Watch>) -> (Film, Counters) {
        let size = self.studio.size;
        let (mut film, mut counters) = (Film::new(size), Counters::default());
        let (mut negative, mut done) = (Negative::new(size, self.kernel), 0);
        while done < size.height() {
            let from = negative.end();
            let to = from.saturating_add(negative.rows_at_a_time()).min(size.height());
            negative.extend_to(to);
            counters += self.expose(&mut negative, from..to, &|_| 0..samples, watch);
            done = negative.develop(done, &mut film);
        }
        (film, counters)
    }

    /// Adds samples to the rows of a negative that are there: for every pixel those that `which`
    /// names.
    pub fn expose(
        &self,
        negative: &mut Negative,
        rows: Range<u32>,
        which: &(dyn Fn(Pixel) -> Range<u32> + Sync),
        watch: Option<Watch>,
    ) -> Counters {
        let (width, height) = (self.studio.size.width(), rows.end - rows.start);
        let Ok(part) = Size::new(i64::from(width), i64::from(height)) else { return Counters::default() };
        let negative = Mutex::new(negative);
        let options = self.cast.general.tile_options("rendering");
        let stride = Shares::sums_per_pixel(self.kernel);
        let make_desk = || Desk::new(self.kernel);
        let finished = for_each_tile(part, &options, make_desk, |desk, tile| {
            let tile = Tile { y0: tile.y0 + rows.start, y1: tile.y1 + rows.start, ..tile };
            self.tile(tile, which, watch, desk);
            // Held for the copy of one tile only, which is short beside computing it.
            let mut negative = negative.lock().expect("adding does not panic");
            let (pixels, sums) = &desk.given;
            pixels
                .iter()
                .zip(sums.chunks_exact(stride))
                .for_each(|((x, y), sums)| negative.add(*x, *y, sums));
        });
        let mut counters = Counters::default();
        finished.states.iter().for_each(|desk| counters += desk.counters);
        counters
    }

    /// Leaves on the desk what the samples of a tile give, pixel by pixel; pixels without samples
    /// are left out.
    fn tile(
        &self,
        tile: Tile,
        which: &(dyn Fn(Pixel) -> Range<u32> + Sync),
        watch: Option<Watch>,
        desk: &mut Desk,
    ) {
        desk.given.0.clear();
        desk.given.1.clear();
        let rays: u64 = tile.pixels().map(|pixel| which(pixel).len() as u64).sum();
        if rays == 0 {
            return;
        }
        let search = match self.aperture {
            None => !self.studio.skips(self.cast, tile, rays, &mut desk.counters),
            Some(_) => {
                desk.counters.rays += rays;
                true
            }
        };
        let mut waiting: Vec<(Pixel, Range<u32>)> = Vec::new();
        let mut count = 0;
        for pixel in tile.pixels() {
            let range = which(pixel);
            if range.is_empty() {
                continue;
            }
            count += range.len();
            waiting.push((pixel, range));
            if count >= TOGETHER {
                self.trace(&waiting, search, desk);
                collect(&mut waiting, watch, desk);
                count = 0;
            }
        }
        self.trace(&waiting, search, desk);
        collect(&mut waiting, watch, desk);
    }

    /// Traces and shades samples, which are left on the desk in order.
    fn trace(&self, wanted: &[(Pixel, Range<u32>)], search: bool, desk: &mut Desk) {
        self.aim(wanted, desk);
        desk.hits.clear();
        desk.hits.resize(desk.rays.len(), None);
        if search {
            let interval = self.studio.camera.interval;
            self.accel.nearest_many(&desk.rays, interval, &mut desk.hits, &mut desk.counters);
        }
        let met = desk.rays.iter().zip(&desk.hits);
        let sights: Vec<Sight> =
            met.map(|(ray, hit)| Sight::new(&self.studio.geometry, *ray, *hit)).collect();
        desk.radiances.resize(sights.len(), Vec3::ZERO);
        self.shade.radiances(&sights, &desk.names, &mut desk.counters, &mut desk.radiances);
        for (sample, radiance) in desk.samples.iter_mut().zip(&desk.radiances) {
            sample.color = *radiance;
        }
    }

    /// Leaves samples and their rays on the desk.
    fn aim(&self, wanted: &[(Pixel, Range<u32>)], desk: &mut Desk) {
        desk.places.clear();
        for (pixel, range) in wanted {
            self.sampler.pairs(*pixel, range.clone(), pair::PIXEL, &mut desk.places);
        }
        desk.names.clear();
        desk.names.extend(every_sample(wanted));
        let named = desk.names.iter().zip(&desk.places);
        desk.samples.clear();
        desk.samples.extend(named.clone().map(|((pixel, _), at)| Sample {
            pixel: *pixel,
            at: *at,
            color: Vec3::ZERO,
        }));
        let (camera, size) = (&self.studio.camera, self.studio.size);
        let on_screen = |(((x, y), _), at): (&(Pixel, u32), &[f64; 2])| {
            screen_position(size, f64::from(*x) + at[0], f64::from(*y) + at[1])
        };
        desk.points.clear();
        desk.points.extend(named.map(on_screen));
        desk.rays.clear();
        let Some(aperture) = self.aperture else { return camera.rays(&desk.points, &mut desk.rays) };
        for ((pixel, sample), point) in desk.names.iter().zip(&desk.points) {
            let uv = self.sampler.pair(*pixel, *sample, pair::LENS);
            desk.rays.push(camera.ray_through_lens(*point, aperture.point(uv)));
        }
    }
}

/// Pixel after pixel, sample after sample.
fn every_sample(wanted: &[(Pixel, Range<u32>)]) -> impl Iterator<Item = (Pixel, u32)> + '_ {
    wanted.iter().flat_map(|(pixel, range)| range.clone().map(|sample| (*pixel, sample)))
}
