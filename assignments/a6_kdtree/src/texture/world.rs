//! A6T3, A6T4: which plain materials a textured surface is made of, and how much of each.

use super::{Image, Pattern};
use a1_ray_casting::{Mixture, Part, World};
use common::geometry::{Geometry, Surface};
use common::math::DVec3;
use common::picture::PictureError;
use common::scene::{ImageTexture, Material, PhongMaterial, Position, Scene};
use std::borrow::Cow;
use std::cell::OnceCell;
use std::collections::{BinaryHeap, HashMap};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A picture that cannot be used as a texture.
#[derive(Debug, thiserror::Error)]
#[error("{}:{}:{}: this `ImageTexture` cannot be used", file.display(), position.line, position.column)]
pub struct TextureError {
    /// The scene file.
    pub file: PathBuf,
    /// Where the texture stands in it.
    pub position: Position,
    /// What is the matter with the picture.
    pub source: PictureError,
}

/// A scene with its textures made ready.
pub struct TexturedScene<'a> {
    scene: &'a Scene,
    geometry: &'a Geometry,
    /// What becomes of each material at a point.
    textures: Vec<Texture>,
    /// Every picture once.
    images: Vec<Arc<Image>>,
}

/// What becomes of a material at a point.
enum Texture {
    /// It is no blend.
    Leaf(Leaf),
    /// A blend of two earlier ones.
    Solid { pattern: Pattern, children: [u32; 2] },
}

/// A material that is no blend.
struct Leaf {
    plain: PhongMaterial,
    /// A picture that replaces its colour, and how many stand side by side along u and v.
    image: Option<(Arc<Image>, [f64; 2])>,
}

/// Where the way down from a material ends.
enum Down<'s> {
    /// At one that is no blend, with its index and weight.
    Leaf(u32, &'s Leaf, f64),
    /// At a blend of two that are both something, with their weights.
    Parts([(u32, f64); 2]),
}

impl<'a> TexturedScene<'a> {
    /// Reads the pictures that the materials name, each file once. `geometry` is the scene's;
    /// `file` is where the scene was read from, for error messages.
    ///
    /// # Errors
    /// If a picture cannot be read.
    pub fn load(scene: &'a Scene, geometry: &'a Geometry, file: &Path) -> Result<Self, TextureError> {
        let mut library = Library::default();
        let textures = scene.materials.iter().map(|material| {
            library.texture(material).map_err(|(position, source)| TextureError {
                file: file.to_owned(),
                position,
                source,
            })
        });
        let textures = textures.collect::<Result<Vec<_>, _>>()?;
        Ok(Self { scene, geometry, textures, images: library.by_file.into_values().collect() })
    }

    /// What was made ready, for `-stats`; `None` if the scene has no textures.
    pub fn describe(&self) -> Option<String> {
        let solid = self.textures.iter().filter(|t| matches!(t, Texture::Solid { .. })).count();
        let kib = self.images.iter().map(|image| image.bytes()).sum::<usize>().div_ceil(1024);
        let pictures = self.images.len();
        (solid + pictures > 0)
            .then(|| format!("textures: {solid} solid, {pictures} picture files of {kib} KiB"))
    }

    /// The materials that are left when all blends at a point have been followed, from these on,
    /// with their weights, all above zero. A blend is worked out when all that contain it have
    /// been: they have higher indices. So each is worked out once, however many paths lead to it.
    fn weights(&self, surface: &Surface, from: [(u32, f64); 2]) -> Vec<(&Leaf, f64)> {
        let mut weights = Vec::new();
        // Indices with the bits of a weight, since only those have an order that is total.
        let mut waiting = BinaryHeap::from(from.map(|(index, weight)| (index, weight.to_bits())));
        while let Some((index, bits)) = waiting.pop() {
            let mut weight = f64::from_bits(bits);
            while let Some((_, more)) = pop_same(&mut waiting, index) {
                weight += f64::from_bits(more);
            }
            match &self.textures[index as usize] {
                Texture::Leaf(leaf) => weights.push((leaf, weight)),
                Texture::Solid { pattern, children } => {
                    let parts = parts(weight, pattern.value(surface.point), *children);
                    waiting
                        .extend(parts.into_iter().flatten().map(|(child, share)| (child, share.to_bits())));
                }
            }
        }
        weights
    }

    /// Goes down as long as one part is all: nothing need be kept in order then.
    #[inline]
    fn descend(&self, mut index: u32, point: DVec3) -> Down<'_> {
        let mut weight = 1.0;
        loop {
            let (pattern, children) = match &self.textures[index as usize] {
                Texture::Leaf(leaf) => return Down::Leaf(index, leaf, weight),
                Texture::Solid { pattern, children } => (pattern, *children),
            };
            match parts(weight, pattern.value(point), children) {
                [Some(first), Some(second)] => return Down::Parts([first, second]),
                [first, second] => (index, weight) = first.or(second).unwrap_or((children[0], weight)),
            }
        }
    }

    /// What becomes of materials with these weights at a point.
    fn mixture<'s>(&'s self, surface: &Surface, weights: &[(&'s Leaf, f64)]) -> Mixture<'s> {
        if let [(Leaf { plain, image: None }, _)] = weights {
            return Mixture::Plain(plain);
        }
        let uv = OnceCell::new();
        let material = |leaf: &'s Leaf| match &leaf.image {
            None => Cow::Borrowed(&leaf.plain),
            Some((image, scale)) => {
                let [u, v] = *uv.get_or_init(|| self.geometry.uv(surface));
                let diffuse = image.at(u * scale[0], v * scale[1]);
                Cow::Owned(PhongMaterial { diffuse, ..leaf.plain.clone() })
            }
        };
        let part =
            |&(leaf, weight): &(&'s Leaf, f64)| Part { weight: weight as f32, material: material(leaf) };
        Mixture::Blend(weights.iter().map(part).collect())
    }
}

/// The two parts of a blend with their weights, as far as they are something.
fn parts(weight: f64, value: f64, [first, second]: [u32; 2]) -> [Option<(u32, f64)>; 2] {
    let parts = [(first, weight * value), (second, weight * (1.0 - value))];
    // What single precision takes for nothing is nothing.
    parts.map(|(child, share)| (share as f32 > 0.0).then_some((child, share)))
}

/// Takes the highest entry if it is of this index.
fn pop_same(waiting: &mut BinaryHeap<(u32, u64)>, index: u32) -> Option<(u32, u64)> {
    let same = waiting.peek().is_some_and(|(next, _)| *next == index);
    if same { waiting.pop() } else { None }
}

impl World for TexturedScene<'_> {
    fn as_scene(&self) -> &Scene {
        self.scene
    }

    fn plain(&self, index: u32) -> Option<&PhongMaterial> {
        match &self.textures[index as usize] {
            Texture::Leaf(Leaf { plain, image: None }) => Some(plain),
            _ => None,
        }
    }

    #[inline]
    fn leaf(&self, material: u32, point: DVec3) -> Option<u32> {
        match self.descend(material, point) {
            Down::Leaf(index, Leaf { image: None, .. }, _) => Some(index),
            _ => None,
        }
    }

    fn at(&self, surface: &Surface) -> Mixture<'_> {
        let from = match self.descend(surface.material, surface.point) {
            Down::Leaf(_, leaf, weight) => return self.mixture(surface, &[(leaf, weight)]),
            Down::Parts(from) => from,
        };
        // The higher index comes first in any case.
        let [low, high] = if from[0].0 < from[1].0 { from } else { [from[1], from[0]] };
        match [high, low].map(|(index, _)| &self.textures[index as usize]) {
            [Texture::Leaf(first), Texture::Leaf(second)] if low.0 < high.0 => {
                self.mixture(surface, &[(first, high.1), (second, low.1)])
            }
            _ => self.mixture(surface, &self.weights(surface, from)),
        }
    }
}

/// Pictures read so far, by their one true name.
#[derive(Default)]
struct Library {
    by_file: HashMap<PathBuf, Arc<Image>>,
}

impl Library {
    fn texture(&mut self, material: &Material) -> Result<Texture, (Position, PictureError)> {
        Ok(match material {
            Material::Solid(solid) => {
                Texture::Solid { pattern: Pattern::new(solid), children: solid.children }
            }
            Material::Phong(plain) => {
                let image = plain.image.as_ref().map(|texture| self.scaled(texture)).transpose()?;
                Texture::Leaf(Leaf { plain: PhongMaterial { image: None, ..plain.clone() }, image })
            }
        })
    }

    fn scaled(&mut self, texture: &ImageTexture) -> Result<(Arc<Image>, [f64; 2]), (Position, PictureError)> {
        let image = self.image(&texture.file).map_err(|source| (texture.position, source))?;
        Ok((image, texture.scale.map(f64::from)))
    }

    fn image(&mut self, file: &Path) -> Result<Arc<Image>, PictureError> {
        let name = file.canonicalize().unwrap_or_else(|_| file.to_owned());
        if let Some(image) = self.by_file.get(&name) {
            return Ok(Arc::clone(image));
        }
        let image = Arc::new(Image::read(file)?);
        self.by_file.insert(name, Arc::clone(&image));
        Ok(image)
    }
}
