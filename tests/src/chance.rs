//! What pictures of random samples must look like, by the oracle's samples.
//!
//! A pixel is a ratio of sums over samples. From a fine uniform pattern of the oracle's follow its
//! mean and, to first order in 1/samples, its bias and its variance for independent samples.

use common::math::DVec3;
use oracle::{Filter, Samples, pixel_places};

/// What a pixel of a picture by random samples is drawn from, for each colour channel.
#[derive(Clone, Copy, Debug)]
pub struct Expected {
    /// Mean.
    pub mean: DVec3,
    /// Variance, if the samples are independent.
    pub variance: DVec3,
    /// The most that a single sample can move it, whichever colour of the picture it has.
    pub step: DVec3,
    /// Variance by what may be there and stand between the fine samples: a corner of less than
    /// one of their cells in each pixel.
    pub unseen: DVec3,
}

/// The pixels of a picture with `count` independent samples each, row by row from below. `fine`
/// holds the samples that stand for the truth, best many.
///
/// # Panics
/// Where the filter's weights come to nothing.
pub fn expected(fine: &Samples, filter: Option<Filter>, count: u32) -> Vec<Expected> {
    let colors = || (0..fine.height).flat_map(|j| (0..fine.width).flat_map(move |i| fine.pixel(i, j)));
    let low = colors().copied().reduce(DVec3::min).unwrap_or_default();
    let high = colors().copied().reduce(DVec3::max).unwrap_or_default();
    let rows = (0..fine.height).flat_map(|j| (0..fine.width).map(move |i| (i, j)));
    rows.map(|pixel| of_pixel(fine, filter, f64::from(count), pixel, [low, high])).collect()
}

/// A sample's weight for a pixel, its colour, and which of the pixels near has it.
type Weighted = (f64, DVec3, usize);

fn of_pixel(
    fine: &Samples,
    filter: Option<Filter>,
    count: f64,
    pixel: (u32, u32),
    range: [DVec3; 2],
) -> Expected {
    let (near, givers) = weighted(fine, filter, pixel);
    let share = 1.0 / f64::from(fine.side * fine.side);
    let whole: f64 = share * near.iter().map(|(w, ..)| w).sum::<f64>();
    assert!(whole > 0.0, "the filter catches nothing");
    let mean = share * near.iter().map(|(w, c, _)| *w * *c).sum::<DVec3>() / whole;
    // Of every giver: the means of w, of w(c − mean), of its square, and of its product with w.
    let mut moments = vec![(0.0, DVec3::ZERO, DVec3::ZERO, DVec3::ZERO); givers];
    let mut greatest = 0.0f64;
    for (w, color, giver) in near {
        let pull = w * (color - mean);
        let m = &mut moments[giver];
        m.0 += share * w;
        m.1 += share * pull;
        m.2 += share * pull * pull;
        m.3 += share * w * pull;
        greatest = greatest.max(w);
    }
    let variance: DVec3 = moments.iter().map(|m| m.2 - m.1 * m.1).sum();
    let covariance: DVec3 = moments.iter().map(|m| m.3 - m.0 * m.1).sum();
    let farthest = range.map(|color| (color - mean).abs()).into_iter().reduce(DVec3::max).unwrap_or_default();
    let step = greatest * farthest / (count * whole);
    Expected {
        mean: mean - covariance / (count * whole * whole),
        variance: variance.max(DVec3::ZERO) / (count * whole * whole),
        step,
        unseen: step * step * count * share * givers as f64,
    }
}

/// All samples that count for a pixel, and how many pixels they come from.
fn weighted(fine: &Samples, filter: Option<Filter>, (i, j): (u32, u32)) -> (Vec<Weighted>, usize) {
    let reach = filter.map_or(0, |filter| filter.support());
    let near = |at: u32, end: u32| at.saturating_sub(reach)..(at + reach + 1).min(end);
    let (places, mut all, mut givers) = (pixel_places(fine.side), Vec::new(), 0);
    for (x, y) in near(j, fine.height).flat_map(|y| near(i, fine.width).map(move |x| (x, y))) {
        let (right, up) = (f64::from(x) - f64::from(i) - 0.5, f64::from(y) - f64::from(j) - 0.5);
        let weight = |[u, v]: [f64; 2]| filter.map_or(1.0, |f| f.weight(right + u, up + v));
        let own = places.iter().zip(fine.pixel(x, y));
        all.extend(own.map(|(place, color)| (weight(*place), *color, givers)));
        givers += 1;
    }
    (all, givers)
}
