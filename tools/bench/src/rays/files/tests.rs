//! What is written is read again; what is broken is refused.

use super::super::sets::{NAMES, make};
use super::*;

fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("raysteps-bench-{name}-{}", std::process::id()));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

#[test]
fn what_is_written_is_read_again() {
    let folder = folder("again");
    let world = World::named("sphere500").unwrap();
    let tree = Tree::new(&world.mesh);
    let sets = make(&world, &tree, 16, &NAMES.map(str::to_owned));
    write_all(&folder, &world, &sets).unwrap();
    let prefix = folder.join("sphere500");
    for spelling in ["", ".v.f32"] {
        let again = read_world(Path::new(&format!("{}{spelling}", prefix.display()))).unwrap();
        assert_eq!((&again.name, &again.mesh), (&world.name, &world.mesh));
    }
    let found = sets_beside(&prefix).unwrap();
    assert_eq!(found.len(), 4);
    for file in &found {
        let set = read_set(file, &tree).unwrap();
        let original = sets.iter().find(|s| s.name == set.name).unwrap();
        assert_eq!(&set, original);
        // Without the files of answers the tree gives them.
        fs::remove_file(file.with_extension("").with_extension("gt.f64")).unwrap();
        assert_eq!(&read_set(file, &tree).unwrap(), original);
    }
    fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn broken_files_are_refused() {
    let folder = folder("broken");
    let prefix = folder.join("m");
    let world = World::named("sphere100").unwrap();
    let tree = Tree::new(&world.mesh);
    let complaint = |result: Result<World, AppError>| result.err().map(|e| e.report()).unwrap_or_default();
    assert!(complaint(read_world(&prefix)).contains("cannot read"));
    let refused = |v: &[f32], f: &[u32], what: &str| {
        write(&beside(&prefix, "v.f32"), v.iter().map(|x| x.to_le_bytes())).unwrap();
        write(&beside(&prefix, "f.u32"), f.iter().map(|x| x.to_le_bytes())).unwrap();
        let text = complaint(read_world(&prefix));
        assert!(text.contains(what), "{text}");
    };
    refused(&[0.0; 8], &[0, 0, 0], "three numbers");
    refused(&[0.0; 9], &[0, 1, 3], "names a vertex");
    refused(&[f32::NAN; 9], &[0, 1, 2], "not finite");
    refused(&[0.0; 9], &[], "no triangle");
    let rays = folder.join("m.random.rays.f32");
    fs::write(&rays, [0; 23]).unwrap();
    assert!(read_set(&rays, &tree).unwrap_err().report().contains("cut off"));
    fs::write(&rays, [0; 20]).unwrap();
    assert!(read_set(&rays, &tree).unwrap_err().report().contains("six numbers"));
    fs::write(&rays, [0; 24]).unwrap();
    fs::write(folder.join("m.random.gt.f64"), [0; 16]).unwrap();
    fs::write(folder.join("m.random.gtprim.u32"), [0; 8]).unwrap();
    assert!(read_set(&rays, &tree).unwrap_err().report().contains("as many answers"));
    fs::remove_dir_all(&folder).unwrap();
}
