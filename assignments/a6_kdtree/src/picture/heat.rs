//! A6T5: what every pixel costs, as false colours, behind `-heat`.
//!
//! A pixel's heat is the number of steps (cells or nodes) and of primitive tests that were made
//! for it, by the camera ray and by all rays that follow from it: exactly what `-stats` adds up.

use a1_ray_casting::{Layer, Sight};
use common::counters::Counters;
use common::math::Vec3;
use common::picture::Film;

/// The work of each pixel. Must be the last layer: what later ones do is not seen.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Heat {
    /// The work that is white, and all above; the picture's own maximum if not given.
    pub hottest: Option<u64>,
}

/// Up to this a count fits one channel of a film without rounding.
const CHANNEL: u64 = 1 << 24;

/// The ramp from no work to the hottest, each corner brighter than the one before.
const RAMP: [Vec3; 6] = [
    Vec3::new(0.0, 0.0, 0.0),
    Vec3::new(0.2, 0.05, 0.5),
    Vec3::new(0.65, 0.1, 0.45),
    Vec3::new(0.95, 0.4, 0.1),
    Vec3::new(1.0, 0.85, 0.2),
    Vec3::new(1.0, 1.0, 1.0),
];

/// Black for no work, over violet, red, orange and yellow to white for `hottest` and more; equal
/// steps of work are equal steps on the ramp.
pub fn heat_color(work: u64, hottest: u64) -> Vec3 {
    let x = work.min(hottest) as f32 / hottest.max(1) as f32 * (RAMP.len() - 1) as f32;
    let corner = (x as usize).min(RAMP.len() - 2);
    RAMP[corner].lerp(RAMP[corner + 1], x - corner as f32)
}

impl Heat {
    /// A count as the colour of a pixel, until the picture is developed.
    fn pack(work: u64) -> Vec3 {
        Vec3::new((work % CHANNEL) as f32, (work / CHANNEL) as f32, 0.0)
    }

    /// The count that a pixel holds before the picture is developed.
    pub fn work(pixel: Vec3) -> u64 {
        pixel.x as u64 + pixel.y as u64 * CHANNEL
    }
}

impl Layer for Heat {
    /// What is asked for by other layers is what is measured.
    fn needs_hit(&self) -> bool {
        false
    }

    fn watches_work(&self) -> bool {
        true
    }

    fn value(&self, sight: &Sight, counters: &mut Counters) -> Vec3 {
        Self::pack(counters.work() - sight.work_before)
    }

    fn develop(&self, film: &mut Film) -> Option<String> {
        let work = |film: &Film| film.pixels().iter().map(|p| Self::work(*p)).collect::<Vec<u64>>();
        let counts = work(film);
        let most = counts.iter().copied().max().unwrap_or(0);
        let all: u64 = counts.iter().sum();
        let hottest = self.hottest.unwrap_or(most);
        for (pixel, work) in film.pixels_mut().iter_mut().zip(&counts) {
            *pixel = heat_color(*work, hottest);
        }
        let mean = all as f64 / counts.len() as f64;
        Some(format!(
            "heat: white is {hottest} steps and tests or more; most {most}, mean {mean:.1}, all pixels {all}"
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a6t5_more_work_is_brighter() {
        let bright = |c: Vec3| c.dot(Vec3::new(0.2126, 0.7152, 0.0722));
        let colors: Vec<f32> = (0..=1000).map(|n| bright(heat_color(n, 1000))).collect();
        assert!(colors.windows(2).all(|pair| pair[0] < pair[1]));
        assert_eq!(
            [heat_color(0, 1000), heat_color(7, 7), heat_color(8, 7)],
            [Vec3::ZERO, Vec3::ONE, Vec3::ONE]
        );
        assert_eq!(heat_color(0, 0), Vec3::ZERO, "a picture without any work is black");
    }

    #[test]
    fn a6t5_counts_survive_the_film() {
        for work in [0, 1, CHANNEL - 1, CHANNEL, CHANNEL + 1, 40_000_001, (1 << 47) + 12_345_677] {
            assert_eq!(Heat::work(Heat::pack(work)), work);
        }
    }
}
