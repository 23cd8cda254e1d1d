//! The tile loop covers every pixel once, whatever the threads and tiles.

use super::*;
use crate::counters::Counters;
use crate::math::Vec3;
use proptest::prelude::*;
use std::collections::HashSet;
use std::sync::Mutex;
use std::sync::atomic::Ordering;
use std::thread;
use std::time::Duration;

fn size(width: i64, height: i64) -> Size {
    Size::new(width, height).unwrap()
}

fn options(tile: u32, threads: usize) -> TileOptions<'static> {
    TileOptions { tile: Some(tile), threads: Some(threads), ..TileOptions::default() }
}

/// Two layers of something that depends on the pixel only, and takes long enough for help.
fn pattern(size: Size, options: &TileOptions) -> Rendered<Counters> {
    render(
        size,
        2,
        options,
        || 0.25_f32,
        |quarter, tile, counters: &mut Counters, out| {
            thread::sleep(Duration::from_micros(20));
            for (x, y) in tile.pixels() {
                counters.rays += 1;
                counters.cells += u64::from(x * y);
                let wave = ((x * 31 + y * 17) as f32 * *quarter).sin();
                out.set(0, x, y, Vec3::new(wave, x as f32, y as f32));
                out.set(1, x, y, Vec3::splat(-wave));
            }
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn every_pixel_is_in_exactly_one_tile(
        width in 1..60_i64,
        height in 1..60_i64,
        tile in 1..70_u32,
        threads in 1..5_usize,
    ) {
        let seen = Mutex::new(vec![0; (width * height) as usize]);
        let see = |tile: Tile| {
            assert!(tile.area() == tile.pixels().count() && tile.area() > 0);
            for (x, y) in tile.pixels() {
                seen.lock().unwrap()[(i64::from(y) * width + i64::from(x)) as usize] += 1;
            }
        };
        let (size, options) = (size(width, height), options(tile, threads));
        let finished = for_each_tile(size, &options, || (), |(), tile| see(tile));
        prop_assert!(finished.complete);
        prop_assert!(seen.into_inner().unwrap().iter().all(|&n| n == 1));
    }
}

#[test]
fn pictures_and_counters_do_not_depend_on_threads_or_tiles() {
    let size = size(53, 37);
    let reference = pattern(size, &options(u32::MAX, 1));
    assert_eq!(reference.counters.rays, 53 * 37);
    assert_eq!(reference.films[0].get(52, 36).y, 52.0);
    for threads in [1, 2, 3, 7, 16] {
        for tile in [1, 5, 8, 16, 64] {
            let other = pattern(size, &options(tile, threads));
            assert_eq!(other.films, reference.films, "{threads} threads, tile {tile}");
            assert_eq!(other.counters, reference.counters);
        }
    }
    let chosen = pattern(size, &TileOptions::default());
    assert_eq!(chosen.films, reference.films);
}

#[test]
fn long_work_is_shared_by_the_threads_asked_for() {
    for threads in [1, 2, 4] {
        let ids = Mutex::new(HashSet::new());
        let finished = for_each_tile(
            size(64, 64),
            &options(8, threads),
            || (),
            |(), _| {
                ids.lock().unwrap().insert(thread::current().id());
                thread::sleep(Duration::from_millis(2));
            },
        );
        assert_eq!(ids.into_inner().unwrap().len(), threads);
        assert_eq!(finished.states.len(), threads);
    }
}

#[test]
fn quick_work_stays_on_the_calling_thread() {
    let here = thread::current().id();
    // One tile is never shared, however long it takes.
    for_each_tile(
        size(16, 16),
        &options(16, 8),
        || (),
        |(), _| {
            assert_eq!(thread::current().id(), here);
            thread::sleep(Duration::from_millis(1));
        },
    );
}

#[test]
fn a_stop_ends_the_work_and_keeps_what_is_done() {
    let stop = AtomicBool::new(false);
    let options = TileOptions { stop: Some(&stop), ..options(4, 2) };
    let rendered = render(
        size(32, 32),
        1,
        &options,
        || (),
        |(), tile, done: &mut u64, out| {
            *done += 1;
            out.layer_mut(0).fill(Vec3::ONE);
            if tile.y0 >= 16 {
                stop.store(true, Ordering::Relaxed);
            }
        },
    );
    assert!(!rendered.complete);
    assert!((1..64).contains(&rendered.counters));
    let lit = rendered.films[0].pixels().iter().filter(|&&c| c == Vec3::ONE);
    assert_eq!(lit.count() as u64, rendered.counters * 16);
}

#[test]
fn no_layers_are_a_loop_that_counts_only() {
    let rendered = render(
        size(20, 20),
        0,
        &options(8, 2),
        || (),
        |(), tile, n: &mut u64, _| {
            *n += tile.area() as u64;
        },
    );
    assert_eq!((rendered.films.len(), rendered.counters), (0, 400));
}

#[test]
#[should_panic(expected = "a tile failed")]
fn a_panic_on_any_thread_comes_out() {
    for_each_tile(
        size(64, 64),
        &options(8, 3),
        || (),
        |(), tile| {
            thread::sleep(Duration::from_millis(1));
            assert!(tile.x0 < 40 || tile.y0 < 40, "a tile failed");
        },
    );
}

#[test]
fn small_pictures_get_small_tiles() {
    let side = |w, h| TileOptions::default().side(size(w, h));
    assert_eq!((side(9, 9), side(60, 60), side(200, 200)), (4, 8, 16));
}
