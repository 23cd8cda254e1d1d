//! A3T3: triangles on the screen, nearest in front.
//!
//! Each pixel's centre is compared with the three edges of a triangle (Pineda, "A Parallel
//! Algorithm for Polygon Rasterization", 1988). The edges are kept in homogeneous coordinates
//! (Olano & Greer, "Triangle Scan Conversion using 2D Homogeneous Coordinates", 1997), so that a
//! triangle that reaches behind the eye needs no clipping: the comparison is the one that the
//! ray tracer makes, and the sign of the depth says what is in front.

mod bins;
mod triangle;

use bins::Bins;
use common::counters::Counters;
use common::math::{DVec3, Vec3};
use common::picture::{Film, Size};
use common::tiles::{Tile, TileOptions, render};
use triangle::Triangle;

/// A corner of a triangle to be drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// Homogeneous position on the unit screen square, see [`common::camera::Projection`].
    pub screen: DVec3,
    /// Distance along the camera's direction.
    pub depth: f64,
    /// Linear RGB.
    pub color: Vec3,
}

/// What to draw on.
#[derive(Clone, Copy, Debug)]
pub struct Canvas<'a> {
    /// Size of the picture.
    pub size: Size,
    /// Colour where nothing is drawn.
    pub background: Vec3,
    /// Only depths above this are seen: 0 for an eye, −∞ for an orthographic camera.
    pub nearest: f64,
    /// Threads and tiles; they never change the picture.
    pub options: TileOptions<'a>,
}

/// Draws triangles with a z-buffer; both sides show. At equal depth the first one wins.
///
/// Colours are blended linearly over the triangle in space. A pixel whose centre lies on an edge
/// belongs to the triangle to the right of it, or below it if the edge is level (the usual
/// top-left rule), so that of two triangles with a common edge exactly one gets it.
pub fn rasterise(canvas: &Canvas, triangles: impl IntoIterator<Item = [Corner; 3]>) -> Film {
    let prepared: Vec<Triangle> = triangles.into_iter().filter_map(|t| Triangle::new(canvas, &t)).collect();
    let bins = Bins::new(canvas.size, &prepared);
    let rendered =
        render(canvas.size, 1, &canvas.options, Vec::new, |depths, tile, _: &mut Counters, out| {
            depths.clear();
            depths.resize(tile.area(), f64::INFINITY);
            let colors = out.layer_mut(0);
            colors.fill(canvas.background);
            let mut target = Target { tile, nearest: canvas.nearest, depths, colors };
            for (part, numbers) in bins.within(tile) {
                numbers.iter().for_each(|&n| target.draw(&prepared[n as usize], part));
            }
        });
    rendered.films.into_iter().next().expect("one layer was asked for")
}

/// A tile being drawn on.
struct Target<'a> {
    tile: Tile,
    nearest: f64,
    depths: &'a mut [f64],
    colors: &'a mut [Vec3],
}

impl Target<'_> {
    /// Draws the pixels of a triangle that lie in `part` of the tile.
    fn draw(&mut self, triangle: &Triangle, part: Tile) {
        let Some(part) = intersection(part, triangle.area) else { return };
        for y in part.y0..part.y1 {
            let row = triangle.row(y);
            let start = (y - self.tile.y0) as usize * self.tile.width() as usize;
            for x in part.x0..part.x1 {
                let Some(weights) = triangle.weights(&row, x) else { continue };
                let depth = triangle.depth(weights);
                let place = start + (x - self.tile.x0) as usize;
                if depth > self.nearest && depth < self.depths[place] {
                    self.depths[place] = depth;
                    self.colors[place] = triangle.color(weights);
                }
            }
        }
    }
}

/// What two rectangles have in common.
fn intersection(a: Tile, b: Tile) -> Option<Tile> {
    let both = Tile { x0: a.x0.max(b.x0), y0: a.y0.max(b.y0), x1: a.x1.min(b.x1), y1: a.y1.min(b.y1) };
    (both.x0 < both.x1 && both.y0 < both.y1).then_some(both)
}
