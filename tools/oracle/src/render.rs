//! Whole pictures: colour, depth and normals (course rules §3.3 and §3.4).

use crate::cells::CellGrid;
use crate::{Model, Options, OracleError, Ray, View, World, shade, tree};
use common::math::DVec3;
use common::scene::Scene;
use rayon::prelude::*;

/// A rectangle of linear RGB colours.
#[derive(Clone, Debug, PartialEq)]
pub struct Raster {
    /// Pixels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// The pixels, row by row from the bottom, each row from the left.
    pub pixels: Vec<DVec3>,
}

impl Raster {
    /// The pixel in column `i` of row `j` from the bottom; panics outside the picture.
    pub fn pixel(&self, i: u32, j: u32) -> DVec3 {
        assert!(i < self.width && j < self.height, "no pixel ({i}, {j})");
        self.pixels[j as usize * self.width as usize + i as usize]
    }
}

/// The pictures of one command line, all of one size.
#[derive(Clone, Debug, PartialEq)]
pub struct Pictures {
    /// The picture of `-output`, not clamped.
    pub colour: Raster,
    /// The picture of `-depth`, grey in [0, 1].
    pub depth: Option<Raster>,
    /// The picture of `-normals`.
    pub normals: Option<Raster>,
}

/// What one primary ray brings back.
struct Seen {
    colour: DVec3,
    /// Distance and unit normal, unless it saw the background.
    surface: Option<(f64, DVec3)>,
}

/// Draws a scene. With [`Options::grid`] all pictures show the occupied cells in its place.
///
/// The result depends on nothing but the arguments, whatever the number of threads. Errors are
/// those of [`View::new`], [`World::new`] and impossible options.
pub fn render(scene: &Scene, options: &Options) -> Result<Pictures, OracleError> {
    options.check()?;
    let view = View::new(&scene.camera, options.width, options.height)?;
    let world = World::new(scene)?;
    let cells = options.grid.map(|picture| CellGrid::new(&world, picture));
    let see = |ray: Ray| match &cells {
        None => see_scene(&world, options, ray, &view),
        Some(cells) => see_cells(&world, cells, &ray, &view),
    };
    let seen = every_pixel(options, |x, y| see(view.ray(x, y)));
    let raster = |of: &dyn Fn(&Seen) -> DVec3| Raster {
        width: options.width,
        height: options.height,
        pixels: seen.iter().map(of).collect(),
    };
    Ok(Pictures {
        colour: raster(&|s| s.colour),
        depth: options
            .depth
            .map(|range| raster(&|s| s.surface.map_or(DVec3::ZERO, |(t, _)| DVec3::splat(grey(t, range))))),
        normals: options
            .normals
            .then(|| raster(&|s| s.surface.map_or(DVec3::ZERO, |(_, normal)| normal.abs()))),
    })
}

/// One value per pixel, from the position of its centre.
fn every_pixel<T: Send>(options: &Options, value: impl Fn(f64, f64) -> T + Sync) -> Vec<T> {
    let (width, value) = (options.width, &value);
    let row = |j| (0..width).map(move |i| value(f64::from(i) + 0.5, f64::from(j) + 0.5));
    (0..options.height).into_par_iter().flat_map_iter(row).collect()
}

/// White at `min`, black at `max`, clamped in between.
fn grey(t: f64, (min, max): (f64, f64)) -> f64 {
    ((max - t) / (max - min)).clamp(0.0, 1.0)
}

fn see_scene(world: &World, options: &Options, ray: Ray, view: &View) -> Seen {
    let Some(hit) = world.nearest(&ray, view.range()) else {
        return Seen { colour: world.background, surface: None };
    };
    let colour = match options.model {
        Model::Flat => world.mixture(&hit).sum(|surface| surface.diffuse),
        Model::Diffuse | Model::Phong => shade::local(world, options, &ray, &hit, &world.mixture(&hit)),
        Model::Whitted => tree::colour(world, options, ray, view.range()),
    };
    Seen { colour, surface: Some((hit.t, hit.shading_normal)) }
}

fn see_cells(world: &World, cells: &CellGrid, ray: &Ray, view: &View) -> Seen {
    let Some(hit) = cells.first(ray, view.range()) else {
        return Seen { colour: world.background, surface: None };
    };
    let diffuse = crate::cell_colour(hit.count);
    let lit = shade::sum_of_lights(world, ray.at(hit.t), hit.normal, |_| diffuse);
    Seen { colour: world.ambient * diffuse + lit, surface: Some((hit.t, hit.normal)) }
}
