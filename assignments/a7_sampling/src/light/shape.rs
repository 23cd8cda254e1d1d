//! Points of things that shine.

use super::Cone;
use crate::aperture::disc;
use common::geometry::{Geometry, Hit, SolidShape, Surface};
use common::math::{DVec3, Vec3};
use common::ray::Ray;
use common::shape::ellipsoid::Ellipsoid;
use common::shape::sphere::Sphere;
use std::f64::consts::PI;

/// A primitive of finite area.
#[derive(Clone, Debug)]
pub enum EmitterShape {
    /// A triangle by its corners.
    Triangle([DVec3; 3]),
    /// A sphere.
    Sphere(Sphere),
    /// A sphere under a general map.
    Ellipsoid(Box<Ellipsoid>),
    /// A disc: centre, and two perpendicular radii.
    Disc(DVec3, [DVec3; 2]),
}

/// A point of a primitive as another point sees it.
#[derive(Clone, Copy, Debug)]
pub struct ShapePoint {
    /// The point.
    pub surface: Surface,
    /// Unit direction from whoever looks.
    pub direction: DVec3,
    /// Density of choosing this direction, per steradian; 0 if nothing can be seen of it.
    pub pdf: f64,
}

impl EmitterShape {
    /// All primitives that have a finite area, with their numbers; planes without a rim have none.
    pub fn all(geometry: &Geometry) -> impl Iterator<Item = (u32, Self)> {
        let triangles = geometry.triangle_numbers().iter().zip(geometry.triangles());
        let triangles =
            triangles.map(|(number, corners)| (*number, Self::Triangle(corners.map(Vec3::as_dvec3))));
        let solids = geometry.solids().iter().map(|solid| {
            let shape = match &solid.shape {
                SolidShape::Sphere(sphere) => Self::Sphere(*sphere),
                SolidShape::Ellipsoid(ellipsoid) => Self::Ellipsoid(ellipsoid.clone()),
            };
            (solid.primitive, shape)
        });
        let discs = geometry.sheets().iter().filter_map(|sheet| {
            let (center, radius) = sheet.plane.disc?;
            let (a, b) = sheet.plane.normal.any_orthonormal_pair();
            Some((sheet.primitive, Self::Disc(center, [a * radius, b * radius])))
        });
        triangles.chain(solids).chain(discs)
    }

    /// Its area; of an ellipsoid, by Thomsen's formula, which is within 1.1 % and only says how
    /// often it is chosen.
    pub fn area(&self) -> f64 {
        match self {
            Self::Triangle([a, b, c]) => (*b - *a).cross(*c - *a).length() / 2.0,
            Self::Sphere(sphere) => 4.0 * PI * sphere.radius.powi(2),
            Self::Ellipsoid(e) => {
                const P: f64 = 1.6075;
                let axes = (e.to_world.linear * e.sphere.radius).to_cols_array_2d();
                let [a, b, c] = axes.map(|axis| DVec3::from_array(axis).length().powf(P));
                4.0 * PI * ((a * b + b * c + c * a) / 3.0).powf(1.0 / P)
            }
            Self::Disc(_, [a, _]) => PI * a.length_squared(),
        }
    }

    /// The point of primitive `number` for a point of the unit square, as seen from `from`.
    pub fn point(&self, geometry: &Geometry, number: u32, from: DVec3, uv: [f64; 2]) -> ShapePoint {
        let seen = |position: DVec3, weights: [f64; 2]| {
            let sight = Ray::new(position.as_vec3(), (position - from).normalize_or(DVec3::Z).as_vec3());
            let [u, v] = weights.map(|w| w as f32);
            geometry.surface(&sight, &Hit { t: 0.0, primitive: number, u, v })
        };
        match self {
            Self::Triangle([a, b, c]) => {
                let [u, v] = triangle(uv);
                by_area(seen(*a + (*b - *a) * u + (*c - *a) * v, [u, v]), from, 1.0 / self.area())
            }
            Self::Disc(center, [a, b]) => {
                let (x, y) = disc(uv);
                by_area(seen(*center + *a * x + *b * y, [0.0; 2]), from, 1.0 / self.area())
            }
            Self::Sphere(sphere) => {
                let cone = Cone::new(sphere, from);
                let (direction, distance) = cone.direction(uv);
                let surface = seen(from + direction * distance, [0.0; 2]);
                let pdf = if cone.is_outside() { 1.0 / cone.solid_angle() } else { 0.0 };
                ShapePoint { surface, direction, pdf }
            }
            Self::Ellipsoid(e) => {
                let (direction, _) =
                    Cone::new(&Sphere { center: DVec3::ZERO, radius: 1.0 }, DVec3::ZERO).direction(uv);
                let position = e.to_world.point(e.sphere.center + direction * e.sphere.radius);
                by_area(seen(position, [0.0; 2]), from, ellipsoid_density(e, position))
            }
        }
    }
}

impl EmitterShape {
    /// Density per steradian with which [`EmitterShape::point`], as seen from `from`, is this point
    /// of it; 0 where nothing is looked for.
    pub fn pdf(&self, from: DVec3, surface: &Surface) -> f64 {
        match self {
            Self::Triangle(_) | Self::Disc(..) => by_area(*surface, from, 1.0 / self.area()).pdf,
            Self::Sphere(sphere) => {
                let cone = Cone::new(sphere, from);
                if cone.is_outside() { 1.0 / cone.solid_angle() } else { 0.0 }
            }
            Self::Ellipsoid(e) => by_area(*surface, from, ellipsoid_density(e, surface.point)).pdf,
        }
    }
}

/// Density per area at a point of an ellipsoid whose sphere's points are chosen evenly: the map
/// stretches areas by |det M|·|M⁻ᵀn|.
fn ellipsoid_density(e: &Ellipsoid, point: DVec3) -> f64 {
    let direction = (e.to_world.inverse_point(point) - e.sphere.center).normalize_or_zero();
    let stretch = e.to_world.linear.determinant().abs() * e.to_world.normal(direction).length();
    1.0 / (4.0 * PI * e.sphere.radius.powi(2) * stretch)
}

/// Turns a density per area into one per solid angle.
fn by_area(surface: Surface, from: DVec3, density: f64) -> ShapePoint {
    let to_point = surface.point - from;
    let direction = to_point.normalize_or_zero();
    let cosine = surface.geometric_normal.dot(direction).abs();
    let pdf = to_point.length_squared() * density / cosine;
    ShapePoint { surface, direction, pdf: if pdf.is_finite() { pdf } else { 0.0 } }
}

/// Barycentric weights of the second and third corner, uniform over the triangle. The square is
/// folded along its diagonal, which bends neighbourhoods less than a square root does (Heitz, "A
/// low-distortion map between triangle and square", 2019).
pub fn triangle([u, v]: [f64; 2]) -> [f64; 2] {
    if v > u { [u / 2.0, v - u / 2.0] } else { [u - v / 2.0, v / 2.0] }
}
