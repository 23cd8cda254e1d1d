//! How paths leave surfaces, material by material.

use super::places::Met;
use super::{Found, Path, PathTracer, Scratch};
use crate::bsdf::Bsdf;
use common::math::{DVec3, Vec3};
use common::scene::PhongMaterial;

/// How paths leave the surfaces of a material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Leaving {
    /// Eight at a time, by the matt lobe, which has this colour.
    Matt(Vec3),
    /// Eight at a time, mirrored or refracted.
    Smooth {
        /// Share of light that is sent on.
        color: Vec3,
        /// Index of refraction of glass; 0 for mirrors.
        index: f32,
        /// Light lost on the way through the body.
        absorption: Vec3,
    },
    /// One by one, since several things may happen, or light is given off.
    Alone,
    /// Another material at every point.
    Textured,
}

impl Leaving {
    /// Of a material; `None` if it is textured.
    pub fn of(material: Option<&PhongMaterial>) -> Self {
        let Some(material) = material else { return Self::Textured };
        let bsdf = Bsdf::new(material);
        if material.emissive != Vec3::ZERO {
            return Self::Alone;
        }
        if let Some(color) = bsdf.matt_color() {
            return Self::Matt(color);
        }
        let absorption = material.absorption;
        let smooth = bsdf.smooth_color().filter(|(_, index)| index.is_none_or(|index| index > 0.0));
        smooth.map_or(Self::Alone, |(color, index)| Self::Smooth {
            color,
            index: index.unwrap_or(0.0),
            absorption,
        })
    }
}

/// What a path sees where it meets a surface.
pub(super) struct Look {
    /// 1 if the path comes from the side of the surface's normal, else −1.
    pub side: f32,
    /// Unit normal to shade with, on the path's side.
    pub normal: Vec3,
    /// Where the ray met it.
    pub t: f32,
}

impl PathTracer<'_> {
    /// How paths leave a point of a material.
    #[inline(always)]
    pub(super) fn leaving_at(&self, material: u32, point: impl FnOnce() -> DVec3) -> Leaving {
        let leaving = self.leaving[material as usize];
        if leaving == Leaving::Textured
            && let Some(leaf) = self.world.leaf(material, point())
        {
            return self.leaving[leaf as usize];
        }
        leaving
    }

    /// Looks at a surface that is left with others: takes what the way through the body costs, and
    /// tells what was found there. Returns the colour and the index of refraction; `None`, and
    /// nothing is done, for others.
    #[inline(always)]
    pub(super) fn take_lobe(
        &self,
        path: &mut Path,
        leaving: &Leaving,
        look: &Look,
        generation: u32,
        found: &mut [Found],
    ) -> Option<(Vec3, f32)> {
        let (color, index) = match *leaving {
            Leaving::Matt(color) => (color, 0.0),
            Leaving::Smooth { color, index, absorption } => {
                if look.side < 0.0 && index > 0.0 && absorption != Vec3::ZERO {
                    path.throughput *= (absorption * -look.t).exp();
                }
                (color, index)
            }
            Leaving::Alone | Leaving::Textured => return None,
        };
        if generation == 0 {
            let found = &mut found[path.slot as usize];
            (found.albedo, found.normal, found.depth) = (color, look.normal, look.t);
        }
        Some((color, index))
    }

    /// Puts a surface in line with others that are left in the same way; false if it is to be looked
    /// at alone. `t` is where the ray met it.
    #[inline(always)]
    pub(super) fn put_in_line(
        &self,
        scratch: &mut Scratch,
        mut met: Met,
        material: u32,
        t: f32,
        generation: u32,
        found: &mut [Found],
    ) -> bool {
        let leaving = self.leaving_at(material, || met.point);
        let look = Look { side: met.side, normal: met.normal, t };
        let path = &mut scratch.paths[met.path as usize];
        let Some(lobe) = self.take_lobe(path, &leaving, &look, generation, found) else { return false };
        (met.color, met.index) = lobe;
        if self.sends_on(generation) {
            let is_matt = matches!(leaving, Leaving::Matt(_));
            (if is_matt { &mut scratch.matts } else { &mut scratch.smooth }).push(&met);
        }
        true
    }
}
