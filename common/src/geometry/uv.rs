//! Texture coordinates: where a picture goes on a surface.
//!
//! | shape | u | v |
//! |---|---|---|
//! | sphere | ½ + atan2(x, z) / 2π | ½ + asin(y) / π |
//! | plane | along right | along up |
//! | triangle | weight of the second corner | weight of the third corner |
//! | mesh with coordinates | interpolated | interpolated |
//! | mesh without | as a sphere around the middle of its box | |
//!
//! All of it happens in the shape's own space, so that a picture moves with its shape. (x, y, z)
//! is the unit direction from the centre: the middle of the picture looks along +z, its top is
//! at +y, and from outside it is not mirrored. On a plane one picture covers a square of side
//! 1; up is the y axis, or −z if the plane is more level than steep, and right is up × normal.

use super::Geometry;
use super::Surface;
use crate::math::{Affine, DVec3, Vec2};
use crate::mesh::Mesh;
use crate::scene::Material;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// How points of a shape become texture coordinates.
#[derive(Clone, Debug)]
pub(crate) enum UvMap {
    /// By the direction from a point.
    Round {
        /// That point, in the shape's own space.
        center: DVec3,
        /// From there to the world.
        to_world: Affine,
    },
    /// By two axes.
    Flat {
        /// The axes of u and v, in the shape's own space.
        axes: [DVec3; 2],
        /// From there to the world.
        to_world: Affine,
    },
    /// By the weights of corners.
    Corners {
        /// The mesh whose coordinates are interpolated; `None` for a triangle by itself.
        mesh: Option<Arc<Mesh>>,
        /// Which corner of a triangle in the file is the first, second and third in the world.
        order: [usize; 3],
    },
}

/// A triangle that is no mesh's.
const OWN_CORNERS: [Vec2; 3] = [Vec2::ZERO, Vec2::X, Vec2::Y];

impl UvMap {
    /// A mesh by its own coordinates, or around the middle of its box.
    pub fn of_mesh(mesh: &Arc<Mesh>, to_world: &Affine, order: [usize; 3]) -> Self {
        if !mesh.uvs.is_empty() {
            return Self::Corners { mesh: Some(Arc::clone(mesh)), order };
        }
        let points = || mesh.positions.iter().map(|p| p.as_dvec3());
        let (low, high) = (points().reduce(DVec3::min), points().reduce(DVec3::max));
        let center = (low.unwrap_or_default() + high.unwrap_or_default()) / 2.0;
        Self::Round { center, to_world: *to_world }
    }

    /// A plane of this normal, of any length but zero.
    pub fn of_plane(normal: DVec3, to_world: &Affine) -> Self {
        let n = normal.normalize();
        let level = n.y.abs() > n.x.abs().max(n.z.abs());
        let upright = if level { DVec3::NEG_Z } else { DVec3::Y };
        let right = upright.cross(n).normalize();
        Self::Flat { axes: [right, n.cross(right)], to_world: *to_world }
    }

    /// `triangle` counts from the shape's first.
    fn at(&self, surface: &Surface, triangle: usize) -> [f64; 2] {
        match self {
            Self::Round { center, to_world } => round(to_world.inverse_point(surface.point) - *center),
            Self::Flat { axes, to_world } => {
                let point = to_world.inverse_point(surface.point);
                axes.map(|axis| axis.dot(point))
            }
            Self::Corners { mesh: None, order } => interpolated(OWN_CORNERS, order, surface.weights),
            Self::Corners { mesh: Some(mesh), order } => {
                let corners = mesh.triangles[triangle].map(|k| mesh.uvs[k as usize]);
                interpolated(corners, order, surface.weights)
            }
        }
    }
}

/// Longitude and latitude in [0, 1]; at the poles and at the centre itself u is ½.
fn round(from_center: DVec3) -> [f64; 2] {
    let d = from_center.normalize_or_zero();
    let longitude = if d.x == 0.0 && d.z == 0.0 { 0.0 } else { d.x.atan2(d.z) };
    [0.5 + longitude / TAU, 0.5 + d.y.clamp(-1.0, 1.0).asin() / PI]
}

fn interpolated(corners: [Vec2; 3], order: &[usize; 3], [u, v]: [f32; 2]) -> [f64; 2] {
    let (u, v) = (f64::from(u), f64::from(v));
    let [a, b, c] = order.map(|k| corners[k]);
    let blend = |a: f32, b: f32, c: f32| f64::from(a) * (1.0 - u - v) + f64::from(b) * u + f64::from(c) * v;
    [blend(a.x, b.x, c.x), blend(a.y, b.y, c.y)]
}

/// For each material whether it is a picture or blends one. Textures blend earlier materials, so
/// one pass tells.
pub(crate) fn pictured(materials: &[Material]) -> Vec<bool> {
    let mut pictured: Vec<bool> = Vec::with_capacity(materials.len());
    for material in materials {
        pictured.push(match material {
            Material::Phong(plain) => plain.image.is_some(),
            Material::Solid(solid) => solid.children.iter().any(|&child| pictured[child as usize]),
        });
    }
    pictured
}

impl Geometry {
    /// Texture coordinates (u, v) of a surface point, v upwards; see the module for what they
    /// are on each shape. Finite if the point is. (0, 0) if no picture can be on its material,
    /// since then nothing has been kept to work them out with.
    pub fn uv(&self, surface: &Surface) -> [f64; 2] {
        let (run, _) = self.locate(surface.primitive);
        let triangle = (surface.primitive - run.first) as usize;
        run.uv.as_ref().map_or([0.0; 2], |map| map.at(surface, triangle))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(a: [f64; 2], b: [f64; 2]) -> bool {
        (a[0] - b[0]).abs() < 1e-12 && (a[1] - b[1]).abs() < 1e-12
    }

    #[test]
    fn the_middle_of_a_round_picture_looks_along_z() {
        assert_eq!(round(DVec3::Z), [0.5, 0.5]);
        assert!(near(round(DVec3::X * 7.0), [0.75, 0.5]));
        assert!(near(round(DVec3::new(-1.0, 1.0, 0.0)), [0.25, 0.75]));
    }

    #[test]
    fn poles_and_centre_are_finite() {
        assert_eq!(round(DVec3::Y), [0.5, 1.0]);
        assert_eq!(round(DVec3::new(-0.0, -3.0, -0.0)), [0.5, 0.0]);
        assert_eq!(round(DVec3::ZERO), [0.5, 0.5]);
        assert!(round(DVec3::new(-1e-320, 1.0, -0.0)).iter().all(|c| (0.0..=1.0).contains(c)));
    }

    #[test]
    fn pictures_on_planes_are_upright_and_not_mirrored() {
        let axes = |normal| match UvMap::of_plane(normal, &Affine::IDENTITY) {
            UvMap::Flat { axes, .. } => axes,
            other => panic!("{other:?}"),
        };
        assert_eq!(axes(DVec3::Z * 3.0), [DVec3::X, DVec3::Y]);
        assert_eq!(axes(DVec3::Y), [DVec3::X, DVec3::NEG_Z]);
        assert_eq!(axes(DVec3::X), [DVec3::NEG_Z, DVec3::Y]);
        for normal in [DVec3::NEG_Y, DVec3::new(1.0, -2.0, 3.0), DVec3::new(0.1, 0.9, -0.8)] {
            let [u, v] = axes(normal);
            assert!((u.cross(v) - normal.normalize()).length() < 1e-15, "{normal}");
        }
    }

    #[test]
    fn a_mirrored_triangle_keeps_its_picture() {
        let corners = [Vec2::new(0.0, 0.0), Vec2::new(4.0, 0.0), Vec2::new(0.0, 8.0)];
        assert_eq!(interpolated(corners, &[0, 1, 2], [0.25, 0.5]), [1.0, 4.0]);
        assert_eq!(interpolated(corners, &[0, 2, 1], [0.5, 0.25]), [1.0, 4.0]);
    }
}
