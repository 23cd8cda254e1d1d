//! The tree against asking every triangle.

use super::*;
use crate::world::plain;
use modeller::generated::{Recipe, gyroid, sphere, terrain};
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

fn everything(mesh: &Mesh, ray: &Ray, reach: f64) -> Truth {
    let line = Line::new(ray);
    let hits = mesh.triangles.iter().zip(0..).filter_map(|(t, primitive)| {
        let t = line.meets(corners(mesh, t))?;
        (t > 0.0 && t < reach).then_some(Truth { t, primitive })
    });
    let nearer = |a: Truth, b: Truth| if b.t < a.t { b } else { a };
    hits.reduce(nearer).unwrap_or(Truth { t: f64::INFINITY, primitive: MISS })
}

/// Rays from in and around the mesh; some along axes, some through vertices.
fn rays(mesh: &Mesh, n: usize) -> Vec<Ray> {
    let mut random = Pcg64Mcg::seed_from_u64(11);
    let mut unit = move || (random.next_u32() >> 8) as f32 / (1 << 23) as f32 - 1.0;
    let mut point = move || Vec3::from_array(std::array::from_fn(|_| unit()));
    let ray = |i: usize| {
        let (origin, mut direction) = (point() * 2.0, point());
        match i % 4 {
            0 => direction[i % 3] = 0.0,
            1 => direction = mesh.positions[i * 7 % mesh.positions.len()] - origin,
            _ => {}
        }
        Ray::new(origin, direction)
    };
    (0..n).map(ray).collect()
}

#[test]
fn the_tree_finds_what_asking_every_triangle_finds() {
    for made in [sphere(1_000), gyroid(3_000), terrain(500), sphere(100)] {
        let mesh = plain(made);
        let tree = Tree::new(&mesh);
        let mut hits = 0;
        for (ray, reach) in rays(&mesh, 1_500).iter().zip([f64::INFINITY, 1.0, 0.3].into_iter().cycle()) {
            let expected = everything(&mesh, ray, reach);
            assert_eq!(tree.nearest(ray, reach), expected, "{ray:?}");
            hits += usize::from(expected.is_hit());
        }
        assert!(hits > 200, "{hits}");
    }
}

/// From inside a closed ball every ray leaves somewhere, also through vertices and edges.
#[test]
fn nothing_slips_through_a_closed_mesh() {
    let mesh = plain(Recipe::make(&"sphere2k".parse().unwrap()));
    let tree = Tree::new(&mesh);
    let from = Vec3::new(0.01, -0.02, 0.03);
    let through = mesh.triangles.iter().flat_map(|t| {
        let [a, b, _] = corners(&mesh, t);
        [a, (a + b) / 2.0]
    });
    let rays: Vec<Ray> = through.map(|p| Ray::new(from, p - from)).collect();
    assert!(tree.trace(&rays, f64::INFINITY).iter().all(Truth::is_hit));
}

#[test]
fn one_triangle_and_equal_triangles() {
    let positions = vec![Vec3::ZERO, Vec3::X, Vec3::Y];
    for n in [1, 2, 5, 33] {
        let mesh = Mesh { positions: positions.clone(), triangles: vec![[0, 1, 2]; n], ..Mesh::default() };
        let tree = Tree::new(&mesh);
        let ray = Ray::new(Vec3::new(0.25, 0.25, 1.0), Vec3::NEG_Z);
        assert_eq!(tree.nearest(&ray, f64::INFINITY), Truth { t: 1.0, primitive: 0 });
        assert!(!tree.nearest(&ray, 1.0).is_hit());
    }
}
