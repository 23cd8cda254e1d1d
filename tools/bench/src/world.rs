//! What rays are sent at: one mesh, as its file or recipe gives it and prepared for our structures.

use common::cli::AppError;
use common::geometry::Geometry;
use common::math::{Bounds, DVec3, Vec3};
use common::mesh::{Mesh, read_obj};
use common::scene::{Scene, parse_str};
use modeller::generated::{Generated, Recipe};
use std::path::Path;
use std::sync::Arc;

/// The mesh that `bunny` stands for.
const BUNNY: &str = "scenes/meshes/bunny_40k.obj";

/// A mesh, and the same as primitives numbered like its triangles.
pub struct World {
    /// What it is called in tables.
    pub name: String,
    /// Vertices and triangles.
    pub mesh: Arc<Mesh>,
    /// The mesh in the form that our structures take.
    pub geometry: Geometry,
}

/// A scene whose text names one mesh, which is not in a file.
///
/// # Errors
/// If the text is no scene.
pub fn scene_with(text: &str, mesh: &Arc<Mesh>) -> Result<Scene, AppError> {
    Ok(parse_str("bench", text, &mut Arc::clone(mesh))?)
}

impl World {
    /// Prepares a mesh.
    ///
    /// # Errors
    /// If it has no triangle, or lies beyond the range of single precision.
    pub fn new(name: &str, mesh: Mesh) -> Result<Self, AppError> {
        if mesh.triangles.is_empty() {
            return Err(AppError::Usage(format!("the mesh {name} has no triangle")));
        }
        let mesh = Arc::new(mesh);
        let text = "PerspectiveCamera { center 0 0 5 direction 0 0 -1 up 0 1 0 angle 40 }
            Materials { numMaterials 1 Material { } }
            Group { numObjects 1 MaterialIndex 0 TriangleMesh { obj_file it } }";
        let geometry = Geometry::build(&scene_with(text, &mesh)?)?;
        Ok(Self { name: name.to_owned(), mesh, geometry })
    }

    /// The mesh of a name; see [`mesh_named`].
    ///
    /// # Errors
    /// If there is none of that name.
    pub fn named(name: &str) -> Result<Self, AppError> {
        Self::new(name, mesh_named(name)?)
    }

    /// Corners of a triangle.
    pub fn corners(&self, triangle: u32) -> [Vec3; 3] {
        self.mesh.triangles[triangle as usize].map(|v| self.mesh.positions[v as usize])
    }

    /// Number of triangles.
    pub fn triangles(&self) -> usize {
        self.mesh.triangles.len()
    }

    /// The box of the vertices that are used.
    ///
    /// # Panics
    /// Never: there is at least one triangle.
    pub fn bounds(&self) -> Bounds {
        self.geometry.bounds().expect("a triangle has a box")
    }

    /// Diagonal of the box.
    pub fn diagonal(&self) -> f64 {
        let b = self.bounds();
        (b.max.as_dvec3() - b.min.as_dvec3()).length()
    }

    /// Middle of the box.
    pub fn center(&self) -> DVec3 {
        let b = self.bounds();
        (b.max.as_dvec3() + b.min.as_dvec3()) / 2.0
    }
}

/// The mesh of a name: `bunny`, a recipe such as `sphere200k`, or an OBJ file.
///
/// # Errors
/// If there is none of that name.
pub fn mesh_named(name: &str) -> Result<Mesh, AppError> {
    let file = if name == "bunny" { BUNNY } else { name };
    if Path::new(file).extension().is_some_and(|e| e == "obj") {
        return Ok(read_obj(Path::new(file))?);
    }
    let recipe: Recipe = name.parse().map_err(AppError::Usage)?;
    Ok(plain(recipe.make()))
}

/// A generated mesh in the house's form.
pub fn plain(made: Generated) -> Mesh {
    let positions = made.positions.into_iter().map(Vec3::from_array).collect();
    Mesh { positions, triangles: made.triangles, ..Mesh::default() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_recipe_becomes_a_world_numbered_like_its_triangles() {
        let world = World::named("sphere1k").unwrap();
        assert_eq!((world.triangles(), world.geometry.triangles().len()), (980, 980));
        assert!((0..980).all(|t| world.corners(t) == world.geometry.triangles()[t as usize]));
        assert!(World::named("cube1k").is_err() && World::named("nowhere.obj").is_err());
        assert!(World::new("nothing", Mesh::default()).is_err());
    }
}
