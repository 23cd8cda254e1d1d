//! A quick look around an edge: most may surely be drawn together, as single precision can tell, and where it cannot
//! [`Ring`](crate::collapse::ring::Ring) looks closely.

use crate::collapse::surface::{NONE, Surface, next};
use common::math::Vec3;
use common::math::lanes::LANES;
use common::simd::{self, dispatch};

/// Most faces that stay.
pub(super) const MOST: usize = 2 * LANES;

/// What is around an edge that is not on the boundary: the faces that stay share one side each with the rim, a closed line.
#[derive(Clone)]
pub(super) struct Rim {
    /// How many points there are on it, and how many of them begin a face at the start of the edge; those come first, the
    /// corner opposite the edge first of all.
    pub count: usize,
    pub of_start: usize,
    numbers: [u32; MOST],
    /// Where they are, seen from the start of the edge; the first comes once more at the end.
    pub points: [[f32; MOST + LANES]; 3],
    /// Where to the faces looked at first, as those remember it.
    pub looks: [u32; MOST],
    /// The edge.
    pub edge: Vec3,
    scale: f32,
    origin: Vec3,
}

impl Default for Rim {
    fn default() -> Self {
        Self {
            count: 0,
            of_start: 0,
            numbers: [NONE; MOST],
            points: [[0.0; MOST + LANES]; 3],
            looks: [0; MOST],
            edge: Vec3::ZERO,
            scale: 1.0,
            origin: Vec3::ZERO,
        }
    }
}

impl Rim {
    /// Whether the edge of a half-edge may surely be drawn together to a place: as [`Ring`](crate::collapse::ring::Ring)
    /// would find, and nothing is lost. If not, that is not known.
    #[inline(always)]
    pub(super) fn surely_keeps(&mut self, surface: &Surface, h: u32, place: Vec3) -> bool {
        self.look(surface, h) && self.keeps_topology() && {
            let place = (place - self.origin) * self.scale;
            dispatch!(simd::level(), s => self.keeps_shape(s, place))
        }
    }

    /// Walks around; false if that leads to the boundary, or is a long way.
    #[inline(always)]
    fn look(&mut self, surface: &Surface, h: u32) -> bool {
        let twin = surface.twin(h);
        if twin == NONE {
            return false;
        }
        (self.count, self.scale) = (0, surface.scale as f32);
        self.origin = surface.points[surface.start(h) as usize].at;
        self.edge = (surface.points[surface.end(h) as usize].at - self.origin) * self.scale;
        if !self.look_from(surface, h, twin) || self.count == 0 {
            return false;
        }
        self.of_start = self.count;
        if !self.look_from(surface, twin, h) || self.count == self.of_start {
            return false;
        }
        for axis in &mut self.points {
            axis[self.count] = axis[0];
        }
        true
    }

    /// From the face beyond that of a half-edge to that of its twin.
    #[inline(always)]
    fn look_from(&mut self, surface: &Surface, h: u32, twin: u32) -> bool {
        let last = next(twin);
        let mut spoke = surface.turn(h);
        while spoke != last {
            let at = self.count;
            if spoke == NONE || at >= MOST {
                return false;
            }
            let point = surface.end(spoke);
            let place = (surface.points[point as usize].at - self.origin) * self.scale;
            self.numbers[at] = point;
            (self.points[0][at], self.points[1][at], self.points[2][at]) = (place.x, place.y, place.z);
            self.looks[at] = surface.faces[(spoke >> 2) as usize].remembered();
            self.count += 1;
            spoke = surface.turn(spoke);
        }
        true
    }

    /// Whether the ends of the edge share no neighbours but the corners opposite it, and something is left.
    #[inline(always)]
    fn keeps_topology(&self) -> bool {
        // The corners opposite the edge are the first of each.
        let (of_start, of_end) =
            (&self.numbers[1..self.of_start], &self.numbers[self.of_start + 1..self.count]);
        self.count > 3 && !of_start.iter().any(|point| of_end.contains(point))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collapse::build::build;
    use crate::collapse::ring::Ring;

    /// A sheet with hills, folds and slivers, some of whose steps are allowed.
    fn surface() -> Surface {
        let n = 40u32;
        let height = |i: u32| if i % n < 20 { 0.3 } else { 2.0 } * ((i % 7) * (i % 11)) as f32 / 20.0;
        let x = |i: u32| (i % n) as f32 + if i.is_multiple_of(13) { 0.97 } else { 0.0 };
        let places: Vec<Vec3> =
            (0..n * n).map(|i| Vec3::new(x(i), height(i), (i / n) as f32 + 1e3)).collect();
        let square = |i: u32| [[i, i + n, i + 1], [i + 1, i + n, i + n + 1]];
        let triangles = (0..n * (n - 1)).filter(|i| i % n < n - 1).flat_map(square);
        build(&places, triangles).surface
    }

    #[test]
    fn what_is_sure_is_true() {
        let (surface, mut rim, mut ring) = (surface(), Rim::default(), Ring::default());
        let (mut sure, mut allowed) = (0, 0);
        for h in surface.edges() {
            let ends = [surface.start(h), surface.end(h)];
            let [from, to] = ends.map(|end| surface.points[end as usize].at);
            for place in [from, from.lerp(to, 0.5), to, to + Vec3::new(0.1, 0.6, -0.2)] {
                let at = place.as_dvec3() * surface.scale;
                ring.look(&surface, h);
                let keeps = ring.keeps_topology(&surface, h, None::<fn(u32) -> u32>)
                    && ring.keeps_shape(&surface, at)
                    && ring.lost(ends.map(|end| surface.at(end)), at) == 0.0;
                let is_sure = rim.surely_keeps(&surface, h, place);
                assert!(keeps || !is_sure, "{from} {to} to {place}");
                (sure, allowed) = (sure + usize::from(is_sure), allowed + usize::from(keeps));
            }
        }
        assert!(allowed > 1000 && 10 * sure > 8 * allowed, "{sure} of {allowed}");
    }
}
