//! A mesh made ready to be measured: welded, in double precision, in a tree.

use super::tree::Tree;
use super::weld::Welded;
use common::math::{DVec3, Vec3};

/// A surface that distances are measured from and to.
pub struct Surface {
    /// The mesh with vertices at one place counted as one.
    pub welded: Welded,
    /// Corners of every triangle.
    pub corners: Vec<[DVec3; 3]>,
    /// Unit normals of the triangles; zero for one without area.
    pub normals: Vec<DVec3>,
    /// Areas of the triangles up to and including each.
    pub area_up_to: Vec<f64>,
    /// Finds the nearest triangle.
    pub tree: Tree,
}

impl Surface {
    /// Welds the mesh and builds its tree.
    pub fn new(welded: Welded) -> Self {
        let point = |v: u32| welded.positions[v as usize].as_dvec3();
        let corners: Vec<[DVec3; 3]> = welded.triangles.iter().map(|t| t.map(point)).collect();
        let tree = Tree::new(&corners);
        let crosses: Vec<DVec3> = corners.iter().map(|[a, b, c]| (b - a).cross(c - a)).collect();
        let add = |sum: &mut f64, cross: &DVec3| {
            *sum += 0.5 * cross.length();
            Some(*sum)
        };
        let area_up_to = crosses.iter().scan(0.0, add).collect();
        let normals = crosses.into_iter().map(DVec3::normalize_or_zero).collect();
        Self { welded, corners, normals, area_up_to, tree }
    }

    /// Area of all triangles.
    pub fn area(&self) -> f64 {
        self.area_up_to.last().copied().unwrap_or(0.0)
    }

    /// Area of one triangle.
    pub fn area_of(&self, triangle: usize) -> f64 {
        let before = triangle.checked_sub(1).map_or(0.0, |t| self.area_up_to[t]);
        self.area_up_to[triangle] - before
    }

    /// Diagonal of the box around the vertices that are used; 0 if there are none.
    pub fn diagonal(&self) -> f64 {
        let points = self.welded.triangles.iter().flatten().map(|&v| self.welded.positions[v as usize]);
        let box_ = points.fold(None, |b: Option<(Vec3, Vec3)>, p| {
            Some(b.map_or((p, p), |(low, high)| (low.min(p), high.max(p))))
        });
        box_.map_or(0.0, |(low, high)| (high.as_dvec3() - low.as_dvec3()).length())
    }
}
