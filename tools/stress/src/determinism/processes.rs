//! Debug and release, one instruction set and another: pictures of other processes.

use super::path::everything_hashed;
use super::whitted::hashed;
use crate::Stress;

/// What the pictures came to when this was written, by a release build.
///
/// A debug build (the test command) and a release build (`bench -- stress`) must both arrive here.
/// After a deliberate change of these pictures the failing check prints the new numbers. Sines
/// and powers are those of the system's mathematics library, so other systems may have others.
const PICTURES: [u64; 2] = [0x85e8_88c5_d253_4698, 0xcfa1_962d_8cd2_319c];

/// The same picture, bit for bit, by builds with and without optimisation.
pub fn processes(stress: &Stress) {
    stress.case("p16 debug and release", || {
        let found = [hashed(), everything_hashed()];
        if found == PICTURES || !cfg!(all(target_os = "linux", target_arch = "x86_64")) {
            return Ok(0.0);
        }
        Err(format!("pictures are {found:#x?}, not {PICTURES:#x?}"))
    });
}
