//! A6T3: noise, smooth and without a pattern, the same on every machine.
//!
//! Gradient noise on the integer lattice: every lattice point has a gradient, chosen by a hash
//! of its coordinates, and stands for the linear function that is 0 there and rises along the
//! gradient; between the eight corners of a cell these functions are blended. So noise is 0 on
//! the lattice, and turns up and down about once a unit everywhere else.
//!
//! Hash, gradients and blend are those of Perlin, "Improving Noise", SIGGRAPH 2002. It repeats
//! every 256 units.

use common::math::DVec3;

/// The permutation of 0…255 that the paper's reference fixes: what makes this noise the same as
/// everyone else's.
const PERMUTATION: [u8; 256] = [
    0x97, 0xa0, 0x89, 0x5b, 0x5a, 0x0f, 0x83, 0x0d, 0xc9, 0x5f, 0x60, 0x35, 0xc2, 0xe9, 0x07, 0xe1, 0x8c,
    0x24, 0x67, 0x1e, 0x45, 0x8e, 0x08, 0x63, 0x25, 0xf0, 0x15, 0x0a, 0x17, 0xbe, 0x06, 0x94, 0xf7, 0x78,
    0xea, 0x4b, 0x00, 0x1a, 0xc5, 0x3e, 0x5e, 0xfc, 0xdb, 0xcb, 0x75, 0x23, 0x0b, 0x20, 0x39, 0xb1, 0x21,
    0x58, 0xed, 0x95, 0x38, 0x57, 0xae, 0x14, 0x7d, 0x88, 0xab, 0xa8, 0x44, 0xaf, 0x4a, 0xa5, 0x47, 0x86,
    0x8b, 0x30, 0x1b, 0xa6, 0x4d, 0x92, 0x9e, 0xe7, 0x53, 0x6f, 0xe5, 0x7a, 0x3c, 0xd3, 0x85, 0xe6, 0xdc,
    0x69, 0x5c, 0x29, 0x37, 0x2e, 0xf5, 0x28, 0xf4, 0x66, 0x8f, 0x36, 0x41, 0x19, 0x3f, 0xa1, 0x01, 0xd8,
    0x50, 0x49, 0xd1, 0x4c, 0x84, 0xbb, 0xd0, 0x59, 0x12, 0xa9, 0xc8, 0xc4, 0x87, 0x82, 0x74, 0xbc, 0x9f,
    0x56, 0xa4, 0x64, 0x6d, 0xc6, 0xad, 0xba, 0x03, 0x40, 0x34, 0xd9, 0xe2, 0xfa, 0x7c, 0x7b, 0x05, 0xca,
    0x26, 0x93, 0x76, 0x7e, 0xff, 0x52, 0x55, 0xd4, 0xcf, 0xce, 0x3b, 0xe3, 0x2f, 0x10, 0x3a, 0x11, 0xb6,
    0xbd, 0x1c, 0x2a, 0xdf, 0xb7, 0xaa, 0xd5, 0x77, 0xf8, 0x98, 0x02, 0x2c, 0x9a, 0xa3, 0x46, 0xdd, 0x99,
    0x65, 0x9b, 0xa7, 0x2b, 0xac, 0x09, 0x81, 0x16, 0x27, 0xfd, 0x13, 0x62, 0x6c, 0x6e, 0x4f, 0x71, 0xe0,
    0xe8, 0xb2, 0xb9, 0x70, 0x68, 0xda, 0xf6, 0x61, 0xe4, 0xfb, 0x22, 0xf2, 0xc1, 0xee, 0xd2, 0x90, 0x0c,
    0xbf, 0xb3, 0xa2, 0xf1, 0x51, 0x33, 0x91, 0xeb, 0xf9, 0x0e, 0xef, 0x6b, 0x31, 0xc0, 0xd6, 0x1f, 0xb5,
    0xc7, 0x6a, 0x9d, 0xb8, 0x54, 0xcc, 0xb0, 0x73, 0x79, 0x32, 0x2d, 0x7f, 0x04, 0x96, 0xfe, 0x8a, 0xec,
    0xcd, 0x5d, 0xde, 0x72, 0x43, 0x1d, 0x18, 0x48, 0xf3, 0x8d, 0x80, 0xc3, 0x4e, 0x42, 0xd7, 0x3d, 0x9c,
    0xb4,
];

/// The paper's gradients: to the middles of a cube's twelve edges, four of them twice, to be
/// chosen by four bits.
const GRADIENTS: [[f64; 3]; 16] = [
    [1.0, 1.0, 0.0],
    [-1.0, 1.0, 0.0],
    [1.0, -1.0, 0.0],
    [-1.0, -1.0, 0.0],
    [1.0, 0.0, 1.0],
    [-1.0, 0.0, 1.0],
    [1.0, 0.0, -1.0],
    [-1.0, 0.0, -1.0],
    [0.0, 1.0, 1.0],
    [0.0, -1.0, 1.0],
    [0.0, 1.0, -1.0],
    [0.0, -1.0, -1.0],
    [1.0, 1.0, 0.0],
    [0.0, -1.0, 1.0],
    [-1.0, 1.0, 0.0],
    [0.0, -1.0, -1.0],
];

/// Numbers from here on are whole.
const INTEGERS: f64 = (1u64 << 52) as f64;

/// Perlin's improved noise: 0 at lattice points, within (−1.04, 1.04), with continuous first and
/// second derivatives. Numbers from 2⁵² on are integers, so that it is 0 from there on; it is
/// also 0 for what is no finite point.
#[inline(always)]
pub fn noise(point: DVec3) -> f64 {
    if !point.is_finite() {
        return 0.0;
    }
    let [x, y, z] = point.to_array().map(below);
    let inside = point - DVec3::new(x.1, y.1, z.1);
    // Each hash goes on from that of the coordinates before, which corners share.
    let sides = |hash: usize, cell: usize| [permuted(hash + cell), permuted(hash + cell + 1)];
    let hashes = sides(0, x.0).map(|h| sides(h, y.0).map(|h| sides(h, z.0)));
    let corner = |dx: usize, dy: usize, dz: usize| {
        let from = inside - DVec3::new(dx as f64, dy as f64, dz as f64);
        DVec3::from_array(GRADIENTS[hashes[dx][dy][dz] % 16]).dot(from)
    };
    let [x, y, z] = inside.to_array().map(ease);
    let edge = |dy, dz| mix(corner(0, dy, dz), corner(1, dy, dz), x);
    let face = |dz| mix(edge(0, dz), edge(1, dz), y);
    mix(face(0), face(1), z)
}

/// Noise of ever finer grain: Σ noise(2ᵏ·p) / 2ᵏ for k from 0 to `octaves` − 1.
#[inline(always)]
pub fn fractal_noise(point: DVec3, octaves: u32) -> f64 {
    let scales = std::iter::successors(Some(1.0), |scale| Some(scale * 2.0));
    scales.take(octaves as usize).map(|scale| noise(point * scale) / scale).sum()
}

/// The cell of the lattice below a coordinate, counted around 0…255, and its lower end. From 2⁶³
/// on, where integers end, the cell is just any: every number there is a lattice point.
#[inline(always)]
fn below(x: f64) -> (usize, f64) {
    let towards_zero = x as i64;
    let whole = towards_zero.saturating_sub(i64::from(towards_zero as f64 > x));
    // A number that has no place among the integers is one itself.
    let end = if x.abs() < INTEGERS { whole as f64 } else { x };
    ((whole & 255) as usize, end)
}

#[inline(always)]
fn permuted(index: usize) -> usize {
    usize::from(PERMUTATION[index % 256])
}

/// 6t⁵ − 15t⁴ + 10t³: from 0 to 1 with first and second derivative 0 at both ends, so that cells
/// meet without a crease.
#[inline(always)]
fn ease(t: f64) -> f64 {
    t * t * t * (t * (t * 6.0 - 15.0) + 10.0)
}

#[inline(always)]
fn mix(a: f64, b: f64, t: f64) -> f64 {
    a + t * (b - a)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: f64, y: f64, z: f64) -> f64 {
        noise(DVec3::new(x, y, z))
    }

    /// Points of a coarse lattice with irrational steps.
    fn samples() -> impl Iterator<Item = DVec3> {
        (0..20_000).map(|i| DVec3::new(0.618_033, 0.414_213, 0.732_051) * f64::from(i - 10_000))
    }

    #[test]
    #[expect(clippy::approx_constant, reason = "the point that everyone quotes")]
    fn a6t3_values_that_are_known() {
        assert_eq!(at(3.14, 42.0, 7.0), 0.136_919_958_784_000_12);
        assert_eq!(at(-4.20, 10.0, 6.0), 0.142_080_000_000_000_43);
    }

    #[test]
    fn a6t3_every_number_stands_in_the_table_once() {
        let mut sorted = PERMUTATION;
        sorted.sort_unstable();
        assert!(sorted.iter().enumerate().all(|(i, &n)| i == usize::from(n)));
    }

    #[test]
    fn a6t3_zero_on_the_lattice_and_bounded_between() {
        for i in -300..300 {
            let i = f64::from(i);
            assert_eq!(at(i, 3.0 - i, i * 7.0), 0.0);
        }
        let (low, high) = samples().map(noise).fold((0.0f64, 0.0f64), |(l, h), v| (l.min(v), h.max(v)));
        assert!(-1.04 < low && low < -0.7 && 0.7 < high && high < 1.04, "{low} {high}");
    }

    #[test]
    fn a6t3_repeats_after_256() {
        for p in samples().step_by(100) {
            // Both sums are exact to 2⁻⁴⁰ or so.
            let there = noise(p + DVec3::new(256.0, -512.0, 1024.0));
            assert!((noise(p) - there).abs() < 1e-9, "{p}");
        }
    }

    /// Value and slope run on across the faces of cells.
    #[test]
    fn a6t3_no_step_and_no_crease_between_cells() {
        let h = 1e-5;
        for i in 0..1000 {
            let t = f64::from(i) * 0.377;
            let along = |x: f64| noise(DVec3::new(x, 0.3 + t, 0.9 - 1.3 * t));
            let x = f64::from(i % 40 - 20);
            let (before, here, after) = (along(x - h), along(x), along(x + h));
            assert!((after - before).abs() < 4.0 * h);
            let kink = (after - here) - (here - before);
            assert!(kink.abs() < 100.0 * h * h, "{kink:e}");
        }
    }

    #[test]
    fn a6t3_octaves_halve() {
        let p = DVec3::new(0.3, 7.2, -1.9);
        assert_eq!(fractal_noise(p, 0), 0.0);
        assert_eq!(fractal_noise(p, 1), noise(p));
        let three = noise(p) + noise(p * 2.0) / 2.0 + noise(p * 4.0) / 4.0;
        assert!((fractal_noise(p, 3) - three).abs() < 1e-15);
        assert_eq!(fractal_noise(DVec3::splat(1e300), 32), 0.0, "beyond the range of numbers");
    }
}
