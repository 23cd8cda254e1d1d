//! From linear light to the 256 levels of an 8-bit file, and back.

use super::Film;
use crate::math::Vec3;

/// How light is coded in the levels of 8-bit files. Float files always hold linear light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Transfer {
    /// Level = trunc(255·c): the course's pictures, written as they are.
    #[default]
    Linear,
    /// The sRGB curve (IEC 61966-2-1), rounded to the nearest level: what screens expect.
    Srgb,
}

impl Transfer {
    /// The level of one channel. NaN gives 0; values outside [0, 1] are clamped.
    pub fn level(self, c: f32) -> u8 {
        // `as` truncates towards zero, saturates at 0 and 255, and takes NaN to 0.
        match self {
            Self::Linear => (c * 255.0) as u8,
            Self::Srgb => (srgb_from_linear(c) * 255.0 + 0.5) as u8,
        }
    }

    /// The three levels of a colour.
    pub fn levels(self, color: Vec3) -> [u8; 3] {
        color.to_array().map(|c| self.level(c))
    }

    /// A light value in [0, 1] that [`Transfer::level`] takes back to `level`.
    pub fn light(self, level: u8) -> f32 {
        self.decode(f32::from(level) / 255.0)
    }

    /// The light that a coded value in [0, 1] stands for.
    pub fn decode(self, coded: f32) -> f32 {
        match self {
            Self::Linear => coded,
            Self::Srgb => linear_from_srgb(coded),
        }
    }
}

/// The film's levels, three bytes a pixel, top row first as picture files want them.
pub fn levels_from_top(film: &Film, transfer: Transfer) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(film.size().pixels() * 3);
    for row in film.rows().rev() {
        bytes.extend(row.iter().flat_map(|&color| transfer.levels(color)));
    }
    bytes
}

/// IEC 61966-2-1, encoding. Negative light stays on the straight part of the curve.
fn srgb_from_linear(c: f32) -> f32 {
    if c > 0.003_130_8 { 1.055 * c.powf(1.0 / 2.4) - 0.055 } else { 12.92 * c }
}

/// IEC 61966-2-1, decoding.
fn linear_from_srgb(c: f32) -> f32 {
    if c > 0.040_45 { ((c + 0.055) / 1.055).powf(2.4) } else { c / 12.92 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn linear_truncates_and_clamps() {
        let level = |c| Transfer::Linear.level(c);
        assert_eq!(level(0.5), 127);
        assert_eq!(level(0.999_99), 254);
        assert_eq!(level(1.0), 255);
        assert_eq!(level(-0.0039), 0);
        for (c, expected) in [
            (f32::NAN, 0),
            (f32::INFINITY, 255),
            (f32::NEG_INFINITY, 0),
            (-3.0, 0),
            (7.0, 255),
            (f32::MAX, 255),
        ] {
            assert_eq!(level(c), expected, "{c}");
            assert_eq!(Transfer::Srgb.level(c), expected, "{c}");
        }
    }

    /// Reference values worked out with the curve's definition in double precision.
    #[test]
    fn srgb_rounds_the_standard_curve() {
        let exact = |c: f64| {
            let s = if c > 0.003_130_8 { 1.055 * c.powf(1.0 / 2.4) - 0.055 } else { 12.92 * c };
            (s * 255.0).round() as u8
        };
        for i in 0..=10_000 {
            let c = f64::from(i) / 10_000.0;
            assert_eq!(Transfer::Srgb.level(c as f32), exact(c), "{c}");
        }
        assert_eq!(Transfer::Srgb.level(0.214_041_14), 128);
    }

    #[test]
    fn every_level_survives_the_way_to_light_and_back() {
        for transfer in [Transfer::Linear, Transfer::Srgb] {
            for level in 0..=255 {
                assert_eq!(transfer.level(transfer.light(level)), level, "{transfer:?}");
            }
        }
    }
}
