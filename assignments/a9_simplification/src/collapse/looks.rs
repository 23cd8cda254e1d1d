//! Where does a surface look, near a place? Bounds of normals in cells: most triangles of the original
//! look along all of those near them, and so nothing need be asked of them one by one.

use crate::collapse::against::Probe;
use crate::collapse::lattice::Lattice;

/// A component of one, in units of which normals are bounded.
const ONE: f64 = 511.0;
/// More than what is lost by the rounding of three components, each times another.
const LOST: i32 = 800;

/// Least components of some normals, and of their opposites; every fourth is not used.
pub(super) type Least = [i16; 8];

/// Bounds of normals in the slots of a lattice.
pub(super) struct Looks {
    least: Vec<Least>,
}

/// A direction: how much each bound of normals adds to the least cosine.
pub(super) struct Look(Least);

impl Look {
    /// Of a normal's components, in units of 1/511 of the largest.
    #[inline(always)]
    pub(super) fn of([x, y, z]: [i16; 3]) -> Self {
        Self([x.max(0), y.max(0), z.max(0), 0, (-x).max(0), (-y).max(0), (-z).max(0), 0])
    }
}

impl Looks {
    /// Of probes, each in all cells within its reach.
    pub(super) fn new(lattice: Lattice, probes: &[Probe]) -> Self {
        let mut least = vec![[i16::MAX; 8]; lattice.slots()];
        for probe in probes {
            let unit = probe.normal * (ONE / probe.normal.abs().max_element());
            // What is no number becomes 0, along which nothing looks for certain.
            // The next integer below, or one less; `floor` is slow where processors lack it.
            let below = |c: f64| c as i16 - i16::from(c < 0.0);
            let [x, y, z] = unit.to_array().map(below);
            let [u, v, w] = unit.to_array().map(|c| below(-c));
            let other = [x, y, z, 0, u, v, w, 0];
            let cells = probe.cells(&lattice);
            if !cells.are_many() {
                lattice.each(&cells, |slot| {
                    let least = &mut least[slot];
                    *least = std::array::from_fn(|i| least[i].min(other[i]));
                });
            }
        }
        Self { least }
    }

    /// Whether all normals in a slot are known to be within a right angle of a direction.
    #[inline(always)]
    pub(super) fn all_along(&self, slot: usize, look: &Look) -> bool {
        let sum: i32 = self.least[slot].iter().zip(look.0).map(|(&a, b)| i32::from(a) * i32::from(b)).sum();
        sum > LOST
    }
}
