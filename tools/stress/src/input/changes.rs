//! Cases by number: prefixes, edits, swaps.

use super::family::{Family, Numbers, Sample};
use crate::kit::Draw;
use crate::{Stress, Tier};

/// All cases of a family.
pub struct Cases {
    samples: Vec<Sample>,
    /// For each sample the number of its first prefix, and how many there are.
    prefixes: Vec<(usize, usize)>,
    numbers: Numbers,
    stress: Stress,
}

/// An input to be read.
pub struct Case {
    /// The sample's name.
    pub name: String,
    /// What was done to it.
    pub change: String,
    /// What is left.
    pub bytes: Vec<u8>,
}

/// Bytes from which on a sample is rather not chosen.
const LARGE: usize = 50_000;

/// Words that promise much, or nothing, in either byte order.
const EXTREMES: [u32; 8] = [0, 1, 0x7f, 30_000, 65_535, 1 << 24, i32::MAX as u32, u32::MAX];

impl Cases {
    /// The cases of a family; swaps and edits by the seed.
    pub fn new(family: &Family, tier: Tier, seed: u64) -> Self {
        let samples = (family.samples)();
        let numbers = (family.numbers)(tier.is_thorough());
        let more = if tier == Tier::Long { 10 } else { 1 };
        let numbers = Numbers { edits: more * numbers.edits, swaps: more * numbers.swaps, ..numbers };
        let mut first = 0;
        let prefixes = samples.iter().map(|sample| {
            let count = (sample.bytes.len() + 1).min(numbers.prefixes);
            first += count;
            (first - count, count)
        });
        let prefixes = prefixes.collect();
        Self { samples, prefixes, numbers, stress: Stress::new(18, "", tier, seed) }
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.prefix_count() + self.numbers.edits + self.numbers.swaps
    }

    fn prefix_count(&self) -> usize {
        self.prefixes.last().map_or(0, |(first, count)| first + count)
    }

    /// One of them.
    pub fn case(&self, number: usize) -> Case {
        if number < self.prefix_count() {
            return self.prefix(number);
        }
        let mut draw = self.stress.draw(1800 + number as u64);
        let mut sample = &self.samples[draw.below(self.samples.len())];
        if sample.bytes.len() > LARGE && draw.chance(0.95) {
            // They hold no words that small ones do not hold.
            sample = &self.samples[draw.below(self.samples.len())];
        }
        let mut bytes = sample.bytes.clone();
        let change = if number < self.prefix_count() + self.numbers.edits {
            edit(&mut bytes, &mut draw)
        } else {
            swap(&mut bytes, &mut draw)
        };
        Case { name: sample.name.clone(), change, bytes }
    }

    fn prefix(&self, number: usize) -> Case {
        let at = self.prefixes.partition_point(|(first, _)| *first <= number) - 1;
        let (sample, (first, count)) = (&self.samples[at], self.prefixes[at]);
        let end = prefix_length(number - first, count, sample.bytes.len());
        let bytes = sample.bytes[..end].to_vec();
        Case { name: sample.name.clone(), change: format!("cut at byte {end}"), bytes }
    }
}

/// The length of prefix `i` of `count`: all lengths if there are so many, else half of them from
/// the beginning on and the others evenly up to the whole.
fn prefix_length(i: usize, count: usize, whole: usize) -> usize {
    let near = count / 2;
    if count > whole || i < near {
        return i;
    }
    let step = (whole - near) as f64 / (count - 1 - near).max(1) as f64;
    near + ((i - near) as f64 * step).round() as usize
}

/// Changes, removes or adds one byte; or several at once, as an extreme number.
fn edit(bytes: &mut Vec<u8>, draw: &mut Draw) -> String {
    if bytes.is_empty() {
        return "nothing to edit".to_owned();
    }
    // Headers are where promises are made.
    let reach = if draw.chance(0.5) { bytes.len() } else { bytes.len().min(120) };
    let at = draw.below(reach);
    match draw.below(4) {
        0 => bytes[at] = draw.bits() as u8,
        1 => drop(bytes.remove(at)),
        2 => bytes.insert(at, draw.pick(b"{}#0-.eE9/ \n\x00\xff")),
        _ => {
            let word = draw.pick(&EXTREMES);
            let word = if draw.chance(0.5) { word.to_le_bytes() } else { word.to_be_bytes() };
            bytes.iter_mut().skip(at).zip(word).for_each(|(byte, new)| *byte = new);
        }
    }
    format!("edited at byte {at}")
}

/// Swaps, doubles or removes words (what stands between white space, or the white space).
fn swap(bytes: &mut Vec<u8>, draw: &mut Draw) -> String {
    let mut words: Vec<Vec<u8>> =
        bytes.split_inclusive(u8::is_ascii_whitespace).map(<[u8]>::to_vec).collect();
    if words.is_empty() {
        return "no words to swap".to_owned();
    }
    let (a, b) = (draw.below(words.len()), draw.below(words.len()));
    let change = match draw.below(5) {
        0..=2 => {
            words.swap(a, b);
            format!("swapped words {a} and {b}")
        }
        3 => {
            words.insert(a, words[b].clone());
            format!("word {b} again before word {a}")
        }
        _ => {
            words.remove(a);
            format!("without word {a}")
        }
    };
    *bytes = words.concat();
    change
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prefixes_are_all_there_or_spread_out() {
        let lengths = |count: usize, whole: usize| -> Vec<usize> {
            (0..count).map(|i| prefix_length(i, count, whole)).collect()
        };
        assert_eq!(lengths(5, 4), [0, 1, 2, 3, 4]);
        assert_eq!(lengths(6, 1000), [0, 1, 2, 3, 502, 1000]);
    }

    #[test]
    fn cases_come_again_by_their_number() {
        let samples = || vec![Sample { name: "a".to_owned(), bytes: b"one two three".to_vec() }];
        let numbers = |_| Numbers { prefixes: 99, edits: 50, swaps: 50 };
        let family = Family { name: "words", samples, read: |_, _| Ok(()), numbers };
        let [cases, same, other] = [0, 0, 1].map(|seed| Cases::new(&family, Tier::Quick, seed));
        assert_eq!(cases.len(), 14 + 100);
        let all = |cases: &Cases| -> Vec<Vec<u8>> { (0..cases.len()).map(|i| cases.case(i).bytes).collect() };
        assert_eq!(all(&cases), all(&same));
        assert_ne!(all(&cases), all(&other));
        assert_eq!(cases.case(13).bytes, b"one two three");
        assert!((14..114).filter(|&i| cases.case(i).bytes != b"one two three").count() > 60);
    }
}
