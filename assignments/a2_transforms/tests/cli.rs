//! The program `a2_transforms`, run as its users run it.

use tests::battery::usage;
use tests::binary::Binary;

const PROGRAM: Binary = Binary { path: env!("CARGO_BIN_EXE_a2_transforms"), assignment: 2 };

tests::battery!(PROGRAM);

#[test]
fn wrong_values_of_its_own_flags_are_refused() {
    usage::own_flags(
        &PROGRAM,
        &[
            ("-normals", &["'-normals <PICTURE>'"]),
            ("-normals n.bmp", &["'n.bmp'"]),
            ("-normals nowhere/n.tga", &["'nowhere/n.tga'"]),
            ("-output o.tga -normals ./o.tga", &["two pictures"]),
            ("-depth 1 2 n.tga -normals n.tga", &["two pictures"]),
            ("-output o.tga -shade_back=no", &["-shade_back"]),
            ("-output o.tga -shade_bak", &["'-shade_back'"]),
        ],
    );
}
