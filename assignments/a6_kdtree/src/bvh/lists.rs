//! Lists of rays that wait at nodes and leaves.

use super::packet::RAYS;
use super::wide::{Child, WIDTH};

/// Where a list of rays waits.
#[derive(Clone, Copy)]
pub struct Task {
    /// What they are to look into.
    pub child: Child,
    /// Where the list starts …
    first: usize,
    /// … and how long it is.
    len: usize,
    /// From here on nothing is in use by any list that waits.
    free: usize,
}

impl Task {
    const NONE: Self = Self { child: Child::NOTHING, first: 0, len: 0, free: 0 };

    /// Rays that wait.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Places from one child's list to the next: eight numbers can be stored at the end of any list
    /// before the last are.
    #[inline(always)]
    fn stride(&self) -> usize {
        self.len.next_multiple_of(RAYS)
    }
}

/// Ends of the lists of a node's children, counted from where the first starts.
pub type Ends = [usize; WIDTH];

/// All lists that wait, on a stack.
pub struct Lists {
    /// Numbers of records, list after list.
    numbers: Vec<u32>,
    tasks: Vec<Task>,
    /// How many of the tasks count.
    waiting: usize,
}

impl Lists {
    /// Nobody.
    pub fn new() -> Self {
        Self { numbers: Vec::new(), tasks: Vec::new(), waiting: 0 }
    }

    /// These at the root, and nobody elsewhere.
    pub fn start(&mut self, rays: impl ExactSizeIterator<Item = u32>) {
        let len = rays.len();
        self.numbers.clear();
        self.numbers.extend(rays);
        self.tasks.clear();
        self.tasks.push(Task { child: Child::node(0), first: 0, len, free: len });
        self.waiting = 1;
    }

    /// The next list.
    #[inline(always)]
    pub fn pop(&mut self) -> Option<Task> {
        self.waiting = self.waiting.checked_sub(1)?;
        Some(self.tasks[self.waiting])
    }

    /// What the list after that waits at.
    #[inline(always)]
    pub fn next(&self) -> Option<Child> {
        Some(self.tasks[self.waiting.checked_sub(1)?].child)
    }

    /// Who is on a task's list.
    #[inline(always)]
    pub fn of(&self, task: &Task) -> &[u32] {
        &self.numbers[task.first..][..task.len]
    }

    /// The same, with places for the lists of a node's children, and where each starts.
    #[inline(always)]
    pub fn split(&mut self, task: &Task) -> (&[u32], &mut [u32], Ends) {
        let stride = task.stride();
        let end = task.free + WIDTH * stride;
        if self.numbers.len() < end {
            self.numbers.resize(2 * end, 0);
        }
        let (used, places) = self.numbers.split_at_mut(task.free);
        let starts = std::array::from_fn(|child| child * stride);
        (&used[task.first..][..task.len], &mut places[..WIDTH * stride], starts)
    }

    /// Lets the children's lists wait, that of the low end of the node's axis first or last.
    #[inline(always)]
    pub fn push(&mut self, task: &Task, children: &[Child; WIDTH], ends: &Ends, low_first: bool) {
        if self.tasks.len() < self.waiting + WIDTH {
            self.tasks.resize(2 * self.waiting + WIDTH, Task::NONE);
        }
        let stride = task.stride();
        let turned = if low_first { WIDTH - 1 } else { 0 };
        for i in 0..WIDTH {
            let child = i ^ turned;
            let (first, len) = (task.free + child * stride, ends[child] - child * stride);
            let free = task.free + WIDTH * stride;
            // Stays only if anybody is on it; no branch is made of that.
            self.tasks[self.waiting] = Task { child: children[child], first, len, free };
            self.waiting += usize::from(len > 0);
        }
    }
}

/// The next one to eight of a list, and how many they are; unused places repeat the first.
#[inline(always)]
pub fn eight(list: &[u32]) -> ([u32; RAYS], usize) {
    match list.first_chunk() {
        Some(records) => (*records, RAYS),
        None => {
            let mut records = [list[0]; RAYS];
            for (record, other) in records.iter_mut().zip(list) {
                *record = *other;
            }
            (records, list.len())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is popped after `pushed`: children and their lists.
    fn popped(lists: &mut Lists) -> Vec<(usize, Vec<u32>)> {
        let mut all = Vec::new();
        while let Some(task) = lists.pop() {
            all.push((task.child.index(), lists.of(&task).to_vec()));
        }
        all
    }

    #[test]
    fn a6t2_lists_of_children_come_in_order_and_do_not_overlap() {
        let children = std::array::from_fn(|child| Child::node(child + 1));
        for low_first in [false, true] {
            let mut lists = Lists::new();
            lists.start(0..19);
            let mut waiting = Vec::new();
            // Two levels: what waits at the first must survive the second.
            for _ in 0..2 {
                let task = lists.pop().unwrap();
                let (list, places, mut ends) = lists.split(&task);
                for number in list {
                    for child in [0, 3, 7] {
                        if number % (child as u32 + 1) == 0 {
                            places[ends[child]] = *number;
                            ends[child] += 1;
                        }
                    }
                }
                lists.push(&task, &children, &ends, low_first);
                let of = |child: usize| (child + 1, ends[child]);
                waiting.push(if low_first { [of(0), of(3), of(7)] } else { [of(7), of(3), of(0)] });
            }
            let every = |n: usize| (0..19).filter(|i| i % n as u32 == 0).collect::<Vec<u32>>();
            let mut expected: Vec<(usize, Vec<u32>)> = Vec::new();
            let first = if low_first { [1, 4, 8] } else { [8, 4, 1] };
            expected.extend(first.map(|n| (n, every(n.max(first[0])))));
            expected.extend(first[1..].iter().map(|n| (*n, every(*n))));
            assert_eq!(popped(&mut lists), expected, "{low_first}");
        }
    }

    #[test]
    fn a6t2_eight_of_a_list_repeat_the_first() {
        let list: Vec<u32> = (5..16).collect();
        assert_eq!(eight(&list), ([5, 6, 7, 8, 9, 10, 11, 12], 8));
        assert_eq!(eight(&list[8..]), ([13, 14, 15, 13, 13, 13, 13, 13], 3));
    }
}
