//! Cubic cells that are found by hashing, so that neither empty space nor a crowded corner of it
//! costs anything.

use crate::collapse::surface::Surface;
use common::math::DVec3;

/// What meets more cells than this is better held against everything.
const MOST_CELLS: u64 = 1024;

/// The greatest number of a cell.
const FARTHEST: i32 = i16::MAX as i32;
/// How far the slots of neighbours along y and z are apart.
const BESIDE: i32 = 12_347;
const BEHIND: i32 = 7_654_321;

/// Numbers of a cell along the axes, and the same negative, so that the least of several is both the lowest
/// and the highest; every fourth is 0.
type Cell = [i16; 8];

/// Space, cut into cubes that share some slots.
#[derive(Clone, Copy)]
pub(super) struct Lattice {
    /// Where numbers begin.
    origin: DVec3,
    /// Cells for each unit of length, before the coarsening.
    fineness: f64,
    /// Cells are larger by that power of two.
    coarser: u32,
    /// All bits of a slot's number.
    last_slot: usize,
}

/// Cells in a box: the lowest, and how many more there are along each axis.
#[derive(Clone, Copy, Default)]
pub(super) struct Cells {
    low: [i32; 3],
    more: [u32; 3],
}

/// A surface of which the cells of all points are known.
pub(super) struct Grid<'a> {
    /// The surface.
    pub surface: &'a Surface,
    lattice: Lattice,
    /// Size of a cell.
    size: f64,
    cells: Vec<Cell>,
}

impl Lattice {
    /// Cells of a size, in at least so many slots.
    pub(super) fn new(origin: DVec3, size: f64, slots: usize) -> Self {
        let fineness = 1.0 / size.max(f64::MIN_POSITIVE);
        Self { origin, fineness, coarser: 0, last_slot: 0 }.with_slots(slots)
    }

    /// The same cells in at least so many slots.
    pub(super) fn with_slots(self, slots: usize) -> Self {
        Self { last_slot: slots.max(1).next_power_of_two() - 1, ..self }
    }

    /// How many slots there are.
    pub(super) fn slots(&self) -> usize {
        self.last_slot + 1
    }

    /// The cell of a place before the coarsening. What is near zero or very far off shares cells with what is
    /// beside it: all that matters is that numbers never fall along an axis.
    #[inline(always)]
    fn cell(&self, p: DVec3) -> Cell {
        let p = (p - self.origin) * self.fineness;
        let number = |x: f64| (x as i32).clamp(-FARTHEST, FARTHEST) as i16;
        let [x, y, z] = [number(p.x), number(p.y), number(p.z)];
        [x, y, z, 0, -x, -y, -z, 0]
    }

    /// The cells that a box meets.
    #[inline(always)]
    pub(super) fn cells(&self, low: DVec3, high: DVec3) -> Cells {
        self.between(least(self.cell(low), self.cell(high)))
    }

    /// From the least of the numbers of some cells to the greatest.
    #[inline(always)]
    fn between(&self, [x, y, z, _, u, v, w, _]: Cell) -> Cells {
        let coarse = |number: i16| i32::from(number) >> self.coarser;
        let (low, high) = ([x, y, z].map(coarse), [u, v, w].map(|number| coarse(-number)));
        Cells { low, more: std::array::from_fn(|i| (high[i] - low[i]) as u32) }
    }

    /// Calls `what` with the slot of each of some cells.
    #[inline(always)]
    pub(super) fn each(&self, cells: &Cells, mut what: impl FnMut(usize)) {
        self.each_named(cells, |slot, _| what(slot));
    }

    /// Calls `what` with the slot of each of some cells, and with a name that few others in that slot have: from 0 to
    /// 32766.
    #[inline(always)]
    pub(super) fn each_named(
        &self,
        Cells { low: [x, y, z], more }: &Cells,
        mut what: impl FnMut(usize, i16),
    ) {
        // Neighbours along x are neighbours in memory.
        let mut slot = x.wrapping_add(y.wrapping_mul(BESIDE)).wrapping_add(z.wrapping_mul(BEHIND));
        let [mut x_left, mut y_left, mut z_left] = *more;
        loop {
            what(slot as usize & self.last_slot, (slot >> 15) as i16 & 0x7ffe);
            if x_left > 0 {
                (x_left, slot) = (x_left - 1, slot.wrapping_add(1));
            } else if y_left > 0 {
                (x_left, y_left) = (more[0], y_left - 1);
                slot = slot.wrapping_add(BESIDE).wrapping_sub(more[0] as i32);
            } else if z_left > 0 {
                (x_left, y_left, z_left) = (more[0], more[1], z_left - 1);
                let back = (more[1] as i32).wrapping_mul(BESIDE).wrapping_add(more[0] as i32);
                slot = slot.wrapping_add(BEHIND).wrapping_sub(back);
            } else {
                return;
            }
        }
    }
}

#[inline(always)]
fn least(a: Cell, b: Cell) -> Cell {
    std::array::from_fn(|i| a[i].min(b[i]))
}

impl Cells {
    /// Whether there are so many that it is better not to ask for each.
    #[inline(always)]
    pub(super) fn are_many(&self) -> bool {
        let [x, y, z] = self.more.map(u64::from);
        (x + 1) * (y + 1) * (z + 1) > MOST_CELLS
    }
}

impl<'a> Grid<'a> {
    /// Cells of a size in mean sides of a surface's faces.
    pub(super) fn new(surface: &'a Surface, sides: f64) -> Self {
        let size = sides * mean_side(surface);
        let origin = if surface.points.is_empty() { DVec3::ZERO } else { surface.at(0) };
        let lattice = Lattice::new(origin, size, surface.faces.len());
        let cells = (0..surface.points.len() as u32).map(|point| lattice.cell(surface.at(point))).collect();
        Self { surface, lattice, size, cells }
    }

    /// Bytes that are held for all points.
    #[cfg(test)]
    pub(super) fn bytes(&self) -> usize {
        self.cells.capacity() * size_of::<Cell>()
    }

    /// Its lattice, with cells that are at least of a size and slots as many as faces.
    pub(super) fn coarser(&self, size: f64) -> Lattice {
        let coarser = (size / self.size).log2().ceil().clamp(0.0, 15.0) as u32;
        Lattice { coarser, ..self.lattice }
    }

    /// The cells of a lattice of its own that the box around a face meets.
    #[inline(always)]
    pub(super) fn cells(&self, lattice: &Lattice, face: u32) -> Cells {
        let [a, b, c] = self.surface.faces[face as usize].corners();
        let [a, b, c] = [self.cells[a as usize], self.cells[b as usize], self.cells[c as usize]];
        lattice.between(least(least(a, b), c))
    }
}

/// Mean length of some sides.
fn mean_side(surface: &Surface) -> f64 {
    let stride = 1 + surface.faces.len() / 1000;
    let side = |[a, b, _]: [u32; 3]| (surface.at(a) - surface.at(b)).length();
    let sides = surface.faces.iter().step_by(stride);
    sides.map(|face| side(face.corners())).sum::<f64>() * stride as f64 / surface.faces.len().max(1) as f64
}
