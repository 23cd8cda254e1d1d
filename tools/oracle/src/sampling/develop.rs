//! From samples to pixels (course rule §7.2).

use super::{Filter, pixel_places};
use crate::{Raster, Samples};
use common::math::DVec3;
use rayon::prelude::*;

/// The pixels that samples make. Without a filter: the plain mean of the pixel's own. With one:
/// all samples of the pixels within its support, which the picture's border clips, weighted by
/// their offset from the pixel's centre; where the weights come to nothing, that plain mean.
pub(crate) fn develop(samples: &Samples, filter: Option<Filter>) -> Raster {
    let (width, height) = (samples.width, samples.height);
    let pixel = |j: u32| {
        move |i: u32| match filter {
            None => mean(samples, i, j),
            Some(filter) => filtered(samples, filter, i, j).unwrap_or_else(|| mean(samples, i, j)),
        }
    };
    let pixels = (0..height).into_par_iter().flat_map_iter(|j| (0..width).map(pixel(j))).collect();
    Raster { width, height, pixels }
}

fn mean(samples: &Samples, i: u32, j: u32) -> DVec3 {
    let own = samples.pixel(i, j);
    own.iter().sum::<DVec3>() / own.len() as f64
}

/// `None` if the weights come to nothing.
fn filtered(samples: &Samples, filter: Filter, i: u32, j: u32) -> Option<DVec3> {
    let reach = i64::from(filter.support());
    let near = |at: u32, end: u32| {
        let at = i64::from(at);
        (at - reach).max(0)..(at + reach + 1).min(i64::from(end))
    };
    let places = pixel_places(samples.side);
    let (mut sum, mut weights) = (DVec3::ZERO, 0.0);
    for y in near(j, samples.height) {
        for x in near(i, samples.width) {
            let (right, up) = ((x - i64::from(i)) as f64, (y - i64::from(j)) as f64);
            for (place, color) in places.iter().zip(samples.pixel(x as u32, y as u32)) {
                let weight = filter.weight(right + place[0] - 0.5, up + place[1] - 0.5);
                sum += weight * *color;
                weights += weight;
            }
        }
    }
    (weights > 0.0).then(|| sum / weights)
}
