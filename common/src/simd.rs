//! Eight lanes at a time with run-time dispatch: the door to fearless_simd.
//!
//! A default build runs on any x86-64; the widest instructions the processor has are chosen at
//! run time, once per ray or tile, with [`dispatch!`]. Nothing that decides a picture depends
//! on the choice: vector code only discards what is certainly missed, or does for eight what is done
//! for one, step by step, so that each has the bits that it would have alone ([`crate::math::lanes`]).

pub use fearless_simd::{
    Bytes, Level, Select, Simd, SimdBase, SimdFloat, SimdMask, dispatch, f32x4, f32x8, f64x4, f64x8, i32x4,
    i32x8, mask32x8, mask64x4, u32x8,
};
use std::ops::Range;
use std::sync::OnceLock;

/// Vectors of single precision, of whatever width.
pub trait Floats<S: Simd>: SimdFloat<S, Element = f32> {}

impl<S: Simd, V: SimdFloat<S, Element = f32>> Floats<S> for V {}

/// Asks the memory for the cache line in which an array begins, without waiting for it.
#[inline(always)]
pub fn prefetch<T>(array: &[T]) {
    prefetch_index::prefetch_index(array, 0);
}

/// The same for all in which some entries of an array begin; those that do not exist are passed over.
#[inline(always)]
pub fn prefetch_all<T>(array: &[T], entries: Range<usize>) {
    for entry in (entries.start..array.len().min(entries.end)).step_by((CACHE_LINE / size_of::<T>()).max(1)) {
        prefetch_index::prefetch_index(array, entry);
    }
}

/// Bytes.
const CACHE_LINE: usize = 64;

static LEVEL: OnceLock<Level> = OnceLock::new();

/// The instruction set in use: what [`restrict`] chose, else the best that the processor has.
#[inline]
pub fn level() -> Level {
    *LEVEL.get_or_init(Level::new)
}

/// Chooses the instruction set for this process by name (`auto`, `baseline`, `sse4`, `avx2`,
/// `avx512`); must come before the first ray.
///
/// # Errors
/// If the processor lacks it, or another choice is already in use.
pub fn restrict(name: &str) -> Result<(), String> {
    let level = by_name(name).ok_or_else(|| format!("this processor does not offer `{name}`"))?;
    LEVEL.set(level).map_err(|_| "the instruction set was already chosen".to_owned())
}

/// The level of that name if this processor has it.
pub fn by_name(name: &str) -> Option<Level> {
    let best = Level::new();
    match name {
        "auto" => Some(best),
        "baseline" => Some(Level::baseline()),
        #[cfg(target_arch = "x86_64")]
        "sse4" => best.as_sse4_2().map(Level::Sse4_2),
        #[cfg(target_arch = "x86_64")]
        "avx2" => best.as_avx2().map(Level::Avx2),
        #[cfg(target_arch = "x86_64")]
        "avx512" => best.as_avx512().map(Level::Avx512),
        _ => None,
    }
}
