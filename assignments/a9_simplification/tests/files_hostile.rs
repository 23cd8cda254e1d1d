//! Mesh files that are wrong: every one is refused with its place, and none takes memory for what
//! it only claims to hold.

mod shapes;

use a9_simplification::files::Kind;
use proptest::prelude::*;
use shapes::{cube, square};

fn refusal(kind: Kind, bytes: &[u8]) -> String {
    match kind.parse("bad", bytes) {
        Ok(mesh) => {
            panic!("{} triangles were read: {}", mesh.triangles.len(), String::from_utf8_lossy(bytes))
        }
        Err(error) => error.to_string(),
    }
}

/// A text with three vertices and a face, one part replaced.
fn ply(from: &str, to: &str) -> Vec<u8> {
    let good = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
        element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    assert!(good.contains(from) && Kind::Ply.parse("good", good.as_bytes()).is_ok());
    good.replacen(from, to, 1).into_bytes()
}

#[test]
fn a9t6_wrong_ply_files() {
    for (from, to, needle) in [
        ("ply\n", "plu\n", "bad:1: Expected magic number"),
        ("format ascii 1.0\n", "", "No format line"),
        ("ascii", "morse", "bad:2: "),
        ("vertex 3", "vertex -3", "bad:3: "),
        ("vertex 3", "vertex 4", "bad:"),
        ("vertex 3", "vertex 4000000000", "4000000000 elements `vertex` do not fit a file of"),
        ("face 1", "face 999999999999", "999999999999 elements `face` do not fit"),
        ("property float z\n", "", "no element `vertex` with numbers x, y and z"),
        ("vertex_indices", "corners", "no element `face` with a list of whole numbers"),
        ("element face 1\nproperty list uchar int vertex_indices\n", "", "no element `face`"),
        ("end_header", "element dust 5\nend_header", "5 elements `dust` do not fit"),
        ("end_header\n", "", "bad:9: "),
        ("1 0 0", "1 0 nan", "bad:11: Couldn't read element line. String: '1 0 nan"),
        ("1 0 0", "1 1e99 0", "bad:11: a number is not finite"),
        ("1 0 0", "1 zero 0", "bad:11: "),
        ("1 0 0", "1 0", "bad:11: "),
        ("3 0 1 2", "3 0 1 3", "bad:13: vertex index 3 is out of range: there are 3"),
        ("3 0 1 2", "3 0 1 -1", "bad:13: vertex index -1 is out of range"),
        ("3 0 1 2", "4000000 0 1 2", "bad:13: "),
        ("3 0 1 2", "2 0 1", "no triangles"),
        ("0 1 0", "2 0 0", "no area"),
        ("list uchar int", "list uchar float", "no element `face` with a list of whole"),
    ] {
        let error = refusal(Kind::Ply, &ply(from, to));
        assert!(error.starts_with("bad:") && error.contains(needle), "{from} -> {to}: {error}");
        assert_eq!(error.lines().count(), 1, "{error}");
    }
}

#[test]
fn a9t6_wrong_stl_files() {
    let good = "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid s\n";
    assert!(Kind::Stl.parse("good", good.as_bytes()).is_ok());
    for (from, to, needle) in [
        ("vertex 1 0 0", "vertex 1 0 nan", "bad:5: "),
        ("vertex 1 0 0", "vertex 1 0", "bad:5: "),
        ("vertex 1 0 0\n", "", "bad:6: "),
        ("facet normal", "face normal", "bad:2: "),
        ("endfacet\nendsolid s\n", "", "bad:7: "),
        ("facet normal 0 0 1\nouter", "facet normal 0 0 up\nouter", "bad:2: "),
        ("vertex 0 1 0", "vertex 2 0 0", "no area"),
        ("solid s\nfacet", "facet", "(a text begins with `solid`)"),
    ] {
        let error = refusal(Kind::Stl, good.replacen(from, to, 1).as_bytes());
        assert!(error.starts_with("bad:") && error.contains(needle), "{from} -> {to}: {error}");
        assert_eq!(error.lines().count(), 1, "{error}");
    }
    assert!(refusal(Kind::Stl, b"solid s\nendsolid s\n").contains("no triangles"));
}

#[test]
fn a9t6_wrong_binary_stl_files() {
    let good = Kind::Stl.bytes(&cube()).unwrap();
    let short = refusal(Kind::Stl, &good[..good.len() - 1]);
    assert_eq!(short, "bad: this binary STL file says 12 triangles, but ends after 11");
    let mut claims = good.clone();
    claims[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    assert!(refusal(Kind::Stl, &claims).contains("says 4294967295 triangles, but ends after 12"));
    let mut infinite = good.clone();
    infinite[84 + 50 * 2 + 12..][..4].copy_from_slice(&f32::INFINITY.to_le_bytes());
    assert!(
        refusal(Kind::Stl, &infinite).contains("triangle 3 of this binary STL file has a corner that is not")
    );
    assert!(refusal(Kind::Stl, &good[..50]).contains("at least 84 bytes"));
}

#[test]
fn a9t6_every_prefix_is_read_or_refused() {
    for kind in Kind::ALL {
        let bytes = kind.bytes(&square(2, 0.0, 0.0)).unwrap();
        for end in 0..bytes.len() {
            // Texts may end between two faces; nothing may panic.
            let _ = kind.parse("m", &bytes[..end]);
        }
        assert!(kind.parse("m", &bytes[..bytes.len() / 3]).is_err());
    }
}

proptest! {
    #[test]
    fn a9t6_changed_bytes_are_read_or_refused(
        kind in prop::sample::select(Kind::ALL.to_vec()),
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..4),
    ) {
        let mut bytes = kind.bytes(&square(2, 0.0, 0.0)).unwrap();
        for (place, byte) in changes {
            let place = place.index(bytes.len());
            bytes[place] = byte;
        }
        if let Ok(mesh) = kind.parse("m", &bytes) {
            prop_assert!(mesh.positions.iter().all(|p| p.is_finite()));
            prop_assert!(mesh.triangles.iter().flatten().all(|&v| (v as usize) < mesh.positions.len()));
        }
    }
}
