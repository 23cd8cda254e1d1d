//! Surfaces that paths have met, put in line by how they are left, eight to a block.

use super::Path;
use crate::numbers::Stream;
use common::geometry::{Abreast, Surface};
use common::math::lanes::{LANES, Stored, Vectors, dot, each, load, load_wide, narrow, store};
use common::math::{DVec3, Vec3};
use common::ray::Ray;
use common::simd::{Select, Simd, SimdBase, f32x8, f64x8};

/// A surface that a path has met and leaves with others like it.
#[derive(Clone, Copy)]
pub(super) struct Met {
    /// Which of the paths of this generation.
    pub path: u32,
    /// The primitive.
    pub primitive: u32,
    /// The point.
    pub point: DVec3,
    /// Unit normal of the surface.
    pub own: DVec3,
    /// How far beside the surface rays start.
    pub away: f64,
    /// 1 if the path comes from the side of that normal, else −1.
    pub side: f32,
    /// Unit normal to shade with, on the path's side.
    pub normal: Vec3,
    /// Share of light that is sent on.
    pub color: Vec3,
    /// Index of refraction of glass; 0 for mirrors, and for matt surfaces.
    pub index: f32,
}

impl Met {
    /// A surface that a ray has met, without what its material says.
    #[inline(always)]
    pub fn new(path: u32, ray: &Ray, surface: &Surface) -> Self {
        let own = surface.geometric_normal;
        let side = if own.dot(ray.direction.as_dvec3()) > 0.0 { -1.0 } else { 1.0 };
        Self {
            path,
            primitive: surface.primitive,
            point: surface.point,
            own,
            away: surface.away(),
            side,
            normal: surface.normal * side,
            color: Vec3::ZERO,
            index: 0.0,
        }
    }
}

/// Up to eight of them.
#[derive(Clone, Copy)]
pub(super) struct Block {
    /// How many there are.
    pub count: usize,
    pub path: [u32; LANES],
    pub primitive: [u32; LANES],
    pub point: Stored<f64>,
    pub own: Stored<f64>,
    pub away: [f64; LANES],
    pub side: [f32; LANES],
    pub normal: Stored<f32>,
    pub color: Stored<f32>,
    pub index: [f32; LANES],
}

/// Those of a generation that are left in the same way.
#[derive(Default)]
pub(super) struct Queue {
    pub blocks: Vec<Block>,
    /// The number of the block that takes those that come one by one, if there is one.
    open: Option<usize>,
}

impl Queue {
    pub fn clear(&mut self) {
        self.blocks.clear();
        self.open = None;
    }

    #[inline(always)]
    pub fn push(&mut self, place: &Met) {
        let open = self.open.filter(|number| self.blocks[*number].count < LANES).unwrap_or_else(|| {
            self.blocks.push(Block::EMPTY);
            self.blocks.len() - 1
        });
        self.open = Some(open);
        let block = &mut self.blocks[open];
        let lane = block.count % LANES;
        block.count += 1;
        block.path[lane] = place.path;
        block.primitive[lane] = place.primitive;
        block.away[lane] = place.away;
        block.side[lane] = place.side;
        block.index[lane] = place.index;
        for axis in 0..3 {
            block.point[axis][lane] = place.point[axis];
            block.own[axis][lane] = place.own[axis];
            block.normal[axis][lane] = place.normal[axis];
            block.color[axis][lane] = place.color[axis];
        }
    }
}

impl Block {
    pub const EMPTY: Self = Self {
        count: 0,
        path: [0; LANES],
        primitive: [0; LANES],
        point: [[0.0; LANES]; 3],
        own: [[0.0; LANES]; 3],
        away: [0.0; LANES],
        side: [1.0; LANES],
        normal: [[0.0; LANES]; 3],
        color: [[0.0; LANES]; 3],
        index: [0.0; LANES],
    };
}

/// The same as the arithmetic sees them.
pub(super) struct Places<'b, S: Simd> {
    pub block: &'b Block,
    pub streams: [Stream; LANES],
    pub throughput: Vectors<f32x8<S>>,
    pub spot: Abreast<S>,
    pub normal: Vectors<f32x8<S>>,
    /// The surface's own normal on the path's side.
    pub geometric: Vectors<f32x8<S>>,
    pub color: Vectors<f32x8<S>>,
}

impl<'b, S: Simd> Places<'b, S> {
    #[inline(always)]
    pub fn new(simd: S, block: &'b Block, paths: &[Path]) -> Self {
        let own = load_wide(simd, &block.own);
        let side = f32x8::from_slice(simd, &block.side);
        let mut throughput = [[0.0; LANES]; 3];
        let mut streams = [paths[0].stream; LANES];
        for lane in 0..LANES {
            let path = &paths[block.path[lane] as usize];
            streams[lane] = path.stream;
            for (axis, lanes) in throughput.iter_mut().enumerate() {
                lanes[lane] = path.throughput[axis];
            }
        }
        Self {
            block,
            streams,
            throughput: load(simd, &throughput),
            spot: Abreast {
                point: load_wide(simd, &block.point),
                normal: own,
                away: f64x8::from_slice(simd, &block.away),
            },
            normal: load(simd, &block.normal),
            geometric: each(own, |n| narrow(simd, n) * side),
            color: load(simd, &block.color),
        }
    }

    /// A bit for each that there is.
    #[inline(always)]
    pub fn present(&self) -> u32 {
        (1 << self.block.count) - 1
    }

    /// Where rays in these directions start.
    #[inline(always)]
    pub fn start(&self, simd: S, direction: Vectors<f64x8<S>>) -> Stored<f32> {
        let of = |x: f64| f64x8::splat(simd, x);
        let sign = dot(self.spot.normal, direction).simd_lt(of(0.0)).select(of(-1.0), of(1.0));
        store(self.spot.beside(simd, sign))
    }
}
