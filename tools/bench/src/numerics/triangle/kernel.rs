//! What a triangle test looks like to this part, whoever wrote it.

use common::math::Vec3;
use common::ray::Ray;

/// A test of one ray against one triangle.
pub trait Kernel {
    /// What it is called in tables.
    const NAME: &'static str;
    /// What it wants to know of a ray, worked out once for all triangles.
    type Ray;
    /// What it keeps of a triangle.
    type Triangle;

    /// Prepares a ray.
    fn ray(ray: &Ray) -> Self::Ray;

    /// Prepares a triangle.
    fn triangle(corners: &[Vec3; 3]) -> Self::Triangle;

    /// Where the line of the ray meets the triangle, at any t; both sides count.
    fn hit(ray: &Self::Ray, triangle: &Self::Triangle) -> Option<f64>;
}

/// Many triangles without any structure.
pub trait Contender {
    /// What it is called in tables.
    fn name(&self) -> &'static str;

    /// Puts every t at which the line of the ray meets a triangle into `found`, in any order.
    fn crossings(&self, ray: &Ray, found: &mut Vec<f64>);

    /// The least t above 0; +∞ if there is none.
    fn nearest(&self, ray: &Ray) -> f64;
}

/// The triangles as one kernel wants them, asked one after the other.
pub struct Soup<K: Kernel>(Vec<K::Triangle>);

impl<K: Kernel> Soup<K> {
    /// Prepares all triangles.
    pub fn new(triangles: &[[Vec3; 3]]) -> Self {
        Self(triangles.iter().map(K::triangle).collect())
    }
}

impl<K: Kernel> Contender for Soup<K> {
    fn name(&self) -> &'static str {
        K::NAME
    }

    fn crossings(&self, ray: &Ray, found: &mut Vec<f64>) {
        let ray = K::ray(ray);
        found.extend(self.0.iter().filter_map(|triangle| K::hit(&ray, triangle)));
    }

    fn nearest(&self, ray: &Ray) -> f64 {
        let ray = K::ray(ray);
        let mut best = f64::INFINITY;
        for triangle in &self.0 {
            if let Some(t) = K::hit(&ray, triangle)
                && t > 0.0
                && t < best
            {
                best = t;
            }
        }
        best
    }
}
