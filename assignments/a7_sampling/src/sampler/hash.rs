//! Numbers that look random but follow from what they are for.
//!
//! Nothing here has a state: the number for (seed, pixel, sample, dimension) is a function of
//! these, so that neither threads nor the order of work can change a picture.

/// Every bit of the argument changes half the bits of the result; one-to-one. This is the last
/// step of SplitMix64 (Steele, Lea & Flood, "Fast splittable pseudorandom number generators",
/// 2014).
#[inline]
pub fn mix(mut x: u64) -> u64 {
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// An odd constant of no pattern: the golden ratio as a fraction of 2⁶⁴.
const STEP: u64 = 0x9e37_79b9_7f4a_7c15;

/// One number for a seed and two words.
#[inline]
pub fn hash(seed: u64, a: u64, b: u64) -> u64 {
    mix(mix(seed.wrapping_add(STEP) ^ mix(a.wrapping_mul(STEP).wrapping_add(1)))
        .wrapping_add(b.wrapping_mul(STEP)))
}

/// The upper and the lower half of a number as two points of [0, 1).
#[inline]
pub fn units(x: u64) -> [f64; 2] {
    [unit((x >> 32) as u32), unit(x as u32)]
}

/// 32 bits as a point of [0, 1).
#[inline]
pub fn unit(x: u32) -> f64 {
    f64::from(x) / 4_294_967_296.0
}

/// Where `index` goes when the numbers below `len` are shuffled; which shuffle is told by `key`.
/// One-to-one for every key. Steps that can be undone mix the numbers below the next power of
/// two, and whoever lands outside goes on until inside (Black & Rogaway, "Ciphers with arbitrary
/// finite domains", 2002).
///
/// # Panics
/// If `index` is not below `len`.
#[inline]
pub fn shuffled(index: u32, len: u32, key: u64) -> u32 {
    assert!(index < len, "{index} is not below {len}");
    if len == 1 {
        return 0;
    }
    let mask = u32::MAX >> (len - 1).leading_zeros();
    let half = (32 - mask.leading_zeros()).div_ceil(2);
    let (low, high) = (key as u32, (key >> 32) as u32);
    let mut x = index;
    loop {
        for (add, times) in
            [(low, high | 1), (high, low | 1), (low >> 16, 0x2c1b_3c6d), (high >> 16, 0x297a_2d39)]
        {
            x = x.wrapping_add(add).wrapping_mul(times) & mask;
            x ^= x >> half;
            x ^= (add >> 8) & mask;
        }
        if x < len {
            return x;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shuffle_is_one_to_one_and_favours_nobody() {
        for len in [1u32, 2, 3, 4, 5, 9, 16, 36, 100] {
            let mut places = vec![0u32; (len * len) as usize];
            let trials = 2000 * len;
            for key in 0..trials {
                let mut seen = vec![false; len as usize];
                for i in 0..len {
                    let to = shuffled(i, len, mix(u64::from(key)));
                    assert!(!std::mem::replace(&mut seen[to as usize], true), "len {len} key {key}");
                    places[(i * len + to) as usize] += 1;
                }
            }
            // Every place is met about 2000 times; the standard deviation is below 45.
            let (least, most) = (places.iter().min(), places.iter().max());
            assert!(
                len == 1 || *least.unwrap() > 1700 && *most.unwrap() < 2300,
                "len {len}: {least:?} {most:?}"
            );
        }
    }

    #[test]
    fn neighbours_have_nothing_in_common() {
        let mut ones = [0u32; 64];
        for i in 0..4096u64 {
            let change = hash(1, i, 7) ^ hash(1, i + 1, 7);
            (0..64).for_each(|bit| ones[bit] += u32::from(change >> bit & 1 == 1));
        }
        // Binomial: 2048 ± 32.
        assert!(ones.iter().all(|n| (1850..2250).contains(n)), "{ones:?}");
    }
}
