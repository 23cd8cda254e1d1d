//! Sobol's sequence in many dimensions.
//!
//! Samples that are spread evenly in the first dimensions at once tell more of a path's first
//! surfaces than pairs that are good each for itself, as in assignment 7. One set of points serves
//! all pixels; each pixel scrambles every coordinate in its own way after Owen, so pixels err
//! independently of each other.

use super::Use;
use super::directions::DIRECTIONS;
use a7_sampling::sampler::hash::{mix, unit};
use a7_sampling::sampler::sobol::owen_reversed;
use common::math::lanes::LANES;
use std::sync::OnceLock;

/// Dimensions that a point has; what a path asks beyond is random.
pub const DIMENSIONS: usize = DIRECTIONS.len() + 1;

/// Where a pair of coordinates begins: the lower a dimension, the better it is spread together
/// with others, so the first surfaces come first.
#[inline]
pub fn dimension(what: Use) -> Option<usize> {
    let first = |generation: u32| if generation == 0 { 2 } else { 4 + 7 * generation as usize };
    let place = match what {
        Use::Pixel => 0,
        Use::Light(generation) => first(generation),
        Use::Way(generation) => first(generation) + 2,
        Use::Lens => 6,
        Use::Roulette(0) => 8,
        Use::Caustic(0) => 9,
        Use::Roulette(generation) => first(generation) + 4,
        Use::Caustic(generation) => first(generation) + 5,
    };
    (place + 1 < DIMENSIONS).then_some(place)
}

/// The point with the number `sample`, bits turned round: the lowest is the first behind the point.
pub fn point(sample: u32) -> [u32; DIMENSIONS] {
    let columns = columns();
    std::array::from_fn(|dimension| {
        let (mut rest, mut value) = (sample, 0);
        while rest != 0 {
            value ^= columns[dimension][rest.trailing_zeros() as usize];
            rest &= rest - 1;
        }
        value
    })
}

/// Two coordinates in the scrambling that a key stands for.
#[inline]
pub fn scrambled(point: [u32; 2], key: u64) -> [f64; 2] {
    let value = |bits: u32, key: u64| unit(owen_reversed(bits, key as u32).reverse_bits());
    [value(point[0], key), value(point[1], mix(key) >> 32)]
}

/// The same of eight points, each with a key of its own.
#[inline(always)]
pub fn all_scrambled(points: [[u32; LANES]; 2], keys: [u64; LANES]) -> [[f64; LANES]; 2] {
    let (mut first, mut second) = ([0; LANES], [0; LANES]);
    for lane in 0..LANES {
        (first[lane], second[lane]) = (keys[lane] as u32, (mix(keys[lane]) >> 32) as u32);
    }
    let value = |mut bits: [u32; LANES], keys: [u32; LANES]| {
        let mut units = [0.0; LANES];
        for lane in 0..LANES {
            bits[lane] = owen_reversed(bits[lane], keys[lane]);
        }
        for bits in &mut bits {
            *bits = bits.reverse_bits();
        }
        for lane in 0..LANES {
            units[lane] = unit(bits[lane]);
        }
        units
    };
    [value(points[0], first), value(points[1], second)]
}

/// What every bit of a sample's number changes, bits turned round.
fn columns() -> &'static [[u32; 32]; DIMENSIONS] {
    static COLUMNS: OnceLock<Box<[[u32; 32]; DIMENSIONS]>> = OnceLock::new();
    COLUMNS.get_or_init(|| {
        let mut all = Box::new([[0; 32]; DIMENSIONS]);
        // The first dimension only turns the bits round.
        all[0] = std::array::from_fn(|bit| 1 << bit);
        for (columns, &(degree, coefficients, first)) in all[1..].iter_mut().zip(&DIRECTIONS) {
            *columns = recurrence(degree as usize, coefficients, first);
        }
        all
    })
}

/// Direction numbers by the recurrence of a primitive polynomial (Bratley & Fox, "Algorithm 659",
/// 1988).
fn recurrence(degree: usize, coefficients: u32, first: &[u32]) -> [u32; 32] {
    let mut direction = [0u32; 32];
    for bit in 0..32 {
        direction[bit] = if bit < degree {
            first[bit] << (31 - bit)
        } else {
            let last = direction[bit - degree];
            (1..degree).fold(last ^ (last >> degree), |sum, k| {
                let used = coefficients >> (degree - 1 - k) & 1;
                sum ^ (used * direction[bit - k])
            })
        };
    }
    direction.map(u32::reverse_bits)
}
