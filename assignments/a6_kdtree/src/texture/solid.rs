//! A6T3: patterns that fill space, so that a body looks cut from a block of them.

use super::fractal_noise;
use common::math::{DMat4, DVec3};
use common::scene::{SolidTexture, SolidTextureKind};
use common::simd::{self, Simd, dispatch};

/// A coordinate this close to an integer, as a part of what it was computed from, is that
/// integer. Points of a face that lies in a lattice plane are off it by a few roundings of
/// 2⁻⁵³, some of them to either side; without this rule such a face would be speckled.
const SAME: f64 = 1.0 / (1u64 << 44) as f64;

/// A pattern p ↦ [0, 1] with its place in space.
#[derive(Clone, Debug, PartialEq)]
pub struct Pattern {
    kind: SolidTextureKind,
    /// From the world to the space in which the pattern has unit size.
    matrix: DMat4,
}

impl Pattern {
    /// The pattern of a texture; the list of its transforms is multiplied out once.
    pub fn new(texture: &SolidTexture) -> Self {
        let matrix = texture.transform.iter().fold(DMat4::IDENTITY, |m, xform| m * xform.matrix());
        Self { kind: texture.kind, matrix }
    }

    /// The share in [0, 1] that the first material has at a point of the world. A number for
    /// every point, even one that overflows on the way: ½ (or the first square) then.
    pub fn value(&self, point: DVec3) -> f64 {
        // Rounding to integers takes a function call without the instructions for it.
        dispatch!(simd::level(), s => s.vectorize(
            #[inline(always)]
            || self.worked_out(point),
        ))
    }

    #[inline(always)]
    fn worked_out(&self, point: DVec3) -> f64 {
        let p = self.matrix.transform_point3(point);
        let value = match self.kind {
            SolidTextureKind::Checkerboard => self.square(point, p),
            SolidTextureKind::Noise { octaves } => (fractal_noise(p, octaves) + 0.5).clamp(0.0, 1.0),
            SolidTextureKind::Marble { octaves, frequency, amplitude } => {
                stripes(frequency, p.x, amplitude, fractal_noise(p, octaves))
            }
            SolidTextureKind::Wood { octaves, frequency, amplitude } => {
                stripes(frequency, p.x.hypot(p.z), amplitude, fractal_noise(p, octaves))
            }
        };
        if value.is_nan() { 0.5 } else { value }
    }

    /// 1 in the cubes whose corner ⌊x⌋, ⌊y⌋, ⌊z⌋ has an even sum, else 0.
    #[inline(always)]
    fn square(&self, point: DVec3, p: DVec3) -> f64 {
        let m = &self.matrix;
        let terms =
            m.x_axis.abs() * point.x.abs() + m.y_axis.abs() * point.y.abs() + m.z_axis.abs() * point.z.abs();
        let tolerance = (terms + m.w_axis.abs()).truncate() * SAME;
        // The sum of large integers would be rounded; that of their last bits is not.
        let odd = (0..3).filter(|&i| is_odd(cell(p[i], tolerance[i]))).count();
        if odd % 2 == 0 { 1.0 } else { 0.0 }
    }
}

/// The integer below a coordinate, or next to it within the tolerance.
#[inline(always)]
fn cell(x: f64, tolerance: f64) -> f64 {
    let nearest = x.round();
    if (x - nearest).abs() <= tolerance { nearest } else { x.floor() }
}

/// Whether an integer is odd. Halving is exact; what is no number is not odd.
#[inline(always)]
fn is_odd(x: f64) -> bool {
    x / 2.0 - (x / 2.0).floor() > 0.0
}

/// A sine wave of the distance, pushed to and fro by the noise.
fn stripes(frequency: f32, distance: f64, amplitude: f32, noise: f64) -> f64 {
    let phase = f64::from(frequency) * distance + f64::from(amplitude) * noise;
    (phase.sin() + 1.0) / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use common::scene::{Position, Xform};

    fn pattern(kind: SolidTextureKind, transform: Vec<Xform>) -> Pattern {
        let position = Position { line: 1, column: 1 };
        Pattern::new(&SolidTexture { kind, transform, children: [0, 1], position })
    }

    fn board(x: f64, y: f64, z: f64) -> f64 {
        pattern(SolidTextureKind::Checkerboard, vec![]).value(DVec3::new(x, y, z))
    }

    #[test]
    fn a6t3_squares_alternate_through_zero() {
        let row: Vec<f64> = (-4..4).map(|i| board(f64::from(i) + 0.5, 0.5, 0.5)).collect();
        assert_eq!(row, [1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0]);
        assert_eq!([board(-0.5, -0.5, 0.5), board(-0.5, -0.5, -0.5), board(-0.5, 0.5, 0.5)], [1.0, 0.0, 0.0]);
        assert_eq!([board(0.0, 0.0, 0.0), board(-1.0, 0.0, 0.0), board(-1.0, -1.0, 0.0)], [1.0, 0.0, 1.0]);
    }

    #[test]
    fn a6t3_a_face_in_a_lattice_plane_is_not_speckled() {
        let above = f64::from_bits(1f64.to_bits() + 1);
        let below = f64::from_bits(1f64.to_bits() - 2);
        assert_eq!([board(0.5, above, 0.5), board(0.5, 1.0, 0.5), board(0.5, below, 0.5)], [0.0; 3]);
        assert_eq!(board(0.5, 1.0 - 1e-9, 0.5), 1.0, "but a real distance counts");
        let far = pattern(SolidTextureKind::Checkerboard, vec![Xform::Translate(DVec3::Y * 1e6)]);
        let plane = |y: f64| far.value(DVec3::new(0.5, y - 1e6, 0.5));
        assert_eq!(plane(1.0 + 1e-10), plane(1.0 - 1e-10));
    }

    #[test]
    fn a6t3_the_transform_is_applied_as_it_stands() {
        let doubled = pattern(SolidTextureKind::Checkerboard, vec![Xform::Scale(DVec3::splat(2.0))]);
        let at = |x: f64| doubled.value(DVec3::new(x, 0.1, 0.1));
        assert_eq!([at(0.25), at(0.75), at(1.25)], [1.0, 0.0, 1.0], "twice as many squares, not half");
        let order = vec![Xform::Translate(DVec3::X), Xform::Scale(DVec3::splat(2.0))];
        let moved = pattern(SolidTextureKind::Checkerboard, order);
        assert_eq!(moved.value(DVec3::new(0.25, 0.1, 0.1)), 0.0, "the last of the list comes first");
        let columns = pattern(SolidTextureKind::Checkerboard, vec![Xform::Scale(DVec3::new(1.0, 0.0, 1.0))]);
        assert_eq!(columns.value(DVec3::new(0.5, 7.5, 0.5)), 1.0, "a singular one makes columns");
    }

    #[test]
    fn a6t3_marble_runs_along_x_and_wood_around_y() {
        let (octaves, frequency, amplitude) = (4, 2.0, 0.0);
        let marble = pattern(SolidTextureKind::Marble { octaves, frequency, amplitude }, vec![]);
        let wood = pattern(SolidTextureKind::Wood { octaves, frequency, amplitude }, vec![]);
        let p = DVec3::new(3.0, 0.3, 4.0);
        assert_eq!(marble.value(p), (6f64.sin() + 1.0) / 2.0);
        assert_eq!(wood.value(p), (10f64.sin() + 1.0) / 2.0);
        assert_eq!(wood.value(p), wood.value(DVec3::new(-5.0, 9.0, 0.0)));
        let noisy = SolidTextureKind::Marble { octaves, frequency, amplitude: 1.5 };
        let phase = 6.0 + 1.5 * fractal_noise(p, octaves);
        assert_eq!(pattern(noisy, vec![]).value(p), (phase.sin() + 1.0) / 2.0);
    }

    #[test]
    fn a6t3_noise_is_around_a_half() {
        let noise = |octaves| pattern(SolidTextureKind::Noise { octaves }, vec![]);
        assert_eq!(noise(0).value(DVec3::new(0.3, 0.4, 0.5)), 0.5);
        assert_eq!(noise(3).value(DVec3::new(1.0, 2.0, 3.0)), 0.5, "on the lattice of every octave");
    }

    #[test]
    fn a6t3_there_is_a_value_at_the_end_of_the_world() {
        let (octaves, frequency, amplitude) = (32, 3e38, -3e38);
        for kind in [
            SolidTextureKind::Checkerboard,
            SolidTextureKind::Noise { octaves },
            SolidTextureKind::Marble { octaves, frequency, amplitude },
            SolidTextureKind::Wood { octaves, frequency, amplitude },
        ] {
            for c in [0.0, 1e30, -1e30, f64::MAX, f64::INFINITY, f64::NAN] {
                let huge = pattern(kind, vec![Xform::Scale(DVec3::splat(1e38)); 9]);
                for pattern in [pattern(kind, vec![]), huge] {
                    let value = pattern.value(DVec3::new(c, -c, 1.0));
                    assert!((0.0..=1.0).contains(&value), "{kind:?} {c}: {value}");
                }
            }
        }
    }
}
