//! A6T3, A6T4: which plain materials a textured surface is made of, and how much of each.

use super::{Image, Pattern};
use a1_ray_casting::{Mixture, Part, World};
use common::geometry::{Geometry, Surface};
use common::picture::PictureError;
use common::scene::{ImageTexture, Material, PhongMaterial, Position, Scene};
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

    /// The materials that are left when all blends at a point have been followed, with their
    /// weights, all above zero. A blend is worked out when all that contain it have been: they
    /// have higher indices. So each is worked out once, however many paths lead to it.
    fn weights(&self, surface: &Surface) -> Vec<(&Leaf, f64)> {
        let mut weights = Vec::new();
        // Indices with the bits of a weight, since only those have an order that is total.
        let mut waiting = BinaryHeap::from([(surface.material, 1f64.to_bits())]);
        while let Some((index, bits)) = waiting.pop() {
            let mut weight = f64::from_bits(bits);
            while let Some((_, more)) = pop_same(&mut waiting, index) {
                weight += f64::from_bits(more);
            }
            match &self.textures[index as usize] {
                Texture::Leaf(leaf) => weights.push((leaf, weight)),
                Texture::Solid { pattern, children: [first, second] } => {
                    let value = pattern.value(surface.point);
                    for (child, share) in [(first, weight * value), (second, weight * (1.0 - value))] {
                        // What single precision takes for nothing is nothing.
                        if share as f32 > 0.0 {
                            waiting.push((*child, share.to_bits()));
                        }
                    }
                }
            }
        }
        weights
    }
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

    fn at(&self, surface: &Surface) -> Mixture<'_> {
        if let Some(material) = self.plain(surface.material) {
            return Mixture::Plain(material);
        }
        let weights = self.weights(surface);
        if let [(Leaf { plain, image: None }, _)] = weights[..] {
            return Mixture::Plain(plain);
        }
        let uv = OnceCell::new();
        let material = |leaf: &Leaf| match &leaf.image {
            None => leaf.plain.clone(),
            Some((image, scale)) => {
                let [u, v] = *uv.get_or_init(|| self.geometry.uv(surface));
                PhongMaterial { diffuse: image.at(u * scale[0], v * scale[1]), ..leaf.plain.clone() }
            }
        };
        let part = |(leaf, weight)| Part { weight: weight as f32, material: material(leaf) };
        Mixture::Blend(weights.into_iter().map(part).collect())
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
