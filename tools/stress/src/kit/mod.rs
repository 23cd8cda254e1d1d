//! What checks share: random rays, closed meshes, exact oracles.

mod agreement;
mod coverage;
mod dyadic;
mod march_oracle;
mod meshes;
mod placed;
mod random;
mod reproducer;
mod triangle_oracle;
mod winding;
mod worlds;

pub use agreement::{Named, agree, grid_of, structures};
pub use coverage::{Region, coverage};
pub use dyadic::Dyadic;
pub use march_oracle::cells_crossed;
pub use meshes::{closed_meshes, convex_sphere, fan, file_mesh, lattice_sphere, lumpy_sphere};
pub use placed::{Placement, aim, placed, simd_levels};
pub use random::Draw;
pub use reproducer::{ray_bits, triangle_bits};
pub use triangle_oracle::{ExactTriangle, exact_triangle};
pub use winding::{inside_points, winding};
pub use worlds::{build, committed_scenes, geometry_of, repository, scene_of};
