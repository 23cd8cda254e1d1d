//! Meshes as text: the course's subset of Wavefront OBJ (`v x y z`, `f i j k`, indices from 1).

use crate::mesh::Mesh;
use glam::DVec3;
use std::fmt::Write;

/// `mesh` with every coordinate rounded to `decimals` places: exactly what a reader of the file
/// gets.
pub fn rounded(mesh: &Mesh, decimals: usize) -> Mesh {
    let round = |x: f64| number(x, decimals).parse().expect("a printed number can be read");
    let positions = mesh.positions.iter().map(|p| DVec3::new(round(p.x), round(p.y), round(p.z))).collect();
    Mesh { positions, triangles: mesh.triangles.clone() }
}

/// The text of an OBJ file: `comment` lines first, then vertices with at most `decimals` decimals,
/// then faces.
pub fn to_text(mesh: &Mesh, comment: &str, decimals: usize) -> String {
    let mut text = String::new();
    for line in comment.lines() {
        writeln!(text, "# {line}").expect("writing to a string");
    }
    for p in &mesh.positions {
        let [x, y, z] = p.to_array().map(|c| number(c, decimals));
        writeln!(text, "v {x} {y} {z}").expect("writing to a string");
    }
    for t in &mesh.triangles {
        let [a, b, c] = t.map(|v| v + 1);
        writeln!(text, "f {a} {b} {c}").expect("writing to a string");
    }
    text
}

/// `x` with at most `decimals` decimals, without trailing zeros and without a negative zero.
fn number(x: f64, decimals: usize) -> String {
    let fixed = format!("{x:.decimals$}");
    let short = if fixed.contains('.') { fixed.trim_end_matches('0').trim_end_matches('.') } else { &fixed };
    if short == "-0" { "0".into() } else { short.into() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_rounded() {
        let cases = [(1.0, "1"), (-0.000001, "0"), (0.123456, "0.12346"), (-2.5, "-2.5"), (100.0, "100")];
        for (x, text) in cases {
            assert_eq!(number(x, 5), text);
        }
        assert_eq!(number(100.0, 0), "100");
    }

    #[test]
    fn text_has_one_line_for_each_vertex_and_face() {
        let mesh = Mesh { positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y], triangles: vec![[0, 1, 2]] };
        assert_eq!(to_text(&mesh, "two\nlines", 5), "# two\n# lines\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    }
}
