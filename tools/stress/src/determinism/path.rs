//! Path-traced pictures, bit for bit, however the work is dealt out.

use super::hash;
use crate::Stress;
use crate::light::everything::{everything, lumps};
use crate::light::stage::Stage;
use common::tiles::TileOptions;

fn stage(flags: &str) -> Stage {
    Stage::new(&everything(), &[("lumps.obj", &lumps())], &format!("-size 37 23 -spp 12 {flags}"))
}

/// Threads, tiles, the way samples are dealt out, and structures change no bit.
pub fn path(stress: &Stress) {
    for (name, check) in [
        ("threads and tiles", threads_and_tiles as fn()),
        ("shares of samples", shares_of_samples),
        ("structures", structures),
        ("a part of the picture", crop),
    ] {
        stress.case(format!("p16 path tracing, {name}"), || {
            check();
            Ok(0.0)
        });
    }
}

fn threads_and_tiles() {
    let stage = stage("");
    let (expected, counted) = stage.sums(4, &[12]);
    for threads in [1, 2, 3, 7, 16] {
        for tile in [4, 8, 16, 32] {
            let options = TileOptions { threads: Some(threads), tile: Some(tile), ..TileOptions::default() };
            let (sums, counters) = stage.sums_with(4, &[12], options);
            assert!(sums == expected, "{threads} threads, tiles of {tile}");
            let work = |c: common::counters::Counters| (c.rays, c.shadow_rays, c.ended_by_roulette);
            assert_eq!(work(counters), work(counted), "{threads} threads, tiles of {tile}");
        }
    }
    assert!(stage.sums(5, &[12]).0 != expected, "another seed, another picture");
}

fn shares_of_samples() {
    for flags in ["", "-sampler random", "-sampler halton", "-integrator naive", "-sampler multi_jittered"] {
        let stage = stage(flags);
        let expected = stage.sums(4, &[12]).0;
        for ends in [&[5, 12][..], &[1, 2, 11, 12], &[3, 4, 5, 6, 7, 12]] {
            assert!(stage.sums(4, ends).0 == expected, "{flags} {ends:?}");
        }
    }
}

fn structures() {
    let expected = stage("-accel list").sums(4, &[12]).0;
    for accel in ["bvh", "kdtree", "grid -grid 5 6 7"] {
        assert!(stage(&format!("-accel {accel}")).sums(4, &[12]).0 == expected, "{accel}");
    }
}

/// The part of a picture that is drawn alone has the pixels of the whole.
fn crop() {
    let whole = stage("").film(4);
    let part = stage("-crop 5 3 29 20").film(4);
    assert_eq!((part.width(), part.height()), (24, 17));
    for y in 0..17 {
        let row = &whole.row(y + 3)[5..29];
        assert_eq!(part.row(y), row, "row {y}");
    }
}

/// A picture as a number.
pub(super) fn everything_hashed() -> u64 {
    let film = stage("").film(4);
    hash(film.pixels().iter().flat_map(|c| c.to_array().map(f32::to_bits)))
}
