//! From the scene as written to primitives in world space.

use super::smooth::Smooth;
use super::uv::{UvMap, pictured};
use super::{FEW_RUNS, FEWER_RUNS, Facet, Geometry, PlacedMesh, Run, RunKind, Sheet, Solid, SolidShape};
use crate::math::affine::AffineKind;
use crate::math::{Affine, Bounds, DMat4, DVec3, Vec3};
use crate::mesh::Mesh;
use crate::scene::{Disc, Node, NodeKind, Position, Scene, ShapeSpec};
use crate::shape::ellipsoid::Ellipsoid;
use crate::shape::plane::Plane;
use crate::shape::sphere::Sphere;
use std::collections::HashMap;
use std::sync::{Arc, OnceLock};

/// A shape that cannot be placed in the world.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}:{}: {message}", position.line, position.column)]
pub struct GeometryError {
    /// Where its keyword stands in the scene file.
    pub position: Position,
    /// What is wrong.
    pub message: String,
}

/// The first primitive of each run if they are few, but more than a search finds as soon; none for runs that
/// there are not.
fn first_of_few(runs: &[Run]) -> Option<[u32; FEW_RUNS]> {
    let mut first = [u32::MAX; FEW_RUNS];
    for (first, run) in first.iter_mut().zip(runs) {
        *first = run.first;
    }
    (FEWER_RUNS..=FEW_RUNS).contains(&runs.len()).then_some(first)
}

/// Where a node stands in the world.
#[derive(Clone, Copy)]
struct Placement {
    matrix: DMat4,
    transformed: bool,
}

/// What is worked out once and used by many shapes.
struct Shared<'a> {
    scene: &'a Scene,
    /// Whether there are pictures on each material.
    pictured: Vec<bool>,
    /// Vertex normals of the meshes that are drawn smooth.
    normals: HashMap<u32, Arc<[Vec3]>>,
}

impl Geometry {
    /// Composes all transforms in `f64` and bakes every shape.
    ///
    /// # Errors
    /// If a composed transform has no inverse, or takes a shape beyond the range of `f32`.
    pub fn build(scene: &Scene) -> Result<Self, GeometryError> {
        let mut geometry = Self::default();
        let mut shared = Shared { scene, pictured: pictured(&scene.materials), normals: HashMap::new() };
        let mut placements: Vec<Placement> = Vec::with_capacity(scene.nodes.len());
        for node in &scene.nodes {
            let placement = place(node, &placements);
            placements.push(placement);
            if let NodeKind::Shape { shape, material } = &node.kind {
                geometry.add(&mut shared, node, shape, *material, &placement)?;
            }
        }
        geometry.bounds = geometry.finite_bounds();
        geometry.facets = Facet::of_few(&geometry.triangles);
        geometry.first_of_few = first_of_few(&geometry.runs);
        Ok(geometry)
    }

    fn add(
        &mut self,
        shared: &mut Shared,
        node: &Node,
        shape: &ShapeSpec,
        material: u32,
        placement: &Placement,
    ) -> Result<(), GeometryError> {
        let error = |message: &str| GeometryError { position: node.position, message: message.to_owned() };
        let to_world = Affine::from_matrix(&placement.matrix)
            .ok_or_else(|| error("the transforms around this shape multiply to a matrix without inverse"))?;
        let first = u32::try_from(self.len()).map_err(|_| error("more than 4294967295 primitives"))?;
        let (kind, start) = match shape {
            ShapeSpec::Sphere { center, radius } => {
                let solid = bake_sphere(*center, *radius, &to_world, placement.transformed, first);
                let fits = solid.bounds.min.is_finite() && solid.bounds.max.is_finite();
                self.solids.push(solid);
                (RunKind::Solid, fits.then_some(self.solids.len() - 1))
            }
            ShapeSpec::Plane { normal, offset, disc } => {
                let mut plane = bake_plane(*normal, *offset, &to_world);
                if let Some(disc) = disc {
                    let baked = bake_disc(disc, *normal, *offset, &to_world);
                    plane.disc = Some(baked.ok_or_else(|| error("a disc can only be scaled evenly"))?);
                }
                self.sheets.push(Sheet { primitive: first, plane });
                (RunKind::Sheet, Some(self.sheets.len() - 1))
            }
            ShapeSpec::Triangle { vertices } => {
                (RunKind::Triangle, self.add_triangles(first, &to_world, std::iter::once(*vertices)))
            }
            ShapeSpec::Mesh { mesh, .. } => {
                (RunKind::Triangle, self.add_mesh(first, &to_world, &shared.scene.meshes[*mesh as usize]))
            }
        };
        let start = start.ok_or_else(|| error("this shape lies beyond the range of single precision"))?;
        let (smooth, uv) = (shared.smooth(shape, &to_world), shared.uv_map(shape, material, &to_world));
        let placed = shared.placed(shape, &to_world, start, first);
        self.runs.push(Run {
            first,
            start: start as u32,
            kind,
            material,
            smooth,
            uv,
            placed,
            body: OnceLock::new(),
            hollow: OnceLock::new(),
        });
        Ok(())
    }

    /// Bakes the mesh's vertices once each, then its triangles.
    fn add_mesh(&mut self, first: u32, to_world: &Affine, mesh: &Mesh) -> Option<usize> {
        let world: Vec<Vec3> = match to_world.kind {
            AffineKind::Identity => mesh.positions.clone(),
            _ => mesh.positions.iter().map(|p| to_world.point(p.as_dvec3()).as_vec3()).collect(),
        };
        let order = winding(to_world);
        let start = self.triangles.len();
        self.triangles.extend(mesh.triangles.iter().map(|t| order.map(|k| world[t[k] as usize])));
        self.number_triangles(start, first);
        world.iter().all(|p| p.is_finite()).then_some(start)
    }

    fn add_triangles(
        &mut self,
        first: u32,
        to_world: &Affine,
        triangles: impl Iterator<Item = [DVec3; 3]>,
    ) -> Option<usize> {
        let order = winding(to_world);
        let start = self.triangles.len();
        self.triangles.extend(triangles.map(|t| order.map(|k| to_world.point(t[k]).as_vec3())));
        self.number_triangles(start, first);
        self.triangles[start..].iter().flatten().all(|p| p.is_finite()).then_some(start)
    }

    fn number_triangles(&mut self, start: usize, first: u32) {
        let count = (self.triangles.len() - start) as u32;
        self.triangle_numbers.extend(first..first + count);
    }

    fn finite_bounds(&self) -> Option<Bounds> {
        let corners = Bounds::of_points(self.triangles.iter().flatten().copied());
        let all = self.solids.iter().fold(corners, |b, s| b.union(&s.bounds));
        (!all.is_empty()).then_some(all)
    }
}

impl Shared<'_> {
    /// The normals of a mesh that is to look smooth, worked out once for all its copies.
    fn smooth(&mut self, shape: &ShapeSpec, to_world: &Affine) -> Option<Box<Smooth>> {
        let &ShapeSpec::Mesh { mesh: index, smooth: true } = shape else { return None };
        let mesh = &self.scene.meshes[index as usize];
        let normals = self.normals.entry(index).or_insert_with(|| mesh.smooth_normals().into());
        let (mesh, normals) = (Arc::clone(mesh), Arc::clone(normals));
        Some(Box::new(Smooth { mesh, normals, to_world: *to_world, order: winding(to_world) }))
    }

    /// What a copy of a mesh is a copy of; its triangles start at `start` and at number `first`.
    fn placed(
        &self,
        shape: &ShapeSpec,
        to_world: &Affine,
        start: usize,
        first: u32,
    ) -> Option<Box<PlacedMesh>> {
        let &ShapeSpec::Mesh { mesh, .. } = shape else { return None };
        let mesh = Arc::clone(&self.scene.meshes[mesh as usize]);
        Some(Box::new(PlacedMesh { mesh, to_world: *to_world, start, first }))
    }

    /// Where pictures go on a shape, if there are any on its material.
    fn uv_map(&self, shape: &ShapeSpec, material: u32, to_world: &Affine) -> Option<Box<UvMap>> {
        let order = winding(to_world);
        let pictured = self.pictured.get(material as usize).is_some_and(|&pictured| pictured);
        pictured.then(|| {
            Box::new(match shape {
                ShapeSpec::Sphere { center, .. } => UvMap::Round { center: *center, to_world: *to_world },
                ShapeSpec::Plane { normal, .. } => UvMap::of_plane(*normal, to_world),
                ShapeSpec::Triangle { .. } => UvMap::Corners { mesh: None, order },
                ShapeSpec::Mesh { mesh, .. } => {
                    UvMap::of_mesh(&self.scene.meshes[*mesh as usize], to_world, order)
                }
            })
        })
    }
}

fn place(node: &Node, placements: &[Placement]) -> Placement {
    let outer = node
        .parent
        .map_or(Placement { matrix: DMat4::IDENTITY, transformed: false }, |p| placements[p as usize]);
    match &node.kind {
        NodeKind::Transform(list) => {
            Placement { matrix: list.iter().fold(outer.matrix, |m, x| m * x.matrix()), transformed: true }
        }
        _ => outer,
    }
}

/// A mirroring map turns triangles inside out; swapping two corners turns them back, so that
/// the world normal is M⁻ᵀ times the normal that the file meant.
pub(super) fn winding(to_world: &Affine) -> [usize; 3] {
    if to_world.linear.determinant() < 0.0 { [0, 2, 1] } else { [0, 1, 2] }
}

fn bake_sphere(center: DVec3, radius: f64, to_world: &Affine, transformed: bool, primitive: u32) -> Solid {
    let half = DVec3::splat(radius);
    let corner = |i: usize| {
        let side = |bit: usize| if i & bit == 0 { -1.0 } else { 1.0 };
        to_world.point(center + half * DVec3::new(side(1), side(2), side(4)))
    };
    let (min, max) =
        (0..8).map(corner).fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(lo, hi), p| (lo.min(p), hi.max(p)));
    let sphere = Sphere { center, radius };
    let shape = match to_world.kind {
        AffineKind::Identity => SolidShape::Sphere(sphere),
        AffineKind::Similarity { scale } => {
            SolidShape::Sphere(Sphere { center: to_world.point(center), radius: radius * scale })
        }
        AffineKind::General => SolidShape::Ellipsoid(Box::new(Ellipsoid { sphere, to_world: *to_world })),
    };
    Solid { primitive, shape, bounds: Bounds::enclosing(min, max), transformed }
}

/// A plane under any affine map is a plane: its normal goes with M⁻ᵀ, one of its points with M.
fn bake_plane(normal: DVec3, offset: f64, to_world: &Affine) -> Plane {
    let unit = normal.normalize();
    let world_normal = to_world.normal(unit).normalize();
    let foot = to_world.point(unit * offset);
    Plane { normal: world_normal, offset: world_normal.dot(foot), disc: None }
}

/// The world-space centre (on the plane) and radius of a disc; `None` under a map that does not
/// scale evenly, which would make it an ellipse.
fn bake_disc(disc: &Disc, normal: DVec3, offset: f64, to_world: &Affine) -> Option<(DVec3, f64)> {
    let scale = match to_world.kind {
        AffineKind::Identity => 1.0,
        AffineKind::Similarity { scale } => scale,
        AffineKind::General => return None,
    };
    let unit = normal.normalize();
    let on_plane = disc.center - unit * (unit.dot(disc.center) - offset);
    Some((to_world.point(on_plane), disc.radius * scale))
}
