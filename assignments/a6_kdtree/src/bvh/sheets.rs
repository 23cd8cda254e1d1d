//! Planes and discs, eight rays at a time.
//!
//! The arithmetic is that of [`common::shape::plane::intersect`], step by step: without fused
//! operations, so that side by side every ray gets the bits that it would get alone.

use common::counters::Counters;
use common::geometry::{Geometry, Hit};
use common::math::{Interval, sum3};
use common::ray::Ray;
use common::shape::ExactRay;
use common::shape::plane::Plane;

/// Rays side by side.
const RAYS: usize = 8;

/// One number for each ray.
type Lanes = [f64; RAYS];

/// Rays widened, one axis after the other.
struct Widened {
    origin: [Lanes; 3],
    direction: [Lanes; 3],
    /// Those that can hit anything at all.
    usable: [bool; RAYS],
}

impl Widened {
    /// One to eight rays; unused places hold rays that hit nothing.
    #[inline(always)]
    fn of(rays: &[Ray]) -> Self {
        let mut wide = Self { origin: [[0.0; RAYS]; 3], direction: [[0.0; RAYS]; 3], usable: [false; RAYS] };
        for (lane, ray) in rays.iter().enumerate().take(RAYS) {
            for axis in 0..3 {
                wide.origin[axis][lane] = f64::from(ray.origin[axis]);
                wide.direction[axis][lane] = f64::from(ray.direction[axis]);
            }
        }
        for lane in 0..RAYS {
            let [o, d] = [&wide.origin, &wide.direction].map(|v| {
                let [x, y, z] = [v[0][lane].abs(), v[1][lane].abs(), v[2][lane].abs()];
                // A NaN makes the sum one.
                x + y + z
            });
            wide.usable[lane] = o < f64::INFINITY && d < f64::INFINITY && d > 0.0;
        }
        wide
    }

    /// Where each ray crosses a plane without a rim, rounded once; what is no number in the range
    /// of single precision, or not even that, lies in no interval.
    #[inline(always)]
    fn crossings(&self, plane: &Plane) -> [f32; RAYS] {
        let (n, mut t) = (plane.normal, [0.0; RAYS]);
        for lane in 0..RAYS {
            let along = |v: &[Lanes; 3]| sum3(n.x * v[0][lane], n.y * v[1][lane], n.z * v[2][lane]);
            t[lane] = ((plane.offset - along(&self.origin)) / along(&self.direction)) as f32;
        }
        t
    }

    /// Where each ray meets one of the sheets inside an interval; NaN where it does not.
    #[inline(always)]
    fn meet(&self, rays: &[Ray], geometry: &Geometry, sheet: usize, interval: Interval) -> [f32; RAYS] {
        let plane = &geometry.sheets()[sheet].plane;
        if plane.disc.is_some() {
            let mut t = [f32::NAN; RAYS];
            for (t, ray) in t.iter_mut().zip(rays) {
                let hit = geometry.hit_sheet(sheet, &ExactRay::new(ray), interval);
                *t = hit.map_or(f32::NAN, |hit| hit.t);
            }
            return t;
        }
        let mut crossings = self.crossings(plane);
        for (t, usable) in crossings.iter_mut().zip(self.usable) {
            let counts = usable & (*t > interval.min) & (*t < interval.max);
            *t = if counts { *t } else { f32::NAN };
        }
        crossings
    }
}

/// The first hit of each ray among planes and discs, as [`Geometry::nearest_sheet`] finds it.
#[inline(always)]
pub fn nearest(
    geometry: &Geometry,
    rays: &[Ray],
    interval: Interval,
    hits: &mut [Option<Hit>],
    c: &mut Counters,
) {
    let sheets = geometry.sheets();
    if sheets.is_empty() {
        return hits.fill(None);
    }
    for (rays, hits) in rays.chunks(RAYS).zip(hits.chunks_mut(RAYS)) {
        let wide = Widened::of(rays);
        let (mut first, mut number) = ([f32::INFINITY; RAYS], [0; RAYS]);
        for (index, sheet) in sheets.iter().enumerate() {
            let t = wide.meet(rays, geometry, index, interval);
            for lane in 0..RAYS {
                // Sheets come in order of their numbers, so that an equal t changes nothing.
                let nearer = t[lane] < first[lane];
                first[lane] = if nearer { t[lane] } else { first[lane] };
                number[lane] = if nearer { sheet.primitive } else { number[lane] };
            }
        }
        for (lane, hit) in hits.iter_mut().enumerate() {
            let found = Hit { t: first[lane], primitive: number[lane], u: 0.0, v: 0.0 };
            *hit = (first[lane] < f32::INFINITY).then_some(found);
            c.intersections += u64::from(wide.usable[lane]) * sheets.len() as u64;
        }
    }
}

/// Whether each ray hits any plane or disc, as [`Geometry::any_sheet`] finds it.
#[inline(always)]
pub fn any(geometry: &Geometry, rays: &[Ray], interval: Interval, hit: &mut [bool], c: &mut Counters) {
    if geometry.sheets().is_empty() {
        return hit.fill(false);
    }
    for (rays, hit) in rays.chunks(RAYS).zip(hit.chunks_mut(RAYS)) {
        let wide = Widened::of(rays);
        let mut blocked = [false; RAYS];
        for index in 0..geometry.sheets().len() {
            let t = wide.meet(rays, geometry, index, interval);
            for lane in 0..RAYS {
                c.intersections += u64::from(wide.usable[lane] & !blocked[lane]);
                blocked[lane] |= !t[lane].is_nan();
            }
        }
        hit.copy_from_slice(&blocked[..hit.len()]);
    }
}
