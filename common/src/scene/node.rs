//! Groups, transforms and shapes, as written.

use super::Position;
use crate::math::{DMat4, DVec3};

/// One node of the flat scene tree.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Index of the enclosing group or transform in [`super::Scene::nodes`], smaller than this
    /// node's own index; `None` for the outermost group only.
    pub parent: Option<u32>,
    /// What it is.
    pub kind: NodeKind,
    /// Where its keyword stands.
    pub position: Position,
}

/// What a node is.
#[derive(Clone, Debug, PartialEq)]
pub enum NodeKind {
    /// Holds other nodes.
    Group,
    /// Places its one child: the product of the list, the last entry applied first.
    Transform(Vec<Xform>),
    /// Something a ray can hit.
    Shape {
        /// Its geometry in its own space.
        shape: ShapeSpec,
        /// Index into [`super::Scene::materials`].
        material: u32,
    },
}

/// The shapes of the format.
#[derive(Clone, Debug, PartialEq)]
pub enum ShapeSpec {
    /// All points at `radius` from `center`.
    Sphere {
        /// Centre.
        center: DVec3,
        /// Radius, above zero.
        radius: f64,
    },
    /// All points P with P·normal = offset, the normal normalised first.
    Plane {
        /// Any length but zero.
        normal: DVec3,
        /// Signed distance from the origin along the unit normal.
        offset: f64,
        /// Restricts the plane to a disc (an extension).
        disc: Option<Disc>,
    },
    /// A triangle; its front side sees the vertices counter-clockwise.
    Triangle {
        /// The three corners.
        vertices: [DVec3; 3],
    },
    /// A triangle mesh read from a file.
    Mesh {
        /// Index into [`super::Scene::meshes`].
        mesh: u32,
        /// Interpolate normals over the triangles (an extension).
        smooth: bool,
    },
}

/// The part of a plane within `radius` of `center`'s projection onto it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disc {
    /// Centre, projected onto the plane.
    pub center: DVec3,
    /// Radius, above zero.
    pub radius: f64,
}

/// One entry of a transform list. Angles in degrees, right-handed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Xform {
    /// Scale along the axes.
    Scale(DVec3),
    /// Move.
    Translate(DVec3),
    /// Rotate about an axis through the origin (any length but zero) by degrees.
    Rotate(DVec3, f64),
    /// Any affine matrix, as column vectors want it (the file lists it row by row).
    Matrix(DMat4),
}

impl Xform {
    /// The 4×4 matrix that acts on column vectors.
    pub fn matrix(&self) -> DMat4 {
        match *self {
            Self::Scale(s) => DMat4::from_scale(s),
            Self::Translate(t) => DMat4::from_translation(t),
            Self::Rotate(axis, degrees) => DMat4::from_axis_angle(axis.normalize(), degrees.to_radians()),
            Self::Matrix(m) => m,
        }
    }
}
