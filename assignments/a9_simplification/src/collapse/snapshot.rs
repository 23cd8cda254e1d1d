//! What is left at some time of a run, without what is gone.

use crate::collapse::cost::Cost;
use crate::collapse::run::Run;
use crate::collapse::surface::{Face, NONE, Point, Surface};
use crate::collapse::wedges::Wedges;
use common::mesh::Mesh;

/// The faces and points that are left, numbered anew.
pub(super) struct Snapshot {
    pub surface: Surface,
    /// For every original point the one it became, [`NONE`] if no face is left there.
    pub becomes: Vec<u32>,
    /// Points that must stay where they are.
    pub fixed: Vec<bool>,
    /// For every point the first of those that are copies of the same; nothing if there are no copies.
    first: Vec<u32>,
    /// For every face its number in the run, and in the original.
    pub faces: Vec<u32>,
}

impl Snapshot {
    /// Takes it.
    pub(super) fn take<C: Cost>(run: &Run<C>) -> Self {
        let (number, points) = numbered(run);
        let mut faces = Vec::with_capacity(run.surface.alive);
        let mut new_face = vec![NONE; run.surface.faces.len()];
        for ((number, face), new) in (0..).zip(&run.surface.faces).zip(&mut new_face) {
            if !face.is_gone() {
                *new = faces.len() as u32;
                faces.push(number);
            }
        }
        let half_edge = |h: u32| if h == NONE { NONE } else { new_face[(h >> 2) as usize] << 2 | (h & 3) };
        let surface = Surface {
            faces: faces
                .iter()
                .map(|&face| run.surface.faces[face as usize].renumbered(|p| number[p as usize], half_edge))
                .collect(),
            points: points
                .iter()
                .map(|&p| run.surface.points[p as usize])
                .map(|p| Point { at: p.at, out: half_edge(p.out) })
                .collect(),
            alive: faces.len(),
            scale: run.surface.scale,
        };
        let first = match run.copies.is_empty() {
            true => Vec::new(),
            false => points.iter().map(|&p| first_of(run, &number, p)).collect(),
        };
        let mut becomes = roots(&run.parent);
        becomes.truncate(run.parent.len() - run.copies.len());
        becomes.iter_mut().for_each(|root| *root = number[*root as usize]);
        Self { surface, becomes, fixed: points.iter().map(|&p| run.cut[p as usize]).collect(), first, faces }
    }

    /// As a mesh, and for every vertex of the original the one it became.
    pub(super) fn mesh(&self, point_of: &[u32], wedges: Option<&Wedges>) -> (Mesh, Vec<u32>) {
        match wedges {
            None => self.plain_mesh(point_of),
            Some(wedges) => self.mesh_with(wedges),
        }
    }

    fn plain_mesh(&self, point_of: &[u32]) -> (Mesh, Vec<u32>) {
        let mut becomes: Vec<u32> = point_of.iter().map(|&point| became(&self.becomes, point)).collect();
        let mut mesh = Mesh {
            positions: self.surface.points.iter().map(|point| point.at).collect(),
            triangles: self.surface.faces.iter().map(Face::corners).collect(),
            ..Mesh::default()
        };
        if !self.first.is_empty() {
            let vertex = self.without_copies(&mut mesh);
            becomes.iter_mut().for_each(|point| *point = became(&vertex, *point));
        }
        (mesh, becomes)
    }

    /// Leaves only the first of points that are copies of the same. For every point the vertex that it is then.
    fn without_copies(&self, mesh: &mut Mesh) -> Vec<u32> {
        let mut vertex = vec![NONE; self.first.len()];
        let all = std::mem::take(&mut mesh.positions);
        for (point, (&first, at)) in self.first.iter().zip(all).enumerate() {
            // The first comes before its copies.
            if first == point as u32 {
                vertex[point] = mesh.positions.len() as u32;
                mesh.positions.push(at);
            } else {
                vertex[point] = vertex[first as usize];
            }
        }
        mesh.triangles.as_flattened_mut().iter_mut().for_each(|corner| *corner = vertex[*corner as usize]);
        vertex
    }

    fn mesh_with(&self, wedges: &Wedges) -> (Mesh, Vec<u32>) {
        let mut mesh = Mesh::default();
        let mut vertex = vec![NONE; wedges.parent.len()];
        for (&old, face) in self.faces.iter().zip(&self.surface.faces) {
            let corners = face.corners();
            mesh.triangles.push(std::array::from_fn(|i| {
                let wedge = wedges.at(4 * old + i as u32) as usize;
                if vertex[wedge] == NONE {
                    vertex[wedge] = mesh.positions.len() as u32;
                    mesh.positions.push(self.surface.points[corners[i] as usize].at);
                    mesh.normals.extend(wedges.normals.get(wedge));
                    mesh.uvs.extend(wedges.uvs.get(wedge));
                }
                vertex[wedge]
            }));
        }
        let becomes = roots(&wedges.parent).into_iter().map(|wedge| vertex[wedge as usize]).collect();
        (mesh, becomes)
    }
}

/// What became of something, if that is still there.
#[inline(always)]
fn became(becomes: &[u32], number: u32) -> u32 {
    if number == NONE { NONE } else { becomes[number as usize] }
}

/// New numbers of the points that are left, and these points.
fn numbered<C: Cost>(run: &Run<C>) -> (Vec<u32>, Vec<u32>) {
    let mut number = vec![NONE; run.surface.points.len()];
    let mut left = Vec::new();
    for (i, _) in run.surface.points.iter().enumerate().filter(|(_, point)| point.out != NONE) {
        number[i] = left.len() as u32;
        left.push(i as u32);
    }
    (number, left)
}

/// Copies come after what they are copies of and never go, so that the first is still there.
fn first_of<C: Cost>(run: &Run<C>, number: &[u32], point: u32) -> u32 {
    number[run.original(point) as usize]
}

impl Face {
    fn renumbered(&self, point: impl Fn(u32) -> u32, half_edge: impl Fn(u32) -> u32) -> Self {
        let mut face = Self::new(self.corners().map(point));
        face.copy_rest(self, half_edge);
        face
    }
}

/// The last of the points that each point went into.
fn roots(parent: &[u32]) -> Vec<u32> {
    let mut root = parent.to_vec();
    for point in 0..root.len() {
        let mut last = root[point];
        while root[last as usize] != last {
            last = root[last as usize];
        }
        // Whoever passes here later has a short way.
        let mut at = point;
        while root[at] != last {
            at = std::mem::replace(&mut root[at], last) as usize;
        }
    }
    root
}
