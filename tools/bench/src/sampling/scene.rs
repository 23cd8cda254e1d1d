//! What is looked at: functions whose pictures are known, small scenes made for one effect each,
//! and scene files.

use crate::world::scene_with;
use a1_ray_casting::{Sight, Studio, World};
use a4_whitted::WhittedArgs;
use a6_kdtree::bvh::Bvh;
use a6_kdtree::texture::TexturedScene;
use a7_sampling::light::SoftLights;
use a7_sampling::sampler::{Pixel, Sampler};
use a7_sampling::{Exposure, Kernel, SamplingArgs, Shade, SoftWhitted, aperture::Aperture};
use common::accel::{Accel, List};
use common::camera::Camera;
use common::cli::{self, AppError};
use common::counters::Counters;
use common::geometry::Geometry;
use common::math::Vec3;
use common::mesh::Mesh;
use common::picture::Size;
use std::path::Path;
use std::sync::Arc;

/// Fewer primitives need no tree.
const FEW: usize = 16;

/// A colour as a function of the place on a screen of 2 × 2, the origin in its middle.
type Drawing = fn(f32, f32) -> Vec3;

/// A scene that is ready for pictures.
pub struct Place {
    /// What it is called in tables.
    pub name: String,
    studio: Studio,
    args: SamplingArgs,
    drawing: Option<Drawing>,
}

/// A scene under its light, with what finds hits in it.
pub struct Lit<'a> {
    place: &'a Place,
    accel: Box<dyn Accel + 'a>,
    textured: TexturedScene<'a>,
}

/// The samples of a picture: pattern, seed and filter.
pub struct Taste<'a> {
    /// Where samples lie.
    pub sampler: &'a dyn Sampler,
    /// Where they lie on lights, which are shown one sample for each of a pixel.
    pub of_lights: Box<dyn Sampler>,
    /// How they add up.
    pub kernel: Option<Kernel>,
}

/// The colour of a drawing, wherever the ray goes.
struct Drawn(Drawing);

impl Shade for Drawn {
    fn radiances(&self, sights: &[Sight], _: &[(Pixel, u32)], _: &mut Counters, radiances: &mut [Vec3]) {
        for (sight, radiance) in sights.iter().zip(radiances) {
            *radiance = (self.0)(sight.ray.origin.x, sight.ray.origin.y);
        }
    }
}

const DISC: Drawing = |x, y| if x * x + y * y < 0.49 { Vec3::new(1.0, 0.6, 0.2) } else { Vec3::splat(0.1) };
const GRADIENT: Drawing = |x, y| Vec3::new(0.5 + 0.4 * (3.0 * x).sin(), 0.5 + 0.4 * (2.0 * y).cos(), x * y);

/// Text of the scene of drawings: the screen is seen straight on, and the ball never.
const SCREEN: &str = "OrthographicCamera { center 0 0 5 direction 0 0 -1 up 0 1 0 size 2 }
    Materials { numMaterials 1 Material { } }
    Group { numObjects 1 MaterialIndex 0 Sphere { center 0 0 9 radius 1 } }";

const BOARD: &str = "PerspectiveCamera { center 0 1 0 direction 0.2 -0.3 -1 up 0 1 0 angle 50 }
    Background { color 0.5 0.7 1 ambientLight 1 1 1 }
    Materials { numMaterials 3 PhongMaterial { diffuseColor 1 1 1 } PhongMaterial { diffuseColor 0 0 0 }
        Checkerboard { Transform { Scale 1 0 1 } materialIndex 0 materialIndex 1 } }
    Group { numObjects 1 MaterialIndex 2 Plane { normal 0 1 0 offset 0 } }";

const SHADOW: &str = "PerspectiveCamera { center 0 3 6 direction 0 -0.5 -1 up 0 1 0 angle 40 }
    Background { color 0.1 0.1 0.2 }
    Lights { numLights 1 SphereLight { center 2 5 1 radius 0.8 color 0.9 0.9 0.9 } }
    Materials { numMaterials 2 PhongMaterial { diffuseColor 0.8 0.8 0.8 } PhongMaterial { diffuseColor 0.9 0.3 0.2 } }
    Group { numObjects 2 MaterialIndex 0 Plane { normal 0 1 0 offset 0 }
        MaterialIndex 1 Sphere { center 0 1 0 radius 1 } }";

const LENS: &str = "PerspectiveCamera { center 0 1 6 direction 0 -0.1 -1 up 0 1 0 angle 40 aperture 0.5 focalDistance 6 }
    Background { color 0.3 0.4 0.5 ambientLight 0.3 0.3 0.3 }
    Lights { numLights 1 DirectionalLight { direction -1 -1 -1 color 0.8 0.8 0.8 } }
    Materials { numMaterials 2 PhongMaterial { diffuseColor 0.9 0.3 0.2 } PhongMaterial { diffuseColor 0.3 0.9 0.4 } }
    Group { numObjects 3 MaterialIndex 0 Sphere { center 0 0.6 0 radius 0.7 }
        MaterialIndex 1 Sphere { center -1.6 0.6 -3 radius 0.7 } Sphere { center 1.1 0.8 2.2 radius 0.5 } }";

const FEW_THINGS: &str = "PerspectiveCamera { center 0 1.5 7 direction 0 -0.1 -1 up 0 1 0 angle 40 }
    Background { color 0.2 0.3 0.5 ambientLight 0.3 0.3 0.3 }
    Lights { numLights 1 PointLight { position 3 6 4 color 0.8 0.8 0.8 } }
    Materials { numMaterials 2 PhongMaterial { diffuseColor 0.8 0.8 0.7 } PhongMaterial { diffuseColor 0.9 0.3 0.2 } }
    Group { numObjects 4 MaterialIndex 0 Plane { normal 0 1 0 offset 0 }
        MaterialIndex 1 Sphere { center -1 0.6 0 radius 0.6 } Sphere { center 0.9 0.9 -1 radius 0.9 }
        Sphere { center 0.3 0.3 1.6 radius 0.3 } }";

/// The built-in scenes.
#[cfg(test)]
const NAMES: [&str; 6] = ["disc", "gradient", "board", "shadow", "lens", "few"];

impl Place {
    /// The built-in scene of a name, or a file, with all of its light and five bounces.
    ///
    /// # Errors
    /// If there is none, or it is no scene.
    pub fn named(name: &str, size: Size) -> Result<Self, AppError> {
        let args = flags(name, size)?;
        let (text, drawing) = match name {
            "disc" => (SCREEN, Some(DISC)),
            "gradient" => (SCREEN, Some(GRADIENT)),
            "board" => (BOARD, None),
            "shadow" => (SHADOW, None),
            "lens" => (LENS, None),
            "few" => (FEW_THINGS, None),
            file => return Self::from_file(file, args),
        };
        let scene = scene_with(text, &Arc::new(Mesh::default()))?;
        let (geometry, camera) = (Geometry::build(&scene)?, Camera::new(&scene.camera));
        Ok(Self { name: name.to_owned(), studio: Studio { scene, geometry, camera, size }, args, drawing })
    }

    fn from_file(file: &str, args: SamplingArgs) -> Result<Self, AppError> {
        let (studio, _) = Studio::open_textured(args.cast(), &[])?;
        let name = Path::new(file).file_stem().map_or(file.to_owned(), |n| n.to_string_lossy().into_owned());
        Ok(Self { name, studio, args, drawing: None })
    }

    /// The scene with a structure over it.
    ///
    /// # Errors
    /// A texture that cannot be read.
    pub fn lit(&self) -> Result<Lit<'_>, AppError> {
        let geometry = &self.studio.geometry;
        let textured = TexturedScene::load(&self.studio.scene, geometry, &self.args.cast().input)?;
        let accel: Box<dyn Accel> =
            if geometry.len() < FEW { Box::new(List::new(geometry)) } else { Box::new(Bvh::new(geometry)) };
        Ok(Lit { place: self, accel, textured })
    }
}

/// One thread, so that processor time is that of the picture alone.
fn flags(input: &str, size: Size) -> Result<SamplingArgs, AppError> {
    let (width, height) = (size.width().to_string(), size.height().to_string());
    let words = ["a7_sampling", "-input", input, "-size", &width, &height, "-output", "unused.tga"];
    let more = "-shadows -shade_back -bounces 5 -weight 0.01 -threads 1".split(' ');
    let parsed = cli::try_parse_from::<a7_sampling::Program>(words.into_iter().chain(more));
    Ok(parsed.map_err(|stop| AppError::Usage(stop.text))?.options.args)
}

impl Lit<'_> {
    /// The scene's name.
    pub fn name(&self) -> &str {
        &self.place.name
    }

    /// Size of its pictures.
    pub fn size(&self) -> Size {
        self.place.studio.size
    }

    /// Hands over everything that a picture is made of.
    pub fn with<T>(&self, taste: Taste, make: impl FnOnce(&Exposure) -> T) -> T {
        let Place { studio, args, drawing, .. } = self.place;
        let shade: Box<dyn Shade + '_> = match drawing {
            Some(drawing) => Box::new(Drawn(*drawing)),
            None => Box::new(self.light(&args.accel.grid.whitted, taste.of_lights)),
        };
        make(&Exposure {
            studio,
            cast: args.cast(),
            accel: &*self.accel,
            shade: &*shade,
            sampler: taste.sampler,
            aperture: studio.camera.lens.map(|lens| Aperture::new(lens.blades)),
            kernel: taste.kernel,
        })
    }

    fn light(&self, whitted: &WhittedArgs, sampler: Box<dyn Sampler>) -> SoftWhitted<'_> {
        let world: &dyn World = &self.textured;
        let lights = SoftLights::new(&self.place.studio.geometry, world, 1, sampler);
        let lights = (lights.extended() > 0).then_some(lights);
        SoftWhitted { whitted: whitted.whitted(&self.textured, &*self.accel), lights }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_built_in_scene_can_be_lit() {
        let size = Size::new(8, 6).unwrap();
        for name in NAMES {
            let place = Place::named(name, size).unwrap();
            assert_eq!(place.lit().unwrap().name(), name);
        }
        assert!(Place::named("nowhere.txt", size).is_err());
    }
}
