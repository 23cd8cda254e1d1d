//! The picture: which pixels hold a dot.

use crate::Point2;
use common::math::Vec3;
use common::picture::{Film, Size};
use std::sync::atomic::{AtomicU64, Ordering};

/// One bit per pixel, set from any number of threads. Black on white, so that it makes no
/// difference who came first, or how often.
#[derive(Debug)]
pub struct Dots {
    size: Size,
    bits: Vec<AtomicU64>,
}

impl Dots {
    /// An empty picture.
    pub fn new(size: Size) -> Self {
        let words = size.pixels().div_ceil(64);
        Self { size, bits: (0..words).map(|_| AtomicU64::new(0)).collect() }
    }

    /// A0T3. Plots a point of the unit square; others, NaN among them, are not in the picture.
    pub fn plot(&self, p: Point2) {
        let inside = (0.0..1.0).contains(&p.x) && (0.0..1.0).contains(&p.y);
        if !inside {
            return;
        }
        let (width, height) = (self.size.width(), self.size.height());
        // The product can round up to the side itself.
        let column = ((p.x * f64::from(width)) as u32).min(width - 1);
        let row = ((p.y * f64::from(height)) as u32).min(height - 1);
        self.set(row as usize * width as usize + column as usize);
    }

    fn set(&self, pixel: usize) {
        let (word, bit) = (&self.bits[pixel / 64], 1 << (pixel % 64));
        // Most dots fall where one is already, and looking is cheaper than writing.
        if word.load(Ordering::Relaxed) & bit == 0 {
            word.fetch_or(bit, Ordering::Relaxed);
        }
    }

    /// Whether pixel (x, y) holds a dot; y counts from the bottom.
    pub fn get(&self, x: u32, y: u32) -> bool {
        let pixel = y as usize * self.size.width() as usize + x as usize;
        self.bits[pixel / 64].load(Ordering::Relaxed) >> (pixel % 64) & 1 == 1
    }

    /// How many pixels hold a dot.
    pub fn count(&self) -> u64 {
        let ones = |word: &AtomicU64| u64::from(word.load(Ordering::Relaxed).count_ones());
        self.bits.iter().map(ones).sum()
    }

    /// Black dots on white.
    pub fn film(&self) -> Film {
        Film::from_fn(self.size, |x, y| if self.get(x, y) { Vec3::ZERO } else { Vec3::ONE })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a0t3_points_fall_into_the_pixel_that_holds_them() {
        let dots = Dots::new(Size::new(10, 10).unwrap());
        dots.plot(Point2 { x: 0.0, y: 0.0 });
        dots.plot(Point2 { x: 0.35, y: 0.99 });
        dots.plot(Point2 { x: 0.35, y: 0.99 });
        dots.plot(Point2 { x: 1.0_f64.next_down(), y: 0.1 });
        let found: Vec<_> =
            (0..10).flat_map(|y| (0..10).map(move |x| (x, y))).filter(|&(x, y)| dots.get(x, y)).collect();
        assert_eq!(found, [(0, 0), (9, 1), (3, 9)]);
        assert_eq!(dots.count(), 3);
        assert_eq!(dots.film().get(3, 9), Vec3::ZERO);
        assert_eq!(dots.film().get(3, 0), Vec3::ONE);
    }

    #[test]
    fn a0t3_points_outside_leave_no_dot() {
        let dots = Dots::new(Size::new(4, 4).unwrap());
        for odd in [-0.01, 1.0, 1e300, f64::NAN, f64::INFINITY, -f64::MIN_POSITIVE] {
            dots.plot(Point2 { x: odd, y: 0.5 });
            dots.plot(Point2 { x: 0.5, y: odd });
        }
        assert_eq!(dots.count(), 0);
    }
}
