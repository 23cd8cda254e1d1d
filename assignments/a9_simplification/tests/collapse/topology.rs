//! Counts that a simplification must not change, or must keep at zero.

use common::mesh::{Mesh, has_area};
use std::collections::{HashMap, HashSet};

#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Vertices − edges + faces.
    pub euler: i64,
    pub components: usize,
    pub loops: usize,
    /// Edges of more than two triangles, or of two that run along it the same way.
    pub bad_edges: usize,
    pub repeated: usize,
    pub without_area: usize,
}

/// Of a mesh whose vertices at the same place are the same.
pub fn counts(mesh: &Mesh) -> Counts {
    let mut edges: HashMap<[u32; 2], [usize; 2]> = HashMap::new();
    let mut parts = Parts::new(mesh.positions.len());
    for &[a, b, c] in &mesh.triangles {
        for (p, q) in [(a, b), (b, c), (c, a)] {
            edges.entry([p.min(q), p.max(q)]).or_default()[usize::from(p < q)] += 1;
            parts.join(p, q);
        }
    }
    let used: HashSet<u32> = mesh.triangles.as_flattened().iter().copied().collect();
    let mut rims = Parts::new(mesh.positions.len());
    let rim: Vec<[u32; 2]> = edges.iter().filter(|(_, n)| n[0] + n[1] == 1).map(|(&edge, _)| edge).collect();
    rim.iter().for_each(|&[p, q]| rims.join(p, q));
    let sorted = |t: &[u32; 3]| {
        let mut t = *t;
        t.sort_unstable();
        t
    };
    Counts {
        euler: used.len() as i64 - edges.len() as i64 + mesh.triangles.len() as i64,
        components: used.iter().map(|&v| parts.find(v)).collect::<HashSet<_>>().len(),
        loops: rim.iter().map(|&[p, _]| rims.find(p)).collect::<HashSet<_>>().len(),
        bad_edges: edges.values().filter(|n| n[0] > 1 || n[1] > 1).count(),
        repeated: mesh.triangles.len() - mesh.triangles.iter().map(sorted).collect::<HashSet<_>>().len(),
        without_area: mesh
            .triangles
            .iter()
            .filter(|t| !has_area(t.map(|i| mesh.positions[i as usize])))
            .count(),
    }
}

/// Union and find.
struct Parts(Vec<u32>);

impl Parts {
    fn new(count: usize) -> Self {
        Self((0..count as u32).collect())
    }

    fn find(&mut self, mut v: u32) -> u32 {
        while self.0[v as usize] != v {
            self.0[v as usize] = self.0[self.0[v as usize] as usize];
            v = self.0[v as usize];
        }
        v
    }

    fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.find(a), self.find(b));
        self.0[a as usize] = b;
    }
}
