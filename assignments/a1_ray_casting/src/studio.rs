//! From a command line to pictures on disk: the frame that all ray-traced pictures are made in.

use crate::checks::{check_outputs, choose_instructions, refuse_textures};
use crate::{CastArgs, Layer, Report, Sight};
use common::accel::Accel;
use common::camera::{Camera, screen_position};
use common::cli::{self, AppError, Skip};
use common::counters::Counters;
use common::geometry::{Geometry, Hit, SolidShape};
use common::math::Vec3;
use common::picture::{Film, Size, Transfer, write};
use common::ray::Ray;
use common::scene::{self, Node, NodeKind, Scene, ShapeSpec};
use common::tiles::{Tile, TileLayers, render};
use std::path::{Path, PathBuf};

/// From this many primitives on, asking whether a tile can see any of them pays for itself.
const WORTH_CULLING: usize = 16;

/// The camera rays of one tile, which structures can follow together, and what they hit.
#[derive(Default)]
struct TileRays {
    rays: Vec<Ray>,
    hits: Vec<Option<Hit>>,
    values: Vec<Vec3>,
}

/// A layer and the file it is written to.
pub struct Picture<'a> {
    /// Where it goes; `None` renders it for its statistics only.
    pub path: Option<PathBuf>,
    /// What it shows.
    pub layer: Box<dyn Layer + 'a>,
}

/// The picture of `layer`, if there is a file for it.
pub fn picture<'a>(path: &Option<PathBuf>, layer: impl Layer + 'a) -> Option<Picture<'a>> {
    let path = Some(path.clone()?);
    Some(Picture { path, layer: Box::new(layer) })
}

/// A scene made ready for its pictures.
pub struct Studio {
    /// The scene as written.
    pub scene: Scene,
    /// The same as primitives in world space.
    pub geometry: Geometry,
    /// The scene's camera.
    pub camera: Camera,
    /// Size of all pictures.
    pub size: Size,
}

impl Studio {
    /// As [`Studio::open_textured`], for steps that draw plain materials only.
    ///
    /// # Errors
    /// Those, and a scene with textures.
    pub fn open(args: &CastArgs, outputs: &[&Path]) -> Result<(Self, Report), AppError> {
        let opened = Self::open_textured(args, outputs)?;
        refuse_textures(&opened.0.scene)?;
        Ok(opened)
    }

    /// Checks the command line, then reads and prepares the scene. Everything that can be known
    /// to fail fails here, before the first ray. The scene may have textures: it is for the
    /// caller to draw them through a [`crate::World`] that knows how.
    ///
    /// # Errors
    /// Bad sizes and ranges, unwritable `outputs`, an unreadable scene.
    pub fn open_textured(args: &CastArgs, outputs: &[&Path]) -> Result<(Self, Report), AppError> {
        let size = args.size()?;
        args.depth_layer()?;
        choose_instructions(args)?;
        check_outputs(args, outputs, size)?;
        let mut report = Report { size: Some(size), ..Report::default() };
        let sharing = args.general.skips(Skip::Shared);
        let scene = report.time("read", || scene::load_sharing(&args.input, sharing))?;
        let located = |e| AppError::Usage(format!("{}:{e}", args.input.display()));
        let geometry = report.time("prepare", || Geometry::build(&scene)).map_err(located)?;
        report.bounds = geometry.bounds();
        report.counters += prepared(&scene, &geometry);
        let camera = Camera::new(&scene.camera);
        Ok((Self { scene, geometry, camera, size }, report))
    }

    /// Renders the pictures in one pass, writes them, and prints the report if it is wanted.
    ///
    /// # Errors
    /// A picture that cannot be written.
    pub fn shoot(
        &self,
        args: &CastArgs,
        accel: &dyn Accel,
        pictures: &[Picture],
        mut report: Report,
    ) -> Result<(), AppError> {
        self.expose(args, accel, pictures, &mut report)?;
        report.print_if_wanted(args);
        Ok(())
    }

    /// Renders the pictures in one pass and writes them.
    ///
    /// # Errors
    /// A picture that cannot be written.
    pub fn expose(
        &self,
        args: &CastArgs,
        accel: &dyn Accel,
        pictures: &[Picture],
        report: &mut Report,
    ) -> Result<(), AppError> {
        let layers: Vec<&dyn Layer> = pictures.iter().map(|p| &*p.layer).collect();
        let (mut films, counters) = report.time("render", || self.render(args, accel, &layers));
        report.counters += counters;
        report.counters.pictures += layers.len() as u64;
        for (layer, film) in layers.iter().zip(&mut films) {
            let Some(note) = layer.develop(film) else { continue };
            if args.general.program.verbose {
                cli::note(&note);
            }
            report.notes.push(note);
        }
        report.time("write", || {
            let files = pictures.iter().zip(&films).filter_map(|(p, film)| Some((p.path.as_ref()?, film)));
            files.into_iter().try_for_each(|(path, film)| write(path, film, Transfer::Linear))
        })?;
        Ok(())
    }

    /// A1T1: one ray through the centre of every pixel; every layer looks at the same hit.
    pub fn render(&self, args: &CastArgs, accel: &dyn Accel, layers: &[&dyn Layer]) -> (Vec<Film>, Counters) {
        if layers.is_empty() {
            return (Vec::new(), Counters::default());
        }
        let needs_hit = layers.iter().any(|l| l.needs_hit());
        let one_by_one = layers.iter().any(|l| l.watches_work());
        let by_itself = layers.iter().any(|l| l.works_out_surfaces());
        let every_surface = !args.general.skips(Skip::Surface) && !by_itself;
        let options = args.general.tile_options("rendering");
        let rendered = render(
            self.size,
            layers.len(),
            &options,
            TileRays::default,
            |shots, tile, counters: &mut Counters, out| {
                self.aim(tile, shots);
                let search = needs_hit && !self.skips(args, tile, tile.area() as u64, counters);
                if one_by_one {
                    let search = search.then_some(every_surface);
                    return self.look_one_by_one(accel, layers, search, tile, shots, counters, out);
                }
                if search {
                    accel.nearest_many(&shots.rays, self.camera.interval, &mut shots.hits, counters);
                }
                let met = shots.rays.iter().zip(&shots.hits);
                let sights: Vec<Sight> =
                    met.map(|(ray, hit)| Sight::new(&self.geometry, *ray, *hit)).collect();
                if every_surface {
                    Sight::work_out(&sights);
                }
                shots.values.resize(sights.len(), Vec3::ZERO);
                for (i, layer) in layers.iter().enumerate() {
                    layer.values(&sights, counters, &mut shots.values);
                    tile.pixels().zip(&shots.values).for_each(|((x, y), value)| out.set(i, x, y, *value));
                }
                Sight::count(&sights, by_itself, counters);
            },
        );
        (rendered.films, rendered.counters)
    }

    /// Traces and looks at one ray of a tile after the other, so that what has been counted since
    /// was done for it. Hits are looked for if `search` is there, and their surfaces worked out
    /// unasked if it is true.
    #[expect(clippy::too_many_arguments, reason = "the second half of a closure")]
    fn look_one_by_one(
        &self,
        accel: &dyn Accel,
        layers: &[&dyn Layer],
        search: Option<bool>,
        tile: Tile,
        shots: &TileRays,
        counters: &mut Counters,
        out: &mut TileLayers,
    ) {
        for ((x, y), ray) in tile.pixels().zip(&shots.rays) {
            let work_before = counters.work();
            let hit = search.and_then(|_| accel.nearest(ray, self.camera.interval, counters));
            let mut sight = Sight::new(&self.geometry, *ray, hit);
            sight.work_before = work_before;
            let sights = std::slice::from_ref(&sight);
            if search == Some(true) {
                Sight::work_out(sights);
            }
            for (i, layer) in layers.iter().enumerate() {
                out.set(i, x, y, layer.value(&sight, counters));
            }
            Sight::count(sights, layers.iter().any(|l| l.works_out_surfaces()), counters);
        }
    }

    /// One ray through the centre of every pixel of a tile, and no hits yet.
    fn aim(&self, tile: Tile, shots: &mut TileRays) {
        let ray = |(x, y): (u32, u32)| {
            let (sx, sy) = (f64::from(x) + 0.5, f64::from(y) + 0.5);
            self.camera.ray(screen_position(self.size, sx, sy))
        };
        shots.rays.clear();
        shots.rays.extend(tile.pixels().map(ray));
        shots.hits.clear();
        shots.hits.resize(shots.rays.len(), None);
    }

    /// Whether so many rays through a tile, none of them beside the middle of a lens, need not be
    /// traced because they meet nothing; counts them either way.
    pub fn skips(&self, args: &CastArgs, tile: Tile, rays: u64, counters: &mut Counters) -> bool {
        let skips = args.general.skips(Skip::Tile) && self.sees_nothing(tile);
        let counter = if skips { &mut counters.skipped_empty_tile } else { &mut counters.rays };
        *counter += rays;
        skips
    }

    /// Whether no ray of the tile can meet anything. Not asked for a handful of primitives,
    /// where testing them is cheaper, nor when planes reach everywhere.
    fn sees_nothing(&self, tile: Tile) -> bool {
        if self.geometry.len() < WORTH_CULLING || !self.geometry.sheets().is_empty() {
            return false;
        }
        let corner = |x: u32, y: u32| screen_position(self.size, f64::from(x), f64::from(y));
        let (low, high) = (corner(tile.x0, tile.y0), corner(tile.x1, tile.y1));
        self.geometry.bounds().is_some_and(|b| !self.camera.may_see(low, high, &b))
    }
}

/// What reading and baking a scene came to.
fn prepared(scene: &Scene, geometry: &Geometry) -> Counters {
    let is_mesh = |node: &&Node| matches!(node.kind, NodeKind::Shape { shape: ShapeSpec::Mesh { .. }, .. });
    let (uses, files) = (scene.nodes.iter().filter(is_mesh).count(), scene.meshes.len());
    let solids = geometry.solids();
    let matrices = solids.iter().filter(|s| matches!(s.shape, SolidShape::Ellipsoid(_))).count();
    Counters {
        mesh_files: files as u64,
        skipped_mesh_file: uses.saturating_sub(files) as u64,
        matrices: matrices as u64,
        skipped_matrix: (solids.len() - matrices) as u64,
        ..Counters::default()
    }
}
