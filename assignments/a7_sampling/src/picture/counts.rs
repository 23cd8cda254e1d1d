//! A7T6: how many samples each pixel took, as a picture.

use common::math::Vec3;
use common::picture::{Film, Size};

/// Grey of a pixel with the fewest samples: not black, which would look like nothing at all.
const FEWEST: f32 = 0.1;

/// `counts` as grey, row by row from the bottom, all at least 1: every doubling is as large a step,
/// from dark grey for the fewest to white for the most. If all have the same number, all are dark.
///
/// # Panics
/// If there are not as many counts as pixels.
pub fn counts_picture(size: Size, counts: &[u32]) -> Film {
    assert_eq!(counts.len(), size.pixels());
    let doublings = |n: u32| (n.max(1) as f32).log2();
    let least = doublings(counts.iter().copied().min().unwrap_or(1));
    let most = doublings(counts.iter().copied().max().unwrap_or(1));
    let grey = |n: u32| {
        let share = if most > least { (doublings(n) - least) / (most - least) } else { 0.0 };
        FEWEST + (1.0 - FEWEST) * share
    };
    Film::from_fn(size, |x, y| Vec3::splat(grey(counts[(y * size.width() + x) as usize])))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a7t6_every_doubling_is_a_step_from_dark_to_white() {
        let size = Size::new(4, 1).unwrap();
        let greys: Vec<f32> = counts_picture(size, &[8, 16, 32, 64]).pixels().iter().map(|p| p.x).collect();
        for (grey, expected) in greys.iter().zip([0.1, 0.4, 0.7, 1.0]) {
            assert!((grey - expected).abs() < 1e-6, "{greys:?}");
        }
        assert!(counts_picture(size, &[8; 4]).pixels().iter().all(|p| *p == Vec3::splat(FEWEST)));
    }
}
