//! From triangles to a surface: who is whose neighbour, and what is not a surface.
//!
//! Where more than two triangles meet at an edge, or two that turn the same way, nobody is
//! anybody's neighbour; where several fans meet in one point, each gets a copy of the point. So
//! everything becomes a surface with boundary, and the places where it was cut are held fast.

use crate::collapse::surface::{Face, NONE, Point, Surface};
use common::math::{Bounds, Vec3};

/// A surface and how it was cut.
#[derive(Clone)]
pub(super) struct Built {
    pub surface: Surface,
    /// For the copies of points, which come after all others, the points they are copies of.
    pub copies: Vec<u32>,
    /// Whether a point is at a place where the surface was cut.
    pub cut: Vec<bool>,
}

/// Half-edges by the point that they leave: those of point p are `leaving[first[p]..first[p + 1]]`.
struct Leaving {
    first: Vec<u32>,
    /// Half-edges and the points where they end.
    leaving: Vec<(u32, u32)>,
}

/// Builds the surface of triangles over points; no triangle has a point twice.
pub(super) fn build(places: &[Vec3], triangles: impl Iterator<Item = [u32; 3]>) -> Built {
    let faces: Vec<Face> = triangles.map(Face::new).collect();
    let points = places.iter().map(|&at| Point { at, out: NONE }).collect();
    let alive = faces.len();
    let mut built = Built {
        surface: Surface { faces, points, alive, scale: scale_of(places) },
        copies: Vec::new(),
        cut: vec![false; places.len()],
    };
    built.surface.remember_normals();
    let leaving = Leaving::new(&built.surface);
    built.pair_all(&leaving);
    built.find_fans(&leaving);
    built
}

impl Surface {
    fn remember_normals(&mut self) {
        for i in 0..self.faces.len() {
            let normal = self.normal(i);
            self.faces[i].remember(normal);
        }
    }
}

fn scale_of(places: &[Vec3]) -> f64 {
    let bounds = Bounds::of_points(places.iter().copied());
    let size = (bounds.max.as_dvec3() - bounds.min.as_dvec3()).max_element();
    if size > 0.0 && size.is_finite() { (-size.log2().floor()).exp2() } else { 1.0 }
}

impl Leaving {
    fn new(surface: &Surface) -> Self {
        let mut first = vec![0u32; surface.points.len() + 1];
        for corner in surface.faces.iter().flat_map(Face::corners) {
            first[corner as usize + 1] += 1;
        }
        for i in 1..first.len() {
            first[i] += first[i - 1];
        }
        let mut leaving = vec![(0, 0); surface.faces.len() * 3];
        let mut free = first.clone();
        for (face, corners) in surface.faces.iter().map(Face::corners).enumerate() {
            for i in 0..3 {
                let slot = &mut free[corners[i] as usize];
                leaving[*slot as usize] = (4 * face as u32 + i as u32, corners[(i + 1) % 3]);
                *slot += 1;
            }
        }
        Self { first, leaving }
    }

    fn of(&self, point: u32) -> &[(u32, u32)] {
        let point = point as usize;
        &self.leaving[self.first[point] as usize..self.first[point + 1] as usize]
    }

    /// The half-edge from one point to another, and how many there are.
    fn between(&self, from: u32, to: u32) -> (u32, usize) {
        let found = self.of(from).iter().filter(|&&(_, end)| end == to);
        found.fold((NONE, 0), |(_, count), &(h, _)| (h, count + 1))
    }
}

impl Built {
    /// Pairs the half-edges of every edge that has one on each side.
    fn pair_all(&mut self, leaving: &Leaving) {
        for from in 0..self.surface.points.len() as u32 {
            for &(h, to) in leaving.of(from) {
                if self.surface.twin(h) != NONE {
                    continue;
                }
                let (_, same) = leaving.between(from, to);
                let (twin, opposite) = leaving.between(to, from);
                if same > 1 || opposite > 1 {
                    self.cut[from as usize] = true;
                    self.cut[to as usize] = true;
                } else if opposite == 1 {
                    self.surface.pair(h, twin);
                }
            }
        }
    }

    /// Gives every point its fan, and every further fan a copy of the point.
    fn find_fans(&mut self, leaving: &Leaving) {
        for point in 0..leaving.first.len() as u32 - 1 {
            let around = leaving.of(point);
            let Some(&(any, _)) = around.first() else { continue };
            let open = around.iter().map(|&(h, _)| h).find(|&h| self.surface.twin(h) == NONE);
            self.surface.points[point as usize].out = open.unwrap_or(any);
            if self.surface.fan(point).count() < around.len() {
                self.split(point, around);
            }
        }
    }

    #[cold]
    fn split(&mut self, point: u32, around: &[(u32, u32)]) {
        self.cut[point as usize] = true;
        let mut left: Vec<u32> = around.iter().map(|&(h, _)| h).collect();
        let mut fan = point;
        loop {
            let done: Vec<u32> = self.surface.fan(fan).collect();
            for &h in &done {
                self.surface.set_start(h, fan);
            }
            left.retain(|h| !done.contains(h));
            let Some(&any) = left.first() else { break };
            let open = left.iter().copied().find(|&h| self.surface.twin(h) == NONE);
            fan = self.surface.points.len() as u32;
            let at = self.surface.points[point as usize].at;
            self.surface.points.push(Point { at, out: open.unwrap_or(any) });
            self.copies.push(point);
            self.cut.push(true);
        }
    }
}
