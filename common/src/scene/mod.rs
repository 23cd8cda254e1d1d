//! What a scene file says, as plain data with source positions.
//!
//! A [`Scene`] is the result of reading, and nothing has been worked out in it yet: transforms
//! are still lists, a mesh is still in its own space. Lengths and directions are kept in `f64`
//! as written, so that the double-precision oracle and the single-precision core start from the
//! same numbers; colours are linear RGB in `f32`.
//!
//! The tree of groups and transforms is stored flat, in file order (a parent stands before its
//! children), so that a scene nested 100,000 deep costs memory and not call stack.

mod camera;
mod diagnostic;
mod excerpt;
mod lexer;
mod light;
mod line_counter;
mod load;
mod material;
mod node;
mod parse;
mod suggest;

pub use camera::{CameraKind, CameraSpec, Lens, Screen};
pub use diagnostic::SceneError;
pub use light::{LightKind, LightSpec};
pub use load::{MeshSource, load, load_sharing, parse_str};
pub use material::{ImageTexture, Material, PhongMaterial, SolidTexture, SolidTextureKind};
pub use node::{Disc, Node, NodeKind, ShapeSpec, Xform};

use crate::math::Vec3;
use crate::mesh::Mesh;
use std::path::PathBuf;
use std::sync::Arc;

/// Where something stands in the scene file; both count from 1, columns in characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Position {
    /// Line, from 1.
    pub line: u32,
    /// Column in characters, from 1.
    pub column: u32,
}

/// Colour of rays that hit nothing, and the light that comes from everywhere.
#[derive(Clone, Debug, PartialEq)]
pub struct Background {
    /// Linear RGB of a miss; the format's default is 0.5 grey.
    pub color: Vec3,
    /// Ambient light, multiplied with the diffuse colour. Black by default, but white when
    /// the file has no light at all, so that the scenes of assignment 1 show flat colour.
    pub ambient_light: Vec3,
    /// Latitude–longitude picture used as environment light, if any (an extension).
    pub environment: Option<PathBuf>,
}

/// Everything one scene file says.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The file's one camera.
    pub camera: CameraSpec,
    /// Background and ambient light, with defaults filled in.
    pub background: Background,
    /// Lights in file order.
    pub lights: Vec<LightSpec>,
    /// Materials in file order; shapes refer to them by index.
    pub materials: Vec<Material>,
    /// The tree of groups, transforms and shapes, flat, parents before children.
    pub nodes: Vec<Node>,
    /// The meshes named by the file; a mesh file named k times is read and stored once.
    pub meshes: Vec<Arc<Mesh>>,
}
