//! A9T7: what the program does: meshes in one way, scenes in another.

mod on_mesh;
mod on_scene;
mod outputs;

use crate::args::SimplifyArgs;
use common::cli::AppError;

/// The whole program: reads a mesh or a scene, simplifies, measures and shows what was asked for,
/// and writes it.
///
/// # Errors
/// Bad usage, unreadable input, a file that cannot be written.
pub fn run(args: &SimplifyArgs) -> Result<(), AppError> {
    if args.is_mesh() { on_mesh::run(args) } else { on_scene::run(args) }
}
