//! What a ray that leaves a triangle can still meet.
//!
//! It starts beside its triangle's plane and goes away from it, so all of it lies above the height
//! of its start. What reaches no higher is out of the question: of a convex body that is
//! everything, and of one whose facets were rounded the few triangles around a corner that stands
//! out a little. Where so few are left they are asked at once, and the tree is not.

use common::geometry::Geometry;
use common::math::{DVec3, Vec3};
use common::ray::Ray;
use common::shape::triangle_block::{LANES, TriangleBlock};

/// Meshes of more triangles are not looked at: every plane is held against every corner.
const MOST_TRIANGLES: usize = 256;

/// What counts as nothing, relative to the coordinates; far above the rounding of heights in
/// double precision, far below the distance of starts from their surface.
const NOTHING: f64 = 1.0 / (1u64 << 36) as f64;

/// Least area of a triangle beside the square of its longest side: that of thinner ones leaves the
/// direction of their plane in doubt.
const STOUT: f64 = 1.0 / (1 << 10) as f64;

/// One side of a triangle's plane.
#[derive(Clone, Copy, Debug)]
struct Side {
    /// Unit normal to that side.
    normal: DVec3,
    /// Where the plane is along it.
    offset: f64,
    /// How high the highest corner of the mesh is above the plane, at most.
    top: f64,
    /// Number of the block with the triangles that reach above the plane, or why there is none.
    above: Above,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Above {
    None,
    Block(u32),
    Many,
}

/// The sky above each triangle of a small mesh.
pub struct Horizons {
    /// The lowest number of a triangle, and both sides of each.
    first: u32,
    sides: Vec<[Side; 2]>,
    blocks: Vec<TriangleBlock>,
    /// Largest coordinate.
    size: f64,
}

/// What is above a ray's start.
pub enum Sky<'a> {
    /// Nothing that it could meet.
    Open,
    /// Perhaps one of these.
    Few(&'a TriangleBlock),
    /// Whatever the tree says.
    Crowded,
}

impl Horizons {
    /// Those of all triangles; `None` if they are many or do not follow each other, if there is
    /// anything else in the tree, or if there is nothing to be gained.
    pub fn of(geometry: &Geometry) -> Option<Self> {
        let (numbers, triangles) = (geometry.triangle_numbers(), geometry.triangles());
        let (&first, &last) = (numbers.first()?, numbers.last()?);
        let follow = (last - first) as usize + 1 == numbers.len();
        if numbers.len() > MOST_TRIANGLES || !follow || !geometry.solids().is_empty() {
            return None;
        }
        let size = triangles.as_flattened().iter().fold(0.0, |most: f32, c| most.max(c.abs().max_element()));
        let mut all = Self { first, sides: Vec::new(), blocks: Vec::new(), size: f64::from(size) };
        for home in 0..triangles.len() {
            let sides = [1.0, -1.0].map(|sign| all.side(first, triangles, home, sign));
            all.sides.push(sides);
        }
        let helps = |side: &Side| side.above != Above::Many;
        all.sides.as_flattened().iter().any(helps).then_some(all)
    }

    /// One side of a triangle, and what reaches above it.
    fn side(&mut self, first: u32, triangles: &[[Vec3; 3]], home: usize, sign: f64) -> Side {
        let [a, b, c] = triangles[home].map(|corner| corner.as_dvec3());
        let across = (b - a).cross(c - a);
        let longest = (b - a).length_squared().max((c - b).length_squared()).max((a - c).length_squared());
        let normal = across.normalize_or_zero() * sign;
        let mut side = Side { normal, offset: normal.dot(a), top: 0.0, above: Above::Many };
        if across.length() < STOUT * longest || normal == DVec3::ZERO {
            return side;
        }
        let height = |corner: &Vec3| normal.dot(corner.as_dvec3()) - side.offset;
        let mut above = Vec::new();
        for (i, triangle) in triangles.iter().enumerate() {
            let top = triangle.iter().map(height).fold(f64::NEG_INFINITY, f64::max);
            if i != home && top > NOTHING * self.size {
                side.top = side.top.max(top);
                above.push((first + i as u32, *triangle));
            }
            if above.len() > LANES {
                return side;
            }
        }
        side.above = Above::None;
        if !above.is_empty() {
            side.above = Above::Block(self.blocks.len() as u32);
            self.blocks.push(TriangleBlock::pack(above));
        }
        side
    }

    /// What is above the start of a ray that leaves one of the triangles forward.
    #[inline(always)]
    pub fn sky(&self, ray: &Ray) -> Sky<'_> {
        let Some(sides) = self.sides.get(ray.home.wrapping_sub(self.first) as usize) else {
            return Sky::Crowded;
        };
        let (origin, direction) = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
        let rise = sides[0].normal.dot(direction);
        let side = &sides[usize::from(rise < 0.0)];
        let block = match side.above {
            Above::Many => return Sky::Crowded,
            Above::None => None,
            Above::Block(index) => Some(index),
        };
        let height = side.normal.dot(origin) - side.offset;
        let nothing = NOTHING * self.size.max(origin.abs().max_element());
        // Written so that NaN is asked about.
        let goes_away = rise.abs() > NOTHING * direction.abs().max_element() && height > 4.0 * nothing;
        match block {
            _ if !goes_away => Sky::Crowded,
            None => Sky::Open,
            Some(_) if height > side.top + 4.0 * nothing => Sky::Open,
            Some(index) => Sky::Few(&self.blocks[index as usize]),
        }
    }
}
