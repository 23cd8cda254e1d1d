//! The scene of the experiment: a mesh among mirrors.

use crate::world::{World, scene_with};
use a1_ray_casting::Studio;
use common::camera::Camera;
use common::cli::AppError;
use common::geometry::Geometry;
use common::picture::Size;
use common::scene::CameraKind;
use std::f64::consts::TAU;
use std::fmt::Write;

/// Mirror balls around the mesh.
pub const BALLS: u32 = 50;
/// Views; each shows its middle larger than the one before by [`ZOOM`].
pub const VIEWS: i32 = 5;
const ZOOM: f64 = 1.2;
/// Field of view of the first, in degrees.
const FIELD: f64 = 45.0;

/// The studio of a mesh: mirror floor under it, mirror balls round it, two lamps.
///
/// # Errors
/// If the mesh cannot be placed.
pub fn studio(world: &World, side: u32) -> Result<Studio, AppError> {
    let scene = scene_with(&text(world), &world.mesh)?;
    let geometry = Geometry::build(&scene)?;
    let camera = Camera::new(&scene.camera);
    Ok(Studio { scene, geometry, camera, size: Size::new(i64::from(side), i64::from(side))? })
}

/// Turns the studio's camera to view number `view`, from 0.
pub fn zoom(studio: &mut Studio, view: i32) {
    let mut spec = studio.scene.camera.clone();
    let spread = (FIELD.to_radians() / 2.0).tan() / ZOOM.powi(view);
    spec.kind = CameraKind::Perspective { angle: 2.0 * spread.atan().to_degrees() };
    studio.camera = Camera::new(&spec);
}

fn text(world: &World) -> String {
    let (center, bounds) = (world.center(), world.bounds());
    let (radius, floor) = (world.diagonal() / 2.0, f64::from(bounds.min.y));
    let at = |x: f64, y: f64, z: f64| {
        format!("{} {} {}", center.x + x * radius, center.y + y * radius, center.z + z * radius)
    };
    let mut text = format!(
        "PerspectiveCamera {{ center {} direction 0 -0.22 -1 up 0 1 0 angle {FIELD} }}
         Lights {{ numLights 2
             PointLight {{ position {} color 0.7 0.7 0.7 }}
             PointLight {{ position {} color 0.4 0.4 0.4 }} }}
         Background {{ color 0.3 0.4 0.6 ambientLight 0.1 0.1 0.1 }}
         Materials {{ numMaterials 3
             PhongMaterial {{ diffuseColor 0.7 0.6 0.4 }}
             PhongMaterial {{ diffuseColor 0.1 0.1 0.1 reflectiveColor 0.8 0.8 0.8 }}
             PhongMaterial {{ diffuseColor 0.4 0.4 0.4 reflectiveColor 0.3 0.3 0.3 }} }}
         Group {{ numObjects {} MaterialIndex 0 TriangleMesh {{ obj_file it }}
         MaterialIndex 2 Plane {{ normal 0 1 0 offset {floor} }} MaterialIndex 1 ",
        at(0.0, 0.5, 2.3),
        at(-3.0, 4.0, 3.0),
        at(4.0, 3.0, 1.0),
        BALLS + 2
    );
    for i in 0..BALLS {
        // Turned by the golden angle each time, so that they stand nowhere in rows.
        let turn = TAU * 0.381_966 * f64::from(i);
        let (away, size) = (1.05 + 0.9 * f64::from(i) / f64::from(BALLS), 0.06 + 0.02 * f64::from(i % 4));
        let (x, z) = (center.x + away * turn.cos() * radius, center.z + away * turn.sin() * radius);
        let y = floor + size * radius;
        let _ = write!(text, "Sphere {{ center {x} {y} {z} radius {} }} ", size * radius);
    }
    text + "}"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everything_stands_on_the_floor_and_zooming_narrows_the_view() {
        let world = World::named("sphere1k").unwrap();
        let mut studio = studio(&world, 10).unwrap();
        assert_eq!(studio.geometry.len(), world.triangles() + BALLS as usize + 1);
        let floor = world.bounds().min.y;
        let lowest = studio.geometry.solids().iter().map(|s| s.bounds.min.y).fold(f32::INFINITY, f32::min);
        assert!((lowest - floor).abs() < 1e-4);
        let edge = |studio: &Studio| {
            let d = studio.camera.ray((1.0, 0.5)).direction;
            f64::from((d.x / (d.y * d.y + d.z * d.z).sqrt()).abs())
        };
        zoom(&mut studio, 0);
        let wide = edge(&studio);
        zoom(&mut studio, 2);
        assert!((wide / edge(&studio) - ZOOM * ZOOM).abs() < 1e-4);
    }
}
