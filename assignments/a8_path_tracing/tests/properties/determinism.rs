//! Property 16 by the program itself: the same picture, bit for bit, with any instructions.

use std::fs;
use stress::light::everything::{everything, lumps};
use tests::binary::{Binary, Scratch};

const PROGRAM: Binary = Binary { path: env!("CARGO_BIN_EXE_a8_path_tracing"), assignment: 8 };

/// The program's float picture with an instruction set; `None` if the machine has it not.
fn drawn(scratch: &Scratch, simd: &str) -> Option<Vec<u8>> {
    let line = format!("-input scene.txt -output out.pfm -size 37 23 -spp 12 -threads 2 -simd {simd}");
    let outcome = PROGRAM.run(scratch.path(), &line.split_whitespace().collect::<Vec<_>>());
    if outcome.stderr.contains("does not offer") {
        return None;
    }
    assert_eq!(outcome.code, Some(0), "{}", outcome.stderr);
    Some(fs::read(scratch.file("out.pfm")).expect("it was written"))
}

#[test]
fn p16_instruction_sets_change_no_bit() {
    let scratch = Scratch::new(&[("scene.txt", everything().as_bytes()), ("lumps.obj", &lumps())]);
    let expected = drawn(&scratch, "baseline").expect("every machine has it");
    for simd in ["auto", "sse4", "avx2", "avx512"] {
        let Some(bytes) = drawn(&scratch, simd) else { continue };
        assert!(bytes == expected, "-simd {simd} changes the picture");
    }
}
