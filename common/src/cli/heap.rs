//! What is given back to the allocator stays with the process.

use std::hint::black_box;

/// Bytes; twice as many may lie free at the end of a heap from then on.
const BLOCK: usize = 8 << 20;

/// Lets the process keep freed memory for the work that follows.
///
/// Waves of rays take some hundred KiB and give them back, many thousand times. glibc's allocator
/// returns the end of a heap to the system as soon as 128 KiB of it are free, and has every page
/// mapped and cleared anew for the next wave: a thirteenth of a gem's picture. It learns that a
/// program does that when a large block is freed that it had mapped by itself (mallopt(3), "dynamic
/// mmap threshold"): from then on it keeps twice that block's size. So one block is taken and given
/// back, none of its pages touched. Other allocators lose a microsecond.
pub fn keep_freed_memory() {
    drop(black_box(Vec::<u8>::with_capacity(BLOCK)));
}

#[cfg(all(test, target_os = "linux", target_env = "gnu"))]
mod tests {
    use super::*;

    /// Pages that the process had to be given so far, from field 10 of its status.
    fn page_faults() -> u64 {
        let stat = std::fs::read_to_string("/proc/thread-self/stat").unwrap();
        let (_, fields) = stat.rsplit_once(')').unwrap();
        fields.split_whitespace().nth(7).unwrap().parse().unwrap()
    }

    #[test]
    fn memory_that_comes_and_goes_is_mapped_once() {
        keep_freed_memory();
        // Each block alone is too small to be mapped by itself.
        const WAVES: u64 = 100;
        const BLOCKS: u64 = 5;
        const PAGES: u64 = 25;
        let block = |_| black_box(vec![1u8; (PAGES << 12) as usize]);
        let wave = || drop((0..BLOCKS).map(block).collect::<Vec<_>>());
        wave();
        let before = page_faults();
        (0..WAVES).for_each(|_| wave());
        let new = page_faults() - before;
        let all = WAVES * BLOCKS * PAGES;
        assert!(new < all / 8, "{new} of {all}");
    }
}
