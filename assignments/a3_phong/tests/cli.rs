//! The program `a3_phong`, run as its users run it.

use tests::battery::usage;
use tests::binary::Binary;

const PROGRAM: Binary = Binary { path: env!("CARGO_BIN_EXE_a3_phong"), assignment: 3 };

tests::battery!(PROGRAM);

#[test]
fn wrong_values_of_its_own_flags_are_refused() {
    usage::own_flags(
        &PROGRAM,
        &[
            ("-output o.tga -tessellation 10", &["-tessellation", "2"]),
            ("-output o.tga -tessellation 0 5", &["'0'", "-tessellation"]),
            ("-output o.tga -tessellation -3 5", &["'-3'", "-tessellation"]),
            ("-output o.tga -tessellation 99999 5", &["'99999'", "-tessellation"]),
            ("-output o.tga -specular shiny", &["'shiny'", "blinn, phong"]),
            ("-preview p.bmp", &["'p.bmp'"]),
            ("-output o.tga -preview o.tga", &["two pictures"]),
            ("-output o.tga -gourad", &["'-gouraud'"]),
        ],
    );
}
