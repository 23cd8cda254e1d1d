//! Before, after, and where they differ: the picture of `-render`, drawn by our own tracer.

use crate::measure::Tree;
use a1_ray_casting::{CastArgs, Layer, Sight, Studio};
use a4_whitted::{WhittedArgs, WhittedColor};
use a6_kdtree::bvh::Bvh;
use a6_kdtree::picture::heat_color;
use common::accel::Accel;
use common::camera::Camera;
use common::cli::{self, AppError};
use common::counters::Counters;
use common::geometry::Geometry;
use common::math::{DVec3, Vec3};
use common::mesh::Mesh;
use common::picture::{Film, Size};
use common::scene;
use std::sync::Arc;

/// Behind the meshes: none of the colours of distances.
const BACKGROUND: Vec3 = Vec3::new(0.16, 0.2, 0.28);
/// Steps of the ramp of colours, more than a film can tell apart.
const STEPS: f64 = 1e6;
/// Half the camera's angle of view.
const HALF_ANGLE: f64 = 15.0;
/// How much further off the camera stands than it must.
const MARGIN: f64 = 1.04;
/// What a camera looks along that stands a little above, in front, and to the right.
const VIEW: DVec3 = DVec3::new(-0.5, -0.55, -1.0);

/// A mesh, and the camera that it and its successors are seen by.
pub struct Exhibition {
    studio: Studio,
    args: WhittedArgs,
    diagonal: f64,
    hottest: Option<f64>,
    before: Film,
}

impl Exhibition {
    /// Size of the whole picture: three parts of that size side by side.
    ///
    /// # Errors
    /// If it is too large.
    pub fn size(part: Size) -> Result<Size, AppError> {
        Ok(Size::new(3 * i64::from(part.width()), i64::from(part.height()))?)
    }

    /// Sets a mesh up; `cast` gives the size of each part and the threads. `hottest` is the
    /// distance that is white, as a share of the diagonal of the mesh's box.
    ///
    /// # Errors
    /// If the size is impossible, or the mesh lies beyond the range of single precision.
    pub fn new(mesh: &Mesh, cast: &CastArgs, hottest: Option<f64>) -> Result<Self, AppError> {
        let mut args = plain_shading()?;
        args.phong.diffuse.cast.general = cast.general.clone();
        let studio = studio(mesh, None, cast.size()?)?;
        let diagonal = studio.geometry.bounds().map_or(0.0, |b| b.size().as_dvec3().length());
        let before = shaded(&studio, &args);
        Ok(Self { studio, args, diagonal, hottest, before })
    }

    /// The picture of a simplified mesh, and what its colours mean.
    ///
    /// # Errors
    /// If the mesh lies beyond the range of single precision.
    pub fn film(&self, mesh: &Mesh) -> Result<(Film, String), AppError> {
        let after = shaded(&studio(mesh, Some(self.studio.camera), self.studio.size)?, &self.args);
        let tree = Tree::of_mesh(mesh);
        let layer = Distance { tree: &tree, diagonal: self.diagonal, hottest: self.hottest };
        let accel = Bvh::new(&self.studio.geometry);
        let (mut heat, note) = render(&self.studio, &self.args, &accel, &layer);
        let width = self.studio.size.width();
        let film = Film::from_fn(Self::size(self.studio.size)?, |x, y| match x / width {
            0 => self.before.get(x, y),
            1 => after.get(x - width, y),
            _ => heat.row_mut(y)[(x - 2 * width) as usize],
        });
        Ok((film, note.unwrap_or_default()))
    }
}

/// Assignment 4 without shadows or mirrors; triangles are seen from behind, too.
fn plain_shading() -> Result<WhittedArgs, AppError> {
    let words = "a4_whitted -input unused -output unused -shade_back";
    let parsed = cli::try_parse_from::<a4_whitted::Program>(words.split(' '));
    Ok(parsed.map_err(|stop| AppError::Usage(stop.text))?.options.args)
}

/// The mesh before a camera; one that sees all of it, if none is given.
fn studio(mesh: &Mesh, camera: Option<Camera>, size: Size) -> Result<Studio, AppError> {
    let shared = Arc::new(Mesh { uvs: Vec::new(), ..mesh.clone() });
    let scene = scene::parse_str("-render", &stage(mesh), &mut Arc::clone(&shared))?;
    let geometry = Geometry::build(&scene)?;
    let camera = camera.unwrap_or_else(|| Camera::new(&scene.camera));
    Ok(Studio { scene, geometry, camera, size })
}

/// A scene of one mesh whose camera sees all of it.
fn stage(mesh: &Mesh) -> String {
    let eye = eye(mesh);
    let numbers = |v: DVec3| format!("{:e} {:e} {:e}", v.x, v.y, v.z);
    format!(
        "PerspectiveCamera {{ center {} direction {} up 0 1 0 angle {} }}
        Background {{ color {} ambientLight 0.25 0.25 0.25 }}
        Lights {{ numLights 1 DirectionalLight {{ direction -0.3 -1 -0.8 color 0.75 0.75 0.75 }} }}
        Materials {{ numMaterials 1 PhongMaterial {{ diffuseColor 0.85 0.8 0.7 }} }}
        Group {{ numObjects 1 MaterialIndex 0 TriangleMesh {{ obj_file mesh }} }}",
        numbers(eye),
        numbers(VIEW),
        2.0 * HALF_ANGLE,
        numbers(BACKGROUND.as_dvec3())
    )
}

/// Where the camera stands, looking along [`VIEW`] at the middle of the mesh's box: as near as all
/// vertices allow, and a little further.
fn eye(mesh: &Mesh) -> DVec3 {
    let used = || mesh.triangles.iter().flatten().map(|&v| mesh.positions[v as usize].as_dvec3());
    let first = used().next().unwrap_or_default();
    let (low, high) = used().fold((first, first), |(low, high), p| (low.min(p), high.max(p)));
    let (center, ahead) = ((low + high) / 2.0, VIEW.normalize());
    let right = ahead.cross(DVec3::Y).normalize();
    let up = right.cross(ahead);
    let spread = HALF_ANGLE.to_radians().tan();
    let needed = |p: DVec3| {
        let aside = right.dot(p - center).abs().max(up.dot(p - center).abs());
        aside / spread - ahead.dot(p - center)
    };
    let away = used().map(needed).fold(0.0, f64::max) * MARGIN;
    center - ahead * if away > 0.0 { away } else { 1.0 }
}

/// The mesh of a studio in flat shades, so that every triangle can be seen.
fn shaded(studio: &Studio, args: &WhittedArgs) -> Film {
    let accel = Bvh::new(&studio.geometry);
    let layer = WhittedColor { whitted: args.whitted(&studio.scene, &accel) };
    render(studio, args, &accel, &layer).0
}

fn render(
    studio: &Studio,
    args: &WhittedArgs,
    accel: &dyn Accel,
    layer: &dyn Layer,
) -> (Film, Option<String>) {
    let (mut films, _) = studio.render(args.cast(), accel, &[layer]);
    let mut film = films.remove(0);
    let note = layer.develop(&mut film);
    (film, note)
}

/// How far what is seen is from a mesh, in colours.
struct Distance<'a> {
    tree: &'a Tree,
    diagonal: f64,
    hottest: Option<f64>,
}

impl Layer for Distance<'_> {
    /// Until the picture is developed, a pixel holds the distance and whether there is one.
    fn value(&self, sight: &Sight, _: &mut Counters) -> Vec3 {
        let nearest = sight.surface().and_then(|surface| self.tree.nearest(surface.point, None));
        nearest.map_or(Vec3::ZERO, |n| Vec3::new((n.distance() / self.diagonal) as f32, 1.0, 0.0))
    }

    fn develop(&self, film: &mut Film) -> Option<String> {
        let largest = film.pixels().iter().map(|p| f64::from(p.x)).fold(0.0, f64::max);
        let white = self.hottest.unwrap_or(largest).max(f64::MIN_POSITIVE);
        for pixel in film.pixels_mut() {
            let step = (f64::from(pixel.x) / white * STEPS).min(STEPS) as u64;
            *pixel = if pixel.y > 0.0 { heat_color(step, STEPS as u64) } else { BACKGROUND };
        }
        Some(format!(
            "colours of distance: black 0, white {white:.3e} of the diagonal or more; largest seen {largest:.3e}"
        ))
    }
}
