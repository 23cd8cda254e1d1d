//! A triangle mesh as plain data, and the few operations that every model needs.

use glam::DVec3;

/// Triangles over shared vertices. Corners run counter-clockwise when seen from outside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Vertex positions, in the scene's units.
    pub positions: Vec<DVec3>,
    /// Indices into `positions`, three for each triangle.
    pub triangles: Vec<[u32; 3]>,
}

/// An axis-aligned box; both corners belong to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The corner with the least coordinates.
    pub min: DVec3,
    /// The corner with the greatest coordinates.
    pub max: DVec3,
}

impl Bounds {
    /// The box's edge lengths.
    pub fn size(&self) -> DVec3 {
        self.max - self.min
    }
}

impl Mesh {
    /// The corners of triangle `t`.
    pub fn corners(&self, t: usize) -> [DVec3; 3] {
        self.triangles[t].map(|v| self.positions[v as usize])
    }

    /// The least box round all vertices. An empty mesh gives an inverted box.
    pub fn bounds(&self) -> Bounds {
        let empty = Bounds { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };
        self.positions.iter().fold(empty, |b, &p| Bounds { min: b.min.min(p), max: b.max.max(p) })
    }

    /// Stretches and moves the mesh along each axis so that its box becomes `target`.
    pub fn fit(&mut self, target: Bounds) {
        let from = self.bounds();
        let scale = target.size() / from.size();
        for p in &mut self.positions {
            *p = target.min + (*p - from.min) * scale;
        }
    }

    /// Renumbers triangles along a space-filling curve and vertices by first use, so that
    /// neighbours in space are neighbours in the file and in memory.
    pub fn order_spatially(&mut self) {
        let bounds = self.bounds();
        let mut order: Vec<usize> = (0..self.triangles.len()).collect();
        order.sort_by_cached_key(|&t| {
            let [a, b, c] = self.corners(t);
            (morton(bounds, (a + b + c) / 3.0), t)
        });
        let sorted = order.into_iter().map(|t| self.triangles[t]).collect();
        *self = Mesh { positions: std::mem::take(&mut self.positions), triangles: sorted }
            .numbered_by_first_use();
    }

    /// The same triangles with vertices numbered in the order in which they are first used; unused
    /// vertices are dropped.
    pub fn numbered_by_first_use(self) -> Mesh {
        let mut new_index = vec![u32::MAX; self.positions.len()];
        let mut out = Mesh::default();
        for corners in self.triangles {
            out.triangles.push(corners.map(|v| {
                let slot = &mut new_index[v as usize];
                if *slot == u32::MAX {
                    *slot = out.positions.len() as u32;
                    out.positions.push(self.positions[v as usize]);
                }
                *slot
            }));
        }
        out
    }
}

/// Place of `p` on the Morton (Z-order) curve through `bounds`, ten bits for each axis.
fn morton(bounds: Bounds, p: DVec3) -> u32 {
    let cell = ((p - bounds.min) / bounds.size() * 1023.0).to_array().map(|c| c as u32);
    (0..10).rev().fold(0, |code, bit| cell.iter().fold(code, |code, c| code << 1 | c >> bit & 1))
}
