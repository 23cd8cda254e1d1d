//! Which numbers are kept for a pixel.

use super::fixed;
use crate::path::Found;
use common::math::Vec3;

/// What else a picture can show than light: means over what the samples met first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, clap::ValueEnum)]
pub enum Aov {
    /// Share of light that the surface sends on
    Albedo,
    /// Unit normal, facing the eye
    Normal,
    /// Distance along the ray
    Depth,
}

impl Aov {
    /// All of them, in the order in which they are kept.
    pub const ALL: [Self; 3] = [Self::Albedo, Self::Normal, Self::Depth];

    /// The name that flags use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Albedo => "albedo",
            Self::Normal => "normal",
            Self::Depth => "depth",
        }
    }

    /// Numbers that it takes.
    fn len(self) -> usize {
        if self == Self::Depth { 1 } else { 3 }
    }
}

/// Which numbers are kept for a pixel, one after the other: the sum of radiance, the sum of its
/// first half if `halves`, the sums of the AOVs in the order of [`Aov::ALL`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Layout {
    /// Whether there is what an estimate of errors needs: the sum of radiance as it was when the
    /// number of samples was last a power of two.
    pub halves: bool,
    /// Which of [`Aov::ALL`] are kept.
    pub aovs: [bool; 3],
}

impl Layout {
    /// Where the sum of radiance stands.
    pub const RADIANCE: usize = 0;
    /// Where the sum of the first half stands, if it is kept.
    pub const HALF: usize = 3;

    /// Numbers of a pixel, at least 3.
    pub fn stride(self) -> usize {
        self.end_of(Aov::ALL.len())
    }

    /// Whether an AOV is kept.
    pub fn has(self, aov: Aov) -> bool {
        self.aovs[aov as usize]
    }

    /// Where the numbers of an AOV begin; `None` if they are not kept.
    pub fn place(self, aov: Aov) -> Option<usize> {
        self.has(aov).then(|| self.end_of(aov as usize))
    }

    /// Numbers that stand before the AOV of this number.
    fn end_of(self, number: usize) -> usize {
        let kept = Aov::ALL[..number].iter().filter(|aov| self.has(**aov));
        (if self.halves { 6 } else { 3 }) + kept.map(|aov| aov.len()).sum::<usize>()
    }

    /// Adds samples to a pixel's numbers. Returns how many of them had a number that was none and
    /// counted as 0.
    #[inline]
    pub fn add(self, sums: &mut [i128], found: &[Found]) -> u64 {
        if self.aovs != [false; 3] {
            return found.iter().map(|found| u64::from(!self.add_one(sums, found))).sum();
        }
        found.chunks(fixed::MOST).map(|found| add_radiance(sums, found)).sum()
    }

    /// Adds a sample; false if one of its numbers is none.
    #[inline]
    fn add_one(self, sums: &mut [i128], found: &Found) -> bool {
        let mut good = add_color(&mut sums[Self::RADIANCE..][..3], found.radiance);
        if let Some(place) = self.place(Aov::Albedo) {
            good &= add_color(&mut sums[place..][..3], found.albedo);
        }
        if let Some(place) = self.place(Aov::Normal) {
            good &= add_color(&mut sums[place..][..3], found.normal);
        }
        if let Some(place) = self.place(Aov::Depth) {
            let depth = fixed::from_f32(found.depth);
            sums[place] += depth.unwrap_or(0);
            good &= depth.is_some();
        }
        good
    }

    /// As a word of a file.
    pub fn bits(self) -> u32 {
        let [albedo, normal, depth] = self.aovs.map(u32::from);
        u32::from(self.halves) | albedo << 1 | normal << 2 | depth << 3
    }

    /// The layout that [`Layout::bits`] gave this word; `None` if none did.
    pub fn of_bits(bits: u32) -> Option<Self> {
        let bit = |place: u32| bits >> place & 1 == 1;
        (bits < 16).then(|| Self { halves: bit(0), aovs: [bit(1), bit(2), bit(3)] })
    }
}

/// Adds the radiance of at most [`fixed::MOST`] samples, as [`Layout::add`] does.
#[inline]
fn add_radiance(sums: &mut [i128], found: &[Found]) -> u64 {
    let (mut batch, mut bad) = (fixed::Batch::default(), 0);
    for found in found {
        if !batch.add(found.radiance.to_array()) {
            bad += u64::from(!add_color(sums, found.radiance));
        }
    }
    sums.iter_mut().zip(batch.sums()).for_each(|(sum, more)| *sum += more);
    bad
}

/// Adds all three channels, or none of them if one is no number.
#[inline]
fn add_color(sums: &mut [i128], color: Vec3) -> bool {
    if !color.is_finite() {
        return false;
    }
    sums[0] += fixed::from_finite(color.x);
    sums[1] += fixed::from_finite(color.y);
    sums[2] += fixed::from_finite(color.z);
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_stand_one_after_the_other() {
        let all = Layout { halves: true, aovs: [true; 3] };
        assert_eq!(Aov::ALL.map(|aov| all.place(aov)), [Some(6), Some(9), Some(12)]);
        assert_eq!((all.stride(), Layout::default().stride()), (13, 3));
        let some = Layout { halves: false, aovs: [false, true, true] };
        assert_eq!(Aov::ALL.map(|aov| some.place(aov)), [None, Some(3), Some(6)]);
        for bits in 0..16 {
            assert_eq!(Layout::of_bits(bits).unwrap().bits(), bits);
        }
        assert_eq!(Layout::of_bits(16), None);
    }

    #[test]
    fn a_sample_that_is_no_number_adds_nothing_to_what_it_spoils() {
        let layout = Layout { halves: false, aovs: [true, false, true] };
        let mut sums = vec![0; layout.stride()];
        let radiance = Vec3::new(1.0, f32::NAN, 1.0);
        let found = Found { radiance, albedo: Vec3::ONE, normal: Vec3::X, depth: f32::INFINITY };
        assert_eq!(layout.add(&mut sums, &[found]), 1);
        let one = fixed::from_f32(1.0).unwrap();
        assert_eq!(sums, [0, 0, 0, one, one, one, 0]);
    }
}
