//! Scratch: speed of the hierarchy on bounce and random rays.
use a6_kdtree::bvh::Bvh;
use common::accel::{Accel, List};
use common::counters::Counters;
use common::geometry::Geometry;
use common::math::{Interval, Vec3};
use common::ray::Ray;
use std::path::Path;
use std::time::Instant;

fn main() {
    let scene = common::scene::load(Path::new("scenes/scene5_09_bunny_mesh_40k.txt")).unwrap();
    let geometry = Geometry::build(&scene).unwrap();
    for _ in 0..3 {
        let t = Instant::now();
        let bvh = Bvh::new(&geometry);
        println!("build {:?} {:?} {} B/tri", t.elapsed(), bvh.counts(), bvh.bytes() / 40000);
    }
    let bvh = Bvh::new(&geometry);
    let list = List::new(&geometry);
    let grid = a5_grid::Grid::new(
        &geometry,
        a5_grid::Cells::new([40, 40, 33], &geometry.bounds().unwrap()),
        a5_grid::Fit::Exact,
    )
    .unwrap();
    let mut s = 1u64;
    let mut r = || {
        s = s.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (s >> 40) as f32 / (1u64 << 24) as f32
    };
    let b = geometry.bounds().unwrap();
    let c = (b.min + b.max) / 2.0;
    let eye = c + Vec3::new(0.45, 0.35, 1.0) * 0.5;
    let n = 512;
    let fwd = (c - eye).normalize();
    let right = fwd.cross(Vec3::Y).normalize();
    let up = right.cross(fwd);
    let mut primary = vec![];
    for y in 0..n {
        for x in 0..n {
            let (u, v) = ((x as f32 + 0.5) / n as f32 - 0.5, (y as f32 + 0.5) / n as f32 - 0.5);
            primary.push(Ray::new(eye, (fwd + right * u * 0.7 + up * v * 0.7).normalize()));
        }
    }
    let mut counters = Counters::default();
    let mut bounce = vec![];
    for ray in &primary {
        if let Some(h) = bvh.nearest(ray, Interval::FORWARD, &mut counters) {
            let sf = geometry.surface(ray, &h);
            let (z, phi) = (1.0 - 2.0 * r(), r() * 6.2831);
            let q = (1.0f32 - z * z).sqrt();
            let d = (sf.normal + Vec3::new(q * phi.cos(), q * phi.sin(), z)).normalize();
            bounce.push(Ray::new(sf.leave(d.as_dvec3()), d));
        }
    }
    let mut random = vec![];
    for _ in 0..200000 {
        let o = b.min + (b.max - b.min) * Vec3::new(r(), r(), r());
        let (z, phi) = (1.0 - 2.0 * r(), r() * 6.2831);
        let q = (1.0f32 - z * z).sqrt();
        random.push(Ray::new(o, Vec3::new(q * phi.cos(), q * phi.sin(), z)));
    }
    for (name, rays) in [("primary", &primary), ("bounce", &bounce), ("random", &random)] {
        for ray in rays.iter().step_by(997) {
            let (a, b) = (
                bvh.nearest(ray, Interval::FORWARD, &mut counters),
                list.nearest(ray, Interval::FORWARD, &mut counters),
            );
            assert_eq!(a, b);
        }
        let mut line = format!("{name} {}: ", rays.len());
        for accel in [&bvh as &dyn Accel, &grid] {
            let mut best = f64::MAX;
            let mut c = Counters::default();
            for _ in 0..5 {
                c = Counters::default();
                let t = Instant::now();
                for ray in rays {
                    std::hint::black_box(accel.nearest(ray, Interval::FORWARD, &mut c));
                }
                best = best.min(t.elapsed().as_secs_f64());
            }
            let n = rays.len() as f64;
            line += &format!(
                "{:.2} Mrays/s (nodes {:.1} tests {:.1} exact {:.2})  ",
                n / best / 1e6,
                c.cells as f64 / n,
                c.intersections as f64 / n,
                c.exact_tests as f64 / n
            );
        }
        println!("{line}");
    }
}
