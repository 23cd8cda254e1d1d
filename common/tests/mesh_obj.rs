//! OBJ files through the public door: what is read, what is refused and where.

use common::math::{Vec2, Vec3};
use common::mesh::{Mesh, MeshError, parse_obj, read_obj};

fn mesh(text: &str) -> Mesh {
    parse_obj("m.obj", text.as_bytes()).unwrap_or_else(|error| panic!("{error}"))
}

fn error(text: &str) -> String {
    let error: MeshError = parse_obj("m.obj", text.as_bytes()).expect_err("an error");
    error.to_string()
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

fn square(rest: &str) -> String {
    format!("{SQUARE}{rest}")
}

#[test]
fn plain_files_keep_the_order_of_vertices_and_triangles() {
    let mesh = mesh("v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 4 2 3\nf 2 3 4\n");
    let expected = [Vec3::splat(9.0), Vec3::ZERO, Vec3::X, Vec3::Y];
    assert_eq!(mesh.positions, expected);
    assert_eq!(mesh.triangles, [[3, 1, 2], [1, 2, 3]]);
    assert!(mesh.normals.is_empty() && mesh.uvs.is_empty());
}

#[test]
fn polygons_become_fans() {
    assert_eq!(mesh(&square("f 1 2 3 4")).triangles, [[0, 1, 2], [0, 2, 3]]);
    let pentagon = format!("{SQUARE}v -1 0.5 0\nf 1 2 3 4 5");
    assert_eq!(mesh(&pentagon).triangles, [[0, 1, 2], [0, 2, 3], [0, 3, 4]]);
}

#[test]
fn negative_indices_count_back_from_the_face() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 5 5\nf -4 -3 -1\n";
    assert_eq!(mesh(text).triangles, [[0, 1, 2], [0, 1, 3]]);
}

#[test]
fn faces_may_come_before_their_vertices() {
    assert_eq!(mesh(&format!("f 1 2 3\n{SQUARE}")).triangles, [[0, 1, 2]]);
}

#[test]
fn what_is_no_mesh_is_skipped() {
    let text = "\u{feff}# made by hand\nmtllib a.mtl\no thing\ng side\nusemtl red\ns off\n\
                vp 1 2\nwhatever \\\n continued\nl 1 2 3\np 1\n";
    assert_eq!(mesh(&format!("{text}{}", square("f 1 2 3"))).triangles.len(), 1);
}

#[test]
fn line_ends_comments_and_continued_lines_change_nothing() {
    let text = square("f 1 2 3 # the first\nf 1 3 4\n");
    let expected = mesh(&text);
    assert_eq!(mesh(&text.replace('\n', "\r\n")), expected);
    assert_eq!(mesh(&text.replace('\n', "\r")), expected);
    assert_eq!(mesh(&text.replace("f 1 3 4", "f 1 \\\n3 \\\r\n 4#")), expected);
}

#[test]
fn a_fourth_number_divides_and_a_colour_is_ignored() {
    let mesh = mesh("v 2 4 6 2\nv 1 0 0 1 0.5 0\nv 0 1 0 1\nf 1 2 3");
    assert_eq!(mesh.positions, [Vec3::new(1.0, 2.0, 3.0), Vec3::X, Vec3::Y]);
}

#[test]
fn normals_and_texture_coordinates_are_aligned_with_split_vertices() {
    let text = square(
        "vt 0 0\nvt 1 0.5\nvn 0 0 1\nvn 0 1 0\nf 1/1/1 2/2/1 3/1/2\nf 1/1/1 3/1/1 4/2/2 # corner 3 twice",
    );
    let mesh = mesh(&text);
    assert_eq!(mesh.triangles, [[0, 1, 2], [0, 3, 4]]);
    assert_eq!(mesh.positions[2], mesh.positions[3]);
    let (z, y) = (Vec3::Z, Vec3::Y);
    assert_eq!(mesh.normals, [z, z, y, z, y]);
    let far = Vec2::new(1.0, 0.5);
    assert_eq!(mesh.uvs, [Vec2::ZERO, far, Vec2::ZERO, Vec2::ZERO, far]);
}

#[test]
fn attributes_that_not_all_corners_have_are_dropped() {
    let mesh = mesh(&square("vn 0 0 1\nvt 0 0 0\nf 1/1 2/1 3/1\nf 1/1/1 3/1/1 4/1/1"));
    assert!(mesh.normals.is_empty());
    assert_eq!(mesh.uvs.len(), mesh.positions.len());
}

#[test]
fn triangles_without_area_are_dropped_and_counted() {
    let mesh = mesh(&square("v 2 0 0\nv 1 0 0\nf 1 2 3\nf 1 2 2\nf 1 2 5\nf 2 6 3\nf 1 2\nf 3\n"));
    assert_eq!(mesh.triangles, [[0, 1, 2]]);
    assert_eq!(mesh.degenerate, 5);
}

#[test]
fn degenerate_faces_are_counted_with_attributes_too() {
    let mesh = mesh(&square("vt 0 0\nf 1/1 2/1 3/1\nf 1/1 2/1 2/1\nf 1/1 2/1\n"));
    assert_eq!((mesh.triangles.len(), mesh.degenerate), (1, 2));
}

#[test]
fn errors_name_file_and_line() {
    for (text, expected) in [
        ("v 0 0\n", "m.obj:1: expected 3 numbers, found 2"),
        ("\nv 0 nan 0\n", "m.obj:2: `nan` is not a finite number"),
        ("\r\nv 0 1e39 0\r\n", "m.obj:2: `1e39` is too large for a 32-bit float"),
        ("# \\\nv 0 x 0", "m.obj:2: expected a number, found `x`"),
        ("v 0 \\\n 0 \\\n 1.5.2\n", "m.obj:3: expected a number, found `1.5.2`"),
        ("v 1 2 3 4 5", "m.obj:1: a vertex has 3 numbers, 4 with w or 6 with a colour, found 5"),
        ("v 1 2 3 0", "m.obj:1: the vertex divided by its w is not finite"),
        ("vt 1", "m.obj:1: expected 2 numbers, found 1"),
        ("vn 0 0", "m.obj:1: expected 3 numbers, found 2"),
        ("f 1 2 3", "m.obj:1: vertex index 1, but there are none"),
        ("v 0 0 0\nf 1 0 1", "m.obj:2: vertex index 0: indices count from 1"),
        ("v 0 0 0\nf 1 -2 1", "m.obj:2: vertex index -2 is out of range: there are 1"),
        ("v 0 0 0\nf 1 1 1\nf 1 7 1", "m.obj:3: vertex index 7 is out of range: there are 1"),
        ("v 0 0 0\nf 1 4294967297 1", "m.obj:2: vertex index 4294967297 is out of range: there are 1"),
        ("v 0 0 0\nf 1/1 1 1", "m.obj:2: texture coordinate index 1, but there are none"),
        ("v 0 0 0\nvn 0 0 1\nf 1//2 1 1", "m.obj:3: normal index 2 is out of range: there are 1"),
        ("v 0 0 0\nf 1 a 1", "m.obj:2: expected a vertex index, found `a`"),
        ("v 0 0 0\nf 1 /1 1", "m.obj:2: expected a vertex index, found `/1`"),
        ("v 0 0 0\nf 1/1/1/1 1 1", "m.obj:2: expected a vertex index, found `1/1/1/1`"),
        ("f 1.0 2 3", "m.obj:1: expected a vertex index, found `1.0`"),
        ("f\n", "m.obj:1: a face without vertices"),
        ("", "m.obj: this file has no triangles"),
        (SQUARE, "m.obj: this file has no triangles"),
        ("v 0 0 0\nf 1 1 1", "m.obj: this file has no triangles: all 1 faces have no area"),
    ] {
        assert_eq!(error(text), expected, "{text:?}");
    }
}

#[test]
fn a_missing_file_is_named() {
    let error = read_obj("no/such/mesh.obj".as_ref()).expect_err("an error");
    assert!(error.to_string().starts_with("no/such/mesh.obj: "), "{error}");
    assert_eq!(error.line(), None);
}
