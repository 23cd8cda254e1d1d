//! What takes part: anything that answers rays, one at a time or in batches.

use crate::truth::MISS;
use crate::world::World;
use common::cli::AppError;
use common::ray::Ray;

/// What a structure says a ray hits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answer {
    /// In units of the ray's direction; +∞ for a miss.
    pub t: f32,
    /// The triangle; [`MISS`] for none.
    pub primitive: u32,
}

impl Answer {
    /// Nothing is hit.
    pub const MISS: Self = Self { t: f32::INFINITY, primitive: MISS };

    /// Whether anything is hit.
    pub fn is_hit(&self) -> bool {
        self.primitive != MISS
    }
}

/// A structure that is built and can be asked, from several threads at once.
///
/// Who can answer several rays faster together than one after the other overrides the batches;
/// the rays of a batch are neighbours in their set.
pub trait Contender: Sync {
    /// The nearest hit with 0 < t < reach.
    fn nearest(&self, ray: &Ray, reach: f32) -> Answer;

    /// Whether there is a hit with 0 < t < reach.
    fn any(&self, ray: &Ray, reach: f32) -> bool;

    /// The nearest hits of many rays; both slices have the same length.
    fn nearest_batch(&self, rays: &[Ray], reach: f32, answers: &mut [Answer]) {
        for (ray, answer) in rays.iter().zip(answers) {
            *answer = self.nearest(ray, reach);
        }
    }

    /// The same while the clock runs: it stops when the hits are in memory, in whatever form the contender
    /// gives them.
    fn nearest_timed(&self, rays: &[Ray], reach: f32, answers: &mut [Answer]) {
        self.nearest_batch(rays, reach, answers);
    }

    /// Whether each of many rays hits anything; both slices have the same length.
    fn any_batch(&self, rays: &[Ray], reach: f32, answers: &mut [bool]) {
        for (ray, answer) in rays.iter().zip(answers) {
            *answer = self.any(ray, reach);
        }
    }

    /// Bytes that it takes, copies of triangles included, but not the mesh it was built from;
    /// `None` if it does not tell.
    fn bytes(&self) -> Option<usize>;

    /// How many rays of a set it can answer in a reasonable time.
    fn affordable(&self) -> usize {
        usize::MAX
    }
}

/// A kind of structure.
#[derive(Clone, Copy)]
pub struct Structure {
    /// What it is called on the command line and in tables.
    pub name: &'static str,
    /// Builds it, which is what the build time is of.
    pub build: for<'w> fn(&'w World) -> Result<Box<dyn Contender + 'w>, AppError>,
}

/// All kinds that this program was compiled with, ours first.
pub fn all() -> Vec<Structure> {
    #[cfg(feature = "peers")]
    let peers = super::peers::all();
    #[cfg(not(feature = "peers"))]
    let peers = Vec::new();
    [super::ours::all(), peers].concat()
}

/// The kinds of these names, in their order; all kinds if there are no names.
///
/// # Errors
/// If a name is unknown.
pub fn chosen(names: &[String]) -> Result<Vec<Structure>, AppError> {
    if names.is_empty() {
        return Ok(all());
    }
    let one = |name: &String| {
        let known = all();
        let found = known.iter().find(|s| s.name == name).copied();
        found.ok_or_else(|| {
            let names: Vec<&str> = known.iter().map(|s| s.name).collect();
            AppError::Usage(format!("there is no structure `{name}`; there are {}", names.join(", ")))
        })
    };
    names.iter().map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rays::{NAMES, make, verdict::judge};
    use crate::truth::Tree;

    /// Ours are never wrong; single precision may be, at the very edge of a triangle.
    #[test]
    fn structures_answer_as_the_truth_does() {
        for name in ["sphere1k", "gyroid2k", "terrain500"] {
            let world = World::named(name).unwrap();
            let sets = make(&world, &Tree::new(&world.mesh), 48, &NAMES.map(str::to_owned));
            for (place, structure) in all().into_iter().enumerate() {
                let built = (structure.build)(&world).unwrap();
                let ours = place < super::super::ours::all().len();
                for set in &sets {
                    let v = judge(&world, set, &*built);
                    let (wrong, most) =
                        (v.cases.len() + v.missed + v.false_hits + v.wrong, v.error.quantile(1.0));
                    let fine = if ours { wrong == 0 && most < 6e-8 } else { wrong <= 4 && most < 1e-3 };
                    assert!(fine, "{} on {name}, {}: {most:e}, {:?}", structure.name, set.name, v.cases);
                }
            }
        }
    }

    #[test]
    fn names_are_looked_up() {
        let names = ["bvh", "list"].map(str::to_owned);
        assert_eq!(chosen(&names).unwrap().iter().map(|s| s.name).collect::<Vec<_>>(), names);
        assert_eq!(chosen(&[]).unwrap().len(), all().len());
        assert!(chosen(&["octree".to_owned()]).err().unwrap().report().contains("kd-sah"));
    }
}
