//! What every mesh must be: closed, manifold, with the right number of pieces and handles, facing
//! outwards.

use crate::mesh::Mesh;
use glam::DVec3;
use std::collections::HashMap;

/// Checks that every directed edge occurs once and its reverse once, that the triangles round each
/// vertex form a single fan, and that no vertex is unused. The error names the first offender, with
/// vertices numbered from 0.
pub fn closed_manifold(mesh: &Mesh) -> Result<(), String> {
    let next = successors(mesh)?;
    if let Some((v, w)) = next.keys().find(|(v, w)| !next.contains_key(&(*w, *v))) {
        return Err(format!("edge {v}-{w} has a triangle on one side only"));
    }
    let mut leaving: Vec<Vec<u32>> = vec![Vec::new(); mesh.positions.len()];
    for &(v, w) in next.keys() {
        leaving[v as usize].push(w);
    }
    for (v, spokes) in leaving.iter().enumerate() {
        let Some(&first) = spokes.first() else {
            return Err(format!("vertex {v} belongs to no triangle"));
        };
        let turns = fan_length(&next, v as u32, first);
        if turns != spokes.len() {
            return Err(format!("the triangles round vertex {v} form more than one fan"));
        }
    }
    Ok(())
}

/// For each directed edge v→w the third corner of its triangle.
fn successors(mesh: &Mesh) -> Result<HashMap<(u32, u32), u32>, String> {
    let mut next = HashMap::with_capacity(mesh.triangles.len() * 3);
    for &[a, b, c] in &mesh.triangles {
        for (v, w, third) in [(a, b, c), (b, c, a), (c, a, b)] {
            if v == w {
                return Err(format!("triangle {a} {b} {c} names a vertex twice"));
            }
            if next.insert((v, w), third).is_some() {
                return Err(format!("edge {v}->{w} belongs to two triangles"));
            }
        }
    }
    Ok(next)
}

/// How many triangles one passes when turning round `v` from the edge to `first` until that edge
/// comes again.
fn fan_length(next: &HashMap<(u32, u32), u32>, v: u32, first: u32) -> usize {
    let round = std::iter::successors(Some(first), |&w| Some(next[&(v, w)]).filter(|&w| w != first));
    round.count()
}

/// Vertices − edges + triangles of a closed mesh: 2 for each piece, less 2 for each handle.
pub fn euler_characteristic(mesh: &Mesh) -> i64 {
    let triangles = mesh.triangles.len() as i64;
    mesh.positions.len() as i64 - triangles * 3 / 2 + triangles
}

/// The number of pieces between which no edge leads.
pub fn pieces(mesh: &Mesh) -> usize {
    let mut parent: Vec<u32> = (0..mesh.positions.len() as u32).collect();
    for &[a, b, c] in &mesh.triangles {
        let root = find(&mut parent, a);
        for v in [b, c] {
            let other = find(&mut parent, v);
            parent[other as usize] = root;
        }
    }
    (0..parent.len() as u32).filter(|&v| find(&mut parent, v) == v).count()
}

fn find(parent: &mut [u32], mut v: u32) -> u32 {
    while parent[v as usize] != v {
        parent[v as usize] = parent[parent[v as usize] as usize];
        v = parent[v as usize];
    }
    v
}

/// The enclosed volume: positive if the triangles face outwards.
pub fn volume(mesh: &Mesh) -> f64 {
    (0..mesh.triangles.len()).map(|t| mesh.corners(t)).map(|[a, b, c]| a.dot(b.cross(c))).sum::<f64>() / 6.0
}

/// The least ratio of a triangle's height to its longest edge: 0 if some triangle is degenerate,
/// √3/2 at best.
pub fn flattest(mesh: &Mesh) -> f64 {
    let flatness = |[a, b, c]: [DVec3; 3]| {
        let longest = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a));
        (b - a).cross(c - a).length() / longest
    };
    (0..mesh.triangles.len()).map(|t| flatness(mesh.corners(t))).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cube::cube;

    #[test]
    fn a_cube_passes() {
        let cube = cube();
        closed_manifold(&cube).unwrap();
        assert_eq!(euler_characteristic(&cube), 2);
        assert_eq!(pieces(&cube), 1);
        assert_eq!(volume(&cube), 8.0);
        assert_eq!(flattest(&cube), 0.5);
    }

    #[test]
    fn faults_are_found() {
        let mut open = cube();
        open.triangles.pop();
        assert!(closed_manifold(&open).unwrap_err().contains("one side"));
        let mut flipped = cube();
        flipped.triangles[3].swap(0, 1);
        assert!(closed_manifold(&flipped).unwrap_err().contains("two triangles"));
        let mut loose = cube();
        loose.positions.push(DVec3::ZERO);
        assert!(closed_manifold(&loose).unwrap_err().contains("no triangle"));
    }

    /// Two cubes that share one corner: every edge is in order, that vertex is not.
    #[test]
    fn two_fans_at_one_vertex_are_found() {
        let mut pair = cube();
        let moved = cube().positions.into_iter().map(|p| p + 2.0);
        pair.positions.extend(moved);
        pair.triangles.extend(cube().triangles.iter().map(|t| t.map(|v| if v == 0 { 7 } else { v + 8 })));
        let pair = pair.numbered_by_first_use();
        assert_eq!(pair.positions.len(), 15);
        assert!(closed_manifold(&pair).unwrap_err().contains("more than one fan"));
    }

    #[test]
    fn two_pieces_are_found() {
        let mut pair = cube();
        pair.positions.extend(cube().positions.into_iter().map(|p| p + 5.0));
        pair.triangles.extend(cube().triangles.iter().map(|t| t.map(|v| v + 8)));
        closed_manifold(&pair).unwrap();
        assert_eq!(pieces(&pair), 2);
        assert_eq!(euler_characteristic(&pair), 4);
    }
}
