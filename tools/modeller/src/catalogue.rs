//! The list of meshes: names, models and what each must measure.

use crate::mesh::{Bounds, Mesh};
use crate::{check, cube, gem, obj, rabbit, vase};
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
}

/// Decimals that the files keep: a hundred-thousandth of a scene unit is under a hundredth of the finest mesh's edges.
const DECIMALS: usize = 5;

impl Model {
    fn new(
        name: &'static str,
        comment: &'static str,
        mesh: Mesh,
        triangles: usize,
        bounds: Bounds,
    ) -> Self {
        Model {
            name,
            comment,
            mesh: obj::rounded(&mesh, DECIMALS),
            triangles,
            bounds,
        }
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
        let (euler, volume, flattest) = (
            check::euler_characteristic(&self.mesh),
            check::volume(&self.mesh),
            check::flattest(&self.mesh),
        );
        if euler != 2 || !check::is_connected(&self.mesh) {
            return fault(format!(
                "not one piece without handles (Euler characteristic {euler})"
            ));
        }
        if volume <= 0.0 {
            return fault(format!("faces inwards (volume {volume})"));
        }
        if flattest < 1e-3 {
            return fault(format!(
                "a triangle is only {flattest} times as high as long"
            ));
        }
        let b = self.mesh.bounds();
        let off = (b.min - self.bounds.min)
            .abs()
            .max((b.max - self.bounds.max).abs());
        if (off / self.bounds.size()).max_element() > 1e-3 {
            return fault(format!("fills {b:?} instead of {:?}", self.bounds));
        }
        Ok(())
    }
}

/// All models, made afresh.
pub fn all() -> Vec<Model> {
    let mut models = vec![
        Model::new(
            "cube.obj",
            "A cube, corners at +-1.",
            cube::cube(),
            12,
            symmetric(1.0, 1.0, -1.0, 1.0),
        ),
        Model::new(
            "diamond.obj",
            "A round brilliant: the axis is z, the table is up.",
            gem::gem(),
            110,
            symmetric(2.0, 2.0, -1.805, 0.998),
        ),
        Model::new(
            "vase.obj",
            "A vase with a wall of some thickness, turned about y.",
            vase::vase(),
            3840,
            Bounds {
                min: dvec3(-2.304, 0.0, -2.291),
                max: dvec3(2.304, 8.125, 2.291),
            },
        ),
    ];
    let [fine, medium, small, tiny] = rabbit::levels([40_000, 5_000, 1_000, 200]);
    let rabbits = [
        ("bunny_40k.obj", fine, 40_000),
        ("bunny_5k.obj", medium, 5_000),
        ("bunny_1k.obj", small, 1_000),
    ];
    for (name, mesh, count) in rabbits.into_iter().chain([("bunny_200.obj", tiny, 200)]) {
        models.push(Model::new(
            name,
            "A sitting rabbit, modelled from ellipsoids.",
            mesh,
            count,
            rabbit::BOX,
        ));
    }
    models
}

fn symmetric(x: f64, y: f64, low: f64, high: f64) -> Bounds {
    Bounds {
        min: dvec3(-x, -y, low),
        max: dvec3(x, y, high),
    }
}
