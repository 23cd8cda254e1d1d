//! Structures that are built when the first ray asks for them, and not before.
//!
//! A scene whose pictures need no hit, or whose tiles all see nothing, builds nothing. When it
//! is built, all threads that ask wait for the one build.

use common::accel::Accel;
use common::counters::Counters;
use common::geometry::{Geometry, Hit};
use common::math::Interval;
use common::ray::Ray;
use std::panic::resume_unwind;
use std::sync::OnceLock;
use std::thread;
use std::time::{Duration, Instant};

/// A structure of type `A` and how to build it.
pub struct Lazy<'g, A, F> {
    geometry: &'g Geometry,
    threads: usize,
    build: F,
    built: OnceLock<(A, Duration)>,
}

impl<'g, A: Accel + Send, F: Fn(&'g Geometry) -> A + Sync> Lazy<'g, A, F> {
    /// Nothing yet. `build` will run once, in a pool of that many threads, at least one.
    pub fn new(geometry: &'g Geometry, threads: usize, build: F) -> Self {
        Self { geometry, threads, build, built: OnceLock::new() }
    }

    /// The structure, built now if it is not there yet.
    ///
    /// # Panics
    /// If building does, or if the system has no thread to spare.
    #[inline]
    pub fn get(&self) -> &A {
        &self.built.get_or_init(|| self.timed()).0
    }

    /// The structure and how long building it took, by the clock; `None` if nothing has asked.
    pub fn built(&self) -> Option<(&A, Duration)> {
        self.built.get().map(|(structure, time)| (structure, *time))
    }

    #[cold]
    fn timed(&self) -> (A, Duration) {
        let started = Instant::now();
        let structure = apart(self.threads, || (self.build)(self.geometry));
        (structure, started.elapsed())
    }
}

/// Does the work in a pool of its own, called from a thread of no pool. In the pool that renders,
/// a part of a build that waits for another would pass its time with the next tile, whose rays
/// wait for the build: for ever.
pub(crate) fn apart<T: Send>(threads: usize, work: impl Fn() -> T + Sync) -> T {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.max(1)).build();
    let pool = pool.unwrap_or_else(|why| panic!("no thread to build with: {why}"));
    let work = || pool.install(&work);
    if rayon::current_thread_index().is_none() {
        return work();
    }
    thread::scope(|scope| scope.spawn(work).join()).unwrap_or_else(|panic| resume_unwind(panic))
}

impl<'g, A: Accel + Send, F: Fn(&'g Geometry) -> A + Sync> Accel for Lazy<'g, A, F> {
    #[inline]
    fn nearest(&self, ray: &Ray, interval: Interval, counters: &mut Counters) -> Option<Hit> {
        self.get().nearest(ray, interval, counters)
    }

    #[inline]
    fn any(&self, ray: &Ray, interval: Interval, counters: &mut Counters) -> bool {
        self.get().any(ray, interval, counters)
    }

    fn nearest_many(
        &self,
        rays: &[Ray],
        interval: Interval,
        hits: &mut [Option<Hit>],
        counters: &mut Counters,
    ) {
        self.get().nearest_many(rays, interval, hits, counters);
    }

    fn any_many(&self, rays: &[Ray], interval: Interval, hit: &mut [bool], counters: &mut Counters) {
        self.get().any_many(rays, interval, hit, counters);
    }

    fn geometry(&self) -> &Geometry {
        self.geometry
    }

    fn validate(&self) -> Result<(), String> {
        self.get().validate()
    }
}
