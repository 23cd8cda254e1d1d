//! The scene prepared for tracing: transforms composed and baked, one flat list of primitives.
//!
//! A *primitive* is one sphere, one plane or one triangle. Primitives are numbered in file
//! order; the number ([`Hit::primitive`]) breaks ties between equal t, so that every structure
//! names the same one. Corners of triangles are taken to world space in `f64` and rounded to
//! `f32` once, so shared corners stay shared; spheres under similarities and planes under any
//! map stay what they are; only a sphere under a general map keeps its matrix.

mod abreast;
mod body;
mod build;
mod facet;
mod hit;
mod hollow;
mod placed;
mod smooth;
mod surface;
#[cfg(test)]
mod tests;
mod uv;

pub use abreast::{Abreast, Round};
pub use body::Body;
pub use build::GeometryError;
pub use hit::{Hit, hit_triangle, hit_triangle_with, hit_within};
pub use placed::PlacedMesh;
pub use smooth::facing;
pub use surface::{Departure, Surface};

use crate::counters::Counters;
use crate::math::{Bounds, Interval, Vec3};
use crate::ray::Ray;
use crate::shape::ExactRay;
use crate::shape::ellipsoid::Ellipsoid;
use crate::shape::plane::{self, Plane};
use crate::shape::sphere::{self, Sphere};
use facet::Facet;
use smooth::Smooth;
use std::sync::OnceLock;
use uv::UvMap;

/// A finite primitive that is not a triangle.
#[derive(Clone, Debug)]
pub struct Solid {
    /// Its number.
    pub primitive: u32,
    /// Its geometry in world space.
    pub shape: SolidShape,
    /// Its box: exact for a sphere that stands under no transform, else the box around the
    /// eight transformed corners of its own box, as the course's grid wants it.
    pub bounds: Bounds,
    /// Whether it stands under a `Transform`, even one that does nothing.
    pub transformed: bool,
}

/// The kinds of [`Solid`].
#[derive(Clone, Debug)]
pub enum SolidShape {
    /// A sphere in world space.
    Sphere(Sphere),
    /// A sphere under a general affine map.
    Ellipsoid(Box<Ellipsoid>),
}

/// A plane or disc with its number.
#[derive(Clone, Debug)]
pub struct Sheet {
    /// Its number.
    pub primitive: u32,
    /// Its geometry in world space.
    pub plane: Plane,
}

/// A run of primitives that came from one shape of the file.
#[derive(Clone, Debug)]
pub(crate) struct Run {
    /// Number of the first primitive.
    pub first: u32,
    /// Position of the first in the array of its kind.
    pub start: u32,
    /// Which array.
    pub kind: RunKind,
    /// Index into the scene's materials.
    pub material: u32,
    /// Normals to interpolate, if it is a smooth mesh.
    pub smooth: Option<Box<Smooth>>,
    /// Where pictures go on it, if its material has any.
    pub uv: Option<Box<UvMap>>,
    /// The mesh that it is a copy of, if it is one.
    pub placed: Option<Box<PlacedMesh>>,
    /// The body that it bounds if it is a mesh, once someone has asked.
    pub body: OnceLock<Option<Bounds>>,
    /// Whether nothing else is in the body that it bounds, once someone has asked.
    pub hollow: OnceLock<bool>,
}

/// The arrays that primitives are kept in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum RunKind {
    Triangle,
    Solid,
    Sheet,
}

/// As many runs are looked at all at once.
const FEW_RUNS: usize = 16;

/// Among fewer a search is as soon done.
const FEWER_RUNS: usize = 4;

/// All primitives of a scene in world space.
#[derive(Clone, Debug, Default)]
pub struct Geometry {
    pub(crate) triangles: Vec<[Vec3; 3]>,
    pub(crate) triangle_numbers: Vec<u32>,
    /// What surface points want to know of each triangle, worked out beforehand if there are few.
    pub(crate) facets: Vec<Facet>,
    pub(crate) solids: Vec<Solid>,
    pub(crate) sheets: Vec<Sheet>,
    pub(crate) runs: Vec<Run>,
    /// The first primitive of each run if they are few; of runs that there are not, none.
    pub(crate) first_of_few: Option<[u32; FEW_RUNS]>,
    pub(crate) bounds: Option<Bounds>,
}

impl Geometry {
    /// Corners of every triangle, in order of their numbers.
    pub fn triangles(&self) -> &[[Vec3; 3]] {
        &self.triangles
    }

    /// The number of each of [`Geometry::triangles`]; increasing.
    pub fn triangle_numbers(&self) -> &[u32] {
        &self.triangle_numbers
    }

    /// Spheres and ellipsoids.
    pub fn solids(&self) -> &[Solid] {
        &self.solids
    }

    /// Planes and discs; they belong to no box.
    pub fn sheets(&self) -> &[Sheet] {
        &self.sheets
    }

    /// How many primitives there are of all kinds.
    pub fn len(&self) -> usize {
        self.triangles.len() + self.solids.len() + self.sheets.len()
    }

    /// Whether there is nothing to hit.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The box of the finite primitives; `None` if there are none.
    pub fn bounds(&self) -> Option<Bounds> {
        self.bounds
    }

    /// Tests one of [`Geometry::solids`].
    #[inline]
    pub fn hit_solid(&self, index: usize, ray: &ExactRay, interval: Interval) -> Option<Hit> {
        let solid = &self.solids[index];
        let [near, far] = match &solid.shape {
            SolidShape::Sphere(s) => sphere::intersect(ray, s)?,
            SolidShape::Ellipsoid(e) => e.intersect(ray)?,
        };
        let t = [near as f32, far as f32].into_iter().find(|&t| interval.contains(t))?;
        Some(Hit { t, primitive: solid.primitive, u: 0.0, v: 0.0 })
    }

    /// Tests one of [`Geometry::sheets`].
    #[inline]
    pub fn hit_sheet(&self, index: usize, ray: &ExactRay, interval: Interval) -> Option<Hit> {
        let sheet = &self.sheets[index];
        let t = plane::intersect(ray, &sheet.plane)? as f32;
        interval.contains(t).then_some(Hit { t, primitive: sheet.primitive, u: 0.0, v: 0.0 })
    }

    /// The first hit of all planes and discs. Structures ask it before they ask their cells or
    /// nodes, since the answer can end the search early.
    #[inline]
    pub fn nearest_sheet(&self, ray: &Ray, interval: Interval, counters: &mut Counters) -> Option<Hit> {
        // Few scenes have any, and then the ray need not be widened.
        if self.sheets.is_empty() {
            return None;
        }
        let exact = ExactRay::new(ray);
        let hits = self.sheets_before(ray).filter_map(|i| {
            counters.intersections += 1;
            self.hit_sheet(i, &exact, interval)
        });
        hits.reduce(|best, hit| if hit.precedes(Some(&best)) { hit } else { best })
    }

    /// All planes and discs but the one that a ray leaves.
    #[inline]
    fn sheets_before(&self, ray: &Ray) -> impl Iterator<Item = usize> {
        let home = ray.home;
        (0..self.sheets.len()).filter(move |i| self.sheets[*i].primitive != home)
    }

    /// Whether any plane or disc is hit.
    #[inline]
    pub fn any_sheet(&self, ray: &Ray, interval: Interval, counters: &mut Counters) -> bool {
        if self.sheets.is_empty() {
            return false;
        }
        let exact = ExactRay::new(ray);
        self.sheets_before(ray).any(|i| {
            counters.intersections += 1;
            self.hit_sheet(i, &exact, interval).is_some()
        })
    }

    /// The better of `best` and the first hit of some of [`Geometry::solids`].
    #[inline]
    pub fn nearest_solid(
        &self,
        indices: impl IntoIterator<Item = u32>,
        ray: &ExactRay,
        interval: Interval,
        best: Option<Hit>,
        counters: &mut Counters,
    ) -> Option<Hit> {
        indices.into_iter().fold(best, |best, i| {
            counters.intersections += 1;
            let hit = self.hit_solid(i as usize, ray, interval);
            hit.filter(|h| h.precedes(best.as_ref())).or(best)
        })
    }

    /// Whether any of some of [`Geometry::solids`] is hit.
    #[inline]
    pub fn any_solid(
        &self,
        indices: impl IntoIterator<Item = u32>,
        ray: &ExactRay,
        interval: Interval,
        counters: &mut Counters,
    ) -> bool {
        indices.into_iter().any(|i| {
            counters.intersections += 1;
            self.hit_solid(i as usize, ray, interval).is_some()
        })
    }

    /// Index of the run that a primitive belongs to.
    #[inline(always)]
    fn run_of(&self, primitive: u32) -> usize {
        match &self.first_of_few {
            // Counted without a branch: which run it is nobody can guess.
            Some(first) => first.iter().map(|first| u32::from(*first <= primitive)).sum::<u32>() as usize - 1,
            None => self.runs.partition_point(|r| r.first <= primitive) - 1,
        }
    }

    /// Where a primitive is kept: its run and its position in the array of its kind.
    #[inline(always)]
    pub(crate) fn locate(&self, primitive: u32) -> (&Run, usize) {
        let run = &self.runs[self.run_of(primitive)];
        (run, (run.start + primitive - run.first) as usize)
    }

    /// Index into the scene's materials.
    pub fn material(&self, primitive: u32) -> u32 {
        self.locate(primitive).0.material
    }
}
