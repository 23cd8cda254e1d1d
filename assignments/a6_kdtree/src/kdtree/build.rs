//! From the root down: choose a plane, divide what the node holds, go on with both parts.

use super::clip::halves;
use super::event::{self, Events, Fate, MAX_REFERENCES};
use super::reference::{self, Reference, solid_index};
use super::sah::{self, Split, cheapest_split, leaf_cost};
use common::geometry::Geometry;
use common::math::Bounds;
use common::shape::triangle_block::LANES;

/// Most planes between the root and a leaf.
pub const MAX_DEPTH: u32 = 60;

/// Nodes with fewer references are built by one thread.
const WORTH_A_THREAD: usize = 2048;

/// References that all leaves together may hold, per primitive: what cannot be told apart by
/// planes must not be copied into ever more leaves.
const MOST_COPIES: usize = 4;

/// Where a node is cut.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Rule {
    /// In the middle of its longest side
    Median,
    /// So that both sides hold the same number of primitives, across its longest side
    Objects,
    /// Where the surface area heuristic expects rays to cost least
    #[default]
    Sah,
}

impl Rule {
    /// All rules, for those who compare them.
    pub const ALL: [Self; 3] = [Self::Median, Self::Objects, Self::Sah];
}

/// How to build.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// Where nodes are cut.
    pub rule: Rule,
    /// Most planes between root and leaf, at most [`MAX_DEPTH`]. Else the median rules end at
    /// 8 + 1.3 log₂ n and the heuristic where it pays no more.
    pub max_depth: Option<u32>,
    /// Nodes with no more primitives than this are not cut. Else two blocks' worth for the
    /// median rules (about what the heuristic arrives at), and the heuristic decides for itself.
    pub leaf: Option<u32>,
}

/// The tree while it is built.
pub enum Tree {
    /// Primitives, see [`Reference::primitive`]; ascending.
    Leaf(Vec<u32>),
    /// A plane and what lies before and behind it.
    Inner {
        /// 0, 1, 2: across x, y, z.
        axis: usize,
        /// Where.
        at: f32,
        /// The lower side, the upper side.
        children: Box<[Tree; 2]>,
    },
}

/// A node before it is cut.
struct Cell {
    bounds: Bounds,
    references: Vec<Reference>,
    /// Sorted; empty if the rule does not ask for them.
    events: Events,
    depth: u32,
    /// References that the leaves below may hold.
    budget: usize,
}

/// Builds trees over one geometry.
pub struct Builder<'g> {
    geometry: &'g Geometry,
    rule: Rule,
    max_depth: u32,
    leaf: usize,
}

impl<'g> Builder<'g> {
    /// For `n` finite primitives.
    pub fn new(geometry: &'g Geometry, options: &Options, n: usize) -> Self {
        let heuristic = options.rule == Rule::Sah;
        let usual_depth = if heuristic { MAX_DEPTH } else { 8 + (1.3 * (n as f64).log2()) as u32 };
        let usual_leaf = if heuristic { 0 } else { 2 * LANES as u32 };
        Self {
            geometry,
            rule: options.rule,
            max_depth: options.max_depth.unwrap_or(usual_depth).min(MAX_DEPTH),
            leaf: options.leaf.unwrap_or(usual_leaf) as usize,
        }
    }

    /// The tree over all finite primitives, of which there is at least one; the same whatever
    /// the number of threads.
    ///
    /// # Panics
    /// If there are more than 2²⁹ primitives.
    pub fn build(&self, references: Vec<Reference>, bounds: Bounds) -> Tree {
        assert!(references.len() < MAX_REFERENCES, "at most 2^29 primitives");
        let budget = references.len() * MOST_COPIES;
        let events = if self.rule == Rule::Sah { self.events(&references) } else { Events::default() };
        self.subtree(Cell { bounds, references, events, depth: 0, budget })
    }

    fn is_solid(&self, reference: &Reference) -> bool {
        solid_index(self.geometry, reference.primitive).is_some()
    }

    fn events(&self, references: &[Reference]) -> Events {
        let mut events: Events = std::array::from_fn(|_| Vec::with_capacity(2 * references.len()));
        for (i, reference) in references.iter().enumerate() {
            event::push(&mut events, &reference.bounds, self.is_solid(reference), i);
        }
        let [x, y, z] = &mut events;
        rayon::join(|| x.sort_unstable(), || rayon::join(|| y.sort_unstable(), || z.sort_unstable()));
        events
    }

    fn subtree(&self, cell: Cell) -> Tree {
        let Some(split) = self.choose(&cell) else { return leaf(cell.references) };
        let [left, right] = match self.divide(cell, &split) {
            Ok(children) => children,
            Err(references) => return leaf(references),
        };
        let parallel = left.references.len().min(right.references.len()) >= WORTH_A_THREAD;
        let (left, right) = if parallel {
            rayon::join(|| self.subtree(left), || self.subtree(right))
        } else {
            (self.subtree(left), self.subtree(right))
        };
        Tree::Inner { axis: split.axis, at: split.at, children: Box::new([left, right]) }
    }

    /// The plane to cut at; `None` makes a leaf.
    fn choose(&self, cell: &Cell) -> Option<Split> {
        if cell.references.len() <= self.leaf.max(usize::from(self.rule != Rule::Sah))
            || cell.references.is_empty()
            || cell.depth >= self.max_depth
        {
            return None;
        }
        match self.rule {
            Rule::Sah => {
                let total = cell.references.iter().map(|r| sah::weight(self.is_solid(r))).sum();
                let cheapest = cheapest_split(&cell.events, &cell.bounds, total);
                cheapest.filter(|split| split.cost < leaf_cost(total))
            }
            Rule::Median => cell.across_longest(|axis| {
                let (low, high) = (cell.bounds.min[axis], cell.bounds.max[axis]);
                low / 2.0 + high / 2.0
            }),
            Rule::Objects => cell.across_longest(|axis| {
                let center = |r: &Reference| r.bounds.min[axis] / 2.0 + r.bounds.max[axis] / 2.0;
                let mut centers: Vec<f32> = cell.references.iter().map(center).collect();
                let middle = centers.len() / 2;
                *centers.select_nth_unstable_by(middle, f32::total_cmp).1
            }),
        }
    }

    /// Both children, or the references back if the leaves would hold too many.
    fn divide(&self, cell: Cell, split: &Split) -> Result<[Cell; 2], Vec<Reference>> {
        let n = cell.references.len();
        let mut sides = [Vec::with_capacity(n), Vec::with_capacity(n)];
        let (mut fates, mut clipped) = (Vec::with_capacity(n), Vec::new());
        for reference in &cell.references {
            match reference.side(split) {
                Some(side) => {
                    fates.push(Fate::child(side, sides[side].len()));
                    sides[side].push(*reference);
                }
                None => {
                    fates.push(Fate::CLIPPED);
                    clipped.push(reference);
                }
            }
        }
        let mut fresh = [Events::default(), Events::default()];
        for reference in clipped {
            let parts = reference.parts(self.geometry, split);
            for (side, bounds) in parts.into_iter().enumerate().filter_map(|(s, b)| Some((s, b?))) {
                if self.rule == Rule::Sah {
                    event::push(&mut fresh[side], &bounds, self.is_solid(reference), sides[side].len());
                }
                sides[side].push(Reference { bounds, primitive: reference.primitive });
            }
        }
        let total = sides[0].len() + sides[1].len();
        if total > cell.budget {
            return Err(cell.references);
        }
        let events = inherit(&cell.events, &fates, fresh);
        let boxes = halves(&cell.bounds, split.axis, split.at);
        let mut made = sides.into_iter().zip(events).zip(boxes).map(|((references, events), bounds)| {
            let budget = cell.budget * references.len() / total.max(1);
            Cell { bounds, references, events, depth: cell.depth + 1, budget }
        });
        Ok(std::array::from_fn(|_| made.next().expect("there are two sides")))
    }
}

/// The children's events: those of whole references kept in order, the fresh ones merged in.
fn inherit(events: &Events, fates: &[Fate], fresh: [Events; 2]) -> [Events; 2] {
    let mut inherited = fresh;
    for (axis, old) in events.iter().enumerate() {
        let kept = event::hand_down(old, fates);
        for (child, mut kept) in inherited.iter_mut().zip(kept) {
            event::merge(&mut kept, std::mem::take(&mut child[axis]));
            child[axis] = kept;
        }
    }
    inherited
}

fn leaf(references: Vec<Reference>) -> Tree {
    let mut primitives: Vec<u32> = references.iter().map(|r| r.primitive).collect();
    primitives.sort_unstable();
    Tree::Leaf(primitives)
}

impl Cell {
    /// The plane that `place` gives for the longest side along which it tells something apart.
    fn across_longest(&self, place: impl Fn(usize) -> f32) -> Option<Split> {
        let size = self.bounds.max.as_dvec3() - self.bounds.min.as_dvec3();
        let mut axes = [0, 1, 2];
        axes.sort_by(|&a, &b| size[b].total_cmp(&size[a]));
        let split = |axis| Split { axis, at: place(axis), planar_left: true, cost: 0.0 };
        axes.into_iter().map(split).find(|split| {
            let inside = self.bounds.min[split.axis] < split.at && split.at < self.bounds.max[split.axis];
            inside && self.references.iter().any(|r| r.side(split).is_some())
        })
    }
}

/// Builds the tree over everything finite; `None` if there is nothing.
pub fn build(geometry: &Geometry, options: &Options) -> Option<(Tree, Bounds)> {
    let references = reference::all(geometry);
    if references.is_empty() {
        return None;
    }
    let bounds = references.iter().fold(Bounds::EMPTY, |b, r| b.union(&r.bounds));
    let builder = Builder::new(geometry, options, references.len());
    Some((builder.build(references, bounds), bounds))
}
