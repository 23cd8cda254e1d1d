//! The rules that say where to cut, and how far.

/// Most planes between the root and a leaf.
pub const MAX_DEPTH: u32 = 60;

/// Where a node is cut.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Rule {
    /// As one writes the first: across x, y and z in turn, at the median of the centers; whole boxes go to both sides, leaves hold lists
    Textbook,
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
    pub const ALL: [Self; 4] = [Self::Textbook, Self::Median, Self::Objects, Self::Sah];

    /// Whether only that part of a primitive counts that lies in the node: it may belong to one side
    /// where its whole box reaches into both, and large leaves have boxes around such parts.
    pub fn clips(self) -> bool {
        self != Self::Textbook
    }
}

/// How to build.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// Where nodes are cut.
    pub rule: Rule,
    /// Most planes between root and leaf, at most [`MAX_DEPTH`]. Else all but the heuristic end at
    /// 8 + 1.3 log₂ n, and that where it pays no more.
    pub max_depth: Option<u32>,
    /// Nodes with no more primitives than this are not cut. Else two blocks' worth (the
    /// least that has boxes around it where leaves have them), and the heuristic decides for itself.
    pub leaf: Option<u32>,
}
