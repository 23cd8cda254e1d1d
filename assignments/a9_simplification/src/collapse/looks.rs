//! Where does a surface look, near a place? Bounds of normals in cells: most triangles of the original
//! look along all of those near them, and so nothing need be asked of them one by one.

use crate::collapse::lattice::{Cells, Lattice};
use common::math::DVec3;

/// A component of one, in units of which normals are bounded.
const ONE: f64 = 511.0;
/// More than what is lost by the rounding of three components, each times another.
const LOST: i32 = 800;

/// Least components of some normals, and of their opposites; in place of a fourth stands whose cell they are in.
pub(super) type Least = [i16; 8];

/// Of no normals.
const NOTHING: Least = [i16::MAX; 8];
/// Whose several cells are that share a slot; as the least of all it stays so.
const SHARED: i16 = i16::MIN;

/// Bounds of normals in the slots of a lattice.
pub(super) struct Looks {
    lattice: Lattice,
    least: Vec<Least>,
    /// Whether some are in so many cells that they can be met anywhere.
    pub anywhere: bool,
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
    /// Of nothing yet.
    pub(super) fn new(lattice: Lattice) -> Self {
        Self { lattice, least: vec![NOTHING; lattice.slots()], anywhere: false }
    }

    /// Adds a normal with such bounds to some cells.
    #[inline(always)]
    pub(super) fn add(&mut self, cells: &Cells, bounds: &Least) {
        if cells.are_many() {
            self.anywhere = true;
            return;
        }
        let mut bounds = *bounds;
        self.lattice.each_named(cells, |slot, name| {
            let least = &mut self.least[slot];
            bounds[3] = if least[3] == name || *least == NOTHING { name } else { SHARED };
            *least = std::array::from_fn(|i| least[i].min(bounds[i]));
        });
    }

    /// Calls `what` with the slots of those cells in which not all normals are known to be within a right angle of
    /// a direction.
    #[inline(always)]
    pub(super) fn not_along(&self, cells: &Cells, look: &Look, mut what: impl FnMut(usize)) {
        if cells.are_many() {
            return;
        }
        self.lattice.each_named(cells, |slot, name| {
            let least = &self.least[slot];
            // Most slots have nothing of this cell in them.
            if (least[3] == name || least[3] == SHARED) && !are_along(least, look) {
                what(slot);
            }
        });
    }
}

/// Bounds of a normal, given as for [`Look::of`].
#[inline(always)]
pub(super) fn around([x, y, z]: [i16; 3]) -> Least {
    [x - 1, y - 1, z - 1, 0, -x - 1, -y - 1, -z - 1, 0]
}

/// Components of a normal, and of its opposite, that are at least as much and at most two more than these.
#[inline(always)]
pub(super) fn bounds(normal: DVec3) -> Least {
    let unit = normal * (ONE / normal.abs().max_element());
    // What is no number becomes 0, along which nothing looks for certain. Rounds by cutting off, as `floor` is slow
    // where processors lack it.
    around([unit.x as i16, unit.y as i16, unit.z as i16])
}

/// Whether all normals with these bounds are known to be within a right angle of a direction.
#[inline(always)]
pub(super) fn are_along(least: &Least, Look(look): &Look) -> bool {
    let sum: i32 = least.iter().zip(look).map(|(&a, &b)| i32::from(a) * i32::from(b)).sum();
    sum > LOST
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collapse::against::Probe;
    use crate::collapse::surface::Face;
    use common::math::DVec3;

    /// Directions in all octants, and along axes and diagonals.
    fn directions() -> Vec<DVec3> {
        let axis = |i: i32| f64::from(i % 7 - 3) + 0.1 * f64::from(i % 3);
        let lattice = (0..343).map(|i| DVec3::new(axis(i), axis(i / 7), axis(i / 49)));
        lattice.chain([DVec3::X, DVec3::NEG_Y, DVec3::ONE]).filter(|way| way.length() > 0.0).collect()
    }

    fn look(way: DVec3) -> Look {
        let mut face = Face::new([0, 1, 2]);
        face.remember(way);
        Look::of(face.look())
    }

    fn probes(lattice: &Lattice, middle: DVec3, normals: &[DVec3]) -> Vec<Probe> {
        let probe = |&normal: &DVec3| {
            let probe = Probe { middle, normal, reach: 0.1, cells: Cells::default(), least: bounds(normal) };
            Probe { cells: probe.around(lattice), ..probe }
        };
        normals.iter().map(probe).collect()
    }

    fn looks(lattice: Lattice, probes: &[Probe]) -> Looks {
        let mut looks = Looks::new(lattice);
        probes.iter().for_each(|probe| looks.add(&probe.cells, &probe.least));
        looks
    }

    /// Whether all of some probes at one place, with these normals, are known to be along a direction.
    fn are_along(normals: &[DVec3], way: DVec3) -> bool {
        let lattice = Lattice::new(DVec3::ZERO, 1.0, 64);
        let probes = probes(&lattice, DVec3::splat(2.5), normals);
        let mut all = true;
        looks(lattice, &probes).not_along(&probes[0].cells, &look(way), |_| all = false);
        all
    }

    /// What is said of a normal must be true, and be said unless it is nearly at a right angle.
    #[test]
    fn a_normal_is_along_what_it_makes_less_than_a_right_angle_with() {
        for normal in directions() {
            for way in directions() {
                let cosine = normal.normalize().dot(way.normalize());
                let told = are_along(&[normal * 1e-9], way);
                assert!(!told || cosine > 0.0, "{normal} {way}");
                assert!(told || cosine < 0.02, "{normal} {way}");
            }
        }
    }

    #[test]
    fn one_that_looks_elsewhere_is_enough() {
        let most = [DVec3::Z, DVec3::new(0.3, 0.0, 1.0), DVec3::new(0.0, -0.4, 1.0)];
        assert!(are_along(&most, DVec3::new(0.1, 0.2, 1.0)));
        for other in [DVec3::NEG_Z, DVec3::X - DVec3::Z, DVec3::ZERO, DVec3::NAN] {
            let [a, b, c] = most;
            assert!(!are_along(&[a, b, other, c], DVec3::new(0.1, 0.2, 1.0)), "{other}");
        }
    }

    #[test]
    fn where_nothing_is_nothing_looks_elsewhere() {
        let lattice = Lattice::new(DVec3::ZERO, 1.0, 64);
        let looks = looks(lattice, &[]);
        let everywhere = lattice.cells(DVec3::splat(-4.0), DVec3::splat(4.0));
        looks.not_along(&everywhere, &look(DVec3::NEG_ONE), |_| panic!("there is none"));
    }

    /// Cells that share their only slot: what is in one of them says nothing of the other, until both are in it.
    #[test]
    fn who_shares_a_slot_is_not_mistaken_for_another() {
        let lattice = Lattice::new(DVec3::ZERO, 1.0, 1);
        let [here, there] = [DVec3::splat(2.5), DVec3::new(9.5, -7.5, 3.5)];
        let mut all = probes(&lattice, here, &[DVec3::Z]);
        all.extend(probes(&lattice, there, &[DVec3::NEG_Z]));
        let told = |known: &[Probe], asked: &Probe| {
            let mut told = false;
            looks(lattice, known).not_along(&asked.cells, &look(DVec3::NEG_Z), |_| told = true);
            told
        };
        assert!(told(&all[..1], &all[0]) && !told(&all[..1], &all[1]));
        assert!(told(&all, &all[0]) && told(&all, &all[1]));
    }
}
