//! What the oracle refuses to draw, and why.

use common::scene::Position;
use thiserror::Error;

/// Why a scene cannot be rendered. The oracle never draws something else in its place: a
/// reference that is silently wrong would be worse than none.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum OracleError {
    /// A picture of an image texture cannot be read; the text names the file.
    #[error("{0}")]
    Picture(String),
    /// Something that a later assignment adds.
    #[error("{}: {what} belongs to assignment {assignment}", at(.position))]
    Later {
        /// What was found.
        what: &'static str,
        /// The assignment that adds it.
        assignment: u8,
        /// Where its keyword stands; the camera's for the background.
        position: Position,
    },
    /// A transform, or a product of nested ones, that has no inverse.
    #[error("{}: this transform, composed with those around it, has no inverse", at(.0))]
    Singular(Position),
    /// The camera's `direction` is zero, or its `up` is parallel to it.
    #[error("{}: the camera's up is parallel to its direction, or one of them is zero", at(.0))]
    Camera(Position),
    /// An index in the scene points nowhere.
    #[error("{}: refers to a {what} that the scene does not have", at(.position))]
    Missing {
        /// What the index should have named.
        what: &'static str,
        /// Where the node that holds the index stands.
        position: Position,
    },
    /// An option that makes no picture.
    #[error("{0}")]
    Options(&'static str),
}

fn at(position: &Position) -> String {
    format!("line {}, column {}", position.line, position.column)
}
