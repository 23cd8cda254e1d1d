//! Other people's structures, as their manuals have them used, with their default features.
//!
//! `obvhs` (medium build, its own triangle test), `parry3d` (its mesh shape), `bvh` (which names
//! candidates; Möller & Trumbore's test in `f32` decides).

use super::contender::{Answer, Contender, Structure};
use crate::truth::MISS;
use crate::world::World;
use common::cli::AppError;
use common::ray::Ray;
use nalgebra::{Point3, Vector3};
use obvhs::rt_triangle::RtTriangle;
use obvhs::{BvhBuildParams, bvh2::Bvh2, cwbvh::CwBvh};
use parry3d::shape::{CompositeShapeRef, TriMesh};
use std::time::Duration;

/// The peers.
pub fn all() -> Vec<Structure> {
    vec![
        Structure { name: "obvhs-bvh2", build: |world| Ok(Box::new(binary(world))) },
        Structure { name: "obvhs-cwbvh", build: |world| Ok(Box::new(compressed(world))) },
        Structure { name: "parry3d", build: |world| Ok(Box::new(parry(world)?)) },
        Structure { name: "bvh-crate", build: |world| Ok(Box::new(Candidates::new(world))) },
    ]
}

/// A tree of obvhs with its triangles in the tree's order.
struct Obvhs<T> {
    tree: T,
    triangles: Vec<RtTriangle>,
    /// Our number of each of them.
    numbers: Vec<u32>,
    bytes: usize,
}

fn obvhs_triangles(world: &World) -> Vec<obvhs::triangle::Triangle> {
    let triangle = |t: u32| {
        let [v0, v1, v2] = world.corners(t).map(|p| p.to_array().into());
        obvhs::triangle::Triangle { v0, v1, v2 }
    };
    (0..world.triangles() as u32).map(triangle).collect()
}

fn obvhs_ray(ray: &Ray, reach: f32) -> obvhs::ray::Ray {
    obvhs::ray::Ray::new(ray.origin.to_array().into(), ray.direction.to_array().into(), 0.0, reach)
}

impl<T> Obvhs<T> {
    fn new(tree: T, triangles: &[obvhs::triangle::Triangle], numbers: Vec<u32>, node_bytes: usize) -> Self {
        let triangles: Vec<RtTriangle> = numbers.iter().map(|&i| (&triangles[i as usize]).into()).collect();
        let bytes = node_bytes + size_of_val(&*numbers) + size_of_val(&*triangles);
        Self { tree, triangles, numbers, bytes }
    }

    fn answer(&self, hit: &obvhs::ray::RayHit) -> Answer {
        let number = self.numbers.get(hit.primitive_id as usize);
        number.map_or(Answer::MISS, |&primitive| Answer { t: hit.t, primitive })
    }
}

fn binary(world: &World) -> Obvhs<Bvh2> {
    let triangles = obvhs_triangles(world);
    let tree = obvhs::bvh2::builder::build_bvh2_from_tris(
        &triangles,
        BvhBuildParams::medium_build(),
        &mut Duration::default(),
    );
    let (numbers, bytes) = (tree.primitive_indices.clone(), size_of_val(&*tree.nodes));
    Obvhs::new(tree, &triangles, numbers, bytes)
}

fn compressed(world: &World) -> Obvhs<CwBvh> {
    let triangles = obvhs_triangles(world);
    let tree = obvhs::cwbvh::builder::build_cwbvh_from_tris(
        &triangles,
        BvhBuildParams::medium_build(),
        &mut Duration::default(),
    );
    let (numbers, bytes) = (tree.primitive_indices.clone(), size_of_val(&*tree.nodes));
    Obvhs::new(tree, &triangles, numbers, bytes)
}

/// Both trees of obvhs are asked in the same words, but share no trait.
macro_rules! obvhs_contender {
    ($tree:ty) => {
        impl Contender for Obvhs<$tree> {
            fn nearest(&self, ray: &Ray, reach: f32) -> Answer {
                let mut hit = obvhs::ray::RayHit::none();
                self.tree
                    .ray_traverse(obvhs_ray(ray, reach), &mut hit, |r, i| self.triangles[i].intersect(r));
                self.answer(&hit)
            }

            fn any(&self, ray: &Ray, reach: f32) -> bool {
                !self.tree.ray_traverse_miss(obvhs_ray(ray, reach), |r, i| self.triangles[i].intersect(r))
            }

            fn bytes(&self) -> Option<usize> {
                Some(self.bytes)
            }
        }
    };
}
obvhs_contender!(Bvh2);
obvhs_contender!(CwBvh);

struct Parry(TriMesh);

fn parry(world: &World) -> Result<Parry, AppError> {
    let vector = |p: &common::math::Vec3| parry3d::math::Vector::new(p.x, p.y, p.z);
    let vertices = world.mesh.positions.iter().map(vector).collect();
    let mesh = TriMesh::new(vertices, world.mesh.triangles.clone());
    mesh.map(Parry).map_err(|e| AppError::Usage(format!("parry3d: {e}")))
}

impl Contender for Parry {
    fn nearest(&self, ray: &Ray, reach: f32) -> Answer {
        let vector = |p: common::math::Vec3| parry3d::math::Vector::new(p.x, p.y, p.z);
        let ray = parry3d::query::Ray::new(vector(ray.origin), vector(ray.direction));
        let hit = CompositeShapeRef(&self.0).cast_local_ray(&ray, reach.min(f32::MAX), true);
        hit.map_or(Answer::MISS, |(primitive, t)| Answer { t, primitive })
    }

    fn any(&self, ray: &Ray, reach: f32) -> bool {
        self.nearest(ray, reach).is_hit()
    }

    fn bytes(&self) -> Option<usize> {
        None
    }
}

/// A triangle that knows its leaf, as the crate wants it.
struct Leaf {
    corners: [Vector3<f32>; 3],
    node: usize,
    primitive: u32,
}

impl bvh::aabb::Bounded<f32, 3> for Leaf {
    fn aabb(&self) -> bvh::aabb::Aabb<f32, 3> {
        self.corners.iter().fold(bvh::aabb::Aabb::empty(), |b, p| b.grow(&Point3::from(*p)))
    }
}

impl bvh::bounding_hierarchy::BHShape<f32, 3> for Leaf {
    fn set_bh_node_index(&mut self, index: usize) {
        self.node = index;
    }

    fn bh_node_index(&self) -> usize {
        self.node
    }
}

impl Leaf {
    /// t in (0, reach), by Möller & Trumbore (1997).
    fn meets(&self, origin: &Vector3<f32>, direction: &Vector3<f32>, reach: f32) -> Option<f32> {
        let [a, b, c] = &self.corners;
        let (to_b, to_c, from_a) = (b - a, c - a, origin - a);
        let p = direction.cross(&to_c);
        let scale = 1.0 / to_b.dot(&p);
        let q = from_a.cross(&to_b);
        let (u, v, t) = (from_a.dot(&p) * scale, direction.dot(&q) * scale, to_c.dot(&q) * scale);
        (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 && t < reach).then_some(t)
    }
}

struct Candidates {
    tree: bvh::bvh::Bvh<f32, 3>,
    leaves: Vec<Leaf>,
}

impl Candidates {
    fn new(world: &World) -> Self {
        let leaf = |primitive: u32| {
            let corners = world.corners(primitive).map(|p| Vector3::new(p.x, p.y, p.z));
            Leaf { corners, node: 0, primitive }
        };
        let mut leaves: Vec<Leaf> = (0..world.triangles() as u32).map(leaf).collect();
        Self { tree: bvh::bvh::Bvh::build(&mut leaves), leaves }
    }
}

impl Contender for Candidates {
    fn nearest(&self, ray: &Ray, reach: f32) -> Answer {
        let [o, d] = [ray.origin, ray.direction].map(|v| Vector3::new(v.x, v.y, v.z));
        let mut best = Answer { t: reach, primitive: MISS };
        let query = bvh::ray::Ray::new(Point3::from(o), d);
        for leaf in self.tree.nearest_child_traverse_iterator(&query, &self.leaves) {
            if let Some(t) = leaf.meets(&o, &d, best.t) {
                best = Answer { t, primitive: leaf.primitive };
            }
        }
        if best.is_hit() { best } else { Answer::MISS }
    }

    fn any(&self, ray: &Ray, reach: f32) -> bool {
        let [o, d] = [ray.origin, ray.direction].map(|v| Vector3::new(v.x, v.y, v.z));
        let query = bvh::ray::Ray::new(Point3::from(o), d);
        self.tree.traverse_iterator(&query, &self.leaves).any(|leaf| leaf.meets(&o, &d, reach).is_some())
    }

    fn bytes(&self) -> Option<usize> {
        Some(size_of_val(&*self.tree.nodes) + size_of_val(&*self.leaves))
    }
}
