//! Which cells a ray crosses, by sorting all of its crossings exactly.

use super::Dyadic;
use common::ray::Ray;
use std::cmp::Ordering;

/// The ray meets plane number `plane` across `axis` at (position − origin) / direction.
#[derive(Clone, Copy)]
struct Event {
    axis: usize,
    plane: usize,
    /// position − origin, rounded; its sign is exact.
    distance: f64,
    position: f64,
    origin: f64,
    direction: f64,
}

impl Event {
    fn t(&self) -> f64 {
        self.distance / self.direction
    }

    /// The order of the exact quotients. Rounded ones decide if they are far apart.
    fn order(&self, other: &Self) -> Ordering {
        if (self.axis, self.plane) == (other.axis, other.plane) {
            return Ordering::Equal;
        }
        let (a, b) = (self.t(), other.t());
        if (a - b).abs() > (a.abs() + b.abs()) * 1e-12 {
            return a.total_cmp(&b);
        }
        let way = |e: &Self| &Dyadic::new(e.position) - &Dyadic::new(e.origin);
        let left = &way(self) * &Dyadic::new(other.direction);
        let right = &way(other) * &Dyadic::new(self.direction);
        let flip = (self.direction < 0.0) != (other.direction < 0.0);
        if flip { right.cmp(&left) } else { left.cmp(&right) }
    }
}

fn events(axis: usize, planes: &[f64], origin: f64, direction: f64) -> Vec<Event> {
    let event = |(plane, &position): (usize, &f64)| Event {
        axis,
        plane,
        distance: position - origin,
        position,
        origin,
        direction,
    };
    let mut all: Vec<Event> = planes.iter().enumerate().map(event).collect();
    if direction < 0.0 {
        all.reverse();
    }
    if direction == 0.0 { Vec::new() } else { all }
}

/// The layer that a ray along the planes runs in: between two, the upper one.
fn layer(planes: &[f64], origin: f64) -> i64 {
    let n = planes.len() as i64 - 1;
    if origin == planes[n as usize] {
        return n - 1;
    }
    planes.iter().filter(|p| **p <= origin).count() as i64 - 1
}

/// The cells whose interior the ray crosses, in order; from its origin on if `forward`, else
/// along its whole line. `planes` are the cells' sides, not decreasing.
pub fn cells_crossed(planes: &[Vec<f64>; 3], ray: &Ray, forward: bool) -> Vec<[usize; 3]> {
    let origin = ray.origin.as_dvec3().to_array();
    let direction = ray.direction.as_dvec3().to_array();
    let mut cell: [i64; 3] = std::array::from_fn(|a| match direction[a].partial_cmp(&0.0) {
        Some(Ordering::Greater) => -1,
        Some(Ordering::Less) => planes[a].len() as i64 - 1,
        _ => layer(&planes[a], origin[a]),
    });
    let lists: [Vec<Event>; 3] = std::array::from_fn(|a| events(a, &planes[a], origin[a], direction[a]));
    let mut next = [0usize; 3];
    let mut crossed = Vec::new();
    loop {
        let heads = || (0..3).filter_map(|a| lists[a].get(next[a]));
        let Some(first) = heads().copied().reduce(|x, y| if y.order(&x) == Ordering::Less { y } else { x })
        else {
            return crossed;
        };
        // The stretch up to this crossing lies in one cell.
        let ahead = !forward || first.t() > 0.0;
        let inside = (0..3).all(|a| (0..planes[a].len() as i64 - 1).contains(&cell[a]));
        if ahead && inside {
            crossed.push(cell.map(|i| i as usize));
        }
        for a in 0..3 {
            while let Some(event) = lists[a].get(next[a]).filter(|e| e.order(&first) == Ordering::Equal) {
                let beyond = event.direction > 0.0;
                cell[event.axis] = event.plane as i64 - i64::from(!beyond);
                next[a] += 1;
            }
        }
    }
}
