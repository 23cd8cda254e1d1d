//! Materials at a point: which plain surfaces a texture blends there, and with which weights.

mod image;
mod mixture;
mod noise;
mod solid;

pub use mixture::Mixture;
pub(crate) use mixture::{Glass, Medium};

use crate::shape::Uv;
use crate::{OracleError, Surface};
use common::math::DVec3;
use common::scene::{Material, Scene};
use image::Image;
use solid::Solid;

/// The materials of a scene, by their number in the file.
#[derive(Clone, Debug)]
pub(crate) struct Materials {
    list: Vec<Entry>,
}

#[derive(Clone, Debug)]
enum Entry {
    Plain(Surface),
    /// A plain surface whose diffuse colour comes from a picture.
    Pictured(Surface, Image),
    Solid(Solid),
}

impl Materials {
    /// Takes over all materials, and reads the pictures that they name.
    pub fn new(scene: &Scene) -> Result<Self, OracleError> {
        Ok(Self { list: scene.materials.iter().map(Entry::new).collect::<Result<_, _>>()? })
    }

    /// Whether a material, or any that it blends, gives light of its own.
    pub fn emits(&self, number: u32) -> bool {
        let mut pending = vec![number];
        while let Some(number) = pending.pop() {
            match &self.list[number as usize] {
                Entry::Plain(surface) | Entry::Pictured(surface, _) => {
                    if surface.emissive != DVec3::ZERO {
                        return true;
                    }
                }
                Entry::Solid(solid) => pending.extend(solid.children),
            }
        }
        false
    }

    /// What material `number`, which must exist, is at a world-space `point`; `uv` is asked for where a picture is.
    ///
    /// Weights flow from each texture to the two materials below it. Children stand before
    /// their texture, so that one pass from the top down distributes them all, also where a
    /// material is reached on several ways.
    pub fn at(&self, number: u32, point: DVec3, uv: impl Fn() -> Uv) -> Mixture {
        let mut weights = vec![0.0; number as usize + 1];
        weights[number as usize] = 1.0;
        let mut mixture = Mixture::default();
        for index in (0..weights.len()).rev() {
            let weight = weights[index];
            if weight == 0.0 {
                continue;
            }
            match &self.list[index] {
                Entry::Plain(surface) => mixture.add(weight, surface.clone()),
                Entry::Pictured(surface, image) => {
                    mixture.add(weight, Surface { diffuse: image.at(uv()), ..surface.clone() });
                }
                Entry::Solid(solid) => {
                    let part = solid.first_part(point);
                    let [first, second] = solid.children.map(|child| child as usize);
                    weights[first] += weight * part;
                    weights[second] += weight * (1.0 - part);
                }
            }
        }
        mixture
    }
}

impl Entry {
    fn new(material: &Material) -> Result<Self, OracleError> {
        Ok(match material {
            Material::Solid(texture) => Self::Solid(Solid::new(texture)),
            Material::Phong(plain) => match &plain.image {
                None => Self::Plain(Surface::new(plain)),
                Some(texture) => {
                    let image = Image::new(texture).map_err(|e| OracleError::Picture(e.to_string()))?;
                    Self::Pictured(Surface::new(plain), image)
                }
            },
        })
    }
}
