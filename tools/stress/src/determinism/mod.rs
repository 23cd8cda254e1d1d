//! accuracy.md, property 16: the same picture, bit for bit, however it comes about.

mod path;
mod processes;
mod whitted;

pub use path::path;
pub use processes::processes;
pub use whitted::whitted;

/// FNV-1a of some numbers.
fn hash(numbers: impl IntoIterator<Item = u32>) -> u64 {
    let bytes = numbers.into_iter().flat_map(u32::to_le_bytes);
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3))
}
