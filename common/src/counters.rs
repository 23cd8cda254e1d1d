//! What was done while tracing, counted: the figures behind `-stats` and behind every skip.

use std::ops::AddAssign;

/// Counts of traced and skipped work. Each thread counts for itself; sums do not depend on the
/// number of threads or the order of tiles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Camera, mirrored and refracted rays.
    pub rays: u64,
    /// Rays towards lights.
    pub shadow_rays: u64,
    /// Primitive tests asked of any structure; groups and transforms do not count, and a
    /// primitive tested eight at a time counts like one tested alone.
    pub intersections: u64,
    /// Grid cells (or tree nodes) stepped through.
    pub cells: u64,
    /// Candidates that passed the single-precision filter and were decided in double precision.
    pub exact_tests: u64,
    /// Shadow rays not traced because the light faces away from the surface.
    pub skipped_shadow_behind: u64,
    /// Shadow rays not traced because the light gives nothing there.
    pub skipped_shadow_dark: u64,
    /// Shadow rays not traced because they start inside a body that the light is outside of.
    pub skipped_shadow_inside: u64,
    /// Mirrored and refracted rays not made because their colour is black.
    pub skipped_black_secondary: u64,
    /// Mirrored and refracted rays not traced because what they bring is known without.
    pub skipped_known_secondary: u64,
    /// Mirrored and refracted rays dropped by the cut-off weight.
    pub skipped_below_weight: u64,
    /// Surfaces for which no light was chosen because they are mirrors or glass only.
    pub skipped_light_specular: u64,
    /// Paths ended by roulette.
    pub ended_by_roulette: u64,
    /// Camera rays not traced because their tile cannot see any object.
    pub skipped_empty_tile: u64,
    /// Hits whose point and normal were worked out.
    pub surfaces: u64,
    /// Hits of which no more than distance or material was wanted.
    pub skipped_surface: u64,
    /// Pictures rendered.
    pub pictures: u64,
    /// Spheres that rays are taken to by a matrix.
    pub matrices: u64,
    /// Spheres that need none, for no transform moves them or it was baked.
    pub skipped_matrix: u64,
    /// Mesh files read.
    pub mesh_files: u64,
    /// Uses of meshes whose file had been read for another.
    pub skipped_mesh_file: u64,
    /// Grids and trees built.
    pub structures: u64,
    /// Those not built: no ray asked, or there is too little to put into them.
    pub skipped_structure: u64,
    /// Samples of pixels that were good enough without.
    pub skipped_converged: u64,
}

impl Counters {
    /// What finding hits has cost so far: cells or nodes stepped through, and primitive tests.
    #[inline]
    pub fn work(&self) -> u64 {
        self.cells + self.intersections
    }
}

impl AddAssign for Counters {
    fn add_assign(&mut self, other: Self) {
        self.rays += other.rays;
        self.shadow_rays += other.shadow_rays;
        self.intersections += other.intersections;
        self.cells += other.cells;
        self.exact_tests += other.exact_tests;
        self.skipped_shadow_behind += other.skipped_shadow_behind;
        self.skipped_shadow_dark += other.skipped_shadow_dark;
        self.skipped_shadow_inside += other.skipped_shadow_inside;
        self.skipped_black_secondary += other.skipped_black_secondary;
        self.skipped_known_secondary += other.skipped_known_secondary;
        self.skipped_below_weight += other.skipped_below_weight;
        self.skipped_light_specular += other.skipped_light_specular;
        self.ended_by_roulette += other.ended_by_roulette;
        self.skipped_empty_tile += other.skipped_empty_tile;
        self.surfaces += other.surfaces;
        self.skipped_surface += other.skipped_surface;
        self.pictures += other.pictures;
        self.matrices += other.matrices;
        self.skipped_matrix += other.skipped_matrix;
        self.mesh_files += other.mesh_files;
        self.skipped_mesh_file += other.skipped_mesh_file;
        self.structures += other.structures;
        self.skipped_structure += other.skipped_structure;
        self.skipped_converged += other.skipped_converged;
    }
}
