//! What the property tests (`tests/properties_*.rs`) share: random rays, closed meshes, exact
//! oracles.
//!
//! The oracles decide with unbounded integers ([`Dyadic`]) and share no arithmetic with the
//! core. A property runs a fixed number of seeded trials ([`run`]), every trial is one ray (or
//! one shape, one text), so the first failure is a reproducer already; it is printed in bits.
//! `PROPERTY_FACTOR=30` runs thirty times as many trials, `PROPERTY_SEED=7` runs others.

mod agreement;
mod coverage;
mod dyadic;
mod march_oracle;
mod meshes;
mod placed;
mod random;
mod reproducer;
mod trials;
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
pub use trials::{run, tally};
pub use triangle_oracle::{ExactTriangle, exact_triangle};
pub use winding::{inside_points, winding};
pub use worlds::{build, committed_scenes, geometry_of, repository, scene_of};
