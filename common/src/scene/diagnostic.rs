//! Errors of scene files: where, what was expected, what was probably meant.

/// An error in a scene file, rendered with its source line and a caret.
#[derive(Debug, thiserror::Error)]
#[error("{rendered}")]
pub struct SceneError {
    rendered: String,
}
