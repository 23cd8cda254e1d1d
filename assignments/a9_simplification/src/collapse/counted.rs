//! Sorting by counting: how many there are of each kind, where those of each begin, and after each has been put where the next
//! of its kind goes, where they began.

/// Counts become beginnings; tells how many there are in all.
pub(super) fn begin(counts: &mut [u32]) -> u32 {
    let mut before = 0;
    for count in counts {
        (*count, before) = (before, before + *count);
    }
    before
}

/// Beginnings that have been moved to where those of the next kind begin are what they were; behind the last kind there is one
/// without any.
pub(super) fn begin_again(moved: &mut [u32]) {
    moved.rotate_right(1);
    moved[0] = 0;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn where_each_kind_begins_is_known_before_and_after() {
        let mut first = [2, 0, 3, 0];
        assert_eq!((begin(&mut first), first), (5, [0, 2, 2, 5]));
        for kind in [2, 0, 2, 2, 0] {
            first[kind] += 1;
        }
        begin_again(&mut first);
        assert_eq!(first, [0, 2, 2, 5]);
    }
}
