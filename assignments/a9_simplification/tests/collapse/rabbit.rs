//! The rabbits of `scenes/meshes` are made by this assignment.

use a9_simplification::files::Kind;
use a9_simplification::{Goal, Settings, simplify};
use std::path::Path;

/// What `modeller --rabbit` writes, simplified, is what lies there: to the byte.
#[test]
fn rabbits_of_the_scenes_are_made_from_the_fine_one() {
    let fine = Kind::Obj.parse("rabbit.obj", modeller::catalogue::fine_rabbit().text().as_bytes()).unwrap();
    let levels =
        [("bunny_40k.obj", 40_000), ("bunny_5k.obj", 5_000), ("bunny_1k.obj", 1_000), ("bunny_200.obj", 200)];
    let goals = levels.map(|(_, faces)| Goal::Faces(faces));
    let made = simplify(&fine, &goals, &Settings::default()).unwrap();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/meshes");
    for ((name, faces), level) in levels.into_iter().zip(made) {
        assert_eq!(level.mesh.triangles.len(), faces);
        let there = std::fs::read(folder.join(name)).unwrap();
        assert!(
            Kind::Obj.bytes(&level.mesh).unwrap() == there,
            "{name} is out of date: see scenes/README.md"
        );
    }
}
