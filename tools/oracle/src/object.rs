//! Objects: shapes with their transforms composed, one flat list.

use crate::shape::{Crossing, Shape, Soup, Uv};
use crate::transform::product;
use crate::{Hit, OracleError, Ray};
use common::math::{DMat3, DMat4, DVec3};
use common::scene::{Node, NodeKind, Scene};

/// Secondary rays start this fraction of the scene's coordinates away from the surface.
///
/// A hit point carries an error of a few times 1e-16 of the largest coordinate that took part,
/// multiplied by the condition number of the object's transform. 1e-9 leaves room for
/// conditions up to about 1e6, and is a millionth of a pixel in any sensible picture. Objects
/// smaller than that fraction of the coordinates are beyond the oracle.
const STANDOFF: f64 = 1e-9;

/// Cosine of the angle that a smooth normal keeps to the direction of sight: next to nothing,
/// but not to be mistaken for the other side.
const BENT: f64 = 1e-4;

/// One shape with its place in the world.
#[derive(Clone, Debug)]
pub(crate) struct Object {
    /// Index of the shape in `Scene::nodes`.
    pub node: usize,
    pub shape: Shape,
    /// Number of its material in `Scene::materials`.
    pub material: u32,
    pub to_world: DMat4,
    pub to_object: DMat4,
    /// Is there a `Transform` node above it, were it an identity?
    pub transformed: bool,
    /// Inverse transpose of the linear part.
    normal_matrix: DMat3,
    /// Largest coordinate of the object in world space.
    extent: f64,
}

impl Object {
    /// The outward unit normal in world space.
    pub fn world_normal(&self, crossing: &Crossing) -> DVec3 {
        (self.normal_matrix * crossing.normal).normalize()
    }

    /// The unit normal in world space to shade with at a `point`: interpolated between those of
    /// the corners on a smooth mesh, else `flat`.
    ///
    /// Corners that all turn their back to the front of the triangle are taken for the fault of
    /// a file, and turned round. And where the triangle faces along `sight` or against it, so
    /// does the interpolated normal, by bending it if need be: outlines would turn black else.
    fn shading_normal(&self, triangle: usize, point: DVec3, flat: DVec3, sight: DVec3) -> DVec3 {
        let local = self.to_object.transform_point3(point);
        let Some(corners) = self.shape.corner_normals(triangle, local) else { return flat };
        let placed = corners.map(|(weight, n)| (weight, (self.normal_matrix * n).normalize_or_zero()));
        let backwards = placed.iter().all(|(_, n)| n.dot(flat) < 0.0);
        let sum: DVec3 = placed.iter().map(|(weight, n)| weight * n).sum();
        let normal = if backwards { -sum } else { sum }.normalize_or(flat);
        let outward = if sight.dot(flat) > 0.0 { sight } else { -sight };
        let short = BENT - normal.dot(outward);
        if short > 0.0 { (normal + short * outward).normalize() } else { normal }
    }

    /// Texture coordinates at a `point` of the object in world space.
    pub fn uv(&self, triangle: usize, point: DVec3) -> Uv {
        self.shape.uv(triangle, self.to_object.transform_point3(point))
    }

    /// The hit that a crossing of the world-space `ray` with this object is.
    pub fn hit(&self, ray: &Ray, crossing: Crossing) -> Hit<'_> {
        let point = ray.at(crossing.t);
        let scale = self.extent.max(largest(point)).max(largest(ray.origin));
        let normal = self.world_normal(&crossing);
        Hit {
            t: crossing.t,
            node: self.node,
            triangle: crossing.triangle,
            point,
            normal,
            shading_normal: self.shading_normal(crossing.triangle, point, normal, ray.direction),
            object: self,
            standoff: STANDOFF * scale,
        }
    }

    /// Points in world space that span the object: the vertices of triangles, the eight corners
    /// of a sphere's box; one point of a plane, which nothing spans.
    fn spanning_points(&self) -> Vec<DVec3> {
        let local = match &self.shape {
            Shape::Sphere(sphere) => sphere.box_corners().to_vec(),
            Shape::Plane(plane) => vec![plane.anchor()],
            Shape::Triangles(Soup { triangles, .. }) => triangles.as_flattened().to_vec(),
        };
        local.into_iter().map(|p| self.to_world.transform_point3(p)).collect()
    }
}

fn largest(v: DVec3) -> f64 {
    v.abs().max_element()
}

/// The objects of a scene in file order. One pass over the flat tree: parents stand before
/// their children, so each node's matrix is its parent's times its own.
pub(crate) fn objects(scene: &Scene) -> Result<Vec<Object>, OracleError> {
    let mut frames: Vec<(DMat4, bool)> = Vec::with_capacity(scene.nodes.len());
    let mut objects = Vec::new();
    for (index, node) in scene.nodes.iter().enumerate() {
        let mut frame = node.parent.map_or((DMat4::IDENTITY, false), |p| frames[p as usize]);
        match &node.kind {
            NodeKind::Group => {}
            NodeKind::Transform(list) => frame = (frame.0 * product(list), true),
            NodeKind::Shape { shape, material } => {
                check_material(scene, node, *material)?;
                let shape = Shape::new(scene, node, shape)?;
                objects.push(place(index, node, shape, *material, frame)?);
            }
        }
        frames.push(frame);
    }
    Ok(objects)
}

fn check_material(scene: &Scene, node: &Node, material: u32) -> Result<(), OracleError> {
    let missing = OracleError::Missing { what: "material", position: node.position };
    scene.materials.get(material as usize).map(|_| ()).ok_or(missing)
}

fn place(
    index: usize,
    node: &Node,
    shape: Shape,
    material: u32,
    (to_world, transformed): (DMat4, bool),
) -> Result<Object, OracleError> {
    let to_object = to_world.inverse();
    if !to_object.is_finite() {
        return Err(OracleError::Singular(node.position));
    }
    let mut object = Object {
        node: index,
        shape,
        material,
        to_world,
        to_object,
        transformed,
        normal_matrix: DMat3::from_mat4(to_object).transpose(),
        extent: 0.0,
    };
    object.extent = object.spanning_points().into_iter().map(largest).fold(0.0, f64::max);
    Ok(object)
}
