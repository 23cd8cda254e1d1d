//! Which triangles meet at which edge.

use rayon::slice::ParallelSliceMut;

/// A triangle's side: its triangle, and which corner it starts from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Side {
    /// Number of the triangle.
    pub triangle: u32,
    /// 0, 1 or 2; the side leads from this corner to the next.
    pub corner: u32,
}

/// All sides of a mesh, those between the same two vertices beside each other.
#[derive(Clone, Debug, Default)]
pub struct Edges {
    /// Lower vertex, higher vertex, whether the side leads from the higher to the lower, side.
    sides: Vec<(u32, u32, bool, Side)>,
}

/// The sides that share two vertices.
#[derive(Clone, Copy, Debug)]
pub struct Edge<'a> {
    sides: &'a [(u32, u32, bool, Side)],
}

impl Edges {
    /// The edges of some triangles. A triangle that names a vertex twice has none.
    pub fn new(triangles: &[[u32; 3]]) -> Self {
        let mut sides = Vec::with_capacity(3 * triangles.len());
        for (triangle, &[a, b, c]) in (0..).zip(triangles) {
            if a == b || b == c || c == a {
                continue;
            }
            for (corner, (from, to)) in (0..).zip([(a, b), (b, c), (c, a)]) {
                sides.push((from.min(to), from.max(to), from > to, Side { triangle, corner }));
            }
        }
        sides.par_sort_unstable();
        Self { sides }
    }

    /// All edges, in order of their vertices.
    pub fn iter(&self) -> impl Iterator<Item = Edge<'_>> {
        self.sides.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)).map(|sides| Edge { sides })
    }
}

impl Edge<'_> {
    /// Its two vertices, the lower first.
    pub fn vertices(&self) -> [u32; 2] {
        [self.sides[0].0, self.sides[0].1]
    }

    /// How many triangles meet here, at least one.
    pub fn triangles(&self) -> usize {
        self.sides.len()
    }

    /// Its sides, one for each triangle.
    pub fn sides(&self) -> impl Iterator<Item = Side> {
        self.sides.iter().map(|side| side.3)
    }

    /// Its two sides, if just two triangles meet here.
    pub fn pair(&self) -> Option<[Side; 2]> {
        match self.sides {
            [one, other] => Some([one.3, other.3]),
            _ => None,
        }
    }

    /// Whether just two triangles meet here and see it run in the same direction, which one of
    /// them therefore sees from behind.
    pub fn is_wound_badly(&self) -> bool {
        matches!(self.sides, [one, other] if one.2 == other.2)
    }
}
