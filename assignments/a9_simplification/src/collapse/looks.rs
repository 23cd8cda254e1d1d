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

#[cfg(test)]
mod tests {
    use super::*;
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

    /// Whether all of some probes at one place, with these normals, are known to be along a direction.
    fn are_along(normals: &[DVec3], way: DVec3) -> bool {
        let lattice = Lattice::new(DVec3::ZERO, 1.0, 64);
        let probe = |&normal: &DVec3| Probe { middle: DVec3::splat(2.5), normal, reach: 0.1 };
        let probes: Vec<Probe> = normals.iter().map(probe).collect();
        let looks = Looks::new(lattice, &probes);
        let mut all = true;
        lattice.each(&probes[0].cells(&lattice), |slot| all &= looks.all_along(slot, &look(way)));
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
        let looks = Looks::new(lattice, &[]);
        assert!((0..lattice.slots()).all(|slot| looks.all_along(slot, &look(DVec3::NEG_ONE))));
    }
}
