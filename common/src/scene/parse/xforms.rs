//! The entries of a transform list.
//!
//! ```text
//! Scale 1 2 1        UniformScale 2      Translate 0 1 0
//! XRotate 90         YRotate 90          ZRotate 90        # degrees
//! Rotate { 0 1 0 90 }
//! Matrix4f { 1 0 0 5   0 1 0 0   0 0 1 0   0 0 0 1 }       # row by row; `Matrix` too
//! ```

use super::Parser;
use super::block::found;
use crate::math::{DMat3, DMat4, DVec3, Vec3};
use crate::scene::Xform;
use crate::scene::diagnostic::{Fault, Parsed};
use crate::scene::lexer::{Token, TokenKind};

/// The keywords.
pub(super) const XFORMS: [&str; 9] =
    ["Scale", "UniformScale", "Translate", "XRotate", "YRotate", "ZRotate", "Rotate", "Matrix4f", "Matrix"];

/// A matrix whose rows and columns are scaled to largest entry 1 is singular if its determinant
/// is no larger than this: what rounding leaves of an exact zero, with room to spare.
const SINGULAR: f64 = 1e-12;

impl<'a> Parser<'a> {
    /// One entry; it may be singular.
    pub(super) fn xform(&mut self, keyword: Token<'a>) -> Parsed<Xform> {
        Ok(match keyword.text {
            "Scale" => Xform::Scale(self.vector(keyword)?),
            "UniformScale" => Xform::Scale(DVec3::splat(self.number(keyword)?)),
            "Translate" => Xform::Translate(self.vector(keyword)?),
            "XRotate" => Xform::Rotate(DVec3::X, self.number(keyword)?),
            "YRotate" => Xform::Rotate(DVec3::Y, self.number(keyword)?),
            "ZRotate" => Xform::Rotate(DVec3::Z, self.number(keyword)?),
            "Rotate" => self.rotate(keyword)?,
            _ => self.matrix(keyword)?,
        })
    }

    /// One entry that an object can be placed with.
    pub(super) fn invertible_xform(&mut self, keyword: Token<'a>) -> Parsed<Xform> {
        let xform = self.xform(keyword)?;
        let linear = match xform {
            Xform::Scale(scale) => DMat3::from_diagonal(scale),
            Xform::Matrix(matrix) => DMat3::from_mat4(matrix),
            Xform::Translate(_) | Xform::Rotate(..) => return Ok(xform),
        };
        if !is_singular(linear) {
            return Ok(xform);
        }
        let message = format!("this `{}` is singular: it flattens what it transforms", keyword.text);
        Fault::new(keyword.span, message)
            .help("a transform must be invertible; use a small factor instead of zero")
            .fail()
    }

    fn rotate(&mut self, keyword: Token<'a>) -> Parsed<Xform> {
        self.open(keyword)?;
        let [x, y, z, degrees] = self.numbers(keyword)?;
        self.close(keyword, "four numbers")?;
        let axis = DVec3::new(x, y, z);
        if axis.as_vec3() == Vec3::ZERO {
            return Fault::new(keyword.span, "the axis of `Rotate` must not be the zero vector").fail();
        }
        Ok(Xform::Rotate(axis, degrees))
    }

    fn matrix(&mut self, keyword: Token<'a>) -> Parsed<Xform> {
        self.open(keyword)?;
        let rows: [f64; 16] = self.numbers(keyword)?;
        self.close(keyword, "sixteen numbers")?;
        if rows[12..] != [0.0, 0.0, 0.0, 1.0] {
            let message = format!("the last row of this `{}` must be 0 0 0 1", keyword.text);
            return Fault::new(keyword.span, message)
                .help("the matrix is listed row by row; the translation is the 4th, 8th and 12th number")
                .fail();
        }
        Ok(Xform::Matrix(DMat4::from_cols_array(&rows).transpose()))
    }

    fn close(&mut self, keyword: Token<'a>, after: &str) -> Parsed<()> {
        let token = self.lexer.next();
        if token.kind == TokenKind::Close {
            return Ok(());
        }
        let message =
            format!("expected `}}` after the {after} of `{}`, found {}", keyword.text, found(token));
        Fault::new(token.span, message).fail()
    }
}

/// Is the rank below 3, whatever the units? Rows and columns are scaled to largest entry 1 in
/// turn (which changes no rank) before the determinant is looked at.
fn is_singular(matrix: DMat3) -> bool {
    let mut scaled = matrix;
    for _ in 0..4 {
        let Some(columns) = unit_columns(scaled) else {
            return true;
        };
        scaled = columns.transpose();
    }
    scaled.determinant().abs() <= SINGULAR
}

/// Divides each column by its largest entry; `None` if a column is zero.
fn unit_columns(matrix: DMat3) -> Option<DMat3> {
    let largest = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(|c| c.abs().max_element());
    let nonzero = largest.iter().all(|&entry| entry > 0.0);
    nonzero.then(|| {
        DMat3::from_cols(matrix.x_axis / largest[0], matrix.y_axis / largest[1], matrix.z_axis / largest[2])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn singular_does_not_depend_on_the_unit_of_length() {
        let turned = DMat3::from_rotation_z(0.3);
        for factor in [1e-30, 1e-6, 1.0, 1e30] {
            assert!(!is_singular(turned * factor));
            assert!(!is_singular(DMat3::from_diagonal(DVec3::new(factor, 1.0, 1.0)) * turned));
            assert!(!is_singular(turned * DMat3::from_diagonal(DVec3::new(1.0, factor, 1.0))));
        }
    }

    #[test]
    fn rank_below_three_is_singular() {
        let rank_2 = DMat3::from_cols_array(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]);
        assert!(is_singular(rank_2));
        assert!(is_singular(rank_2 * 0.1));
        assert!(is_singular(DMat3::from_diagonal(DVec3::new(1.0, 0.0, 1.0))));
        assert!(is_singular(DMat3::ZERO));
    }
}
