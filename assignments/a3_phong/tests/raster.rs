//! A3T3: the rasteriser by itself, on corners given in pixels.

use a3_phong::{Canvas, Corner, rasterise};
use common::camera::screen_position;
use common::math::{DVec3, Vec3};
use common::picture::{Film, Size};
use common::tiles::TileOptions;

const SIDE: i64 = 40;

fn canvas<'a>() -> Canvas<'a> {
    let size = Size::new(SIDE, SIDE).unwrap();
    Canvas { size, background: Vec3::ZERO, nearest: f64::NEG_INFINITY, options: TileOptions::default() }
}

/// A corner at a point of the picture in pixels.
fn corner(x: f64, y: f64, depth: f64, color: Vec3) -> Corner {
    let (x, y) = screen_position(canvas().size, x, y);
    Corner { screen: DVec3::new(x, y, 1.0), depth, color }
}

fn triangle(points: [(f64, f64); 3], depth: f64, color: Vec3) -> [Corner; 3] {
    points.map(|(x, y)| corner(x, y, depth, color))
}

fn covered(film: &Film) -> Vec<(u32, u32)> {
    let side = SIDE as u32;
    let all = (0..side).flat_map(|y| (0..side).map(move |x| (x, y)));
    all.filter(|&(x, y)| film.get(x, y) != Vec3::ZERO).collect()
}

/// How often each pixel is covered when every triangle is drawn alone.
fn times_covered(triangles: &[[(f64, f64); 3]]) -> Vec<u32> {
    let mut times = vec![0; (SIDE * SIDE) as usize];
    for &points in triangles {
        let film = rasterise(&canvas(), [triangle(points, 1.0, Vec3::ONE)]);
        times.iter_mut().zip(film.pixels()).for_each(|(n, c)| *n += u32::from(*c != Vec3::ZERO));
    }
    times
}

/// Corners on pixel centres, so every edge runs through pixel centres: the hardest case.
#[test]
fn a3t3_top_and_left_edges_belong_to_a_triangle() {
    let (a, b, c, d) = ((2.5, 2.5), (6.5, 2.5), (6.5, 5.5), (2.5, 5.5));
    let expected: Vec<(u32, u32)> = (3..6).flat_map(|y| (2..6).map(move |x| (x, y))).collect();
    for triangles in [[[a, b, c], [a, c, d]], [[a, b, d], [b, c, d]], [[c, b, a], [d, c, a]]] {
        let drawn = triangles.map(|points| triangle(points, 1.0, Vec3::ONE));
        assert_eq!(covered(&rasterise(&canvas(), drawn)), expected);
    }
}

#[test]
fn a3t3_common_edges_leave_no_gap_and_are_not_drawn_twice() {
    // A fan around a pixel centre, its rim on pixel centres, wound both ways in turn.
    let rim: Vec<(f64, f64)> = [(35, 20), (31, 33), (20, 36), (8, 30), (4, 20), (9, 6), (20, 3), (30, 7)]
        .map(|(x, y)| (f64::from(x) + 0.5, f64::from(y) + 0.5))
        .to_vec();
    let middle = (20.5, 20.5);
    let fan: Vec<[(f64, f64); 3]> = (0..rim.len())
        .map(|i| (rim[i], rim[(i + 1) % rim.len()], i % 2 == 0))
        .map(|(a, b, turned)| if turned { [middle, b, a] } else { [middle, a, b] })
        .collect();
    let times = times_covered(&fan);
    assert!(times.iter().all(|&n| n <= 1), "drawn twice");
    // The same region cut differently: a fan around a rim corner.
    let other: Vec<[(f64, f64); 3]> = (1..rim.len() - 1).map(|i| [rim[0], rim[i], rim[i + 1]]).collect();
    assert_eq!(times, times_covered(&other));
    assert!(times.iter().sum::<u32>() > 700);
}

#[test]
fn a3t3_a_plane_of_scattered_triangles_is_covered_exactly_once() {
    // A grid with corners moved about, larger than the picture.
    let at = |i: i32, j: i32| {
        let wobble = |k: i32| f64::from((i * 7919 + j * 104_729 + k * 31).rem_euclid(97)) / 97.0 - 0.5;
        (f64::from(i) * 6.0 + 4.0 * wobble(1), f64::from(j) * 6.0 + 4.0 * wobble(2))
    };
    let cells = (-2..9).flat_map(|j| (-2..9).map(move |i| (i, j)));
    let triangles: Vec<[(f64, f64); 3]> = cells
        .flat_map(|(i, j)| {
            let (a, b, c, d) = (at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
            [[a, b, c], [a, c, d]]
        })
        .collect();
    assert!(times_covered(&triangles).iter().all(|&n| n == 1));
}

#[test]
fn a3t3_the_nearest_wins_in_any_order() {
    let big = [(-50.0, -50.0), (150.0, -50.0), (-50.0, 150.0)];
    let layers = [(3.0, Vec3::X), (-2.0, Vec3::Y), (7.0, Vec3::Z)].map(|(z, c)| triangle(big, z, c));
    for order in [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]] {
        let film = rasterise(&canvas(), order.map(|k| layers[k]));
        assert!(film.pixels().iter().all(|&c| c == Vec3::Y), "{order:?}");
    }
    let equal = [triangle(big, 1.0, Vec3::X), triangle(big, 1.0, Vec3::Y)];
    assert_eq!(rasterise(&canvas(), equal).get(5, 5), Vec3::X, "at equal depth the first stays");
}

/// Two triangles that pass through each other meet where their depths are equal.
#[test]
fn a3t3_intersecting_triangles_part_at_equal_depth() {
    let flat = triangle([(-50.0, -50.0), (150.0, -50.0), (-50.0, 150.0)], 12.0, Vec3::X);
    let slanted = [(-50.0, -50.0), (150.0, -50.0), (-50.0, 150.0)].map(|(x, y)| corner(x, y, x, Vec3::Y));
    let film = rasterise(&canvas(), [flat, slanted]);
    for x in 0..SIDE as u32 {
        // Depth x + ½ at pixel x: nearer than 12 up to x = 11.
        let expected = if x < 12 { Vec3::Y } else { Vec3::X };
        assert!((0..SIDE as u32).all(|y| film.get(x, y) == expected), "{x}");
    }
}

/// A floor under the eye, from far ahead to behind: everything below the horizon and nothing
/// above it, with no clipping and no division by w ≤ 0.
#[test]
fn a3t3_triangles_that_reach_behind_the_eye_are_cut_at_it() {
    let eye = Canvas { nearest: 0.0, ..canvas() };
    // Homogeneous (x, y, w) = (X + w/2, −1 + w/2, w) for the point (X, −1) at distance w.
    let point = |x: f64, w: f64| Corner {
        screen: DVec3::new(x + 0.5 * w, -1.0 + 0.5 * w, w),
        depth: w,
        color: Vec3::ONE,
    };
    let floor = [point(-1e6, 1e6), point(1e6, 1e6), point(0.0, -10.0)];
    let film = rasterise(&eye, [floor]);
    let expected: Vec<(u32, u32)> = (0..20).flat_map(|y| (0..40).map(move |x| (x, y))).collect();
    assert_eq!(covered(&film), expected);
    let behind = [point(-5.0, -1.0), point(5.0, -1.0), point(0.0, -9.0)];
    assert!(covered(&rasterise(&eye, [behind])).is_empty());
}

/// Colours are linear in space: on a receding floor the colour at depth w is w / 100, and depth
/// is known from the height on the screen.
#[test]
fn a3t3_colours_are_blended_in_perspective() {
    let eye = Canvas { nearest: 0.0, ..canvas() };
    let point = |x: f64, w: f64| Corner {
        screen: DVec3::new(x + 0.5 * w, -1.0 + 0.5 * w, w),
        depth: w,
        color: Vec3::splat(w as f32 / 100.0),
    };
    let film = rasterise(&eye, [[point(-200.0, 100.0), point(200.0, 100.0), point(0.0, 0.1)]]);
    for y in 0..19 {
        let below_horizon = 0.5 - (f64::from(y) + 0.5) / SIDE as f64;
        let expected = 1.0 / below_horizon / 100.0;
        assert!((f64::from(film.get(20, y).x) - expected).abs() < 1e-6, "row {y}");
    }
}

#[test]
fn a3t3_triangles_without_area_draw_nothing_and_break_nothing() {
    let odd = [
        [(5.5, 5.5), (5.5, 5.5), (5.5, 5.5)],
        [(1.5, 1.5), (9.5, 9.5), (1.5, 1.5)],
        [(1.5, 1.5), (9.5, 9.5), (20.5, 20.5)],
        [(f64::NAN, 0.0), (30.0, 0.0), (0.0, 30.0)],
        [(f64::INFINITY, 0.0), (30.0, 0.0), (0.0, 30.0)],
    ];
    for points in odd {
        let film = rasterise(&canvas(), [triangle(points, 1.0, Vec3::ONE)]);
        assert!(covered(&film).is_empty(), "{points:?}");
    }
}
