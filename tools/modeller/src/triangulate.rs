//! Polygons with holes cut into triangles, over the corners that they have.
//!
//! Holes are joined to the outline by bridges, and of the single polygon that results one ear
//! after the other is cut off (Meisters, "Polygons Have Ears", 1975). Of all ears the best
//! shaped goes first, so that strokes of letters are cut across and not along.

use crate::outline::Ring;
use glam::DVec2;

/// Triangles over the corners of `rings`, numbered ring after ring; counter-clockwise. The
/// first ring is the outline, counter-clockwise; the others are holes in it, clockwise. No two
/// rings touch.
///
/// # Panics
/// If rings cross themselves or each other.
pub fn triangulate(rings: &[Ring]) -> Vec<[u32; 3]> {
    let points: Vec<DVec2> = rings.concat();
    let mut path = joined(rings, &points);
    let mut triangles = Vec::with_capacity(path.len());
    while path.len() > 3 {
        let ears = (0..path.len()).filter_map(|i| Some((ear_shape(&points, &path, i)?, i)));
        let best = ears.reduce(|best, ear| if ear.0 > best.0 { ear } else { best });
        let (_, i) = best.expect("a polygon that does not cross itself has an ear");
        triangles.push(around(&path, i));
        path.remove(i);
    }
    triangles.push([path[0], path[1], path[2]]);
    triangles
}

/// The corner at place `i` of the path between its neighbours.
fn around(path: &[u32], i: usize) -> [u32; 3] {
    let n = path.len();
    [path[(i + n - 1) % n], path[i], path[(i + 1) % n]]
}

/// All rings as one closed path. Bridges are the shortest links between corners, which cross
/// nothing: what they crossed would have offered a shorter one.
fn joined(rings: &[Ring], points: &[DVec2]) -> Vec<u32> {
    let mut first = 0;
    let mut waiting: Vec<Vec<u32>> = Vec::new();
    for ring in rings {
        waiting.push((first..first + ring.len() as u32).collect());
        first += ring.len() as u32;
    }
    let mut path = waiting.remove(0);
    while !waiting.is_empty() {
        let distance = |a: u32, b: u32| points[a as usize].distance_squared(points[b as usize]);
        let mut shortest = (f64::INFINITY, 0, 0, 0);
        for (h, hole) in waiting.iter().enumerate() {
            for (i, &a) in path.iter().enumerate() {
                for (j, &b) in hole.iter().enumerate() {
                    if distance(a, b) < shortest.0 {
                        shortest = (distance(a, b), h, i, j);
                    }
                }
            }
        }
        let (_, h, i, j) = shortest;
        let mut hole = waiting.remove(h);
        hole.rotate_left(j);
        // There, once round the hole, and back again.
        let detour: Vec<u32> = hole.iter().copied().chain([hole[0], path[i]]).collect();
        path.splice(i + 1..i + 1, detour);
    }
    path
}

/// How well shaped the ear at place `i` is, its height over its longest edge; `None` if it is
/// no ear: not convex, or with another corner inside or on its border.
fn ear_shape(points: &[DVec2], path: &[u32], i: usize) -> Option<f64> {
    let ear = around(path, i);
    let [a, b, c] = ear.map(|v| points[v as usize]);
    let double_area = (b - a).perp_dot(c - a);
    if double_area <= 0.0 {
        return None;
    }
    let left = |from: DVec2, to: DVec2, p: DVec2| (to - from).perp_dot(p - from) >= 0.0;
    let inside = |p: DVec2| left(a, b, p) && left(b, c, p) && left(c, a, p);
    // Bridges visit corners twice: those of the ear itself are no obstacle.
    let blocked = path.iter().any(|v| !ear.contains(v) && inside(points[*v as usize]));
    let longest = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a));
    (!blocked).then_some(double_area / longest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::outline::area;

    fn square(center: DVec2, half: f64, clockwise: bool) -> Ring {
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
        let mut ring: Ring = corners.map(|(x, y)| center + half * DVec2::new(x, y)).to_vec();
        if clockwise {
            ring.reverse();
        }
        ring
    }

    /// n + 2·holes − 2 triangles, all turning left, that fill what the outline leaves.
    fn assert_fills(rings: &[Ring]) {
        let points = rings.concat();
        let triangles = triangulate(rings);
        assert_eq!(triangles.len(), points.len() + 2 * (rings.len() - 1) - 2);
        let areas: Vec<f64> =
            triangles.iter().map(|t| area(&t.map(|v| points[v as usize]).to_vec())).collect();
        assert!(areas.iter().all(|&a| a > 0.0));
        let wanted: f64 = rings.iter().map(area).sum();
        assert!((areas.iter().sum::<f64>() - wanted).abs() < 1e-12 * wanted);
    }

    #[test]
    fn holes_stay_open() {
        let outline = square(DVec2::ZERO, 10.0, false);
        assert_fills(std::slice::from_ref(&outline));
        let one = square(DVec2::new(-4.0, 1.0), 3.0, true);
        assert_fills(&[outline.clone(), one.clone()]);
        assert_fills(&[outline, one, square(DVec2::new(5.0, -2.0), 2.5, true)]);
    }

    #[test]
    fn hollow_corners_are_no_ears() {
        let arrow = [(0.0, 0.0), (4.0, 3.0), (0.0, 6.0), (1.0, 3.0)];
        assert_fills(&[arrow.map(DVec2::from).to_vec()]);
    }
}
