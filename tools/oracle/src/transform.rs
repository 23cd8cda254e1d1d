//! Transform lists as matrices, worked out here once more rather than taken from the scene.

use common::math::{DMat4, DVec3};
use common::scene::Xform;

/// X₁·X₂·…·Xₙ acting on column vectors: the last of the list acts first.
pub(crate) fn product(list: &[Xform]) -> DMat4 {
    list.iter().fold(DMat4::IDENTITY, |m, x| m * matrix(x))
}

fn matrix(xform: &Xform) -> DMat4 {
    match *xform {
        Xform::Scale(s) => images(DVec3::X * s, DVec3::Y * s, DVec3::Z * s, DVec3::ZERO),
        Xform::Translate(t) => images(DVec3::X, DVec3::Y, DVec3::Z, t),
        Xform::Rotate(axis, degrees) => {
            let turn = |v| rotated(v, axis.normalize(), degrees.to_radians());
            images(turn(DVec3::X), turn(DVec3::Y), turn(DVec3::Z), DVec3::ZERO)
        }
        Xform::Matrix(m) => m,
    }
}

/// The affine map that takes the unit vectors to `x`, `y`, `z` and the origin to `o`.
fn images(x: DVec3, y: DVec3, z: DVec3, o: DVec3) -> DMat4 {
    DMat4::from_cols(x.extend(0.0), y.extend(0.0), z.extend(0.0), o.extend(1.0))
}

/// Rodrigues' formula: `v` turned right-handed by `angle` radians about the unit `axis`.
fn rotated(v: DVec3, axis: DVec3, angle: f64) -> DVec3 {
    let (sin, cos) = angle.sin_cos();
    v * cos + axis.cross(v) * sin + axis * axis.dot(v) * (1.0 - cos)
}
