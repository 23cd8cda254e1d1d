//! Lists of rays that wait at nodes, each with the stretch of it that lies inside.

use crate::bvh::packet::RAYS;

/// Where a list of rays waits.
#[derive(Clone, Copy)]
pub struct Task {
    /// Place of the node.
    pub node: u32,
    /// Where the list starts …
    first: usize,
    /// … and how long it is.
    len: usize,
    /// From here on nothing is in use by any list that waits.
    free: usize,
}

impl Task {
    /// Rays that wait.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Places of a list: eight entries can be put at its end before the last are.
    #[inline(always)]
    fn stride(&self) -> usize {
        self.len.next_multiple_of(RAYS)
    }
}

/// Rays with the t at which each enters and leaves a node. All three are equally long.
pub struct Places<'l> {
    /// Their numbers.
    pub rays: &'l mut [u32],
    /// Inside from here …
    pub enter: &'l mut [f32],
    /// … to here.
    pub exit: &'l mut [f32],
}

/// All lists that wait, on a stack.
pub struct Lists {
    rays: Vec<u32>,
    enter: Vec<f32>,
    exit: Vec<f32>,
    tasks: Vec<Task>,
}

impl Lists {
    /// Nobody.
    pub fn new() -> Self {
        Self { rays: Vec::new(), enter: Vec::new(), exit: Vec::new(), tasks: Vec::new() }
    }

    /// Places for all rays at the root, of which there are `len`, and nobody elsewhere.
    pub fn start(&mut self, len: usize) -> Places<'_> {
        self.tasks.clear();
        self.reserve(len.next_multiple_of(RAYS));
        Places { rays: &mut self.rays, enter: &mut self.enter, exit: &mut self.exit }
    }

    /// The first `len` of those places are in use.
    pub fn at_root(&mut self, len: usize) {
        let task = Task { node: 0, first: 0, len, free: len.next_multiple_of(RAYS) };
        self.tasks.extend((len > 0).then_some(task));
    }

    /// The next list.
    #[inline(always)]
    pub fn pop(&mut self) -> Option<Task> {
        self.tasks.pop()
    }

    /// Place of the node that the list after that waits at.
    #[inline(always)]
    pub fn next(&self) -> Option<u32> {
        self.tasks.last().map(|task| task.node)
    }

    /// Who is on a task's list.
    #[inline(always)]
    pub fn of(&self, task: &Task) -> &[u32] {
        &self.rays[task.first..][..task.len]
    }

    /// The stretch of one ray of a list.
    #[inline(always)]
    pub fn stretch(&self, task: &Task, place: usize) -> [f32; 2] {
        [self.enter[task.first + place], self.exit[task.first + place]]
    }

    /// The list, up to a whole number of eights, and places for two more.
    #[inline(always)]
    pub fn split(&mut self, task: &Task) -> [Places<'_>; 3] {
        let stride = task.stride();
        self.reserve(task.free + 2 * stride);
        let (rays, more_rays) = self.rays.split_at_mut(task.free);
        let (enter, more_enter) = self.enter.split_at_mut(task.free);
        let (exit, more_exit) = self.exit.split_at_mut(task.free);
        let (near_rays, far_rays) = more_rays[..2 * stride].split_at_mut(stride);
        let (near_enter, far_enter) = more_enter[..2 * stride].split_at_mut(stride);
        let (near_exit, far_exit) = more_exit[..2 * stride].split_at_mut(stride);
        let list = Places {
            rays: &mut rays[task.first..][..stride],
            enter: &mut enter[task.first..][..stride],
            exit: &mut exit[task.first..][..stride],
        };
        let near = Places { rays: near_rays, enter: near_enter, exit: near_exit };
        [list, near, Places { rays: far_rays, enter: far_enter, exit: far_exit }]
    }

    /// Lets so many of the first places of both wait, the near ones at node `near` first.
    #[inline(always)]
    pub fn push(&mut self, task: &Task, [near, far]: [u32; 2], [near_len, far_len]: [usize; 2]) {
        let stride = task.stride();
        let free = task.free + 2 * stride;
        if far_len > 0 {
            self.tasks.push(Task { node: far, first: task.free + stride, len: far_len, free });
        }
        if near_len > 0 {
            self.tasks.push(Task { node: near, first: task.free, len: near_len, free });
        }
    }

    fn reserve(&mut self, len: usize) {
        if self.rays.len() < len {
            self.rays.resize(2 * len, 0);
            self.enter.resize(2 * len, 0.0);
            self.exit.resize(2 * len, 0.0);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sends those of a list that `to` says to both sides; returns where they wait then.
    fn pass(lists: &mut Lists, task: &Task, nodes: [u32; 2], to: impl Fn(u32) -> [bool; 2]) {
        let len = task.len();
        let [list, mut near, mut far] = lists.split(task);
        let mut ends = [0; 2];
        for ray in &list.rays[..len] {
            for (side, places) in [&mut near, &mut far].into_iter().enumerate() {
                if to(*ray)[side] {
                    places.rays[ends[side]] = *ray;
                    ends[side] += 1;
                }
            }
        }
        lists.push(task, nodes, ends);
    }

    #[test]
    fn a6t1_lists_come_near_before_far_and_do_not_overlap() {
        let mut lists = Lists::new();
        for (ray, place) in lists.start(21).rays.iter_mut().zip(0..21).map(|(place, ray)| (ray, place)) {
            *place = ray;
        }
        lists.at_root(21);
        let root = lists.pop().unwrap();
        pass(&mut lists, &root, [1, 2], |ray| [ray % 2 == 0, ray % 3 == 0]);
        let near = lists.pop().unwrap();
        assert_eq!(near.node, 1);
        pass(&mut lists, &near, [4, 3], |ray| [ray > 100, ray > 10]);
        let all: Vec<(u32, Vec<u32>)> =
            std::iter::from_fn(|| lists.pop().map(|task| (task.node, lists.of(&task).to_vec()))).collect();
        let expected = [(3, vec![12, 14, 16, 18, 20]), (2, vec![0, 3, 6, 9, 12, 15, 18])];
        assert_eq!(all, expected, "nobody waits at node 4");
    }
}
