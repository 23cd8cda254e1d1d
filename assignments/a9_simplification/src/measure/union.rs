//! Sets that are joined, and asked who belongs together.

/// Numbers from 0 on, each at first a set of its own (Tarjan, "Efficiency of a Good But Not
/// Linear Set Union Algorithm", 1975; paths are halved on the way).
#[derive(Clone, Debug)]
pub struct Union {
    parent: Vec<u32>,
}

impl Union {
    /// `count` sets of one number each.
    pub fn new(count: usize) -> Self {
        Self { parent: (0..count as u32).collect() }
    }

    /// The number that stands for a number's set.
    pub fn root(&mut self, mut n: u32) -> u32 {
        while self.parent[n as usize] != n {
            let above = self.parent[self.parent[n as usize] as usize];
            self.parent[n as usize] = above;
            n = above;
        }
        n
    }

    /// Makes one set of two; the lower root stands for it.
    pub fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.parent[a.max(b) as usize] = a.min(b);
    }

    /// Whether a number stands for its set.
    pub fn is_root(&self, n: u32) -> bool {
        self.parent[n as usize] == n
    }
}
