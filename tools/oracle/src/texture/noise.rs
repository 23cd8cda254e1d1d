//! Perlin's improved noise ("Improving Noise", SIGGRAPH 2002).
//!
//! Written as the definition reads: each of the eight lattice points around a place pulls with
//! its gradient, weighted by the product of three fifth-degree fades.

use common::math::DVec3;

/// Perlin's permutation of 0…255, the same in everybody's marble.
const PERMUTATION: &[u8; 256] = b"\
    \x97\xa0\x89\x5b\x5a\x0f\x83\x0d\xc9\x5f\x60\x35\xc2\xe9\x07\xe1\
    \x8c\x24\x67\x1e\x45\x8e\x08\x63\x25\xf0\x15\x0a\x17\xbe\x06\x94\
    \xf7\x78\xea\x4b\x00\x1a\xc5\x3e\x5e\xfc\xdb\xcb\x75\x23\x0b\x20\
    \x39\xb1\x21\x58\xed\x95\x38\x57\xae\x14\x7d\x88\xab\xa8\x44\xaf\
    \x4a\xa5\x47\x86\x8b\x30\x1b\xa6\x4d\x92\x9e\xe7\x53\x6f\xe5\x7a\
    \x3c\xd3\x85\xe6\xdc\x69\x5c\x29\x37\x2e\xf5\x28\xf4\x66\x8f\x36\
    \x41\x19\x3f\xa1\x01\xd8\x50\x49\xd1\x4c\x84\xbb\xd0\x59\x12\xa9\
    \xc8\xc4\x87\x82\x74\xbc\x9f\x56\xa4\x64\x6d\xc6\xad\xba\x03\x40\
    \x34\xd9\xe2\xfa\x7c\x7b\x05\xca\x26\x93\x76\x7e\xff\x52\x55\xd4\
    \xcf\xce\x3b\xe3\x2f\x10\x3a\x11\xb6\xbd\x1c\x2a\xdf\xb7\xaa\xd5\
    \x77\xf8\x98\x02\x2c\x9a\xa3\x46\xdd\x99\x65\x9b\xa7\x2b\xac\x09\
    \x81\x16\x27\xfd\x13\x62\x6c\x6e\x4f\x71\xe0\xe8\xb2\xb9\x70\x68\
    \xda\xf6\x61\xe4\xfb\x22\xf2\xc1\xee\xd2\x90\x0c\xbf\xb3\xa2\xf1\
    \x51\x33\x91\xeb\xf9\x0e\xef\x6b\x31\xc0\xd6\x1f\xb5\xc7\x6a\x9d\
    \xb8\x54\xcc\xb0\x73\x79\x32\x2d\x7f\x04\x96\xfe\x8a\xec\xcd\x5d\
    \xde\x72\x43\x1d\x18\x48\xf3\x8d\x80\xc3\x4e\x42\xd7\x3d\x9c\xb4";

/// The gradients by the low four bits of the hash: the middles of a cube's twelve edges, and
/// the four of them around one corner's tetrahedron a second time.
const GRADIENTS: [[i8; 3]; 16] = [
    [1, 1, 0],
    [-1, 1, 0],
    [1, -1, 0],
    [-1, -1, 0],
    [1, 0, 1],
    [-1, 0, 1],
    [1, 0, -1],
    [-1, 0, -1],
    [0, 1, 1],
    [0, -1, 1],
    [0, 1, -1],
    [0, -1, -1],
    [1, 1, 0],
    [0, -1, 1],
    [-1, 1, 0],
    [0, -1, -1],
];

/// Noise at `p`, in [−1, 1]; 0 at every point with whole coordinates.
pub(crate) fn noise(p: DVec3) -> f64 {
    let cell = p.floor();
    let inside = p - cell;
    let fades = inside.map(fade);
    let corner = |i: usize| {
        let offset = DVec3::from_array(std::array::from_fn(|axis| (i >> axis & 1) as f64));
        let weight = (DVec3::ONE - offset + (2.0 * offset - 1.0) * fades).element_product();
        weight * gradient(cell + offset).dot(inside - offset)
    };
    (0..8).map(corner).sum()
}

/// Σ noise(2ᵏp)/2ᵏ over `octaves` octaves (course rule §5).
pub(crate) fn turbulence(p: DVec3, octaves: u32) -> f64 {
    (0..octaves).map(|k| 0.5f64.powi(k as i32) * noise(2f64.powi(k as i32) * p)).sum()
}

/// 6t⁵ − 15t⁴ + 10t³: from 0 to 1, with two derivatives zero at both ends.
fn fade(t: f64) -> f64 {
    t * t * t * (t * (6.0 * t - 15.0) + 10.0)
}

/// The gradient of a lattice point.
fn gradient(point: DVec3) -> DVec3 {
    // The lattice repeats every 256 steps. The remainder is exact, however large the number.
    let step = |hash: usize, coordinate: f64| {
        usize::from(PERMUTATION[(hash + coordinate.rem_euclid(256.0) as usize) % 256])
    };
    let hash = point.to_array().into_iter().fold(0, step);
    DVec3::from_array(GRADIENTS[hash % 16].map(f64::from))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_a_permutation() {
        let mut sorted = *PERMUTATION;
        sorted.sort_unstable();
        assert!(sorted.iter().enumerate().all(|(i, &value)| i == usize::from(value)));
    }

    /// Values of Perlin's own program, printed to 17 digits; the last ones depend on the order
    /// of summation.
    #[test]
    fn published_values() {
        for (p, value) in [
            // 3.14, which is not meant to be π.
            (DVec3::new(314.0 / 100.0, 42.0, 7.0), 0.136_919_958_784_000_12),
            (DVec3::new(-4.20, 10.0, 6.0), 0.142_080_000_000_000_43),
        ] {
            assert!((noise(p) - value).abs() < 1e-15, "{p}: {}", noise(p));
        }
    }

    #[test]
    fn lattice_points_are_zero_and_the_pattern_repeats() {
        assert_eq!(noise(DVec3::new(-3.0, 17.0, 255.0)), 0.0);
        let p = DVec3::new(-0.25, 7.5, 200.625);
        assert_ne!(noise(p), 0.0);
        assert_eq!(noise(p), noise(p + DVec3::new(256.0, -512.0, 1024.0)));
    }

    /// The derivative across a face of the lattice has no step: second differences shrink with
    /// the square of their width.
    #[test]
    fn smooth_across_the_lattice() {
        let at = |x: f64| noise(DVec3::new(5.0 + x, 0.3, 0.7));
        let bend = |h: f64| at(h) - 2.0 * at(0.0) + at(-h);
        assert!(bend(1e-3).abs() < 1e-5 && at(1e-3) != at(-1e-3), "{}", bend(1e-3));
    }

    #[test]
    fn octaves_halve() {
        let p = DVec3::new(0.3, 0.6, -0.9);
        assert_eq!(turbulence(p, 0), 0.0);
        assert_eq!(turbulence(p, 1), noise(p));
        let three = noise(p) + noise(2.0 * p) / 2.0 + noise(4.0 * p) / 4.0;
        assert!((turbulence(p, 3) - three).abs() < 1e-16);
    }
}
