//! Planes and discs, eight rays at a time.
//!
//! The arithmetic is that of [`common::shape::plane::intersect`], step by step: without fused
//! operations, so that side by side every ray gets the bits that it would get alone.

use super::abreast::{Abreast, RAYS};
use common::counters::Counters;
use common::geometry::{Geometry, Hit, Sheet};
use common::math::{Interval, sum3};
use common::ray::Ray;
use common::shape::ExactRay;
use common::shape::plane::Plane;

/// One number for each ray.
type Lanes = [f64; RAYS];

/// Rays widened, one axis after the other.
struct Widened {
    origin: [Lanes; 3],
    direction: [Lanes; 3],
    /// Those that can hit anything at all.
    usable: [bool; RAYS],
    /// What they leave.
    home: [u32; RAYS],
}

impl Widened {
    /// Of rays side by side.
    #[inline(always)]
    fn of(rays: &Abreast) -> Self {
        let nowhere = [[0.0; RAYS]; 3];
        let mut wide = Self { origin: nowhere, direction: nowhere, usable: [false; RAYS], home: rays.home };
        for axis in 0..3 {
            for lane in 0..RAYS {
                wide.origin[axis][lane] = f64::from(rays.origin[axis][lane]);
                wide.direction[axis][lane] = f64::from(rays.direction[axis][lane]);
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

    /// Whether a ray may hit a sheet: whether it can hit anything, and leaves another.
    #[inline(always)]
    fn is_asked(&self, lane: usize, sheet: &Sheet) -> bool {
        self.usable[lane] & (self.home[lane] != sheet.primitive)
    }

    /// Where each ray meets one of the sheets inside an interval; NaN where it does not.
    #[inline(always)]
    fn meet(&self, rays: &[Ray], geometry: &Geometry, index: usize, interval: Interval) -> [f32; RAYS] {
        let sheet = &geometry.sheets()[index];
        let plane = &sheet.plane;
        if plane.disc.is_some() {
            let mut t = [f32::NAN; RAYS];
            for (lane, ray) in rays.iter().enumerate().filter(|(lane, _)| self.is_asked(*lane, sheet)) {
                let hit = geometry.hit_sheet(index, &ExactRay::new(ray), interval);
                t[lane] = hit.map_or(f32::NAN, |hit| hit.t);
            }
            return t;
        }
        let mut crossings = self.crossings(plane);
        for (lane, t) in crossings.iter_mut().enumerate() {
            let counts = self.is_asked(lane, sheet) & (*t > interval.min) & (*t < interval.max);
            *t = if counts { *t } else { f32::NAN };
        }
        crossings
    }
}

/// Whether none of the rays can meet any plane or disc: there is none, or all leave the only one.
#[inline(always)]
pub fn all_leave(sheets: &[Sheet], rays: &[Ray]) -> bool {
    match sheets {
        [] => true,
        [only] => rays.iter().all(|ray| ray.home == only.primitive),
        _ => false,
    }
}

/// The first hit of each of up to eight rays among planes and discs, as
/// [`Geometry::nearest_sheet`] finds it.
#[inline(always)]
pub fn nearest(
    geometry: &Geometry,
    (rays, abreast): (&[Ray], &Abreast),
    interval: Interval,
    hits: &mut [Option<Hit>],
    c: &mut Counters,
) {
    let sheets = geometry.sheets();
    if all_leave(sheets, rays) {
        return hits.fill(None);
    }
    let wide = Widened::of(abreast);
    let (mut first, mut number) = ([f32::INFINITY; RAYS], [0; RAYS]);
    for (index, sheet) in sheets.iter().enumerate() {
        let t = wide.meet(rays, geometry, index, interval);
        for lane in 0..RAYS {
            c.intersections += u64::from(wide.is_asked(lane, sheet));
            // Sheets come in order of their numbers, so that an equal t changes nothing.
            let nearer = t[lane] < first[lane];
            first[lane] = if nearer { t[lane] } else { first[lane] };
            number[lane] = if nearer { sheet.primitive } else { number[lane] };
        }
    }
    for (lane, hit) in hits.iter_mut().enumerate() {
        let found = Hit { t: first[lane], primitive: number[lane], u: 0.0, v: 0.0 };
        *hit = (first[lane] < f32::INFINITY).then_some(found);
    }
}

/// Whether each of up to eight rays hits any plane or disc, as [`Geometry::any_sheet`] finds it.
#[inline(always)]
pub fn any(
    geometry: &Geometry,
    (rays, abreast): (&[Ray], &Abreast),
    interval: Interval,
    hit: &mut [bool],
    c: &mut Counters,
) {
    let sheets = geometry.sheets();
    if all_leave(sheets, rays) {
        return hit.fill(false);
    }
    let wide = Widened::of(abreast);
    let mut blocked = [false; RAYS];
    for (index, sheet) in sheets.iter().enumerate() {
        let t = wide.meet(rays, geometry, index, interval);
        for lane in 0..RAYS {
            c.intersections += u64::from(wide.is_asked(lane, sheet) & !blocked[lane]);
            blocked[lane] |= !t[lane].is_nan();
        }
    }
    hit.copy_from_slice(&blocked[..hit.len()]);
}
