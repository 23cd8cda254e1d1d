//! How good a simplification is: distances, topology, shapes.
//!
//! [`Original`] is prepared once and compared with any number of simplified meshes. All results
//! are the same on any number of threads, and distances are relative to the diagonal of the
//! original's box.

mod distance;
mod edges;
mod flips;
mod point;
mod quality;
mod samples;
mod surface;
mod topology;
mod tree;
mod union;
mod weld;

pub use distance::{Distance, OneWay};
pub use flips::Flips;
pub use point::nearest_on_triangle;
pub use quality::{BINS, Quality};
pub use topology::Topology;
pub use tree::{Nearest, Tree};

use common::math::DVec3;
use common::mesh::Mesh;
use edges::Edges;
use surface::Surface;
pub(crate) use weld::Welded;

/// Points of each surface's area that distances are taken at unless one says otherwise.
pub const SAMPLES: usize = 200_000;

/// A mesh that others are compared with.
pub struct Original {
    surface: Surface,
    edges: Edges,
    topology: Topology,
    quality: Quality,
    rim: Option<Rim>,
}

/// The boundary of an open mesh.
struct Rim {
    vertices: Vec<DVec3>,
}

/// What became of a mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Comparison {
    /// Both ways, as shares of the diagonal of the original's box.
    pub distance: Distance,
    /// From the vertices of the original's boundary to the other's, in the same unit; `None` if
    /// the original is closed.
    pub boundary: Option<OneWay>,
    /// Of the simplified mesh.
    pub topology: Topology,
    /// Of the simplified mesh.
    pub quality: Quality,
    /// Of the simplified mesh.
    pub flips: Flips,
}

impl Original {
    /// Prepares a mesh.
    pub fn new(mesh: &Mesh) -> Self {
        let surface = Surface::new(Welded::new(mesh));
        let edges = Edges::new(&surface.welded.triangles);
        let topology = Topology::of(&surface, &edges);
        let quality = Quality::of(&surface.corners);
        let rim = Rim::of(&surface, &edges);
        Self { surface, edges, topology, quality, rim }
    }

    /// Diagonal of its box, in its own unit.
    pub fn diagonal(&self) -> f64 {
        self.surface.diagonal()
    }

    /// How its triangles hang together.
    pub fn topology(&self) -> &Topology {
        &self.topology
    }

    /// How its triangles are shaped.
    pub fn quality(&self) -> &Quality {
        &self.quality
    }

    /// Finds the nearest of its triangles, which are numbered as in the mesh.
    pub fn tree(&self) -> &Tree {
        &self.surface.tree
    }

    /// Compares a mesh with it; distances are taken at `samples` points of either area, at all
    /// vertices, and at the middles of all edges.
    pub fn compare(&self, mesh: &Mesh, samples: usize) -> Comparison {
        let other = Surface::new(Welded::new(mesh));
        let edges = Edges::new(&other.welded.triangles);
        let unit = self.diagonal();
        let forward = OneWay::between(&self.surface, &self.edges, &other.tree, samples);
        let backward = OneWay::between(&other, &edges, &self.surface.tree, samples);
        Comparison {
            distance: Distance { forward: forward.relative_to(unit), backward: backward.relative_to(unit) },
            boundary: self.rim.as_ref().map(|rim| rim.distance_to(&other, &edges).relative_to(unit)),
            topology: Topology::of(&other, &edges),
            quality: Quality::of(&other.corners),
            flips: Flips::between(&self.surface, &other),
        }
    }
}

impl Rim {
    fn of(surface: &Surface, edges: &Edges) -> Option<Self> {
        let mut ends: Vec<u32> = boundary(edges).flatten().collect();
        ends.sort_unstable();
        ends.dedup();
        let point = |v: &u32| surface.welded.positions[*v as usize].as_dvec3();
        let vertices: Vec<DVec3> = ends.iter().map(point).collect();
        (!vertices.is_empty()).then_some(Self { vertices })
    }

    /// How far its vertices are from the boundary of another surface.
    fn distance_to(&self, other: &Surface, edges: &Edges) -> OneWay {
        let point = |v: u32| other.welded.positions[v as usize].as_dvec3();
        // A segment is a triangle two of whose corners are one.
        let segments: Vec<[DVec3; 3]> = boundary(edges).map(|[a, b]| [a, b, b].map(point)).collect();
        OneWay::of_points(&self.vertices, &Tree::new(&segments))
    }
}

/// Both ends of every boundary edge.
fn boundary(edges: &Edges) -> impl Iterator<Item = [u32; 2]> {
    edges.iter().filter(|edge| edge.triangles() == 1).map(|edge| edge.vertices())
}
