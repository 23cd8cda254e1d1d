//! A9T4: a tree of boxes that finds the nearest triangle.
//!
//! Unlike the trees of assignment 6, which look along a ray, this one looks around a point: the
//! side of a node that is nearer is visited first, and what is farther than the best triangle so
//! far is left out. Cut at the median of the longest side, which for triangles of a surface is as
//! good as any rule.

use super::point::nearest_on_triangle;
use common::math::{Bounds, DVec3, Vec3};
use common::mesh::Mesh;

/// Triangles of a leaf, at most.
const LEAF: usize = 4;
/// Parts smaller than this are built by the thread that has them.
const WORTH_A_THREAD: usize = 8192;
/// What is left out must be farther by more than the roundings of a distance: six of half an
/// epsilon for the box, a dozen for the triangle; this is twice that.
const SLACK: f64 = 1.0 + 16.0 * f64::EPSILON;

/// A node; its left child follows it.
#[derive(Clone, Copy, Debug)]
struct Node {
    bounds: Bounds,
    /// Of an inner node: the number of nodes from here to the right child. Of a leaf: its first
    /// triangle.
    skip: u32,
    /// Triangles of a leaf; 0 says that it is an inner node.
    count: u32,
}

/// What is nearest to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// Square of the distance.
    pub squared: f64,
    /// The triangle's number; where several are equally near, the lowest of those.
    pub triangle: u32,
    /// Its place in the tree: a good hint for a point close by.
    pub place: u32,
    /// The point of the triangle.
    pub point: DVec3,
}

impl Nearest {
    const NONE: Self =
        Self { squared: f64::INFINITY, triangle: u32::MAX, place: u32::MAX, point: DVec3::INFINITY };

    /// The distance.
    pub fn distance(&self) -> f64 {
        self.squared.sqrt()
    }
}

/// Triangles in a tree.
pub struct Tree {
    nodes: Vec<Node>,
    corners: Vec<[DVec3; 3]>,
    numbers: Vec<u32>,
}

struct Item {
    bounds: Bounds,
    number: u32,
}

impl Tree {
    /// Builds a tree over triangles with finite corners that single precision can hold. The same
    /// on any number of threads.
    ///
    /// # Panics
    /// If there are 2³² triangles or more.
    pub fn new(corners: &[[DVec3; 3]]) -> Self {
        assert!(u32::try_from(corners.len()).is_ok(), "too many triangles");
        let item = |(number, corners): (u32, &[DVec3; 3])| Item {
            bounds: Bounds::of_points(corners.map(|p| p.as_vec3())),
            number,
        };
        let mut items: Vec<Item> = (0..).zip(corners).map(item).collect();
        let nodes = if items.is_empty() { Vec::new() } else { build(&mut items, 0) };
        let numbers: Vec<u32> = items.iter().map(|item| item.number).collect();
        let corners = numbers.iter().map(|&n| corners[n as usize]).collect();
        Self { nodes, corners, numbers }
    }

    /// A tree over the triangles of a mesh.
    pub fn of_mesh(mesh: &Mesh) -> Self {
        let corner = |v: u32| mesh.positions[v as usize].as_dvec3();
        Self::new(&mesh.triangles.iter().map(|t| t.map(corner)).collect::<Vec<_>>())
    }

    /// The triangle that is nearest to `p`; `None` if there is none at all. `hint` is the place of
    /// a triangle that is probably near; it changes how long the search takes and nothing else.
    pub fn nearest(&self, p: DVec3, hint: Option<u32>) -> Option<Nearest> {
        let best = self.search(p, hint, |_| false);
        (best.triangle != u32::MAX).then_some(best)
    }

    /// As [`Tree::nearest`], but `None` also if some triangle is within the square root of
    /// `squared`; that is found out sooner than which is nearest.
    pub fn nearest_beyond(&self, p: DVec3, squared: f64, hint: Option<u32>) -> Option<Nearest> {
        let best = self.search(p, hint, |found| found.squared <= squared);
        (best.triangle != u32::MAX && best.squared > squared).then_some(best)
    }

    /// Whether some triangle within the distance √`squared` of `p`, as far as rounding can tell,
    /// passes the test.
    pub fn any_within(&self, p: DVec3, squared: f64, mut test: impl FnMut(u32) -> bool) -> bool {
        let reach = squared * SLACK;
        let mut stack = vec![0];
        while let Some(at) = stack.pop() {
            let Some(node) = self.nodes.get(at) else { continue };
            if squared_distance(&node.bounds, p) > reach {
                continue;
            }
            if node.count == 0 {
                stack.extend([at + node.skip as usize, at + 1]);
                continue;
            }
            let near =
                |&place: &usize| nearest_on_triangle(p, self.corners[place]).distance_squared(p) <= reach;
            if node.places().filter(near).any(|place| test(self.numbers[place])) {
                return true;
            }
        }
        false
    }

    /// Goes through the tree from near to far until nothing can be nearer than the best, or the
    /// best is `enough`.
    fn search(&self, p: DVec3, hint: Option<u32>, enough: impl Fn(&Nearest) -> bool) -> Nearest {
        let mut best = Nearest::NONE;
        if let Some(place) = hint.filter(|place| (*place as usize) < self.numbers.len()) {
            self.ask(p, place as usize, &mut best);
        }
        // Deep enough for a tree halved 32 times, one waiting child for each level.
        let mut stack = [(0usize, 0.0f64); 48];
        let mut waiting = usize::from(!self.nodes.is_empty());
        while waiting > 0 && !enough(&best) {
            waiting -= 1;
            let (at, squared) = stack[waiting];
            if squared > best.squared * SLACK {
                continue;
            }
            let node = &self.nodes[at];
            if node.count > 0 {
                node.places().for_each(|place| self.ask(p, place, &mut best));
                continue;
            }
            let children = [at + 1, at + node.skip as usize];
            let [left, right] = children.map(|child| (child, squared_distance(&self.nodes[child].bounds, p)));
            let (near, far) = if right.1 < left.1 { (right, left) } else { (left, right) };
            stack[waiting] = far;
            stack[waiting + 1] = near;
            waiting += 2;
        }
        best
    }

    fn ask(&self, p: DVec3, place: usize, best: &mut Nearest) {
        let point = nearest_on_triangle(p, self.corners[place]);
        let (squared, triangle) = (point.distance_squared(p), self.numbers[place]);
        if squared < best.squared || (squared == best.squared && triangle < best.triangle) {
            *best = Nearest { squared, triangle, place: place as u32, point };
        }
    }
}

impl Node {
    fn places(&self) -> std::ops::Range<usize> {
        self.skip as usize..(self.skip + self.count) as usize
    }
}

/// Nodes of a part whose first triangle is at `first` of all.
fn build(items: &mut [Item], first: u32) -> Vec<Node> {
    let bounds = items.iter().fold(Bounds::EMPTY, |all, item| all.union(&item.bounds));
    if items.len() <= LEAF {
        return vec![Node { bounds, skip: first, count: items.len() as u32 }];
    }
    let middle = items.len() / 2;
    let center = |item: &Item| item.bounds.min + item.bounds.max;
    let size = Bounds::of_points(items.iter().map(center)).size();
    let axis = if size.x >= size.y.max(size.z) { 0 } else { 1 + usize::from(size.z > size.y) };
    // The number decides between equals, so that the tree is one and the same.
    items.select_nth_unstable_by(middle, |a, b| {
        center(a)[axis].total_cmp(&center(b)[axis]).then(a.number.cmp(&b.number))
    });
    let threads = items.len() >= WORTH_A_THREAD;
    let (low, high) = items.split_at_mut(middle);
    let (mut left, mut right) = (|| build(low, first), || build(high, first + middle as u32));
    let (left, right) = if threads { rayon::join(left, right) } else { (left(), right()) };
    let mut nodes = Vec::with_capacity(1 + left.len() + right.len());
    nodes.push(Node { bounds, skip: 1 + left.len() as u32, count: 0 });
    nodes.extend(left);
    nodes.extend(right);
    nodes
}

/// Square of the distance from a point to a box; 0 inside.
#[inline]
fn squared_distance(bounds: &Bounds, p: DVec3) -> f64 {
    let away = |low: Vec3, high: Vec3| (low.as_dvec3() - p).max(p - high.as_dvec3()).max(DVec3::ZERO);
    away(bounds.min, bounds.max).length_squared()
}

#[cfg(test)]
mod tests;
