//! Vertices at one place, counted as one.

use common::math::Vec3;
use common::mesh::Mesh;
use rayon::slice::ParallelSliceMut;

/// Positions and triangles of a mesh in which no two vertices share a place.
///
/// A file names a place several times for the sake of its normals and texture coordinates, or
/// because its format knows no shared vertices; what is connected does not depend on that.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Welded {
    /// Positions, in the order in which the mesh has them first.
    pub positions: Vec<Vec3>,
    /// The mesh's triangles in its order; also those that lost a corner.
    pub triangles: Vec<[u32; 3]>,
}

impl Welded {
    /// Welds a mesh; places are equal if all their bits are, and −0 is 0.
    pub fn new(mesh: &Mesh) -> Self {
        let bits = |p: Vec3| (p + Vec3::ZERO).to_array().map(f32::to_bits);
        let mut order: Vec<([u32; 3], u32)> = mesh.positions.iter().map(|p| bits(*p)).zip(0..).collect();
        order.par_sort_unstable();
        // The first vertex at each one's place.
        let mut first = vec![0; order.len()];
        for group in order.chunk_by(|a, b| a.0 == b.0) {
            group.iter().for_each(|(_, v)| first[*v as usize] = group[0].1);
        }
        let mut number = vec![u32::MAX; order.len()];
        let mut positions = Vec::with_capacity(order.len());
        for (v, &to) in first.iter().enumerate() {
            if to as usize == v {
                number[v] = positions.len() as u32;
                positions.push(mesh.positions[v]);
            }
        }
        let new = |v: u32| number[first[v as usize] as usize];
        Self { positions, triangles: mesh.triangles.iter().map(|t| t.map(new)).collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a9t5_places_are_numbered_by_first_use_and_minus_zero_is_zero() {
        let positions = vec![Vec3::X, Vec3::ZERO, Vec3::X, -Vec3::ZERO, Vec3::Y];
        let mesh = Mesh { positions, triangles: vec![[2, 3, 4], [0, 2, 1]], ..Mesh::default() };
        let welded = Welded::new(&mesh);
        assert_eq!(welded.positions, [Vec3::X, Vec3::ZERO, Vec3::Y]);
        assert_eq!(welded.triangles, [[0, 1, 2], [0, 0, 1]]);
        assert_eq!(Welded::new(&Mesh::default()), Welded::default());
    }
}
