//! The Pareto front of price and quality.

use super::Better;

/// Which points nothing beats: no other costs as little and is as good, and better in one of
/// them. Less of the first number is better, of the second what `quality` says. A point with a NaN
/// beats nothing and is never on the front; if neither way is better, none is.
pub fn front(points: &[(f64, f64)], quality: Better) -> Vec<bool> {
    let sign = match quality {
        Better::Less => 1.0,
        Better::More => -1.0,
        Better::Neither => return vec![false; points.len()],
    };
    let beats = |a: &(f64, f64), b: &(f64, f64)| {
        let (dearer, worse) = (a.0 - b.0, sign * (a.1 - b.1));
        dearer <= 0.0 && worse <= 0.0 && (dearer < 0.0 || worse < 0.0)
    };
    let whole = |p: &(f64, f64)| !p.0.is_nan() && !p.1.is_nan();
    points.iter().map(|p| whole(p) && !points.iter().any(|other| beats(other, p))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_front_is_what_nothing_whole_beats() {
        let points = [(1.0, 3.0), (2.0, 2.0), (2.5, 2.0), (0.5, f64::NAN), (9.0, 1.0), (9.0, 1.0)];
        assert_eq!(front(&points, Better::Less), [true, true, false, false, true, true]);
        assert_eq!(front(&points, Better::More), [true, false, false, false, false, false]);
        assert_eq!(front(&points, Better::Neither), [false; 6]);
    }
}
