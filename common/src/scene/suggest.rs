//! "did you mean …?": the nearest of a few known names.

use strsim::damerau_levenshtein;

/// No suggestion for longer words: they are not typing mistakes, and the distance is quadratic.
const LONGEST: usize = 64;

/// The candidate that `word` was probably meant to be: the same up to upper and lower case, or
/// at most one typing mistake per three characters away. `None` if nothing is that near.
pub(super) fn nearest<'c>(word: &str, candidates: impl IntoIterator<Item = &'c str>) -> Option<&'c str> {
    if word.len() > LONGEST {
        return None;
    }
    let lower = word.to_lowercase();
    candidates
        .into_iter()
        .filter(|candidate| *candidate != word)
        .map(|candidate| (damerau_levenshtein(&lower, &candidate.to_lowercase()), candidate))
        .filter(|(distance, candidate)| *distance <= tolerated(candidate))
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, candidate)| candidate)
}

fn tolerated(candidate: &str) -> usize {
    (candidate.chars().count() / 3).max(1)
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn finds_case_slips_and_typing_mistakes_but_no_strangers() {
        let names = ["numObjects", "MaterialIndex", "Sphere", "up"];
        assert_eq!(nearest("numobjects", names), Some("numObjects"));
        assert_eq!(nearest("Shpere", names), Some("Sphere"));
        assert_eq!(nearest("MaterialIdx", names), Some("MaterialIndex"));
        assert_eq!(nearest("Teapot", names), None);
        assert_eq!(nearest("Sphere", names), None);
        assert_eq!(nearest(&"x".repeat(1 << 20), names), None);
    }
}
