//! Affine maps, composed once in `f64`.

use super::{DMat3, DMat4, DVec3};

/// What a map does to shapes, from cheapest to general; decides what can be baked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AffineKind {
    /// Nothing.
    Identity,
    /// Rotation or reflection, one scale for all directions, translation: spheres stay spheres.
    Similarity {
        /// The scale, above zero.
        scale: f64,
    },
    /// Anything else of full rank.
    General,
}

/// An invertible affine map p ↦ linear·p + translation with its inverse.
///
/// Composition happens in [`DMat4`] before this is built, so the error of a chain of transforms
/// does not grow with its depth as far as `f32` can tell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Affine {
    /// Linear part, acting on columns.
    pub linear: DMat3,
    /// Translation.
    pub translation: DVec3,
    /// Inverse of the linear part.
    pub inverse: DMat3,
    /// What the map does to shapes.
    pub kind: AffineKind,
}

impl Affine {
    /// The map that does nothing.
    pub const IDENTITY: Self = Self {
        linear: DMat3::IDENTITY,
        translation: DVec3::ZERO,
        inverse: DMat3::IDENTITY,
        kind: AffineKind::Identity,
    };

    /// From a 4×4 matrix whose last row is 0 0 0 1. `None` if an entry is not finite or the
    /// inverse does not exist in `f64`.
    pub fn from_matrix(m: &DMat4) -> Option<Self> {
        let linear = DMat3::from_mat4(*m);
        let translation = m.w_axis.truncate();
        let inverse = linear.inverse();
        let usable = linear.is_finite() && translation.is_finite() && inverse.is_finite();
        usable.then(|| Self { linear, translation, inverse, kind: classify(&linear, translation) })
    }

    /// The image of a point.
    pub fn point(&self, p: DVec3) -> DVec3 {
        self.linear * p + self.translation
    }

    /// The pre-image of a point.
    pub fn inverse_point(&self, p: DVec3) -> DVec3 {
        self.inverse * (p - self.translation)
    }

    /// The image of a direction.
    pub fn vector(&self, v: DVec3) -> DVec3 {
        self.linear * v
    }

    /// The pre-image of a direction, length kept as it comes out.
    pub fn inverse_vector(&self, v: DVec3) -> DVec3 {
        self.inverse * v
    }

    /// The image of a surface normal, M⁻ᵀn, not normalised.
    pub fn normal(&self, n: DVec3) -> DVec3 {
        self.inverse.transpose() * n
    }
}

/// Columns of one length that stand at right angles make a similarity. The tolerance is a few
/// roundings of `f64`: what it lets through deviates from a sphere by less than 2⁻⁴⁸.
fn classify(linear: &DMat3, translation: DVec3) -> AffineKind {
    if *linear == DMat3::IDENTITY && translation == DVec3::ZERO {
        return AffineKind::Identity;
    }
    let [x, y, z] = [linear.x_axis, linear.y_axis, linear.z_axis];
    let square = x.length_squared();
    let same = |v: f64| (v - square).abs() <= square * 2f64.powi(-48);
    let right = |v: f64| v.abs() <= square * 2f64.powi(-48);
    let similar = same(y.length_squared()) && same(z.length_squared());
    if similar && right(x.dot(y)) && right(y.dot(z)) && right(z.dot(x)) {
        AffineKind::Similarity { scale: square.sqrt() }
    } else {
        AffineKind::General
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds() {
        let of = |m: DMat4| Affine::from_matrix(&m).map(|a| a.kind);
        assert_eq!(of(DMat4::IDENTITY), Some(AffineKind::Identity));
        let turn = DMat4::from_rotation_z(0.3) * DMat4::from_scale(DVec3::splat(2.0));
        match of(turn) {
            Some(AffineKind::Similarity { scale }) => assert!((scale - 2.0).abs() < 1e-14),
            other => panic!("{other:?}"),
        }
        assert_eq!(of(DMat4::from_scale(DVec3::new(1.0, 2.0, 1.0))), Some(AffineKind::General));
        assert_eq!(of(DMat4::from_scale(DVec3::new(1.0, 0.0, 1.0))), None);
    }

    #[test]
    fn tiny_uniform_scale_is_not_singular() {
        let a = Affine::from_matrix(&DMat4::from_scale(DVec3::splat(1e-6))).unwrap();
        assert!((a.inverse_point(a.point(DVec3::ONE)) - DVec3::ONE).length() < 1e-15);
    }
}
