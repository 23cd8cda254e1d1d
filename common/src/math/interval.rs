//! The stretch of a ray in which a hit counts.

/// The open interval (min, max) of ray parameters t. NaN is in no interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Lower end, excluded; may be −∞ (orthographic cameras see what is behind their centre).
    pub min: f32,
    /// Upper end, excluded; may be +∞.
    pub max: f32,
}

impl Interval {
    /// Every t.
    pub const ALL: Self = Self { min: f32::NEG_INFINITY, max: f32::INFINITY };
    /// In front of the origin.
    pub const FORWARD: Self = Self { min: 0.0, max: f32::INFINITY };

    /// In front of the origin, up to but not including `max`.
    pub fn up_to(max: f32) -> Self {
        Self { min: 0.0, max }
    }

    /// Whether min < t < max; false for NaN.
    #[inline]
    pub fn contains(&self, t: f32) -> bool {
        t > self.min && t < self.max
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_and_nan_are_outside() {
        let i = Interval { min: 1.0, max: 2.0 };
        assert!(i.contains(1.5));
        for t in [1.0, 2.0, 0.0, f32::NAN, f32::INFINITY] {
            assert!(!i.contains(t), "{t}");
        }
        assert!(Interval::ALL.contains(-1e38) && !Interval::ALL.contains(f32::NAN));
    }
}
