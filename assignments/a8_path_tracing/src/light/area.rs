//! Surfaces that shine.

use a7_sampling::light::{EmitterShape, triangle};
use common::geometry::{Geometry, Hit, Surface};
use common::math::{Bounds, DVec3, Vec3};
use common::ray::Ray;

/// A shining surface; it shines from its front.
#[derive(Clone, Debug)]
pub struct AreaLight {
    /// Its primitive, or the first of two.
    pub primitive: u32,
    /// What it looks like.
    pub shape: AreaShape,
}

/// The forms of shining surfaces.
#[derive(Clone, Debug)]
pub enum AreaShape {
    /// Two triangles `(a, b, c)` and `(a, c, d)`, corners of a parallelogram, in this order.
    Parallelogram(Flat),
    /// One triangle.
    Triangle(Flat),
    /// Spheres, discs, ellipsoids.
    Round(EmitterShape),
}

/// A corner, the two edges that leave it, unit normal and area of what they span.
#[derive(Clone, Debug)]
pub struct Flat {
    corner: DVec3,
    edges: [DVec3; 2],
    normal: DVec3,
    area: f64,
}

/// A point of a light as another point sees it.
#[derive(Clone, Copy, Debug)]
pub struct Seen {
    /// The point.
    pub surface: Surface,
    /// Unit direction towards it.
    pub direction: DVec3,
    /// Density of choosing this direction, per steradian.
    pub pdf: f64,
}

impl Flat {
    fn new(corner: DVec3, edges: [DVec3; 2], share: f64) -> Option<Self> {
        let across = edges[0].cross(edges[1]);
        let area = across.length() * share;
        (area > 0.0).then(|| Self { corner, edges, normal: across.normalize(), area })
    }

    /// Density per steradian of a direction towards it if its points are chosen evenly; none from
    /// behind.
    #[inline]
    fn pdf(&self, direction: DVec3, distance_squared: f64) -> f64 {
        let cosine = -self.normal.dot(direction);
        if cosine > 0.0 { distance_squared / (self.area * cosine) } else { 0.0 }
    }
}

impl AreaLight {
    /// All shining surfaces among the primitives that `shines` says yes to. Two triangles, one
    /// after the other, that make up a parallelogram are one light.
    pub fn all(geometry: &Geometry, shines: impl Fn(u32) -> bool) -> Vec<Self> {
        let mut lights: Vec<Self> = Vec::new();
        let mut last: Option<(u32, [Vec3; 3])> = None;
        for (&primitive, corners) in geometry.triangle_numbers().iter().zip(geometry.triangles()) {
            if !shines(primitive) {
                continue;
            }
            let before = last.replace((primitive, *corners));
            let joins = before.filter(|(number, _)| {
                number + 1 == primitive && geometry.material(*number) == geometry.material(primitive)
            });
            if let Some(shape) = joins.and_then(|(_, first)| parallelogram(&first, corners)) {
                lights.pop();
                lights.push(Self { primitive: primitive - 1, shape });
                last = None;
                continue;
            }
            let [a, b, c] = corners.map(|corner| corner.as_dvec3());
            if let Some(flat) = Flat::new(a, [b - a, c - a], 0.5) {
                lights.push(Self { primitive, shape: AreaShape::Triangle(flat) });
            }
        }
        let round = EmitterShape::all(geometry)
            .filter(|(number, shape)| !matches!(shape, EmitterShape::Triangle(_)) && shines(*number));
        lights.extend(round.map(|(primitive, shape)| Self { primitive, shape: AreaShape::Round(shape) }));
        lights
    }

    /// Its area.
    pub fn area(&self) -> f64 {
        match &self.shape {
            AreaShape::Parallelogram(flat) | AreaShape::Triangle(flat) => flat.area,
            AreaShape::Round(shape) => shape.area(),
        }
    }

    /// How many primitives it is made of.
    pub fn primitives(&self) -> u32 {
        if let AreaShape::Parallelogram(_) = self.shape { 2 } else { 1 }
    }

    /// The one direction that its front looks to, if it is flat.
    pub fn facing(&self) -> Option<DVec3> {
        match &self.shape {
            AreaShape::Parallelogram(flat) | AreaShape::Triangle(flat) => Some(flat.normal),
            AreaShape::Round(_) => None,
        }
    }

    /// A box around it.
    pub fn bounds(&self) -> Bounds {
        let around = |center: DVec3, reach: DVec3| [center - reach, center + reach];
        let points = match &self.shape {
            AreaShape::Parallelogram(Flat { corner, edges: [a, b], .. }) => {
                vec![*corner, corner + a, corner + b, corner + a + b]
            }
            AreaShape::Triangle(Flat { corner, edges: [a, b], .. }) => {
                vec![*corner, corner + a, corner + b]
            }
            AreaShape::Round(EmitterShape::Sphere(s)) => around(s.center, DVec3::splat(s.radius)).to_vec(),
            AreaShape::Round(EmitterShape::Ellipsoid(e)) => around(e.center(), e.half_extent()).to_vec(),
            AreaShape::Round(EmitterShape::Disc(center, [a, b])) => {
                around(*center, (a * a + b * b).map(f64::sqrt)).to_vec()
            }
            AreaShape::Round(EmitterShape::Triangle(corners)) => corners.to_vec(),
        };
        let low = points.iter().copied().reduce(DVec3::min).unwrap_or_default();
        let high = points.iter().copied().reduce(DVec3::max).unwrap_or_default();
        Bounds { min: low.as_vec3(), max: high.as_vec3() }
    }

    /// The point for a point of the unit square, as seen from `from`; `None` if its back is seen.
    pub fn sample(&self, geometry: &Geometry, from: DVec3, uv: [f64; 2]) -> Option<Seen> {
        if let AreaShape::Round(shape) = &self.shape {
            let point = shape.point(geometry, self.primitive, from, uv);
            let front = point.surface.geometric_normal.dot(point.direction) < 0.0;
            return (front && point.pdf > 0.0).then_some(Seen {
                surface: point.surface,
                direction: point.direction,
                pdf: point.pdf,
            });
        }
        let (flat, primitive, weights) = self.spot(uv)?;
        let to_point = flat.corner + flat.edges[0] * weights[0] + flat.edges[1] * weights[1] - from;
        let squared = to_point.length_squared();
        let direction = to_point / squared.sqrt();
        let pdf = flat.pdf(direction, squared);
        if pdf.is_nan() || pdf <= 0.0 {
            return None;
        }
        let surface = self.surface(geometry, primitive, weights);
        Some(Seen { surface, direction, pdf })
    }

    /// A point of a flat light for a point of the unit square, evenly over its area; `None` for
    /// others.
    pub fn flat_point(&self, geometry: &Geometry, uv: [f64; 2]) -> Option<Surface> {
        let (_, primitive, weights) = self.spot(uv)?;
        Some(self.surface(geometry, primitive, weights))
    }

    /// Of a flat light: the shape, the primitive, and how far along both edges of the shape a point
    /// of the unit square falls.
    #[inline]
    fn spot(&self, uv: [f64; 2]) -> Option<(&Flat, u32, [f64; 2])> {
        match &self.shape {
            AreaShape::Round(_) => None,
            AreaShape::Triangle(flat) => Some((flat, self.primitive, triangle(uv))),
            AreaShape::Parallelogram(flat) => Some((flat, self.primitive + u32::from(uv[0] < uv[1]), uv)),
        }
    }

    /// The surface there.
    #[inline]
    fn surface(&self, geometry: &Geometry, primitive: u32, [s, t]: [f64; 2]) -> Surface {
        // The first triangle of a parallelogram has its corners at (0, 0), (1, 0), (1, 1), the
        // second at (0, 0), (1, 1), (0, 1).
        let [u, v] = match &self.shape {
            AreaShape::Parallelogram(_) if primitive == self.primitive => [s - t, t],
            AreaShape::Parallelogram(_) => [s, t - s],
            _ => [s, t],
        };
        let hit = Hit { t: 0.0, primitive, u: u as f32, v: v as f32 };
        // From which side it is looked at matters to smooth normals only.
        geometry.surface(&Ray::new(Vec3::ZERO, Vec3::Z), &hit)
    }

    /// Density per steradian of [`AreaLight::sample`] from `from` in the unit direction of a point
    /// of it that is so far away; 0 where it is not looked for.
    pub fn pdf(&self, from: DVec3, direction: DVec3, distance: f64, surface: &Surface) -> f64 {
        match &self.shape {
            AreaShape::Parallelogram(flat) | AreaShape::Triangle(flat) => {
                flat.pdf(direction, distance * distance)
            }
            AreaShape::Round(shape) => shape.pdf(from, surface),
        }
    }
}

/// The parallelogram that two triangles (a, b, c) and (a, c, d) make up exactly, up to the
/// rounding of their corners.
fn parallelogram(first: &[Vec3; 3], second: &[Vec3; 3]) -> Option<AreaShape> {
    let ([a, b, c], [e, f, d]) = (first.map(|p| p.as_dvec3()), second.map(|p| p.as_dvec3()));
    let scale = a.abs().max(b.abs()).max(c.abs()).max_element();
    let closes = (a + c - b - d).abs().max_element() <= scale * 2f64.powi(-22);
    let flat = (a == e && c == f && closes).then(|| Flat::new(a, [b - a, d - a], 1.0))??;
    Some(AreaShape::Parallelogram(flat))
}
