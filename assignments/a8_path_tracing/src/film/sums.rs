//! The sums of all pixels of a picture, or of a part of one.

use super::{Aov, Layout, fixed};
use a7_sampling::sampler::Pixel;
use common::math::Vec3;
use common::picture::Size;
use common::tiles::Tile;
use std::ops::Range;

/// Most samples of a pixel, for which sums cannot overflow.
pub const MAX_SAMPLES: u32 = 1 << 31;

/// Most memory that the sums of a picture may take, in bytes.
const MOST_BYTES: u64 = 8 << 30;

/// A picture and the part of it that is rendered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Frame {
    /// Size of the whole picture.
    pub size: Size,
    /// The part, inside of the picture.
    pub crop: Tile,
}

/// A picture whose sums would not fit into memory.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("the sums of {pixels} pixels take {gibibytes:.1} GiB, and may take at most {} GiB: render it in parts with -crop, or give a smaller -size", MOST_BYTES >> 30)]
pub struct TooLarge {
    /// Pixels of the part.
    pub pixels: usize,
    /// What they would take.
    pub gibibytes: f64,
}

impl Frame {
    /// The whole of a picture.
    pub fn whole(size: Size) -> Self {
        Self { size, crop: Tile { x0: 0, y0: 0, x1: size.width(), y1: size.height() } }
    }

    /// Size of the part as a picture of its own.
    ///
    /// # Panics
    /// Never: a part is not empty and not larger than the whole.
    pub fn crop_size(&self) -> Size {
        let (width, height) = (self.crop.width(), self.crop.height());
        Size::new(i64::from(width), i64::from(height)).expect("a part of a picture has a good size")
    }

    /// Whether the part is all of the picture.
    pub fn is_whole(&self) -> bool {
        *self == Self::whole(self.size)
    }

    /// Pixel of the whole picture that has this number in the part, row by row from the bottom.
    pub fn pixel(&self, number: usize) -> Pixel {
        let width = self.crop.width() as usize;
        (self.crop.x0 + (number % width) as u32, self.crop.y0 + (number / width) as u32)
    }
}

/// Sums of the samples of every pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Sums {
    /// What is rendered.
    pub frame: Frame,
    /// Which numbers are kept.
    pub layout: Layout,
    /// The samples of every pixel that is not stopped: from the first to just before the next.
    pub samples: Range<u32>,
    /// Samples that held NaN or an infinity, and count as black.
    pub dropped: u64,
    /// Samples that a pixel had when errors were last looked at.
    pub(super) surveyed: u32,
    /// Samples that each pixel has.
    pub(super) taken: Vec<u32>,
    /// Pixels that are not to have any more.
    pub(super) stopped: Vec<bool>,
    /// [`Layout::stride`] numbers for each pixel.
    pub(super) values: Vec<i128>,
}

/// What samples of a tile add.
#[derive(Clone, Debug, PartialEq)]
pub struct Patch {
    /// Where, counted from the corner of the part.
    pub tile: Tile,
    /// [`Layout::stride`] numbers for each pixel.
    pub values: Vec<i128>,
    /// Samples that held NaN or an infinity.
    pub dropped: u64,
}

impl Sums {
    /// No samples yet; the first will be `first`.
    ///
    /// # Errors
    /// If they would take more memory than is sensible.
    pub fn new(frame: Frame, layout: Layout, first: u32) -> Result<Self, TooLarge> {
        let pixels = frame.crop.area();
        let bytes = pixels as u64 * (layout.stride() as u64 * 16 + 5);
        if bytes > MOST_BYTES {
            return Err(TooLarge { pixels, gibibytes: bytes as f64 / f64::from(1 << 30) });
        }
        Ok(Self {
            frame,
            layout,
            samples: first..first,
            dropped: 0,
            surveyed: 0,
            taken: vec![0; pixels],
            stopped: vec![false; pixels],
            values: vec![0; pixels * layout.stride()],
        })
    }

    /// Samples that a pixel has that was not stopped.
    pub fn done(&self) -> u32 {
        self.samples.end - self.samples.start
    }

    /// Samples that each pixel has, row by row from the bottom.
    pub fn taken(&self) -> &[u32] {
        &self.taken
    }

    /// Whether the pixel of this number is to have more samples.
    pub fn is_active(&self, number: usize) -> bool {
        !self.stopped[number]
    }

    /// Pixels that are to have more samples.
    pub fn active(&self) -> usize {
        self.stopped.iter().filter(|stopped| !**stopped).count()
    }

    /// Adds what a whole pass has found, which had samples up to `end` (excluded).
    ///
    /// # Panics
    /// If `end` lies before the end of the samples, or a patch is not inside of the part.
    pub fn add(&mut self, patches: &[Patch], end: u32) {
        let count = end.checked_sub(self.samples.end).expect("a pass goes forward");
        patches.iter().for_each(|patch| self.add_patch(patch));
        for (taken, stopped) in self.taken.iter_mut().zip(&self.stopped) {
            *taken += if *stopped { 0 } else { count };
        }
        self.samples.end = end;
    }

    fn add_patch(&mut self, patch: &Patch) {
        let (tile, stride) = (patch.tile, self.layout.stride());
        let (width, row) = (self.frame.crop.width() as usize, tile.width() as usize * stride);
        for (y, from) in (tile.y0 as usize..).zip(patch.values.chunks_exact(row)) {
            let to = &mut self.values[(y * width + tile.x0 as usize) * stride..][..row];
            to.iter_mut().zip(from).for_each(|(to, from)| *to += from);
        }
        self.dropped += patch.dropped;
    }

    /// The numbers of a pixel.
    pub(super) fn values_of(&self, number: usize) -> &[i128] {
        let stride = self.layout.stride();
        &self.values[number * stride..][..stride]
    }

    /// Mean radiance of a pixel; black without samples.
    pub fn radiance(&self, number: usize) -> Vec3 {
        self.mean(number, Layout::RADIANCE)
    }

    /// Mean of an AOV of a pixel, three times the same number for [`Aov::Depth`]; `None` if it is
    /// not kept.
    pub fn aov(&self, aov: Aov, number: usize) -> Option<Vec3> {
        let place = self.layout.place(aov)?;
        if aov != Aov::Depth {
            return Some(self.mean(number, place));
        }
        Some(Vec3::splat(fixed::mean(self.values_of(number)[place], self.taken[number]) as f32))
    }

    fn mean(&self, number: usize, place: usize) -> Vec3 {
        let (values, taken) = (self.values_of(number), self.taken[number]);
        let channel = |i: usize| fixed::mean(values[place + i], taken) as f32;
        Vec3::new(channel(0), channel(1), channel(2))
    }
}
