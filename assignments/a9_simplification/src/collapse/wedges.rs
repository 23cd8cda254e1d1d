//! Normals and texture coordinates: what a point has once for each side of a seam.
//!
//! A wedge is a vertex of the mesh, seen from the corners of triangles that use it. Where both
//! sides of an edge use the same wedges it is smooth, else it is a seam; seams are drawn together
//! only along themselves, and where they end or meet the point stays.

use crate::collapse::surface::{NONE, Surface, next};
use common::math::{Vec2, Vec3};
use common::mesh::Mesh;

/// Where the point may be that an edge becomes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Where {
    Anywhere,
    Start,
    End,
    /// The edge must stay.
    Nowhere,
}

/// The wedges of all corners.
#[derive(Clone)]
pub(super) struct Wedges {
    /// For every half-edge the wedge where it starts.
    of: Vec<u32>,
    /// For every vertex itself or one that it went into.
    pub parent: Vec<u32>,
    /// Normals and texture coordinates of the wedges; empty if the mesh has none.
    pub normals: Vec<Vec3>,
    pub uvs: Vec<Vec2>,
}

impl Wedges {
    /// Of the triangles of a mesh that became faces, in their order. `same` tells for every vertex the first that equals it.
    pub(super) fn new(mesh: &Mesh, same: Vec<u32>, faces: impl Iterator<Item = [u32; 3]>) -> Self {
        let of = faces.flat_map(|[a, b, c]| [same[a as usize], same[b as usize], same[c as usize], NONE]);
        let of = of.collect();
        Self { of, parent: same, normals: mesh.normals.clone(), uvs: mesh.uvs.clone() }
    }

    /// The wedge where a half-edge starts.
    pub(super) fn at(&self, h: u32) -> u32 {
        self.of[h as usize]
    }

    fn is_seam(&self, surface: &Surface, h: u32) -> bool {
        let twin = surface.twin(h);
        twin == NONE || self.at(h) != self.at(next(twin)) || self.at(next(h)) != self.at(twin)
    }

    /// How many seams and boundaries leave a point.
    fn seams(&self, surface: &Surface, point: u32) -> usize {
        let fan = surface.fan(point).filter(|&h| self.is_seam(surface, h)).count();
        // The last edge of an open fan is not the start of a half-edge that leaves the point.
        fan + usize::from(surface.on_boundary(point))
    }

    /// Where the point may be that the edge of `h` becomes.
    pub(super) fn place(&self, surface: &Surface, h: u32) -> Where {
        let [start, end] = [surface.start(h), surface.end(h)].map(|point| self.seams(surface, point));
        let stays = |seams: usize| seams != 0 && seams != 2;
        let along = self.is_seam(surface, h);
        match (stays(start), stays(end)) {
            (true, true) => Where::Nowhere,
            _ if start > 0 && end > 0 && !along => Where::Nowhere,
            (true, false) => Where::Start,
            (false, true) => Where::End,
            (false, false) => Where::Anywhere,
        }
    }

    /// Merges the wedges on both sides of the edge of `h`, `along` of the way to its end. To be
    /// called before the edge is drawn together.
    pub(super) fn merge(&mut self, surface: &Surface, h: u32, along: f32) {
        let twin = surface.twin(h);
        let left = (self.at(h), self.at(next(h)));
        let right = if twin == NONE { left } else { (self.at(next(twin)), self.at(twin)) };
        self.blend(left, along);
        // Where a seam ends, two wedges meet one.
        if right.0 != left.0 {
            self.blend(right, along);
        }
        for (kept, gone) in [left, right] {
            if self.parent[gone as usize] == gone && kept != gone {
                self.parent[gone as usize] = kept;
            }
        }
        for spoke in surface.fan(surface.end(h)) {
            let wedge = &mut self.of[spoke as usize];
            for (kept, gone) in [left, right] {
                if *wedge == gone {
                    *wedge = kept;
                    break;
                }
            }
        }
    }

    fn blend(&mut self, (kept, gone): (u32, u32), along: f32) {
        let (kept, gone) = (kept as usize, gone as usize);
        if let Some(&normal) = self.normals.get(gone) {
            let mixed = self.normals[kept].lerp(normal, along);
            self.normals[kept] = mixed.try_normalize().unwrap_or(self.normals[kept]);
        }
        if let Some(&uv) = self.uvs.get(gone) {
            self.uvs[kept] = self.uvs[kept].lerp(uv, along);
        }
    }
}
