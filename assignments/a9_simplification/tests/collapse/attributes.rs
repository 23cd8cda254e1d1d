//! Normals and texture coordinates.

use crate::shapes::{METHODS, grid, one};
use a9_simplification::{Goal, Method};
use common::math::{Vec2, Vec3};
use common::mesh::Mesh;
use std::collections::HashMap;
use std::f32::consts::TAU;

/// A tube along z whose seam has texture coordinates 0 on one side and 1 on the other.
fn tube(n: u32) -> Mesh {
    let around = |u: f32| if u == 1.0 { 0.0 } else { TAU * u };
    let mut tube = grid(n, |u, v| Vec3::new(around(u).cos(), around(u).sin(), 3.0 * v));
    tube.normals = tube.positions.iter().map(|p| Vec3::new(p.x, p.y, 0.0)).collect();
    tube.uvs = (0..(n + 1) * (n + 1))
        .map(|i| Vec2::new((i % (n + 1)) as f32, (i / (n + 1)) as f32) / n as f32)
        .collect();
    tube
}

#[test]
fn attributes_stay_with_their_places() {
    for method in METHODS {
        let simplified = one(&tube(32), Goal::Ratio(0.1), method).mesh;
        assert_eq!(simplified.normals.len(), simplified.positions.len());
        assert_eq!(simplified.uvs.len(), simplified.positions.len());
        for ((p, n), uv) in simplified.positions.iter().zip(&simplified.normals).zip(&simplified.uvs) {
            assert!((n.length() - 1.0).abs() < 1e-5);
            let outward = Vec3::new(p.x, p.y, 0.0).normalize();
            assert!(n.dot(outward) > 0.97, "{method:?} {n} at {p}");
            assert!((uv.y * 3.0 - p.z).abs() < 0.1, "{method:?} {uv} at {p}");
            let turn = (p.y.atan2(p.x) / TAU).rem_euclid(1.0);
            let off = (uv.x - turn).abs();
            assert!(off.min(1.0 - off) < 0.03, "{method:?} {uv} at {p}");
        }
    }
}

#[test]
fn seams_stay_seams() {
    for method in METHODS {
        let simplified = one(&tube(32), Goal::Ratio(0.1), method).mesh;
        // No triangle reaches across: its texture would run backwards all around.
        for t in &simplified.triangles {
            let u = t.map(|i| simplified.uvs[i as usize].x);
            let spread = u.iter().fold(0.0f32, |m, x| m.max((x - u[0]).abs()));
            assert!(spread < 0.75, "{method:?} {u:?}");
        }
        let mut sides: HashMap<[u32; 3], Vec<f32>> = HashMap::new();
        for (p, uv) in simplified.positions.iter().zip(&simplified.uvs) {
            sides.entry(p.to_array().map(f32::to_bits)).or_default().push(uv.x);
        }
        let seam: Vec<_> = sides.values().filter(|u| u.len() == 2).collect();
        assert!(seam.len() >= 2, "{method:?}");
        assert!(sides.values().all(|u| u.len() <= 2));
        assert!(seam.iter().all(|u| (u[0] - u[1]).abs() > 0.9), "{method:?} {seam:?}");
    }
}

#[test]
fn the_map_leads_near() {
    for mesh in [tube(24), Mesh { normals: vec![], uvs: vec![], ..tube(24) }] {
        let simplified = one(&mesh, Goal::Ratio(0.2), Method::Memoryless);
        assert_eq!(simplified.becomes.len(), mesh.positions.len());
        for (&to, from) in simplified.becomes.iter().zip(&mesh.positions) {
            let apart = simplified.mesh.positions[to as usize] - *from;
            assert!(apart.length() < 1.0, "{apart}");
        }
    }
}
