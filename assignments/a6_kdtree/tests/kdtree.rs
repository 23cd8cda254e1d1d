//! kd-trees against the list: same primitive, same bits of t, by every rule, on every scene and
//! on inputs made to break them.

mod world;

use a6_kdtree::kdtree::{KdTree, MAX_DEPTH, Options, Rule};
use common::accel::{Accel, List};
use common::counters::Counters;
use common::geometry::Geometry;
use common::math::{Interval, Vec3};
use common::ray::Ray;
use world::{agree_on, geometry, lumpy_ball, rays, scene, scenes};

fn build(geometry: &Geometry, rule: Rule) -> KdTree<'_> {
    KdTree::new(geometry, Options { rule, ..Options::default() })
}

/// All rules agree with the list on `n` rays; returns the number of hits.
fn agree(geometry: &Geometry, n: usize) -> usize {
    Rule::ALL.into_iter().map(|rule| world::agree(&build(geometry, rule), n)).sum()
}

#[test]
fn a6t1_equals_the_list_on_every_scene() {
    let hits: usize = scenes().map(|g| agree(&g, if g.len() > 10_000 { 40 } else { 400 })).sum();
    assert!(hits > 10_000, "the rays should meet something: {hits}");
}

#[test]
fn a6t1_coincident_concentric_flat_and_single() {
    let equal = "Sphere { center 1 2 3 radius 0.5 } ".repeat(20_000);
    assert!(agree(&geometry(&equal, 20_000), 20) > 0);
    let concentric: String = (1..=20).map(|i| format!("Sphere {{ center 0 0 0 radius {i} }} ")).collect();
    assert!(agree(&geometry(&concentric, 20), 2000) > 0);
    let flat: String = (0..100)
        .map(|i| format!("Triangle {{ vertex0 {i} 0 0 vertex1 {i} 1 0 vertex2 {i}.5 0 0 }} "))
        .collect();
    assert!(agree(&geometry(&flat, 100), 3000) > 0);
    assert!(agree(&geometry("Sphere { center 0 0 0 radius 1 }", 1), 500) > 0);
    let one = "Triangle { vertex0 0 0 0 vertex1 1 0 0 vertex2 0 1 0 }";
    assert!(agree(&geometry(one, 1), 500) > 0);
    assert!(agree(&geometry(&one.repeat(3000), 3000), 50) > 0);
    let mixed = "Plane { normal 0 1 0 offset -1 } Sphere { center 0 0 0 radius 1 } \
                 Triangle { vertex0 -2 0 0 vertex1 2 0 0 vertex2 0 2 0 } \
                 Transform { Scale 1 0.5 2 Rotate { 1 1 0 30 } Sphere { center 1 0 0 radius 1 } }";
    assert!(agree(&geometry(mixed, 4), 3000) > 0);
}

#[test]
fn a6t1_nothing_and_planes_only() {
    let planes = geometry("Plane { normal 0 1 0 offset -1 }", 1);
    for rule in Rule::ALL {
        let (tree, mut c) = (build(&planes, rule), Counters::default());
        tree.validate().unwrap();
        let down = Ray::new(Vec3::ZERO, Vec3::NEG_Y);
        assert_eq!(tree.nearest(&down, Interval::FORWARD, &mut c).map(|h| h.t), Some(1.0));
        let nan = Ray::new(Vec3::NAN, Vec3::NEG_Y);
        assert!(tree.nearest(&nan, Interval::FORWARD, &mut c).is_none());
        assert!(!tree.any(&nan, Interval::ALL, &mut c));
    }
}

/// Sizes that halve for ever make the deepest trees.
#[test]
fn a6t1_geometric_series_and_bounded_depth() {
    let series: String = (0..120)
        .map(|i| format!("Sphere {{ center {:e} 0 0 radius {:e} }} ", 2f64.powi(60 - i), 2f64.powi(58 - i)))
        .collect();
    let geometry = geometry(&series, 120);
    for rule in Rule::ALL {
        for max_depth in [None, Some(0), Some(3), Some(u32::MAX)] {
            let tree = KdTree::new(&geometry, Options { rule, max_depth, leaf: None });
            assert!(tree.summary().depth <= max_depth.unwrap_or(MAX_DEPTH).min(MAX_DEPTH));
            world::agree(&tree, 500);
        }
    }
}

/// Quads on the planes of a lattice, which is where the trees cut.
fn lattice(n: usize) -> Geometry {
    let mut text = String::new();
    for axis in 0..3 {
        for (k, (i, j)) in (0..=n).flat_map(|k| (0..n).flat_map(move |i| (0..n).map(move |j| (k, (i, j))))) {
            let corner = |di: usize, dj: usize| {
                let mut p = [0; 3];
                (p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]) = (k, i + di, j + dj);
                format!("{} {} {}", p[0], p[1], p[2])
            };
            let [a, b, c, d] = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
            text += &format!("Triangle {{ vertex0 {a} vertex1 {b} vertex2 {c} }} ");
            text += &format!("Triangle {{ vertex0 {a} vertex1 {c} vertex2 {d} }} ");
        }
    }
    geometry(&text, 6 * n * n * (n + 1))
}

/// Every combination of special directions, from corners, edges, faces and between.
#[test]
fn a6t1_special_rays_in_an_axis_aligned_lattice() {
    let geometry = lattice(3);
    let list = List::new(&geometry);
    let trees = Rule::ALL.map(|rule| build(&geometry, rule));
    let parts = [0.0, -0.0, 1.0, -1.0, 1e-45, -1e-45, 1e30, -1e30];
    let places = [0.0, 1.0, 1.5, 3.0, -1.0];
    let mut hits = 0;
    for tree in &trees {
        tree.validate().unwrap();
        for d in 0..512 {
            let direction = Vec3::new(parts[d % 8], parts[d / 8 % 8], parts[d / 64]);
            for o in (0..125).step_by(18) {
                let origin = Vec3::new(places[o % 5], places[o / 5 % 5], places[o / 25]);
                hits += agree_on(tree, &list, &Ray::new(origin, direction));
            }
        }
    }
    assert!(hits > 3_000, "{hits}");
    assert!(agree(&geometry, 1000) > 0);
}

/// From inside a closed mesh at its corners and edges: never a miss.
#[test]
fn a6t1_watertight_at_corners_and_edges() {
    let geometry = lumpy_ball(12);
    let list = List::new(&geometry);
    for tree in Rule::ALL.map(|rule| build(&geometry, rule)) {
        tree.validate().unwrap();
        for (i, [a, b, c]) in geometry.triangles().iter().enumerate() {
            let from = Vec3::new(0.01, -0.02, 0.03);
            for target in [*a, (*a + *b) / 2.0, *a + (*c - *a) * 0.3] {
                let (ray, mut counters) = (Ray::new(from, target - from), Counters::default());
                assert!(tree.any(&ray, Interval::FORWARD, &mut counters), "{ray:?}");
                assert!(i % 7 > 0 || agree_on(&tree, &list, &ray) > 0);
            }
        }
    }
}

#[test]
fn a6t1_far_and_tiny_scenes() {
    for (scale, shift) in [(1e-6, 0.0), (1e6, 0.0), (1.0, 148376.0), (1.0, -1e6), (1e-18, 0.0), (1e18, 0.0)] {
        let object = format!(
            "Transform {{ Translate {shift} 1 {shift} UniformScale {scale} TriangleMesh {{ obj_file lumpy_8 }} }}"
        );
        assert!(agree(&geometry(&object, 1), 300) > 0);
    }
}

#[test]
fn a6t1_the_tree_does_not_depend_on_threads() {
    let geometry = lumpy_ball(36);
    for rule in Rule::ALL {
        let with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| build(&geometry, rule).fingerprint())
        };
        let one = with(1);
        assert!([2, 3, 7].into_iter().all(|n| with(n) == one), "{rule:?}");
    }
}

#[test]
fn a6t1_the_heuristic_is_cheaper_than_the_middle() {
    for geometry in [lumpy_ball(40), scene("scene5_09_bunny_mesh_40k.txt")] {
        let trees = Rule::ALL.map(|rule| build(&geometry, rule));
        let [textbook, median, objects, sah] = trees.each_ref().map(|tree| tree.summary().cost);
        let all = [textbook, median, objects, sah];
        assert!(sah < 0.85 * median && sah < 0.7 * objects && objects < textbook, "{all:?}");
        for rays in [rays(&geometry, 2000), view(&geometry)] {
            // In blocks of eight triangles, a step costing what the build takes it to cost.
            let price = trees.each_ref().map(|tree| {
                let mut c = Counters::default();
                rays.iter().for_each(|ray| {
                    tree.nearest(ray, Interval::FORWARD, &mut c);
                });
                c.cells as f64 * 1.5 + c.intersections as f64 / 8.0
            });
            let [textbook, median, objects, sah] = price;
            assert!(sah < 0.9 * median && sah < 0.9 * objects && sah < 0.6 * textbook, "{price:?}");
        }
    }
}

/// Rays from one point outside through a lattice of points in the middle of the box.
fn view(geometry: &Geometry) -> Vec<Ray> {
    let bounds = geometry.bounds().unwrap();
    let eye = bounds.max + bounds.size() * Vec3::new(0.1, 0.2, 1.0);
    let target =
        |i: usize, j: usize| bounds.min + bounds.size() * Vec3::new(i as f32 / 50.0, j as f32 / 50.0, 0.5);
    (0..50).flat_map(|i| (0..50).map(move |j| Ray::new(eye, target(i, j) - eye))).collect()
}

#[test]
fn a6t1_memory_leaf_size_and_summary() {
    let geometry = lumpy_ball(58);
    let tree = build(&geometry, Rule::Sah);
    let per_triangle = tree.bytes() as f64 / geometry.len() as f64;
    assert!(per_triangle <= 80.0, "{per_triangle} bytes per triangle");
    let (s, leaf) = (tree.summary(), Some(1024));
    assert_eq!(s.nodes, 2 * s.leaves - 1);
    assert!(s.references >= geometry.len() && s.empty < s.leaves);
    let coarse = KdTree::new(&geometry, Options { leaf, ..Options::default() });
    coarse.validate().unwrap();
    assert!(coarse.summary().leaves < s.leaves / 2);
}

#[test]
fn a6t1_ties_and_neighbours_in_different_leaves() {
    let (geometry, rays) = world::ties();
    let list = List::new(&geometry);
    for rule in Rule::ALL {
        let tree = build(&geometry, rule);
        let hits: usize = rays.iter().map(|ray| agree_on(&tree, &list, ray)).sum();
        assert!(hits > 10_000, "{hits}");
    }
}
