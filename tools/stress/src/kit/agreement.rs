//! Do all structures answer with the same bits?

use super::ray_bits;
use a5_grid::{Cells, Fit, Grid};
use a6_kdtree::bvh::Bvh;
use a6_kdtree::kdtree::{KdTree, Options, Rule};
use common::accel::Accel;
use common::counters::Counters;
use common::geometry::{Geometry, Hit};
use common::math::{Bounds, Interval, Vec3};
use common::ray::Ray;

/// A grid around the finite objects, or around the origin if there are none.
///
/// # Panics
/// If it would be too large.
pub fn grid_of(geometry: &Geometry, count: [u32; 3], fit: Fit) -> Grid<'_> {
    let bounds = geometry.bounds().unwrap_or(Bounds::of_points([Vec3::ZERO]));
    Grid::new(geometry, Cells::new(count, &bounds), fit).expect("a grid of moderate size")
}

/// A structure and what to call it.
pub struct Named<'g> {
    /// For messages.
    pub name: String,
    /// The structure.
    pub accel: Box<dyn Accel + Send + 'g>,
}

/// Grids of these resolutions, the kd-trees of all rules and the hierarchy, all found valid.
///
/// # Panics
/// If one is not, or a grid would be too large.
pub fn structures<'g>(geometry: &'g Geometry, grids: &[([u32; 3], Fit)]) -> Vec<Named<'g>> {
    let mut all: Vec<Named> = Vec::new();
    for &(count, fit) in grids {
        let accel = Box::new(grid_of(geometry, count, fit));
        all.push(Named { name: format!("grid {count:?} {fit:?}"), accel });
    }
    for rule in Rule::ALL {
        let accel = Box::new(KdTree::new(geometry, Options { rule, ..Options::default() }));
        all.push(Named { name: format!("kd-tree {rule:?}"), accel });
    }
    all.push(Named { name: "hierarchy".to_owned(), accel: Box::new(Bvh::new(geometry)) });
    for Named { name, accel } in &all {
        accel.validate().unwrap_or_else(|why| panic!("{name}: {why}"));
    }
    all
}

/// A hit to the last bit.
type Bits = (u32, u32, u32, u32);

/// A hit as bits: −0 and +0 differ.
fn bits(hit: &Hit) -> Bits {
    (hit.primitive, hit.t.to_bits(), hit.u.to_bits(), hit.v.to_bits())
}

/// The first structure (usually the list) and the others agree on the nearest hit to the bit, and on whether there is any; 1 if so.
///
/// # Errors
/// Who found what, and the ray.
pub fn agree(list: &dyn Accel, structures: &[Named], ray: &Ray, interval: Interval) -> Result<f64, String> {
    let mut counters = Counters::default();
    let truth = list.nearest(ray, interval, &mut counters);
    let fault = |what: &str, got: String| {
        Err(format!("{what}: {got}, should be {truth:?} in {interval:?}\n{}", ray_bits(ray)))
    };
    if list.any(ray, interval, &mut counters) != truth.is_some() {
        return fault("any of the first", "the opposite".to_owned());
    }
    for Named { name, accel } in structures {
        let hit = accel.nearest(ray, interval, &mut counters);
        if hit.as_ref().map(bits) != truth.as_ref().map(bits) {
            return fault(name, format!("{hit:?}"));
        }
        if accel.any(ray, interval, &mut counters) != truth.is_some() {
            return fault(name, "any is the opposite".to_owned());
        }
    }
    Ok(f64::from(u8::from(truth.is_some())))
}
