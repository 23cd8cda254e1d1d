//! The picture of the leaves' boxes against all boxes, and against the scene that they hold.

use crate::world::{geometry, lumpy_ball, rays, scene, scenes};
use crate::{args, file, picture, printed, studio_of};
use a6_kdtree::kdtree::{KdTree, Options, Rule};
use a6_kdtree::picture::{BoxPicture, Entered, first_box};
use common::accel::{Accel, List};
use common::counters::Counters;
use common::math::{Bounds, Interval, Vec3};
use common::ray::Ray;

/// All leaves that hold something: their place, box and number of primitives.
fn full_leaves(tree: &KdTree) -> Vec<(usize, Bounds, usize)> {
    let mut waiting = vec![(0, tree.root_box())];
    let mut leaves = Vec::new();
    while let Some((place, bounds)) = waiting.pop() {
        let node = tree.nodes()[place];
        if node.is_leaf() {
            leaves.push((place, bounds, tree.held_by(node)));
            continue;
        }
        let (mut low, mut high) = (bounds, bounds);
        low.max[node.axis()] = node.at();
        high.min[node.axis()] = node.at();
        waiting.extend([(node.child(), low), (node.child() + 1, high)]);
    }
    leaves.retain(|(_, _, held)| *held > 0);
    leaves
}

/// From where to where a ray is in a closed box.
fn stretch(ray: &Ray, b: &Bounds) -> Option<(f64, f64)> {
    let (mut enter, mut exit) = (f64::NEG_INFINITY, f64::INFINITY);
    for k in 0..3 {
        let (o, d) = (f64::from(ray.origin[k]), f64::from(ray.direction[k]));
        let sides = [f64::from(b.min[k]), f64::from(b.max[k])];
        if d == 0.0 {
            if !(sides[0]..=sides[1]).contains(&o) {
                return None;
            }
        } else {
            let t = sides.map(|s| (s - o) / d);
            (enter, exit) = (enter.max(t[0].min(t[1])), exit.min(t[0].max(t[1])));
        }
    }
    (enter <= exit).then_some((enter, exit))
}

/// The first of all boxes, asked one by one.
fn first_of(leaves: &[(usize, Bounds, usize)], ray: &Ray, interval: Interval) -> Option<(f64, usize, usize)> {
    let (min, max) = (f64::from(interval.min), f64::from(interval.max));
    let met = leaves.iter().filter_map(|(place, bounds, held)| {
        let (enter, exit) = stretch(ray, bounds)?;
        (exit > min && enter < max).then_some((enter, *place, *held))
    });
    met.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))
}

#[test]
fn a6t5_the_first_box_is_the_first_of_all_boxes() {
    let (mut met, mut inside, mut c) = (0, 0, Counters::default());
    let some = scenes().filter(|g| g.len() < 3000).chain([lumpy_ball(8)]);
    for geometry in some {
        for rule in Rule::ALL {
            let tree = KdTree::new(&geometry, Options { rule, ..Options::default() });
            let leaves = full_leaves(&tree);
            for ray in rays(&geometry, 60) {
                for interval in [Interval::FORWARD, Interval::ALL, Interval::up_to(0.5)] {
                    let found = first_box(&tree, &ray, interval, &mut c);
                    let expected = first_of(&leaves, &ray, interval);
                    assert_eq!(found.map(|e| (e.t, e.leaf, e.count)), expected, "{ray:?}");
                    let Some(Entered { t, axis, leaf, .. }) = found else { continue };
                    let (_, bounds, _) = leaves.iter().find(|l| l.0 == leaf).unwrap();
                    let towards = ray.direction[axis] > 0.0;
                    let face = if towards { bounds.min[axis] } else { bounds.max[axis] };
                    let off = (ray.at(t)[axis] - f64::from(face)).abs();
                    assert!(off <= 1e-12 * (1.0 + f64::from(face).abs() + ray.origin[axis].abs() as f64));
                    met += 1;
                    inside += usize::from(interval == Interval::FORWARD && t < 0.0);
                }
            }
        }
    }
    assert!(met > 5000 && inside > 100, "{met} {inside}");
}

/// Balls on a lattice, cut along lattice planes, and rays through edges and corners of the boxes:
/// where several are entered at the same t, the first in the tree counts.
#[test]
fn a6t5_boxes_that_are_entered_together() {
    // Not all, so that leaves stand at different depths.
    let balls: String = (0..64)
        .filter(|i| i % 5 != 0)
        .map(|i| format!("Sphere {{ center {} {} {} radius 0.25 }} ", i % 4, i / 4 % 4, i / 16))
        .collect();
    let geometry = geometry(&balls, 51);
    let (mut together, mut c) = (0, Counters::default());
    for rule in Rule::ALL {
        let tree = KdTree::new(&geometry, Options { rule, leaf: Some(1), ..Options::default() });
        let leaves = full_leaves(&tree);
        let planes: Vec<(usize, f32)> =
            tree.nodes().iter().filter(|n| !n.is_leaf()).map(|n| (n.axis(), n.at())).collect();
        for (i, (a, at)) in planes.iter().enumerate() {
            let (b, other) = planes[(i * 7 + 3) % planes.len()];
            let mut origin = Vec3::splat(1.5);
            origin[*a] = *at;
            origin[b] = other;
            for signs in 0..27 {
                let sign = |k: i32| (signs / k % 3 - 1) as f32;
                let direction = Vec3::new(sign(1), sign(3), sign(9));
                if direction == Vec3::ZERO {
                    continue;
                }
                let ray = Ray::new(origin - direction * 8.0, direction);
                let expected = first_of(&leaves, &ray, Interval::ALL);
                let found = first_box(&tree, &ray, Interval::ALL, &mut c);
                assert_eq!(found.map(|e| (e.t, e.leaf, e.count)), expected, "{ray:?}");
                let enter = |b: &Bounds| stretch(&ray, b).map(|s| s.0);
                let same =
                    leaves.iter().filter(|l| expected.is_some() && enter(&l.1) == expected.map(|e| e.0));
                together += usize::from(same.count() > 1);
            }
        }
    }
    assert!(together > 1000, "{together}");
}

/// Nothing is hit outside the boxes.
#[test]
fn a6t5_every_hit_lies_in_or_behind_the_first_box() {
    let (mut hits, mut c) = (0, Counters::default());
    for geometry in
        [lumpy_ball(20), scene("scene5_05_sphere_triangles.txt"), scene("scene5_03_offcenter_spheres.txt")]
    {
        let list = List::new(&geometry);
        for rule in Rule::ALL {
            let tree = KdTree::new(&geometry, Options { rule, ..Options::default() });
            for ray in rays(&geometry, 2000) {
                let found = first_box(&tree, &ray, Interval::FORWARD, &mut c);
                let Some(hit) = list.nearest(&ray, Interval::FORWARD, &mut c) else { continue };
                let reach = 1.0 + f64::from(hit.t.abs());
                assert!(found.is_some_and(|e| e.t <= f64::from(hit.t) + 1e-6 * reach), "{found:?} {hit:?}");
                hits += 1;
            }
        }
    }
    assert!(hits > 1500, "{hits}");
}

/// A tree without planes is a grid of one cell, and looks like one.
#[test]
fn a6t5_a_single_leaf_looks_like_a_single_cell() {
    let folder = tempfile::tempdir().unwrap();
    let all = format!("-input {} -size 60 50", file("scene5_06_bunny_mesh_200.txt").display());
    printed(folder.path(), &format!("{all} -output @/tree.png -visualize_kdtree -kd_max_depth 0"));
    printed(folder.path(), &format!("{all} -output @/grid.png -visualize_grid -grid 1 1 1"));
    assert_eq!(picture(folder.path(), "tree.png"), picture(folder.path(), "grid.png"));
    let colors = picture(folder.path(), "tree.png");
    assert!(colors.pixels().iter().any(|c| *c != colors.get(0, 0)), "a box before a background");
}

#[test]
fn a6t5_planes_have_no_boxes() {
    let text = "PerspectiveCamera { center 0 0 5 direction 0 0 -1 up 0 1 0 angle 40 }
        Background { color 0.25 0.5 0.75 } Materials { numMaterials 1 Material { } }
        Group { numObjects 1 MaterialIndex 0 Plane { normal 0 0 1 offset 0 } }";
    let (studio, args) = (studio_of(text, 20, 20), args("-visualize_kdtree"));
    let tree = KdTree::new(&studio.geometry, args.options());
    let light = args.grid.whitted.phong.diffuse.local_light(&studio.scene);
    let layer = BoxPicture { tree: &tree, light, interval: studio.camera.interval };
    let (films, counters) = studio.render(args.cast(), &tree, &[&layer]);
    assert!(films[0].pixels().iter().all(|c| *c == Vec3::new(0.25, 0.5, 0.75)));
    assert_eq!((counters.rays, counters.cells, counters.intersections), (400, 0, 0));
}

/// Depth and normals beside the boxes are those of the scene.
#[test]
fn a6t5_side_pictures_show_the_scene() {
    let folder = tempfile::tempdir().unwrap();
    let all = format!("-input {} -size 60 60", file("scene5_06_bunny_mesh_200.txt").display());
    printed(
        folder.path(),
        &format!("{all} -output @/a.png -normals @/a.pfm -visualize_kdtree -kdtree median"),
    );
    printed(folder.path(), &format!("{all} -output @/b.png -normals @/b.pfm -accel list"));
    assert_eq!(picture(folder.path(), "a.pfm"), picture(folder.path(), "b.pfm"));
    assert_ne!(picture(folder.path(), "a.png"), picture(folder.path(), "b.png"));
}
