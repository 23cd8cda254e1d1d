//! Sums are the same bits whatever the way to them.

mod fake;

use a8_path_tracing::film::join::{Part, join};
use a8_path_tracing::film::{Frame, Identity, Sums, checkpoint::Checkpoint};
use a8_path_tracing::render::{End, Goal, Rendering, spared, trace_spared};
use a8_path_tracing::{Aov, Estimator, Found, Layout};
use common::counters::Counters;
use common::math::Vec3;
use common::tiles::TileOptions;
use fake::{ALL, Fake, frame, go_on, goal, part, size};
use proptest::prelude::*;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

const WILD: Fake = Fake { spread: 70, nap: Duration::ZERO };

fn named(name: String, sums: Sums) -> Part {
    Part { name, checkpoint: Checkpoint { identity: Identity::default().with("-seed", 1), sums } }
}

/// What is said when these parts are put together.
fn refusal(parts: Vec<Sums>) -> String {
    let parts = parts.into_iter().zip('a'..).map(|(sums, name)| named(name.to_string(), sums)).collect();
    join(parts).unwrap_err().to_string()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn splits_and_resumes_change_no_bit(
        width in 1..40u32,
        height in 1..40u32,
        end in 1..60u32,
        cuts in prop::collection::vec(0..60u32, 0..5),
        across in 0..40u32,
        up in 0..40u32,
        threads in 1..5usize,
        tile in 1..50u32,
    ) {
        let size = size(width, height);
        let whole = part(&WILD, Frame::whole(size), 0..end);
        // With other threads and tiles, and rests between.
        let mut rested = Sums::new(Frame::whole(size), ALL, 0).unwrap();
        let options = TileOptions { tile: Some(tile), threads: Some(threads), ..TileOptions::default() };
        let mut cuts: Vec<u32> = cuts.into_iter().filter(|cut| *cut < end).chain([0, end]).collect();
        cuts.sort_unstable();
        cuts.dedup();
        for cut in &cuts {
            go_on(&WILD, &mut rested, goal(*cut), options);
        }
        prop_assert!(rested == whole);
        // On many machines.
        let (x, y) = (across.min(width), up.min(height));
        let crops = [[0, 0, x, y], [x, 0, width, y], [0, y, x, height], [x, y, width, height]];
        let crops = crops.into_iter().filter(|[x0, y0, x1, y1]| x0 < x1 && y0 < y1);
        let mut parts: Vec<Part> = crops
            .flat_map(|crop| cuts.windows(2).map(move |cut| (crop, cut[0]..cut[1])))
            .map(|(crop, samples)| named(format!("{crop:?} {samples:?}"), part(&WILD, frame(size, crop), samples)))
            .collect();
        parts.reverse();
        prop_assert!(join(parts).unwrap().sums == whole);
    }
}

#[test]
fn means_are_those_of_the_samples() {
    let (fake, size) = (Fake::default(), size(5, 3));
    let sums = part(&fake, Frame::whole(size), 0..50);
    for number in 0..15 {
        let pixel = (number as u32 % 5, number as u32 / 5);
        let mean = |of: &dyn Fn(Found) -> Vec3| {
            (0..50).map(|sample| of(fake.found(pixel, sample)).as_dvec3()).sum::<common::math::DVec3>() / 50.0
        };
        let near = |found: Vec3, of: &dyn Fn(Found) -> Vec3| (found.as_dvec3() - mean(of)).length() < 1e-6;
        assert!(near(sums.radiance(number), &|found| found.radiance));
        assert!(near(sums.aov(Aov::Albedo, number).unwrap(), &|found| found.albedo));
        assert!(near(sums.aov(Aov::Normal, number).unwrap(), &|found| found.normal));
        assert!(near(sums.aov(Aov::Depth, number).unwrap(), &|found| Vec3::splat(found.depth)));
    }
}

#[test]
fn a_crop_has_the_pixels_of_the_whole() {
    let size = size(31, 17);
    let (whole, crop) =
        (part(&WILD, Frame::whole(size), 3..20), part(&WILD, frame(size, [7, 2, 30, 16]), 3..20));
    assert!(whole.dropped > crop.dropped && crop.dropped > 0, "some samples were to be no numbers");
    for number in 0..crop.taken().len() {
        let (x, y) = crop.frame.pixel(number);
        assert_eq!(crop.radiance(number), whole.radiance((y * 31 + x) as usize), "{x} {y}");
        assert!(crop.radiance(number).is_finite());
    }
}

#[test]
fn a_stopped_pass_counts_for_nothing() {
    struct Impatient<'a>(&'a AtomicBool);
    impl Estimator for Impatient<'_> {
        type Scratch = u64;
        fn trace(&self, s: &mut u64, p: &[(u32, u32)], r: Range<u32>, c: &mut Counters, f: &mut [Found]) {
            if r.contains(&11) && p.contains(&(20, 20)) {
                self.0.store(true, Ordering::Relaxed);
            }
            WILD.trace(s, p, r, c, f);
        }
    }
    let (stop, frame) = (AtomicBool::new(false), Frame::whole(size(40, 40)));
    let mut sums = Sums::new(frame, ALL, 0).unwrap();
    let options =
        TileOptions { stop: Some(&stop), threads: Some(2), tile: Some(4), ..TileOptions::default() };
    let rendering = Rendering { goal: goal(64), options };
    let tally = rendering.run(&Impatient(&stop), &mut sums, |_| {});
    assert_eq!((tally.end, sums.samples.clone()), (End::Stopped, 0..8));
    assert!(sums == part(&WILD, frame, 0..8));
    assert_eq!(tally.counters.rays, 40 * 40 * 8);
    stop.store(false, Ordering::Relaxed);
    go_on(&WILD, &mut sums, goal(64), TileOptions::default());
    assert!(sums == part(&WILD, frame, 0..64));
}

#[test]
fn time_ends_a_rendering_between_passes() {
    let fake = Fake { spread: 3, nap: Duration::from_micros(100) };
    let mut sums = Sums::new(Frame::whole(size(8, 8)), ALL, 0).unwrap();
    let goal = Goal { end: 1 << 20, time: Some(Duration::from_millis(300)), error: None };
    let started = Instant::now();
    let options = TileOptions { threads: Some(1), ..TileOptions::default() };
    let tally = go_on(&fake, &mut sums, goal, options);
    assert_eq!(tally.end, End::Time);
    // A busy machine may take longer for a sample than promised, so only the order of magnitude.
    assert!((3..=60).contains(&sums.done()), "{}", sums.done());
    assert!(started.elapsed() < Duration::from_secs(3));
    assert!(sums == part(&Fake { nap: Duration::ZERO, ..fake }, sums.frame, 0..sums.done()));
}

/// Noise of standard deviation `noise(x)` around 0.5.
struct Noisy;

impl Noisy {
    fn noise(x: u32) -> f64 {
        if x < 32 { 0.02 } else { 0.4 }
    }
}

impl Estimator for Noisy {
    type Scratch = ();
    fn trace(&self, (): &mut (), p: &[(u32, u32)], r: Range<u32>, _: &mut Counters, f: &mut [Found]) {
        let samples = p.iter().flat_map(|pixel| r.clone().map(move |sample| (pixel, sample)));
        for (found, ((x, y), sample)) in f.iter_mut().zip(samples) {
            let word = a7_sampling::sampler::hash::hash(u64::from(sample), u64::from(*x), u64::from(*y));
            // Uniform over ±√3: variance 1.
            let one = (a7_sampling::sampler::hash::unit(word as u32) * 2.0 - 1.0) * 3f64.sqrt();
            found.radiance = Vec3::splat((0.5 + Self::noise(*x) * one) as f32);
        }
    }
}

fn until(error: f64, end: u32, sums: &mut Sums) -> End {
    let goal = Goal { end, time: None, error: Some(error) };
    Rendering { goal, options: TileOptions::default() }.run(&Noisy, sums, |_| {}).end
}

#[test]
fn noisy_pixels_get_more_samples_and_all_get_as_good_as_asked_for() {
    let layout = Layout { halves: true, ..Layout::default() };
    let mut sums = Sums::new(Frame::whole(size(64, 64)), layout, 0).unwrap();
    assert_eq!(until(0.02, 1 << 14, &mut sums), End::Error);
    let mean = |columns: Range<u32>| {
        let of = (0..64 * 64).filter(|n| columns.contains(&(n % 64)));
        let all: Vec<u32> = of.map(|n| sums.taken()[n as usize]).collect();
        all.iter().sum::<u32>() as f64 / all.len() as f64
    };
    // Away from the border the quiet half has enough at once. Brightness² + 0.01 is 0.26: the
    // other half needs 0.4² / (0.02² · 0.26) = 1538 samples, and most have them at 2048.
    assert_eq!(mean(0..29), 16.0);
    let busy = mean(35..64);
    assert!((1024.0..=2700.0).contains(&busy), "{busy}");
    let error = |number: &usize| f64::from(sums.radiance(*number).x - 0.5).powi(2) / 0.26;
    let busy: Vec<f64> = (0..64 * 64).filter(|n| n % 64 >= 35).map(|n| error(&n)).collect();
    let rms = (busy.iter().sum::<f64>() / busy.len() as f64).sqrt();
    assert!(rms < 0.025, "{rms}");
}

#[test]
fn a_rendering_with_errors_goes_on_to_the_bit() {
    let layout = Layout { halves: true, ..Layout::default() };
    let new = || Sums::new(Frame::whole(size(48, 20)), layout, 0).unwrap();
    let mut whole = new();
    until(0.05, 500, &mut whole);
    assert!(whole.active() > 0 && whole.active() < 48 * 20, "{}", whole.active());
    for rests in [&[1u32, 8, 16, 17, 64, 300][..], &[32, 33, 128], &[499]] {
        let mut sums = new();
        for end in rests.iter().chain(&[500]) {
            until(0.05, *end, &mut sums);
            let kept = Checkpoint { identity: Identity::default(), sums: sums.clone() };
            assert!(a8_path_tracing::film::checkpoint::decode(&kept.encode()).unwrap() == kept);
        }
        assert!(sums == whole, "{rests:?}");
    }
}

#[test]
fn parts_that_do_not_join_are_refused_by_name() {
    let (fake, size) = (Fake::default(), size(10, 8));
    let of = |crop: [u32; 4], samples: Range<u32>| part(&fake, frame(size, crop), samples);
    let whole = |samples: Range<u32>| of([0, 0, 10, 8], samples);
    for (parts, needles) in [
        (vec![whole(0..4), whole(6..8)], &["samples 4 to 5 are in none"][..]),
        (vec![whole(4..8), whole(0..5)], &["samples 4 to 4 are both in 'b' and in 'a'"]),
        (vec![whole(0..4), whole(0..4)], &["samples 0 to 3 are both"]),
        (
            vec![of([0, 0, 5, 8], 0..2), of([5, 0, 10, 8], 0..3)],
            &["samples 2 to 2 of pixels 0 0 5 8 are in none"],
        ),
        (vec![of([0, 0, 5, 8], 0..2), of([4, 0, 10, 8], 0..2)], &["'a' and 'b' overlap"]),
        (
            vec![of([0, 0, 5, 8], 0..2), of([6, 0, 10, 8], 0..2)],
            &["pixels 5 0 6 8 (as -crop", "none of the files"],
        ),
        (vec![of([0, 0, 10, 3], 0..2), of([0, 3, 4, 8], 0..2)], &["pixels 4 3 10 8 "]),
        (
            vec![of([0, 4, 10, 8], 0..2), of([3, 0, 5, 2], 0..2)],
            &["pixels 0 0 3 4 ", "36 pixels are missing in all"],
        ),
        (
            vec![of([0, 0, 5, 8], 0..2), of([5, 0, 10, 8], 0..1), of([5, 0, 10, 8], 2..3)],
            &["samples 1 to 1 of pixels 5 0 10 8 are in none"],
        ),
        (vec![], &["nothing to merge"]),
    ] {
        let said = refusal(parts);
        needles.iter().for_each(|needle| assert!(said.contains(needle), "{needle}: {said}"));
    }
    let one = named("a".to_owned(), whole(0..4));
    let mut other = named("b".to_owned(), whole(4..8));
    other.checkpoint.identity = Identity::default().with("-seed", 2);
    let said = join(vec![one, other]).unwrap_err().to_string();
    assert_eq!(said, "'a' was made with -seed 1, but 'b' with -seed 2");
    let alone = join(vec![named("a".to_owned(), of([2, 2, 5, 6], 3..7))]).unwrap();
    assert!(alone.sums == of([2, 2, 5, 6], 3..7), "a part alone stays a part");
}

#[test]
fn what_is_too_large_is_refused() {
    let huge = Frame::whole(size(16_384, 16_384));
    let said = Sums::new(huge, ALL, 0).unwrap_err().to_string();
    assert!(said.contains("GiB") && said.contains("-crop"), "{said}");
}

/// Of every pixel the samples taken and those it was spared are all that there can be.
#[test]
fn spared_samples_are_counted_and_can_be_traced() {
    struct Counted<'a>(&'a Fake);
    impl Estimator for Counted<'_> {
        type Scratch = u64;
        fn trace(&self, s: &mut u64, p: &[(u32, u32)], r: Range<u32>, c: &mut Counters, f: &mut [Found]) {
            self.0.trace(s, p, r.clone(), c, f);
            // The left half has no noise.
            let each = f.chunks_exact_mut(r.len()).zip(p).filter(|(_, (x, _))| *x < 16);
            each.flat_map(|(f, _)| f).for_each(|found| found.radiance = Vec3::ONE);
        }
    }
    let estimator = Counted(&Fake { spread: 3, nap: Duration::ZERO });
    let layout = Layout { halves: true, ..Layout::default() };
    let mut sums = Sums::new(Frame::whole(size(32, 32)), layout, 5).unwrap();
    let goal = Goal { end: 5 + 3000, time: None, error: Some(0.01) };
    let options = TileOptions::default();
    let tally = Rendering { goal, options }.run(&estimator, &mut sums, |_| {});
    let left = spared(&sums, &goal);
    assert!(left > 14 * 32 * 2900, "{left}");
    assert_eq!(tally.paths + left, 32 * 32 * 3000);
    let before = sums.clone();
    assert_eq!(trace_spared(&estimator, &sums, &goal, &options).rays, left);
    assert!(before == sums);
}
