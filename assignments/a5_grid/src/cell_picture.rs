//! A5T2: the grid itself as a picture.

use crate::{Cells, March};
use a1_ray_casting::{Layer, Mixture, Sight};
use a2_transforms::{LocalLight, diffuse};
use common::counters::Counters;
use common::geometry::Surface;
use common::math::{DVec3, Interval, Vec3};
use common::ray::Ray;
use common::scene::PhongMaterial;

/// The first occupied cell along every ray, as a matt cube coloured by how much it holds.
pub struct CellPicture<'a> {
    /// How the box is cut.
    pub cells: &'a Cells,
    /// How many primitives each cell holds.
    pub counts: &'a [u8],
    /// The scene's lights.
    pub light: LocalLight<'a>,
    /// Where the camera's rays count.
    pub interval: Interval,
}

/// Corners of the colour ramp, from few to many.
const RAMP: [Vec3; 5] = [
    Vec3::new(0.25, 0.4, 1.0),
    Vec3::new(0.2, 0.9, 0.9),
    Vec3::new(0.3, 0.9, 0.2),
    Vec3::new(1.0, 0.9, 0.1),
    Vec3::new(1.0, 0.15, 0.1),
];

/// White for one primitive, then fifteen steps from blue over green to red for 2 to 16.
pub fn cell_color(count: u8) -> Vec3 {
    if count <= 1 {
        return Vec3::ONE;
    }
    let x = f32::from(count.min(16) - 2) / 14.0 * 4.0;
    let corner = (x as usize).min(3);
    RAMP[corner].lerp(RAMP[corner + 1], x - corner as f32)
}

/// The face of a matt box that a ray enters at `t` through a face across `axis`, in the light of
/// the scene without shadows.
pub fn shaded_face(light: &LocalLight, ray: &Ray, axis: usize, t: f64, color: Vec3) -> Vec3 {
    let mut normal = DVec3::ZERO;
    normal[axis] = -f64::from(ray.direction[axis].signum());
    let surface = Surface {
        point: ray.at(t),
        error: DVec3::ZERO,
        normal: normal.as_vec3(),
        geometric_normal: normal,
        material: 0,
        primitive: 0,
        weights: [0.0; 2],
    };
    let material = PhongMaterial { diffuse: color, ..PhongMaterial::default() };
    light.radiance(&surface, &Mixture::Plain(&material), ray.direction, diffuse)
}

impl CellPicture<'_> {
    /// The face through which a ray that starts inside a cell would have come in.
    fn face_behind(&self, sight: &Sight, cell: [usize; 3]) -> (usize, f64) {
        let (min, max) = self.cells.corners(cell);
        let behind = |a: usize| {
            let d = f64::from(sight.ray.direction[a]);
            let near = if d > 0.0 { min[a] } else { max[a] };
            if d == 0.0 { f64::NEG_INFINITY } else { (near - f64::from(sight.ray.origin[a])) / d }
        };
        let axis = (0..3).fold(0, |best, a| if behind(a) > behind(best) { a } else { best });
        (axis, behind(axis))
    }
}

impl Layer for CellPicture<'_> {
    fn needs_hit(&self) -> bool {
        false
    }

    fn value(&self, sight: &Sight, counters: &mut Counters) -> Vec3 {
        counters.rays += 1;
        let march = March::new(self.cells, &sight.ray, self.interval);
        for step in march.into_iter().flatten() {
            counters.cells += 1;
            let count = self.counts[self.cells.index(step.cell)];
            if count > 0 {
                let (axis, t) = match step.axis {
                    Some(axis) => (axis, step.enter),
                    None => self.face_behind(sight, step.cell),
                };
                return shaded_face(&self.light, &sight.ray, axis, t, cell_color(count));
            }
        }
        self.light.scene.background.color
    }
}
