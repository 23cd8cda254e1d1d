//! Spheres, ellipsoids and discs: nets of parallels and meridians.

use super::{Label, Resolution, Tessellation, Vertex};
use common::geometry::SolidShape;
use common::math::{Affine, DVec3};
use common::shape::sphere::Sphere;
use std::f64::consts::{PI, TAU};

impl Tessellation {
    /// A sphere, or one under a general map, as a closed polyhedron whose corners lie on it.
    /// The axis is y, before the map for an ellipsoid. Each pole is one corner, with triangles
    /// around it.
    pub(super) fn add_solid(&mut self, shape: &SolidShape, resolution: Resolution, label: Label) {
        match shape {
            SolidShape::Sphere(sphere) => self.add_ball(sphere, &Affine::IDENTITY, resolution, label),
            SolidShape::Ellipsoid(e) => self.add_ball(&e.sphere, &e.to_world, resolution, label),
        }
    }

    fn add_ball(&mut self, sphere: &Sphere, to_world: &Affine, resolution: Resolution, label: Label) {
        let Resolution { theta, phi } = resolution;
        let first = self.vertices.len() as u32;
        let vertex = |direction: DVec3| Vertex {
            point: to_world.point(sphere.center + direction * sphere.radius),
            normal: to_world.normal(direction).normalize_or_zero(),
        };
        let poles = [vertex(DVec3::NEG_Y), vertex(DVec3::Y)];
        self.vertices.extend(poles);
        for j in 1..phi {
            let (ring, height) = (PI * f64::from(j) / f64::from(phi)).sin_cos();
            self.vertices.extend(circle(theta).map(|(x, z)| vertex(DVec3::new(ring * x, -height, ring * z))));
        }
        let at = |i: u32, j: u32| match j {
            0 => first,
            _ if j == phi => first + 1,
            _ => first + 2 + (j - 1) * theta + i % theta,
        };
        // A mirroring map turns the net inside out; walking it the other way turns it back.
        let mirrored = to_world.linear.determinant() < 0.0;
        self.add_net(theta, phi, label, |i, j| at(if mirrored { i } else { theta - i }, j));
    }

    /// A disc as a closed net of sectors around its centre.
    pub(super) fn add_disc(
        &mut self,
        normal: DVec3,
        center: DVec3,
        radius: f64,
        resolution: Resolution,
        label: Label,
    ) {
        let Resolution { theta, phi } = resolution;
        let first = self.vertices.len() as u32;
        let x = normal.any_orthonormal_vector();
        let y = normal.cross(x);
        self.vertices.push(Vertex { point: center, normal });
        for j in 1..=phi {
            let ring = radius * f64::from(j) / f64::from(phi);
            let rim = circle(theta).map(|(s, t)| Vertex { point: center + (x * s + y * t) * ring, normal });
            self.vertices.extend(rim);
        }
        let at = |i: u32, j: u32| match j {
            0 => first,
            _ => first + 1 + (j - 1) * theta + i % theta,
        };
        self.add_net(theta, phi, label, |i, j| at(theta - i, j));
    }
}

/// Cosines and sines of `steps` equal steps around.
fn circle(steps: u32) -> impl Iterator<Item = (f64, f64)> {
    (0..steps).map(move |i| {
        let (s, c) = (TAU * f64::from(i) / f64::from(steps)).sin_cos();
        (c, s)
    })
}
