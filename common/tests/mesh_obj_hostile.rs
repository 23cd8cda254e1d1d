//! OBJ files of all kinds: what tobj reads we read alike, and no bytes bring the reader down.

use common::mesh::{Mesh, parse_obj};
use proptest::prelude::*;

/// A square in two ways, with everything a face can refer to.
const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n\
                      f 1/1/1 2//1 3/1\nf -4 -3 -2 -1\n";

/// The same file by tobj alone.
fn by_tobj(text: &str) -> Option<(Vec<f32>, Vec<u32>)> {
    let options = tobj::LoadOptions { triangulate: true, ..Default::default() };
    let no_materials = |_: &std::path::Path| Ok(Default::default());
    let (models, _) = tobj::load_obj_buf(&mut text.as_bytes(), &options, no_materials).ok()?;
    let [model] = <[tobj::Model; 1]>::try_from(models).ok()?;
    Some((model.mesh.positions, model.mesh.indices))
}

/// Corner coordinates of all triangles, in order.
fn corners(mesh: &Mesh) -> Vec<f32> {
    let indices = mesh.triangles.iter().flatten();
    indices.flat_map(|&i| mesh.positions[i as usize].to_array()).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    /// Vertices on a curve of which no three are on a line, so that nothing is dropped.
    #[test]
    fn agrees_with_tobj(
        scale in 0.001_f32..1000.0,
        count in 3_usize..20,
        faces in prop::collection::vec(prop::collection::btree_set(0_usize..1000, 3..6), 1..30),
        negative: bool,
    ) {
        let mut text = String::new();
        for i in 0..count {
            let t = i as f32 * scale;
            text += &format!("v {t} {:e} {:.3}\n", t * i as f32, (i * i * i) as f32);
        }
        for face in &faces {
            let mut corners: Vec<usize> = face.iter().map(|i| i % count).collect();
            corners.sort_unstable();
            corners.dedup();
            prop_assume!(corners.len() >= 3);
            let shift = if negative { count as i64 } else { -1 };
            text += "f";
            for corner in corners {
                text += &format!(" {}", corner as i64 - shift);
            }
            text += "\n";
        }
        let ours = parse_obj("m.obj", text.as_bytes()).expect("a good mesh");
        let (positions, indices) = by_tobj(&text).expect("tobj reads it");
        let theirs: Vec<f32> = indices.iter().flat_map(|&i| positions[3 * i as usize..][..3].to_vec()).collect();
        prop_assert_eq!(ours.degenerate, 0);
        prop_assert_eq!(corners(&ours), theirs);
    }

    #[test]
    fn any_bytes_are_read_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        let _ = parse_obj("m.obj", &bytes);
    }

    #[test]
    fn any_statements_are_read_or_refused(
        text in r"((v|vt|vn|f|l|#|\\\n)( |\t)([-+]?[0-9]{1,3}(\.[0-9])?|/|//|nan|1e99|[0-9]/[0-9]|\\){0,5}( |\n|\r)){0,30}",
    ) {
        if let Ok(mesh) = parse_obj("m.obj", text.as_bytes()) {
            check(&mesh)?;
        }
    }

    #[test]
    fn every_byte_edit_is_read_or_refused(at: prop::sample::Index, byte: u8) {
        let mut bytes = SQUARE.as_bytes().to_vec();
        let index = at.index(bytes.len());
        bytes[index] = byte;
        if let Ok(mesh) = parse_obj("m.obj", &bytes) {
            check(&mesh)?;
        }
    }
}

/// What the type promises of every mesh.
fn check(mesh: &Mesh) -> Result<(), TestCaseError> {
    let count = mesh.positions.len();
    prop_assert!(mesh.positions.iter().all(|p| p.is_finite()));
    prop_assert!(mesh.triangles.iter().flatten().all(|&i| (i as usize) < count));
    prop_assert!(!mesh.triangles.is_empty());
    prop_assert!([0, count].contains(&mesh.normals.len()));
    prop_assert!([0, count].contains(&mesh.uvs.len()));
    Ok(())
}
