//! The rules that say where to cut, and how far.

/// Most planes between the root and a leaf.
pub const MAX_DEPTH: u32 = 60;

/// Where a node is cut.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Rule {
    /// In the middle of its longest side
    Median,
    /// So that both sides hold the same number of primitives, across its longest side
    Objects,
    /// Where the surface area heuristic expects rays to cost least
    #[default]
    Sah,
}

impl Rule {
    /// All rules, for those who compare them.
    pub const ALL: [Self; 3] = [Self::Median, Self::Objects, Self::Sah];
}

/// How to build.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// Where nodes are cut.
    pub rule: Rule,
    /// Most planes between root and leaf, at most [`MAX_DEPTH`]. Else the median rules end at
    /// 8 + 1.3 log₂ n and the heuristic where it pays no more.
    pub max_depth: Option<u32>,
    /// Nodes with no more primitives than this are not cut. Else two blocks' worth for the
    /// median rules (about what the heuristic arrives at), and the heuristic decides for itself.
    pub leaf: Option<u32>,
}
