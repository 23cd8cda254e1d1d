//! Property 2: meshes of any size, at any place, under any transform.

use super::passages::odd_passages;
use super::{from_inside, grid, must_hit};
use crate::kit::{build, fan, file_mesh, geometry_of, inside_points, lattice_sphere, lumpy_sphere, placed};
use crate::{Stress, Trials};
use a6_kdtree::bvh::Bvh;
use a6_kdtree::kdtree::{KdTree, Options};
use common::accel::List;
use common::math::DVec3;

/// Scale and offset of property 2. The last ones leave a mesh of a few dozen units on a lattice
/// as coarse as 1/64 or 1: corners collapse, the mesh stays closed.
pub(super) fn placements() -> Vec<(f64, DVec3)> {
    let far = DVec3::new(148_376.0, 1234.0, -223_423.0);
    let scales = [2f64.powi(-60), 2f64.powi(60), 1e-6, 1e-3, 1e3, 1e6];
    let mut all: Vec<_> = scales.iter().map(|&s| (s, DVec3::ZERO)).collect();
    all.extend([1.0, 16.0, 1000.0].map(|s| (s, far)));
    all.extend([(1000.0, DVec3::splat(1e7)), (30.0, DVec3::new(-1e7, 1e7, 3.0)), (1e5, DVec3::X * 1e7)]);
    all.extend([(1e-6, DVec3::new(0.5, 0.25, -0.5) * 1e-4), (1e6, far * 10.0)]);
    all
}

/// Rays hit, and whole lines pass an odd number of times, wherever the mesh is put.
pub fn places(stress: &Stress) {
    let meshes = [
        ("lumpy sphere", lumpy_sphere(2, 4)),
        ("lattice sphere", lattice_sphere(2, 2)),
        ("diamond", file_mesh("diamond.obj")),
        ("split square fans", fan(16, 3)),
        ("bunny_200", file_mesh("bunny_200.obj")),
    ];
    for (name, mesh) in &meshes {
        for (scale, offset) in placements() {
            let place = placed(mesh, scale, offset, 32);
            assert!(place.inside.len() >= 4, "{name} × {scale:e} + {offset}: no point inside");
            let geometry = geometry_of(&place.triangles);
            let (list, grid) = (List::new(&geometry), grid(&geometry));
            let (tree, bvh) = (KdTree::new(&geometry, Options::default()), Bvh::new(&geometry));
            let label = format!("{name} × {scale:.1e} + {offset:.0}");
            stress.run(format!("p02 hits, {label}"), 201, Trials::new(1_000, 60_000), |draw| {
                let ray = from_inside(draw, &place.triangles, &place.inside);
                must_hit(&list, &ray)
                    .and(must_hit(&grid, &ray))
                    .and(must_hit(&tree, &ray))
                    .and(must_hit(&bvh, &ray))
            });
            odd_passages(stress, &format!("p02 parity, {label}"), &place, 500);
        }
    }
}

/// The same under transforms around transforms.
pub fn nested(stress: &Stress) {
    let around = "Transform { Translate 3 -7 11 Rotate { 1 2 3 40 }
        Transform { Scale 2 -0.5 1 ZRotate 33 Group { numObjects 1
        Transform { Matrix { 1 0.5 0 0  0 1 0.25 0  0.125 0 1 0  0 0 0 1 } UniformScale 0.01
        TriangleMesh { obj_file it } } } } }";
    for (name, mesh) in
        [("lumpy", lumpy_sphere(3, 5)), ("fans", fan(64, 6)), ("diamond", file_mesh("diamond.obj"))]
    {
        let geometry = build(around, mesh);
        let inside = inside_points(geometry.triangles(), 32, 12);
        assert!(inside.len() >= 8, "{name}: no point inside");
        let (list, grid) = (List::new(&geometry), grid(&geometry));
        let (tree, bvh) = (KdTree::new(&geometry, Options::default()), Bvh::new(&geometry));
        stress.run(format!("p02 nested transforms, {name}"), 203, Trials::new(20_000, 600_000), |draw| {
            let ray = from_inside(draw, geometry.triangles(), &inside);
            must_hit(&list, &ray)
                .and(must_hit(&grid, &ray))
                .and(must_hit(&tree, &ray))
                .and(must_hit(&bvh, &ray))
        });
    }
}
