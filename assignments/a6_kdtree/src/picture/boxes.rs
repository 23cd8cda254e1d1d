//! A6T5: the boxes of a kd-tree's leaves as a picture, behind `-visualize_kdtree`.

use crate::kdtree::{KdTree, halves};
use a1_ray_casting::{Layer, Sight};
use a2_transforms::LocalLight;
use a5_grid::{cell_color, shaded_face};
use common::counters::Counters;
use common::math::{Bounds, Interval, Vec3};
use common::ray::Ray;

/// The first leaf along every ray that holds anything, as a matt box coloured by how much it
/// holds, in the colours of assignment 5.
pub struct BoxPicture<'a> {
    /// The tree.
    pub tree: &'a KdTree<'a>,
    /// The scene's lights.
    pub light: LocalLight<'a>,
    /// Where the camera's rays count.
    pub interval: Interval,
}

/// A leaf that a ray enters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entered {
    /// Where; before the interval if the ray starts inside.
    pub t: f64,
    /// 0, 1, 2: through a face across x, y, z.
    pub axis: usize,
    /// Place of the leaf among the tree's nodes.
    pub leaf: usize,
    /// Number of primitives that it holds, at least 1.
    pub count: usize,
}

/// Where a ray comes into a closed box, and through a face across which axis. A ray that starts
/// inside came in before. `None` if it passes by, or is inside only outside the interval.
fn entry(ray: &Ray, bounds: &Bounds, interval: Interval) -> Option<(f64, usize)> {
    let (mut enter, mut exit, mut through) = (f64::NEG_INFINITY, f64::INFINITY, 0);
    for axis in 0..3 {
        let (origin, direction) = (f64::from(ray.origin[axis]), f64::from(ray.direction[axis]));
        let (min, max) = (f64::from(bounds.min[axis]), f64::from(bounds.max[axis]));
        if direction == 0.0 {
            if origin < min || origin > max {
                return None;
            }
            continue;
        }
        let (near, far) = if direction > 0.0 { (min, max) } else { (max, min) };
        // Monotonic in the plane whatever the rounding, so no part is entered before the whole.
        let (near, far) = ((near - origin) / direction, (far - origin) / direction);
        if near > enter {
            (enter, through) = (near, axis);
        }
        exit = exit.min(far);
    }
    let (min, max) = (f64::from(interval.min), f64::from(interval.max));
    (enter <= exit && exit > min && enter < max).then_some((enter, through))
}

/// The first leaf along a ray that holds anything; of leaves entered at the same t, the one that
/// comes first in the tree. Every node whose box is met counts as a step.
pub fn first_box(tree: &KdTree, ray: &Ray, interval: Interval, counters: &mut Counters) -> Option<Entered> {
    let mut best: Option<Entered> = None;
    let mut waiting = Vec::new();
    let root = tree.root_box();
    if ray.is_usable() && !tree.nodes().is_empty() {
        waiting.extend(entry(ray, &root, interval).map(|(t, axis)| (0, root, t, axis)));
    }
    while let Some((place, bounds, t, axis)) = waiting.pop() {
        if best.is_some_and(|b| t > b.t) {
            continue;
        }
        counters.cells += 1;
        let node = tree.nodes()[place];
        if node.is_leaf() {
            let found = Entered { t, axis, leaf: place, count: tree.held_by(node) };
            let first = best.is_none_or(|b| (t, place) < (b.t, b.leaf));
            if found.count > 0 && first {
                best = Some(found);
            }
            continue;
        }
        let backward = usize::from(ray.direction[node.axis()] < 0.0);
        let parts = halves(&bounds, node.axis(), node.at());
        // The nearer part on top.
        for side in [1 - backward, backward] {
            let met = entry(ray, &parts[side], interval);
            waiting.extend(met.map(|(t, axis)| (node.child() + side, parts[side], t, axis)));
        }
    }
    best
}

impl Layer for BoxPicture<'_> {
    fn needs_hit(&self) -> bool {
        false
    }

    fn value(&self, sight: &Sight, counters: &mut Counters) -> Vec3 {
        counters.rays += 1;
        match first_box(self.tree, &sight.ray, self.interval, counters) {
            None => self.light.scene.background.color,
            Some(face) => {
                let color = cell_color(face.count.min(16) as u8);
                shaded_face(&self.light, &sight.ray, face.axis, face.t, color)
            }
        }
    }
}
