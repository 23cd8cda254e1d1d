//! Mesh files there and back, in all their dialects.

mod shapes;

use a9_simplification::files::{Kind, read, write};
use common::math::{Vec2, Vec3};
use common::mesh::Mesh;
use proptest::prelude::*;
use shapes::{cube, mesh, square};
use std::fs;

fn parse(kind: Kind, text: &str) -> Mesh {
    kind.parse("m", text.as_bytes()).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn there_and_back(kind: Kind, mesh: &Mesh) -> Mesh {
    kind.parse("m", &kind.bytes(mesh).unwrap()).unwrap()
}

fn corners(mesh: &Mesh) -> Vec<[Vec3; 3]> {
    mesh.triangles.iter().map(|t| t.map(|v| mesh.positions[v as usize])).collect()
}

#[test]
fn a9t6_plain_meshes_survive_every_kind() {
    for shape in [cube(), square(3, 0.1, -7.3e-12)] {
        for kind in [Kind::Obj, Kind::Ply] {
            assert_eq!(there_and_back(kind, &shape), shape, "{kind:?}");
        }
        // Places are numbered anew in an STL, which has corners only.
        let stl = there_and_back(Kind::Stl, &shape);
        assert_eq!(corners(&stl), corners(&shape));
        assert_eq!(stl.positions.len(), shape.positions.len());
    }
}

#[test]
fn a9t6_attributes_survive_where_the_kind_has_them() {
    let bare = square(2, 0.0, 1.5);
    let (n, m) = (bare.positions.len(), bare.positions.iter());
    let uvs: Vec<Vec2> = m.clone().map(|p| Vec2::new(p.x * 0.5, p.y)).collect();
    let normals = vec![Vec3::new(0.1, 0.2, 0.97); n];
    for (normals, uvs) in [(normals.clone(), uvs.clone()), (normals, vec![]), (vec![], uvs)] {
        let full = Mesh { normals, uvs, ..bare.clone() };
        assert_eq!(there_and_back(Kind::Ply, &full), full);
        // An OBJ file with attributes is renumbered by first use.
        let obj = there_and_back(Kind::Obj, &full);
        let of = |mesh: &Mesh| -> Vec<_> {
            let list = mesh.triangles.as_flattened().iter().map(|&v| v as usize);
            list.map(|v| (mesh.positions[v], mesh.normals.get(v).copied(), mesh.uvs.get(v).copied()))
                .collect()
        };
        assert!(of(&obj) == of(&full));
        assert_eq!(corners(&there_and_back(Kind::Stl, &full)), corners(&full));
    }
}

#[test]
fn a9t6_suffixes_say_the_kind() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["a.obj", "a.PLY", "a.Stl"] {
        let path = folder.path().join(name);
        write(&path, &cube()).unwrap();
        assert_eq!(corners(&read(&path).unwrap()), corners(&cube()), "{name}");
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 3);
    for name in ["a.txt", "obj", "a"] {
        let error = write(&folder.path().join(name), &cube()).unwrap_err().to_string();
        assert!(error.contains(".obj .ply .stl"), "{error}");
        assert!(read(&folder.path().join(name)).is_err());
    }
    let missing = folder.path().join("no/such.ply");
    assert!(write(&missing, &cube()).unwrap_err().to_string().contains("cannot write"));
    assert!(read(&missing).unwrap_err().to_string().contains("such.ply: "));
}

#[test]
fn a9t6_ply_dialects() {
    let text = "ply\nformat ascii 1.0\ncomment hello there\nobj_info x\n\
        element camera 1\nproperty float fov\nproperty list uchar int numbers\n\
        element face 2\nproperty uchar red\nproperty list uchar uint vertex_index\n\
        element vertex 4\nproperty double z\nproperty int y\nproperty float x\nproperty uchar red\n\
        end_header\n45 2 7 8\n0 3 0 1 2\n255 4 0 1 2 3\n0.5 0 0 1\n0.5 0 1 1\n0.5 1 1 1\n0.5 1 0 1\n";
    let found = parse(Kind::Ply, text);
    let at = |x: f32, y: f32| Vec3::new(x, y, 0.5);
    assert_eq!(found.positions, [at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)]);
    assert_eq!(found.triangles, [[0, 1, 2], [0, 1, 2], [0, 2, 3]]);
    // The same with the bytes of a big-endian machine.
    let mut bytes =
        "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
        property float z\nelement face 1\nproperty list int ushort vertex_indices\nend_header\n"
            .as_bytes()
            .to_vec();
    let points = [Vec3::ZERO, Vec3::X, Vec3::Y];
    bytes.extend(points.iter().flat_map(|p| p.to_array()).flat_map(f32::to_be_bytes));
    bytes.extend(3i32.to_be_bytes());
    bytes.extend([0u16, 1, 2].into_iter().flat_map(u16::to_be_bytes));
    assert_eq!(Kind::Ply.parse("m", &bytes).unwrap(), mesh(points.to_vec(), vec![[0, 1, 2]]));
}

#[test]
fn a9t6_stl_dialects() {
    let facet = |z: f32| {
        format!(
            "facet normal 0 0 1\n  outer loop\n    vertex 0 0 {z}\n    vertex 1 0 {z}\n\n    vertex 0 1 {z}\n  endloop\nendfacet\n"
        )
    };
    let [one, two] = [facet(0.0), facet(1.0)];
    for text in [
        format!("solid part\n{one}{two}endsolid part\n"),
        format!("solid\n{one}endsolid\nsolid second\n{two}endsolid second\n"),
        format!("solid a b c\r\n{}endsolid", format!("{one}{two}").replace('\n', "\r\n")),
        format!("\n  solid x\n{one}{two}"),
    ] {
        let found = parse(Kind::Stl, &text);
        assert_eq!((found.triangles.len(), found.positions.len()), (2, 6), "{text}");
    }
    // A binary file whose comment says that it is a text.
    let mut bytes = Kind::Stl.bytes(&cube()).unwrap();
    bytes[..9].copy_from_slice(b"solid abc");
    assert_eq!(corners(&Kind::Stl.parse("m", &bytes).unwrap()), corners(&cube()));
    bytes[..9].copy_from_slice(b"no text  ");
    bytes.push(0);
    assert_eq!(Kind::Stl.parse("m", &bytes).unwrap().triangles.len(), 12, "what follows is not read");
}

#[test]
fn a9t6_triangles_without_area_are_dropped_and_counted() {
    let mut faulty = cube();
    faulty.triangles.extend([[0, 1, 1], [2, 2, 2]]);
    for kind in Kind::ALL {
        let found = there_and_back(kind, &faulty);
        assert_eq!((found.triangles.len(), found.degenerate), (12, 2), "{kind:?}");
    }
}

proptest! {
    /// Every finite number is the same after having been written and read.
    #[test]
    fn a9t6_numbers_keep_their_bits(bits in prop::array::uniform9(any::<u32>())) {
        let p = bits.map(f32::from_bits);
        prop_assume!(p.iter().all(|x| x.is_finite()));
        let points = vec![Vec3::from_slice(&p), Vec3::from_slice(&p[3..]), Vec3::from_slice(&p[6..])];
        prop_assume!(common::mesh::has_area([points[0], points[1], points[2]]));
        let one = mesh(points, vec![[0, 1, 2]]);
        for kind in Kind::ALL {
            let found = there_and_back(kind, &one);
            let same = |a: Vec3, b: Vec3| a == b && a.to_array().map(f32::to_bits) == b.to_array().map(f32::to_bits);
            prop_assert!(found.positions.iter().zip(&one.positions).all(|(a, b)| same(*a, *b)), "{kind:?}");
        }
    }
}
