//! What the rays of a bundle do at leaves. Where many reach one, a vector holds rays and the triangles
//! come one after the other; where few do, a vector holds triangles and the rays come one after the other.

use super::bundle::{Bundle, MOST, lanes_of, vector, vector_of};
use super::packet::{Lanes, RAYS};
use super::single::limits;
use super::walk::Visit;
use super::wide::{Bvh, Held, WideNode};
use common::counters::Counters;
use common::geometry::{Hit, hit_triangle};
use common::math::Interval;
use common::math::lanes::greatest_lane;
use common::shape::ExactRay;
use common::shape::faces::Faces;
use common::shape::triangle_block::{LANES, TriangleBlock, judge};
use common::shape::unfolded::Unfolded;
use common::simd::{Select, Simd, SimdBase, SimdMask, f32x8};

/// A bundle on its way, and what is known of its rays.
pub struct Journey<'a, 'g> {
    /// The tree.
    pub bvh: &'a Bvh<'g>,
    /// The rays.
    pub bundle: &'a Bundle<'a>,
    /// By ray: hits later than this do not matter; known before the exact hit is.
    pub last: Lanes<MOST>,
    /// By ray: boxes that are entered later do not matter.
    pub limits: Lanes<MOST>,
}

/// Some triangles of a block that rays are asked about.
pub struct Leaf<'a> {
    /// The number of the block.
    pub index: usize,
    /// The block.
    pub block: &'a TriangleBlock,
    /// A bit for each that a ray may meet.
    pub triangles: u32,
}

impl Leaf<'_> {
    /// The number of a triangle among all places of all blocks.
    #[inline(always)]
    pub fn triangle(&self, lane: usize) -> u32 {
        (self.index * LANES + lane) as u32
    }
}

/// What triangles of a leaf, a bit for each, do to a ray, or one triangle to rays, a bit for each.
pub struct Found {
    /// What surely is hit.
    pub certain: u32,
    /// What may be hit beside.
    pub doubtful: u32,
}

/// What is looked for.
pub trait Seek<'a, 'g: 'a> {
    /// See [`Visit::BY_DISTANCE`].
    const BY_DISTANCE: bool;

    /// The bundle on its way.
    fn journey(&mut self) -> &mut Journey<'a, 'g>;

    /// Asks those rays of a vector that are `asked`, of which `at` is the first.
    fn ask_vector<S: Simd>(
        &mut self,
        simd: S,
        leaf: &Leaf,
        unfolded: &Unfolded,
        at: usize,
        asked: u32,
        c: &mut Counters,
    );

    /// Asks one ray.
    fn ask_ray<S: Simd>(
        &mut self,
        simd: S,
        leaf: &Leaf,
        faces: &Faces<f32x8<S>>,
        ray: usize,
        c: &mut Counters,
    );

    /// Asks one ray about solids.
    fn ask_solids<S: Simd>(&mut self, simd: S, held: Held, ray: usize, c: &mut Counters);

    /// A bit for each ray that need not be asked any more.
    fn settled(&self) -> u32;

    /// Where the search may end after all this.
    fn end<S: Simd>(&mut self, simd: S) -> f32;
}

/// Someone who seeks, on the way.
pub struct Seeker<K>(pub K);

impl<'a, 'g: 'a, S: Simd, K: Seek<'a, 'g>> Visit<S> for Seeker<K> {
    const BY_DISTANCE: bool = K::BY_DISTANCE;

    #[inline(always)]
    fn leaf(&mut self, simd: S, node: &WideNode, child: usize, c: &mut Counters) -> f32 {
        let Journey { bvh, bundle, limits, .. } = self.0.journey();
        let (bvh, bundle) = (*bvh, *bundle);
        let rays = bundle.meeting(simd, node, child, limits) & !self.0.settled();
        if rays == 0 {
            return self.0.end(simd);
        }
        match node.child[child].held() {
            Held::Block(index, len) => {
                c.intersections += len as u64 * u64::from(rays.count_ones());
                let block = &bvh.blocks[index];
                let triangles = bundle.fan.meeting(simd, block) & ((1 << len) - 1);
                if triangles != 0 {
                    let leaf = Leaf { index, block, triangles };
                    self.block(simd, &leaf, bundle.rays.len(), rays, c);
                }
            }
            held => lanes_of(rays).for_each(|ray| self.0.ask_solids(simd, held, ray, c)),
        }
        self.0.end(simd)
    }
}

impl<K> Seeker<K> {
    #[inline(always)]
    fn block<'a, 'g: 'a, S: Simd>(&mut self, simd: S, leaf: &Leaf, count: usize, rays: u32, c: &mut Counters)
    where
        K: Seek<'a, 'g>,
    {
        let faces = leaf.block.faces(simd);
        let mut unfolded = None;
        for at in (0..count).step_by(S::f32s::LEN) {
            let asked = rays >> at & every::<S>();
            // Each triangle is asked about all rays, or each ray about all triangles: what takes fewer steps.
            if asked.count_ones() > leaf.triangles.count_ones() {
                if unfolded.is_none() {
                    unfolded = Some(Unfolded::of(&faces));
                }
                if let Some(unfolded) = &unfolded {
                    self.0.ask_vector(simd, leaf, unfolded, at, asked, c);
                }
                continue;
            }
            for lane in lanes_of(asked) {
                self.0.ask_ray(simd, leaf, &faces, at + lane, c);
            }
        }
    }
}

impl<'a, 'g> Journey<'a, 'g> {
    /// Where hits matter until `last`, no farther than the rays reach; to none that is not asked for.
    #[inline(always)]
    pub fn new<S: Simd>(simd: S, bvh: &'a Bvh<'g>, bundle: &'a Bundle<'a>, last: &Lanes<MOST>) -> Self {
        let mut journey = Self { bvh, bundle, last: *last, limits: [f32::NEG_INFINITY; MOST] };
        for at in (0..bundle.rays.len()).step_by(S::f32s::LEN) {
            let reach = vector(simd, &bundle.packet.reach, at);
            vector(simd, last, at).min(reach).store_slice(vector_of::<S, _>(&mut journey.last, at));
            journey.end_vector(simd, at, bundle.asked >> at & every::<S>());
        }
        journey
    }

    /// Makes limits of those rays of a vector that have another last hit.
    #[inline(always)]
    pub fn end_vector<S: Simd>(&mut self, simd: S, at: usize, changed: u32) {
        let (last, reach) = (vector(simd, &self.last, at), vector(simd, &self.bundle.packet.reach, at));
        let limits = mask(simd, changed).select(limits(simd, last, reach), vector(simd, &self.limits, at));
        limits.store_slice(vector_of::<S, _>(&mut self.limits, at));
    }

    /// Hits of one ray later than `last` do not matter from now on. Written as a vector, since it is read as one soon.
    #[inline(always)]
    pub fn end_ray<S: Simd>(&mut self, simd: S, ray: usize, last: f32) {
        let at = ray / S::f32s::LEN * S::f32s::LEN;
        let this = 1 << (ray - at);
        let all = mask(simd, this).select(S::f32s::splat(simd, last), vector(simd, &self.last, at));
        all.store_slice(vector_of::<S, _>(&mut self.last, at));
        self.end_vector(simd, at, this);
    }

    /// The latest limit of all rays.
    #[inline(always)]
    pub fn greatest<S: Simd>(&self, simd: S) -> f32 {
        let eight = |at: usize| f32x8::from_slice(simd, &self.limits[at..at + RAYS]);
        let most = eight(0).max(eight(RAYS)).max(eight(2 * RAYS).max(eight(3 * RAYS)));
        greatest_lane(simd, most)
    }

    /// What one ray does to all triangles of a leaf, and where those that it surely hits are hit at the latest.
    #[inline(always)]
    pub fn judge<S: Simd>(
        &self,
        simd: S,
        leaf: &Leaf,
        faces: &Faces<f32x8<S>>,
        ray: usize,
    ) -> (Found, Lanes) {
        let interval = Interval { min: self.bundle.interval.min, max: self.last[ray] };
        let verdict = judge(simd, faces, &self.bundle.packet.filter(ray), interval);
        let mut possible = verdict.possible & leaf.triangles;
        if possible != 0 {
            possible &= !leaf.block.lanes_of(simd, self.bundle.rays[ray].home);
        }
        let certain = verdict.certain & possible;
        (Found { certain, doubtful: possible & !certain }, verdict.latest)
    }

    /// Where a ray hits one triangle of a leaf, exactly. That is asked at once where the filter is in doubt:
    /// a ray that might have hit nothing would keep all others going.
    #[cold]
    #[inline(never)]
    pub fn decide_now(&self, leaf: &Leaf, lane: usize, ray: usize, c: &mut Counters) -> Option<Hit> {
        c.exact_tests += 1;
        let (exact, block) = (ExactRay::new(&self.bundle.rays[ray]), leaf.block);
        hit_triangle(&block.vertices(lane), block.index[lane], &exact, self.bundle.interval)
    }
}

/// The lanes of a vector that have a bit.
#[inline(always)]
pub fn mask<S: Simd>(simd: S, bits: u32) -> S::mask32s {
    S::mask32s::from_bitmask(simd, u64::from(bits))
}

/// A bit for each lane of a vector.
#[inline(always)]
fn every<S: Simd>() -> u32 {
    u32::MAX >> (u32::BITS as usize - S::f32s::LEN)
}
