//! Rays that wait for others like them, before they flow through the tree together.
//!
//! Rays of one octant that start in one place meet mostly the same nodes, however far apart they were
//! in what was asked. So those that wait are sorted by octant and, within each, by cells of space along
//! a Morton curve: what flows together then is as much alike as it can be.
//!
//! All boxes are made wider by one bound of the errors, so that a record need not hold a ray's own.
//! With u = 2⁻²⁴, sides and origins within 3·G of each other along every axis, G being the greatest
//! coordinate of the tree's bounds, a side s that is made wider by r is met at (s ± r)·i − o·i, which
//! is wrong by u·3·G·|i| at most for the wider side, the inverse, the two products and the difference
//! each; r = 16u·3·G is taken.

use super::bundle::lanes_of;
use super::known::Known;
use super::order::{Order, cells_of};
use super::packet::RAYS;
use super::stream::{MANY, OCTANTS, Stream};
use common::math::Bounds;
use common::math::lanes::Vectors;
use common::ray::Ray;
use common::simd::{Simd, SimdBase, SimdMask, dispatch, f32x8, level};

/// Most rays that wait: more would not make streams much more alike, and take more memory.
const MOST: usize = 1 << 18;

/// Rays from one place make lists long enough if there is one of them for so many nodes.
const NODES_PER_RAY: usize = 16;

/// Farther from the scene's origin than this, times the greatest coordinate, no ray may start.
const FARTHEST: f32 = 2.0;

/// 16u for everything within [`FARTHEST`] and 1.
const ROOM: f32 = (1.0 + FARTHEST) / (1 << 20) as f32;

/// Where a length is more than this times a direction, or less than its inverse, products could overflow or
/// underflow.
const ORDINARY: f32 = (1u64 << 60) as f32;

/// Rays that wait.
pub struct Pool {
    /// Which of all rays they are, and their cells.
    waiting: Vec<(u32, u16)>,
    /// The same in the order of their cells.
    order: Order,
    bounds: Bounds,
    greatest: f32,
    /// Whether rays may start anywhere.
    takes_all: bool,
}

impl Pool {
    /// An empty one, if so many rays are worth it in a tree of so many nodes within `bounds`.
    pub fn of_many(rays: usize, nodes: usize, bounds: &Bounds) -> Option<Self> {
        if rays < MANY || MANY * NODES_PER_RAY < nodes {
            return None;
        }
        Some(Self {
            waiting: Vec::new(),
            order: Order::NONE,
            bounds: *bounds,
            greatest: bounds.min.abs().max(bounds.max.abs()).max_element(),
            takes_all: nodes <= MANY.min(rays.min(MOST) / OCTANTS),
        })
    }

    /// Whether rays that start anywhere are better off here; else only those that start beside each
    /// other are.
    #[inline(always)]
    pub fn takes_all(&self) -> bool {
        self.takes_all
    }

    /// Whether those that wait had better flow before others come.
    pub fn is_full(&self) -> bool {
        self.waiting.len() >= MOST
    }

    /// Takes those of eight rays that are `asked` for, a bit for each, which have these numbers. Returns
    /// those that it cannot take: they run along an axis, start far away, or are no rays.
    #[inline(always)]
    pub fn take<S: Simd>(
        &mut self,
        simd: S,
        [origin, direction]: [Vectors<f32x8<S>>; 2],
        asked: u32,
        numbers: &[u32; RAYS],
    ) -> u32 {
        let of = |x: f32| f32x8::splat(simd, x);
        let (least, most) = (self.greatest.max(1.0) / ORDINARY, self.greatest * ORDINARY);
        let mut fit = asked;
        for axis in 0..3 {
            let step = direction[axis].abs();
            let is_near = origin[axis].abs().simd_le(of(self.greatest * FARTHEST));
            fit &= (step.simd_gt(of(least)) & step.simd_lt(of(most)) & is_near).to_bitmask() as u32;
        }
        let mut cells = [0; RAYS];
        cells_of(simd, origin, direction, &self.bounds).store_slice(&mut cells);
        for lane in lanes_of(fit) {
            self.waiting.push((numbers[lane], cells[lane] as u16));
        }
        asked & !fit
    }

    /// Lets all flow that wait: calls `flow` with one stream after the other and what is known of its
    /// rays, in their order. Of all rays so much is `known`; nothing of any that wait if `is_new`.
    /// `max` is where hits end to count.
    pub fn let_flow<T: Known>(
        &mut self,
        rays: &[Ray],
        max: f32,
        (known, is_new): (&mut [T], bool),
        mut flow: impl FnMut(&mut Stream, &mut [T]),
    ) {
        self.order.sort(&mut self.waiting);
        let (bounds, mut stream, mut some) = (self.bounds, Stream::new(self.greatest * ROOM), Vec::new());
        while let Some((octant, numbers)) = self.order.next() {
            some.clear();
            // Not fetched if it need not be: it lies far apart.
            match is_new {
                true => some.resize(numbers.len(), T::NONE),
                false => some.extend(numbers.iter().map(|&number| known[number as usize])),
            }
            dispatch!(level(), s => stream.fill(s, (octant, numbers), rays, &some, max, &bounds));
            flow(&mut stream, &mut some);
            for (&number, value) in numbers.iter().zip(&some) {
                if !is_new || *value != T::NONE {
                    known[number as usize] = *value;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::abreast::columns;
    use super::*;
    use common::math::Vec3;

    const BOUNDS: Bounds = Bounds { min: Vec3::new(-1.0, 0.0, -3.0), max: Vec3::new(2.0, 4.0, 1.0) };

    /// Takes rays eight at a time, whose numbers begin at 100; returns those of the last eight left.
    fn take(pool: &mut Pool, rays: &[Ray], asked: u32) -> u32 {
        let mut left = 0;
        for (rays, first) in rays.chunks(RAYS).zip((100..).step_by(RAYS)) {
            let numbers = std::array::from_fn(|i| first + i as u32);
            left = dispatch!(level(), s => pool.take(s, columns(s, rays, rays[0]), asked, &numbers));
        }
        left
    }

    #[test]
    fn a6t2_pools_are_for_many_rays() {
        let is_made = |rays, nodes| Pool::of_many(rays, nodes, &BOUNDS).is_some();
        assert!(is_made(MANY, 1) && is_made(MANY, MANY * NODES_PER_RAY));
        assert!(!is_made(MANY - 1, 1) && !is_made(1 << 30, MANY * NODES_PER_RAY + 1));
        let takes_all = |rays, nodes| Pool::of_many(rays, nodes, &BOUNDS).unwrap().takes_all();
        assert!(takes_all(MANY, MANY / OCTANTS) && takes_all(MOST, MANY));
        assert!(!takes_all(MANY, MANY) && !takes_all(1 << 30, MANY + 1));
    }

    #[test]
    fn a6t2_a_pool_takes_rays_that_its_boxes_are_wide_enough_for() {
        let good = Ray::new(Vec3::new(1.0, 2.0, -7.9), Vec3::new(0.1, -2.0, 0.3));
        let mut rays = [good; RAYS];
        rays[1].direction.y = 0.0;
        rays[2].direction.y = 1e-25;
        rays[3].origin.z = -8.1;
        rays[4].direction *= 1e30;
        rays[5].direction = -good.direction;
        let mut pool = Pool::of_many(MANY, 1, &BOUNDS).unwrap();
        let left = take(&mut pool, &rays, 0b1011_1111);
        assert_eq!(left, 0b1_1110, "the others are taken, but the one that was not asked for");
        pool.order.sort(&mut pool.waiting);
        assert_eq!(pool.order.next(), Some((2, &[100, 107][..])));
        assert_eq!(pool.order.next(), Some((5, &[105][..])));
        assert_eq!(pool.order.next(), None, "all have flown");
        pool.order.sort(&mut pool.waiting);
        assert_eq!(pool.order.next(), None, "nobody waits");
    }

    #[test]
    fn a6t2_streams_are_sorted_by_octant_and_place_and_about_equally_long() {
        let direction = [Vec3::new(1.0, 2.0, -3.0), Vec3::new(1.0, 2.0, 3.0)];
        let ray = |i: usize| {
            let place = [-0.9, 1.9, 0.6, -0.2][i / 2 % 4];
            Ray::new(Vec3::new(place, 1.0, 0.0), direction[i % 2])
        };
        let rays: Vec<Ray> = (0..3 * MANY).map(ray).collect();
        let mut pool = Pool::of_many(MANY, 1, &BOUNDS).unwrap();
        take(&mut pool, &rays, 0xFF);
        pool.order.sort(&mut pool.waiting);
        let mut all = Vec::new();
        while let Some((octant, numbers)) = pool.order.next() {
            assert_eq!(numbers.len(), MANY * 3 / 4, "two streams for each octant");
            let ray = |number: u32| rays[number as usize - 100];
            assert!(numbers.iter().all(|n| (ray(*n).direction.z < 0.0) == (octant == 4)));
            let place = |number: u32| (ray(number).origin.x, number);
            assert!(numbers.is_sorted_by(|a, b| place(*a) < place(*b)));
            all.extend_from_slice(numbers);
        }
        all.sort_unstable();
        assert!(all.iter().zip(100..).all(|(number, expected)| *number == expected));
        assert_eq!(all.len(), rays.len(), "each flows once");
    }
}
