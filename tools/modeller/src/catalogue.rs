//! The list of meshes: names, models and what each must measure.

use crate::mesh::{Bounds, Mesh};
use crate::{check, cube, gem, logo, obj, rabbit, vase};
use glam::dvec3;

/// A mesh as it goes to disk.
pub struct Model {
    /// File name in `scenes/meshes`.
    pub name: &'static str,
    /// One line about it, written at the top of the file.
    pub comment: &'static str,
    /// The mesh, its coordinates rounded as they stand in the file.
    pub mesh: Mesh,
    /// Number of triangles that the course's scenes expect.
    pub triangles: usize,
    /// The box that the scenes' cameras are made for.
    pub bounds: Bounds,
    /// How many pieces it has, and how many handles they have together.
    pub topology: (usize, usize),
}

/// Decimals that the files keep: a hundred-thousandth of a scene unit is under a hundredth of the
/// finest mesh's edges.
const DECIMALS: usize = 5;

impl Model {
    fn new(name: &'static str, comment: &'static str, mesh: Mesh, triangles: usize, bounds: Bounds) -> Self {
        Model { name, comment, mesh: obj::rounded(&mesh, DECIMALS), triangles, bounds, topology: (1, 0) }
    }

    /// The file's content.
    pub fn text(&self) -> String {
        obj::to_text(&self.mesh, self.comment, DECIMALS)
    }

    /// Checks everything that is promised of the mesh; the error says what is wrong.
    pub fn check(&self) -> Result<(), String> {
        let fault = |what: String| Err(format!("{}: {what}", self.name));
        let found = self.mesh.triangles.len();
        if found != self.triangles {
            return fault(format!("{found} triangles instead of {}", self.triangles));
        }
        check::closed_manifold(&self.mesh).or_else(fault)?;
        let (euler, volume, flattest) =
            (check::euler_characteristic(&self.mesh), check::volume(&self.mesh), check::flattest(&self.mesh));
        let (pieces, handles) = self.topology;
        let found = check::pieces(&self.mesh);
        if found != pieces || euler != 2 * (pieces as i64 - handles as i64) {
            return fault(format!(
                "{found} pieces of Euler characteristic {euler}, not {pieces} with {handles} handles"
            ));
        }
        if volume <= 0.0 {
            return fault(format!("faces inwards (volume {volume})"));
        }
        if flattest < 1e-3 {
            return fault(format!("a triangle is only {flattest} times as high as long"));
        }
        let b = self.mesh.bounds();
        let off = (b.min - self.bounds.min).abs().max((b.max - self.bounds.max).abs());
        if (off / self.bounds.size()).max_element() > 1e-3 {
            return fault(format!("fills {b:?} instead of {:?}", self.bounds));
        }
        Ok(())
    }
}

/// All meshes but the rabbits, in the order in which they are written.
pub fn all() -> Vec<Model> {
    let cube_box = Bounds { min: dvec3(-1.0, -1.0, -1.0), max: dvec3(1.0, 1.0, 1.0) };
    let gem_box = Bounds { min: dvec3(-2.0, -2.0, -1.805), max: dvec3(2.0, 2.0, 0.998) };
    let vase_box = Bounds { min: dvec3(-2.304, 0.0, -2.291), max: dvec3(2.304, 8.125, 2.291) };
    vec![
        Model::new("cube.obj", "A cube, corners at +-1.", cube::cube(), 12, cube_box),
        Model::new(
            "diamond.obj",
            "A round brilliant: the axis is z, the table is up.",
            gem::gem(),
            110,
            gem_box,
        ),
        Model::new(
            "vase.obj",
            "A vase with a wall of some thickness, turned about y.",
            vase::vase(),
            3840,
            vase_box,
        ),
        Model {
            // The six has one hole, the eight two.
            topology: (5, 3),
            ..Model::new(
                "logo.obj",
                "6.837 in solid characters; the front looks along +z.",
                logo::logo(),
                13_872,
                logo::BOX,
            )
        },
    ]
}

/// The rabbit from which assignment 9 makes those of the scenes.
pub fn fine_rabbit() -> Model {
    let comment = "A sitting rabbit, modelled from ellipsoids.";
    Model::new("rabbit.obj", comment, rabbit::fine(), 175_500, rabbit::BOX)
}
