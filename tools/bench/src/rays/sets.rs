//! The four ray sets of a mesh: coherent, half coherent, towards a light, and incoherent.

use crate::truth::{Tree, Truth};
use crate::world::World;
use common::math::{DVec3, Vec3};
use common::ray::Ray;
use modeller::generated::wave::{cosine, sine};
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Names of the sets, in the order in which they are made.
pub const NAMES: [&str; 4] = ["primary", "bounce", "shadow", "random"];

/// Rays that ask the same kind of question.
#[derive(Clone, Debug, PartialEq)]
pub struct RaySet {
    /// What it is called in tables and files.
    pub name: String,
    /// In the order in which they are asked.
    pub rays: Vec<Ray>,
    /// Hits count for 0 < t < reach.
    pub reach: f32,
    /// What each of them hits.
    pub truth: Vec<Truth>,
}

/// Bounced and shadow rays start this share of the box's diagonal off the surface.
const OFF_SURFACE: f64 = 1e-4;
/// Share of the frame that the mesh fills.
const FILLED: f64 = 0.96;
/// Tangent of half the field of view, 45°.
const HALF_FIELD: f64 = 0.414_213_562_373_095_05;

/// A pinhole camera that sees all of a mesh from the upper left.
struct View {
    eye: DVec3,
    forward: DVec3,
    right: DVec3,
    up: DVec3,
}

impl View {
    /// As near as it can be with every vertex inside the frame.
    fn new(world: &World) -> Self {
        let forward = DVec3::new(-0.45, -0.35, -1.0).normalize();
        let right = forward.cross(DVec3::Y).normalize();
        let up = right.cross(forward);
        let center = world.center();
        let needed = |p: &Vec3| {
            let p = p.as_dvec3() - center;
            p.dot(right).abs().max(p.dot(up).abs()) / (FILLED * HALF_FIELD) - p.dot(forward)
        };
        let distance = world.mesh.positions.iter().map(needed).fold(0.0, f64::max);
        Self { eye: center - forward * distance, forward, right, up }
    }

    /// `side`² rays in rows from the top.
    fn rays(&self, side: usize) -> Vec<Ray> {
        let at = |k: usize| ((k as f64 + 0.5) / side as f64 * 2.0 - 1.0) * HALF_FIELD;
        let direction =
            |x: usize, y: usize| (self.forward + self.right * at(x) - self.up * at(y)).normalize();
        let pixels = (0..side).flat_map(|y| (0..side).map(move |x| (x, y)));
        pixels.map(|(x, y)| Ray::new(self.eye.as_vec3(), direction(x, y).as_vec3())).collect()
    }

    /// A point above the camera's left shoulder, outside the mesh.
    fn lamp(&self, world: &World) -> DVec3 {
        let radius = world.diagonal() / 2.0;
        world.center() + (self.right * -1.5 + self.up * 3.0 - self.forward * 2.0) * radius
    }
}

/// Where a camera ray met the mesh, moved off it, and the normal on the camera's side.
struct Landing {
    point: DVec3,
    normal: DVec3,
}

/// Makes the sets of these names, `side`² rays each, with what they hit.
pub fn make(world: &World, truth: &Tree, side: usize, names: &[String]) -> Vec<RaySet> {
    let view = View::new(world);
    let primary = set(truth, "primary", view.rays(side), f32::INFINITY);
    let landings = landings(world, &primary);
    let lamp = view.lamp(world);
    let made = names.iter().map(|name| match name.as_str() {
        "primary" => primary.clone(),
        "bounce" => set(truth, name, bounced(&landings, side * side), f32::INFINITY),
        "shadow" => set(truth, name, to_lamp(&landings, lamp, side * side), 1.0),
        _ => set(truth, "random", anywhere(world, side * side), f32::INFINITY),
    });
    made.collect()
}

fn set(truth: &Tree, name: &str, rays: Vec<Ray>, reach: f32) -> RaySet {
    let truth = truth.trace(&rays, f64::from(reach));
    RaySet { name: name.to_owned(), rays, reach, truth }
}

fn landings(world: &World, primary: &RaySet) -> Vec<Landing> {
    let off = world.diagonal() * OFF_SURFACE;
    let hits = primary.rays.iter().zip(&primary.truth).filter(|(_, truth)| truth.is_hit());
    let landing = |(ray, truth): (&Ray, &Truth)| {
        let [a, b, c] = world.corners(truth.primitive).map(|p| p.as_dvec3());
        let normal = (b - a).cross(c - a).normalize();
        let normal = if normal.dot(ray.direction.as_dvec3()) > 0.0 { -normal } else { normal };
        Landing { point: ray.at(truth.t) + normal * off, normal }
    };
    hits.map(landing).collect()
}

/// The landings in order, each as often as it takes to make `count`.
fn spread(landings: &[Landing], count: usize) -> impl Iterator<Item = &Landing> {
    let count = if landings.is_empty() { 0 } else { count };
    (0..count).map(move |j| &landings[j * landings.len() / count])
}

/// Directions about the normal, as dense as the cosine.
fn bounced(landings: &[Landing], count: usize) -> Vec<Ray> {
    let mut random = Pcg64Mcg::seed_from_u64(12345);
    let ray = |landing: &Landing| {
        let n = landing.normal;
        let side = n.any_orthonormal_vector();
        let (height, turn) = (unit(&mut random), unit(&mut random));
        let flat = side * cosine(turn) + n.cross(side) * sine(turn);
        let direction = flat * height.sqrt() + n * (1.0 - height).sqrt();
        Ray::new(landing.point.as_vec3(), direction.as_vec3())
    };
    spread(landings, count).map(ray).collect()
}

/// The whole way to the lamp, which stands at t = 1.
fn to_lamp(landings: &[Landing], lamp: DVec3, count: usize) -> Vec<Ray> {
    let ray = |l: &Landing| Ray::new(l.point.as_vec3(), (lamp - l.point).as_vec3());
    spread(landings, count).map(ray).collect()
}

/// Origins all over the box, directions all over the sphere.
fn anywhere(world: &World, count: usize) -> Vec<Ray> {
    let mut random = Pcg64Mcg::seed_from_u64(777);
    let bounds = world.bounds();
    let (min, size) = (bounds.min.as_dvec3(), bounds.size().as_dvec3());
    let mut ray = || {
        let origin = min + size * DVec3::new(unit(&mut random), unit(&mut random), unit(&mut random));
        let (z, turn) = (2.0 * unit(&mut random) - 1.0, unit(&mut random));
        let flat = (1.0 - z * z).sqrt();
        Ray::new(origin.as_vec3(), DVec3::new(flat * cosine(turn), flat * sine(turn), z).as_vec3())
    };
    (0..count).map(|_| ray()).collect()
}

/// Between 0 and 1, the latter excluded.
fn unit(random: &mut Pcg64Mcg) -> f64 {
    (random.next_u64() >> 11) as f64 / (1u64 << 53) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sets_are_what_their_names_say() {
        let world = World::named("sphere1k").unwrap();
        let tree = Tree::new(&world.mesh);
        let names = NAMES.map(str::to_owned);
        let sets = make(&world, &tree, 64, &names);
        assert!(sets.iter().all(|s| s.rays.len() == 4096 && s.truth.len() == 4096));
        let share = |s: &RaySet| s.truth.iter().filter(|t| t.is_hit()).count() as f64 / 4096.0;
        let [primary, bounce, shadow, random] = [0, 1, 2, 3].map(|k| share(&sets[k]));
        assert!((0.4..0.9).contains(&primary), "the ball fills the frame: {primary}");
        assert!(bounce < 0.5 && shadow < 0.7 && random > 0.5, "{bounce} {shadow} {random}");
        assert_eq!((sets[0].reach, sets[2].reach), (f32::INFINITY, 1.0));
        let unit = |ray: &Ray| (ray.direction.length() - 1.0).abs() < 1e-6;
        assert!([0, 1, 3].iter().all(|&k| sets[k].rays.iter().all(unit)));
        // From every start the lamp is at t = 1.
        let lamps: Vec<DVec3> = sets[2].rays.iter().map(|r| r.at(1.0)).collect();
        assert!(lamps.iter().all(|p| p.distance(lamps[0]) < 1e-5));
        assert_eq!(make(&world, &tree, 64, &names), sets, "the same every time");
    }

    /// The outermost rows and columns see nothing, but not many of them.
    #[test]
    fn the_mesh_fills_the_frame_but_for_a_rim() {
        let world = World::named("terrain1k").unwrap();
        let primary = &make(&world, &Tree::new(&world.mesh), 200, &["primary".to_owned()])[0];
        let hit = |x: usize, y: usize| primary.truth[y * 200 + x].is_hit();
        assert!((0..200).all(|k| !(hit(k, 1) || hit(k, 198) || hit(1, k) || hit(198, k))));
        let rim = 8;
        assert!((0..200).any(|k| hit(rim, k) || hit(199 - rim, k) || hit(k, rim) || hit(k, 199 - rim)));
    }
}
