//! Which triangles may be seen in which part of the picture.

use super::intersection;
use super::triangle::Triangle;
use common::picture::Size;
use common::tiles::Tile;

/// Side of a bin in pixels: that of an ordinary tile.
const SIDE: u32 = 16;

/// The picture cut into squares, each with the numbers of the triangles that may touch it, in
/// increasing order.
pub struct Bins {
    size: Size,
    columns: usize,
    lists: Vec<Vec<u32>>,
}

impl Bins {
    /// Sorts triangles into bins by the boxes around them.
    pub fn new(size: Size, triangles: &[Triangle]) -> Self {
        let columns = size.width().div_ceil(SIDE) as usize;
        let rows = size.height().div_ceil(SIDE) as usize;
        let mut bins = Self { size, columns, lists: vec![Vec::new(); columns * rows] };
        for (number, triangle) in (0..).zip(triangles) {
            for (square, list) in bins.touched_by(triangle.area) {
                // Asking costs less than listing a large thin triangle everywhere in its box.
                if triangle.may_touch(square) {
                    bins.lists[list].push(number);
                }
            }
        }
        bins
    }

    /// The squares that a rectangle touches, with the positions of their lists.
    fn touched_by(&self, area: Tile) -> impl Iterator<Item = (Tile, usize)> + use<> {
        let (size, columns) = (self.size, self.columns);
        let of = |from: u32, to: u32| from / SIDE..to.div_ceil(SIDE);
        let (across, up) = (of(area.x0, area.x1), of(area.y0, area.y1));
        up.flat_map(move |j| across.clone().map(move |i| (i, j))).map(move |(i, j)| {
            let (x0, y0) = (i * SIDE, j * SIDE);
            let (x1, y1) = ((x0 + SIDE).min(size.width()), (y0 + SIDE).min(size.height()));
            (Tile { x0, y0, x1, y1 }, j as usize * columns + i as usize)
        })
    }

    /// The parts of a tile that lie in one square each, with the triangles to draw there.
    pub fn within(&self, tile: Tile) -> impl Iterator<Item = (Tile, &[u32])> {
        self.touched_by(tile).filter_map(move |(square, list)| {
            Some((intersection(square, tile)?, self.lists[list].as_slice()))
        })
    }
}
