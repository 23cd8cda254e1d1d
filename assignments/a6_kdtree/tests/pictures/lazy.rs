//! Structures that are built when the first ray asks, once, and not before.

use crate::world::{agree_on, lumpy_ball, rays};
use crate::{args, out_of_sight, studio_of};
use a1_ray_casting::{Depth, Layer, Sight, Studio};
use a6_kdtree::Lazy;
use a6_kdtree::kdtree::{KdTree, Options};
use common::accel::{Accel, List};
use common::counters::Counters;
use common::geometry::Geometry;
use common::math::{Interval, Vec3};
use common::picture::Film;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Barrier, mpsc};
use std::thread;
use std::time::Duration;

/// A tree that counts how often it is built.
fn counted<'a>(
    geometry: &'a Geometry,
    builds: &'a AtomicUsize,
) -> Lazy<'a, KdTree<'a>, impl Fn(&'a Geometry) -> KdTree<'a> + Sync> {
    Lazy::new(geometry, 2, move |geometry| {
        builds.fetch_add(1, Ordering::Relaxed);
        KdTree::new(geometry, Options::default())
    })
}

#[test]
fn a6t5_built_once_for_all_who_ask_together() {
    let (geometry, builds, ready) = (lumpy_ball(30), AtomicUsize::new(0), Barrier::new(8));
    let lazy = counted(&geometry, &builds);
    let ray = rays(&geometry, 1)[0];
    assert!(lazy.built().is_none() && lazy.geometry().len() == 10_800);
    thread::scope(|scope| {
        for _ in 0..8 {
            scope.spawn(|| {
                ready.wait();
                lazy.any(&ray, Interval::ALL, &mut Counters::default());
            });
        }
    });
    assert_eq!(builds.load(Ordering::Relaxed), 1);
    let (tree, time) = lazy.built().expect("it was asked for");
    assert!(time > Duration::ZERO);
    assert_eq!(tree.fingerprint(), KdTree::new(&geometry, Options::default()).fingerprint());
    lazy.validate().unwrap();
    let list = List::new(&geometry);
    let hits: usize = rays(&geometry, 300).iter().map(|ray| agree_on(&lazy, &list, ray)).sum();
    assert!(hits > 100 && builds.load(Ordering::Relaxed) == 1);
}

/// A part of the build waits for another part on another thread of the pool, while a further ray
/// asks. Whoever waits must not pass the time with that ray, which waits for the build.
#[test]
fn a6t5_a_build_in_parallel_inside_parallel_work() {
    let (done, wait) = mpsc::channel();
    thread::spawn(move || {
        let (geometry, both_run, asked) = (lumpy_ball(2), Barrier::new(3), AtomicBool::new(false));
        let lazy = Lazy::new(&geometry, 2, |geometry| {
            let first = || {
                both_run.wait();
                while !asked.load(Ordering::Acquire) {
                    thread::yield_now();
                }
            };
            let second = || {
                both_run.wait();
                thread::sleep(Duration::from_millis(100));
            };
            rayon::join(first, second);
            List::new(geometry)
        });
        let ray = rays(&geometry, 1)[0];
        let ask = || _ = lazy.any(&ray, Interval::ALL, &mut Counters::default());
        let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build().unwrap();
        pool.in_place_scope(|scope| {
            scope.spawn(|_| ask());
            both_run.wait();
            scope.spawn(|_| ask());
            asked.store(true, Ordering::Release);
        });
        assert!(lazy.built().is_some());
        done.send(()).unwrap();
    });
    wait.recv_timeout(Duration::from_secs(60)).expect("it ends");
}

/// Draws one layer through a tree that counts its builds.
fn draw(studio: &Studio, flags: &str, layer: &dyn Layer) -> (Film, usize) {
    let builds = AtomicUsize::new(0);
    let lazy = counted(&studio.geometry, &builds);
    let (mut films, _) = studio.render(args(flags).cast(), &lazy, &[layer]);
    (films.remove(0), builds.load(Ordering::Relaxed))
}

#[test]
fn a6t5_tiles_that_see_nothing_build_nothing() {
    let studio = studio_of(&out_of_sight(), 40, 40);
    let depth = Depth { min: 0.0, max: 1.0 };
    let (skipped, builds) = draw(&studio, "", &depth);
    assert_eq!(builds, 0);
    let (traced, builds) = draw(&studio, "-noskip tile", &depth);
    assert_eq!((traced == skipped, builds), (true, 1));
}

/// A picture that looks at no hit.
struct Blank;

impl Layer for Blank {
    fn value(&self, _: &Sight, _: &mut Counters) -> Vec3 {
        Vec3::ONE
    }

    fn needs_hit(&self) -> bool {
        false
    }
}

#[test]
fn a6t5_pictures_without_hits_build_nothing() {
    let turned = out_of_sight().replace("direction 0 0 -1", "direction 0 0 1").replace("angle 40", "angle 4");
    let studio = studio_of(&turned, 40, 40);
    assert_eq!(draw(&studio, "", &Blank).1, 0);
    let (film, builds) = draw(&studio, "", &Depth { min: 100.0, max: 80.0 });
    assert!(builds == 1 && film.pixels().iter().any(|c| *c != Vec3::ZERO), "now balls are seen");
}
