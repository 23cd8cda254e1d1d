//! From the root down: choose a plane, divide what the node holds, go on with both parts.

use super::clip::halves;
use super::coarse;
use super::event::{self, Event, Events, MAX_REFERENCES};
use super::pile::{Base, Fresh, Pile};
use super::plan::{Plan, PlanNode};
use super::reference::{self, Reference, solid_index};
use super::rule::{MAX_DEPTH, Options, Rule};
use super::sah::{self, Split, cheapest_split};
use common::geometry::Geometry;
use common::math::Bounds;
use common::shape::triangle_block::LANES;

/// Nodes with fewer references are built by one thread.
const WORTH_A_THREAD: usize = 2048;

/// Nodes with more references choose among planes at equal distances ([`coarse`]); the rest
/// among all that could be best.
const LARGE: usize = 4096;

/// References that all leaves together may hold, per primitive: what cannot be told apart by
/// planes must not be copied into ever more leaves.
const MOST_COPIES: usize = 4;

/// A node before it is cut.
struct Cell {
    bounds: Bounds,
    /// From where on the pile is its own.
    base: Base,
    /// Whether its events are there.
    is_sorted: bool,
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
    pub fn build(&self, references: Vec<Reference>, bounds: Bounds) -> Plan {
        assert!(references.len() < MAX_REFERENCES, "at most 2^29 primitives");
        let budget = references.len() * MOST_COPIES;
        let mut pile = Pile::new(references, Events::default());
        let mut plan = Plan::default();
        let root = Cell { bounds, base: Base::default(), is_sorted: false, depth: 0, budget };
        self.subtree(root, &mut pile, &mut plan);
        plan
    }

    fn weight(&self, references: &[Reference]) -> u32 {
        if self.geometry.solids().is_empty() {
            return references.len() as u32 * sah::weight(false);
        }
        references.iter().map(|r| sah::weight(self.is_solid(r))).sum()
    }

    fn is_solid(&self, reference: &Reference) -> bool {
        solid_index(self.geometry, reference.primitive).is_some()
    }

    /// The plane to cut at; `None` makes a leaf.
    fn find(&self, cell: &mut Cell, pile: &mut Pile) -> Option<Split> {
        let count = pile.references.len() - cell.base.references;
        if count <= LARGE {
            self.sort(cell, pile);
        }
        let split = self.choose(cell, pile.references(&cell.base));
        if split.is_some() || cell.is_sorted || self.rule != Rule::Sah {
            return split;
        }
        // What lies close together tells itself apart where no plane at equal distances does.
        self.sort(cell, pile);
        self.choose(cell, pile.references(&cell.base))
    }

    /// Sorts the boxes' ends once and for all that is below.
    fn sort(&self, cell: &mut Cell, pile: &mut Pile) {
        if self.rule == Rule::Sah && !cell.is_sorted {
            pile.sort(&cell.base, |reference| self.is_solid(reference));
            cell.is_sorted = true;
        }
    }

    /// Adds the subtree of the cell on top of the pile, and takes that off.
    fn subtree(&self, mut cell: Cell, pile: &mut Pile, plan: &mut Plan) {
        let split = self.find(&mut cell, pile);
        let Some((split, [left, right])) = split.and_then(|s| Some((s, self.divide(&cell, &s, pile)?)))
        else {
            plan.leaf(pile.references(&cell.base).0);
            pile.take_off(&cell.base);
            return;
        };
        plan.nodes.push(PlanNode::Inner(split.axis as u8, split.at));
        let lower = pile.references.len() - left.base.references;
        let upper = left.base.references - right.base.references;
        if lower.min(upper) < WORTH_A_THREAD {
            self.subtree(left, pile, plan);
            self.subtree(right, pile, plan);
            return;
        }
        let mut own = pile.split_off(&left.base);
        let left = Cell { base: Base::default(), ..left };
        let mut plans = [Plan::default(), Plan::default()];
        let [left_plan, right_plan] = &mut plans;
        rayon::join(|| self.subtree(left, &mut own, left_plan), || self.subtree(right, pile, right_plan));
        plans.into_iter().for_each(|below| plan.append(below));
    }

    /// The plane by the rule; with the heuristic, by the events if they are there.
    fn choose(&self, cell: &Cell, (references, events): (&[Reference], [&[Event]; 3])) -> Option<Split> {
        if references.len() <= self.leaf.max(usize::from(self.rule != Rule::Sah))
            || references.is_empty()
            || cell.depth >= self.max_depth
        {
            return None;
        }
        match self.rule {
            Rule::Sah => {
                let total = self.weight(references);
                if sah::is_surely_leaf(total) {
                    return None;
                }
                let cheapest = if cell.is_sorted {
                    cheapest_split(events, &cell.bounds, total)
                } else {
                    coarse::cheapest_split(references, &cell.bounds, |r| sah::weight(self.is_solid(r)))
                };
                cheapest.filter(|split| split.cost < f64::from(sah::price(total)))
            }
            Rule::Median => cell.across(cell.longest_first(), references, |axis| {
                let (low, high) = (cell.bounds.min[axis], cell.bounds.max[axis]);
                low / 2.0 + high / 2.0
            }),
            Rule::Objects => {
                cell.across(cell.longest_first(), references, |axis| median_center(references, axis))
            }
            Rule::Textbook => cell.across(cell.in_turn(), references, |axis| median_center(references, axis)),
        }
    }

    /// Both children, the lower one on top of the pile; `None` if the leaves would hold too many.
    fn divide(&self, cell: &Cell, split: &Split, pile: &mut Pile) -> Option<[Cell; 2]> {
        let whole = pile.judge(&cell.base, split);
        for clipped in 0..pile.clipped.len() {
            let reference = pile.references[pile.clipped[clipped] as usize];
            let parts = match self.rule.clips() {
                true => reference.parts(self.geometry, split),
                false => [Some(reference.bounds); 2],
            };
            for (side, bounds) in parts.into_iter().enumerate() {
                let Some(bounds) = bounds else { continue };
                let Fresh { references, events } = &mut pile.fresh[side];
                if cell.is_sorted {
                    let index = whole[side] as usize + references.len();
                    event::push(events, &bounds, self.is_solid(&reference), index);
                }
                references.push(Reference { bounds, primitive: reference.primitive });
            }
        }
        let sizes = [0, 1].map(|side| whole[side] as usize + pile.fresh[side].references.len());
        let total = sizes[0] + sizes[1];
        if total > cell.budget {
            pile.fresh = Default::default();
            return None;
        }
        let surely_leaf = |size: usize| self.geometry.solids().is_empty() && sah::is_surely_leaf(size as u32);
        let bases = [pile.divide(&cell.base, sizes.map(|size| !surely_leaf(size))), cell.base];
        let [left, right] = halves(&cell.bounds, split.axis, split.at);
        let child = |side: usize, bounds: Bounds| {
            let budget = cell.budget * sizes[side] / total.max(1);
            Cell { bounds, base: bases[side], is_sorted: cell.is_sorted, depth: cell.depth + 1, budget }
        };
        Some([child(0, left), child(1, right)])
    }
}

impl Cell {
    /// The axes from the longest side to the shortest.
    fn longest_first(&self) -> [usize; 3] {
        let size = self.bounds.max.as_dvec3() - self.bounds.min.as_dvec3();
        let mut axes = [0, 1, 2];
        axes.sort_by(|&a, &b| size[b].total_cmp(&size[a]));
        axes
    }

    /// The axes, another one first on every level.
    fn in_turn(&self) -> [usize; 3] {
        [0, 1, 2].map(|i| (self.depth as usize + i) % 3)
    }

    /// The plane that `place` gives for the first axis along which it tells something apart.
    fn across(
        &self,
        axes: [usize; 3],
        references: &[Reference],
        place: impl Fn(usize) -> f32,
    ) -> Option<Split> {
        let split = |axis| Split { axis, at: place(axis), planar_left: true, cost: 0.0 };
        axes.into_iter().map(split).find(|split| {
            let inside = self.bounds.min[split.axis] < split.at && split.at < self.bounds.max[split.axis];
            inside && references.iter().any(|r| r.side(split) < 2)
        })
    }
}

/// The median of the centers of all boxes along an axis; there is at least one.
fn median_center(references: &[Reference], axis: usize) -> f32 {
    let center = |r: &Reference| r.bounds.min[axis] / 2.0 + r.bounds.max[axis] / 2.0;
    let mut centers: Vec<f32> = references.iter().map(center).collect();
    let middle = centers.len() / 2;
    *centers.select_nth_unstable_by(middle, f32::total_cmp).1
}

/// Builds the tree over everything finite; `None` if there is nothing.
pub fn build(geometry: &Geometry, options: &Options) -> Option<(Plan, Bounds)> {
    let references = reference::all(geometry);
    if references.is_empty() {
        return None;
    }
    let bounds = references.iter().fold(Bounds::EMPTY, |b, r| b.union(&r.bounds));
    let builder = Builder::new(geometry, options, references.len());
    Some((builder.build(references, bounds), bounds))
}
