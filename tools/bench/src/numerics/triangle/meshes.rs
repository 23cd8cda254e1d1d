//! The closed meshes that rays are shot at from inside.

use crate::numerics::draw::Draw;
use crate::world::{World, plain};
use common::cli::AppError;
use common::math::{DVec3, Vec3};
use common::mesh::Mesh;
use common::ray::Ray;
use modeller::generated::gyroid;
use modeller::generated::wave::{cosine, sine};
use std::f64::consts::PI;

/// What rays are aimed at.
pub const CLASSES: [&str; 4] = ["vertices", "edges", "centroids", "anywhere"];

/// Points inside that rays start at.
const ORIGINS: usize = 64;

/// A closed mesh and places inside it.
pub struct Body {
    /// The mesh.
    pub world: World,
    inside: Vec<Vec3>,
}

/// All bodies: few lumps; the same with corners that rays can be aimed at without rounding; the
/// same far from the origin; and many walls behind each other.
///
/// # Errors
/// Never, since all have triangles.
pub fn bodies() -> Result<Vec<Body>, AppError> {
    let near = lumpy();
    let moved = |p: &Vec3| *p * 100.0 + Vec3::new(148_376.0, 1234.0, -223_423.0);
    let on_lattice = |p: &Vec3| (*p * 64.0).round() / 64.0;
    let with = |place: &dyn Fn(&Vec3) -> Vec3| Mesh {
        positions: near.positions.iter().map(place).collect(),
        ..near.clone()
    };
    Ok(vec![
        Body::new("lumpy ball", with(&|p| *p), None)?,
        Body::new("on a lattice", with(&on_lattice), Some(64.0))?,
        Body::new("far away", with(&moved), None)?,
        Body::new("gyroid", plain(gyroid(1000)), None)?,
    ])
}

/// 448 triangles: a ball cut into 15 belts of 16, radii between 0.8 and 1.2.
fn lumpy() -> Mesh {
    const AROUND: u32 = 16;
    const BELTS: u32 = 15;
    let mut draw = Draw::new(448);
    let mut positions = vec![Vec3::Z * 1.1];
    for belt in 1..BELTS {
        let height = (PI * f64::from(belt) / f64::from(BELTS)).cos();
        let flat = (1.0 - height * height).sqrt();
        for place in 0..AROUND {
            let turn = f64::from(place) / f64::from(AROUND);
            let p = DVec3::new(flat * cosine(turn), flat * sine(turn), height);
            positions.push((p * draw.between(0.8, 1.2)).as_vec3());
        }
    }
    positions.push(Vec3::NEG_Z * 0.9);
    let at = |belt: u32, place: u32| match belt {
        0 => 0,
        BELTS => 1 + AROUND * (BELTS - 1),
        _ => 1 + AROUND * (belt - 1) + place % AROUND,
    };
    let square = |belt: u32, place: u32| {
        let [a, b] = [at(belt, place), at(belt, place + 1)];
        let [c, d] = [at(belt + 1, place), at(belt + 1, place + 1)];
        [[a, c, b], [b, c, d]]
    };
    let squares = (0..BELTS).flat_map(|belt| (0..AROUND).flat_map(move |place| square(belt, place)));
    let triangles = squares.filter(|[a, b, c]| a != b && b != c && c != a).collect();
    Mesh { positions, triangles, ..Mesh::default() }
}

impl Body {
    fn new(name: &str, mesh: Mesh, lattice: Option<f64>) -> Result<Self, AppError> {
        let world = World::new(name, mesh)?;
        let mut draw = Draw::new(77);
        let (center, half) = (world.center(), world.bounds().size().as_dvec3() / 2.0);
        let mut inside = Vec::new();
        while inside.len() < ORIGINS {
            let place = center + half * draw.cube();
            let place = lattice.map_or(place, |n| (place * n).round() / n).as_vec3();
            if winding(&world, place.as_dvec3()) > 0.5 {
                inside.push(place);
            }
        }
        Ok(Self { world, inside })
    }

    /// A ray from inside, aimed as the class number says.
    pub fn ray(&self, class: usize, draw: &mut Draw) -> Ray {
        let origin = self.inside[draw.below(self.inside.len())];
        let [a, b, c] = self.world.corners(draw.below(self.world.triangles()) as u32);
        let target = match class {
            0 => a,
            // A share that a lattice can tell.
            1 => a + (b - a) * (draw.below(64) as f32 / 64.0),
            2 => (a + b + c) / 3.0,
            _ => return Ray::new(origin, draw.direction().as_vec3()),
        };
        Ray::new(origin, target - origin)
    }
}

/// How often the mesh is wound round a point: 1 inside, 0 outside (van Oosterom & Strackee 1983).
fn winding(world: &World, p: DVec3) -> f64 {
    let angle = |t: u32| {
        let [a, b, c] = world.corners(t).map(|corner| (corner.as_dvec3() - p).normalize_or_zero());
        let volume = a.dot(b.cross(c));
        2.0 * volume.atan2(1.0 + a.dot(b) + b.dot(c) + c.dot(a))
    };
    (0..world.triangles() as u32).map(angle).sum::<f64>() / (4.0 * PI)
}

#[cfg(test)]
mod tests {
    use super::*;
    use modeller::check::closed_manifold;

    #[test]
    fn bodies_are_closed_and_origins_inside() {
        for body in bodies().unwrap() {
            let mesh = modeller::mesh::Mesh {
                positions: body.world.mesh.positions.iter().map(|p| p.as_dvec3()).collect(),
                triangles: body.world.mesh.triangles.clone(),
            };
            closed_manifold(&mesh).unwrap();
            assert!(body.inside.iter().all(|p| (winding(&body.world, p.as_dvec3()) - 1.0).abs() < 1e-9));
        }
        assert_eq!(lumpy().triangles.len(), 448);
    }
}
