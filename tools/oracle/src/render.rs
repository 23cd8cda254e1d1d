//! Whole pictures: colour, depth and normals (course rules §3.3 and §3.4).

use crate::cells::{CellGrid, CellHit};
use crate::sampling::{develop, pixel_places};
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

/// The colours of all samples of a picture, not clamped.
#[derive(Clone, Debug, PartialEq)]
pub struct Samples {
    /// Pixels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Samples along each side of a pixel; they stand where [`crate::pixel_places`] says.
    pub side: u32,
    /// Row by row from the bottom, pixel by pixel, sample by sample.
    colours: Vec<DVec3>,
}

impl Samples {
    /// The samples of the pixel in column `i` of row `j` from the bottom.
    ///
    /// # Panics
    /// Outside the picture.
    pub fn pixel(&self, i: u32, j: u32) -> &[DVec3] {
        assert!(i < self.width && j < self.height, "no pixel ({i}, {j})");
        let count = (self.side * self.side) as usize;
        &self.colours[(j as usize * self.width as usize + i as usize) * count..][..count]
    }
}

/// A scene prepared for the pictures of one command line.
struct Stage<'a> {
    options: &'a Options,
    view: View,
    world: World,
    cells: Option<CellGrid>,
}

/// Draws a scene. With [`Options::grid`] all pictures show the occupied cells in its place.
///
/// The colour of a pixel is that of its samples; depth and normals are those of the one ray
/// through the pixel's centre and the lens's middle. The result depends on nothing but the
/// arguments, whatever the number of threads. Errors are those of [`View::new`], [`World::new`]
/// and impossible options.
pub fn render(scene: &Scene, options: &Options) -> Result<Pictures, OracleError> {
    let stage = Stage::new(scene, options)?;
    let raster = |value: &(dyn Fn(Option<(f64, DVec3)>) -> DVec3 + Sync)| Raster {
        width: options.width,
        height: options.height,
        pixels: every_pixel(options, |x, y| value(stage.surface(&stage.view.ray(x, y)))),
    };
    Ok(Pictures {
        colour: develop(&stage.samples(), options.filter),
        depth: options
            .depth
            .map(|range| raster(&|s| s.map_or(DVec3::ZERO, |(t, _)| DVec3::splat(grey(t, range))))),
        normals: options.normals.then(|| raster(&|s| s.map_or(DVec3::ZERO, |(_, normal)| normal.abs()))),
    })
}

/// The samples that [`render`] makes its colours of. Errors are the same.
pub fn samples(scene: &Scene, options: &Options) -> Result<Samples, OracleError> {
    Ok(Stage::new(scene, options)?.samples())
}

impl<'a> Stage<'a> {
    fn new(scene: &Scene, options: &'a Options) -> Result<Self, OracleError> {
        options.check()?;
        let view = View::new(&scene.camera, options.width, options.height)?;
        let world = World::new(scene)?;
        let cells = options.grid.map(|picture| CellGrid::new(&world, picture));
        // Cells are lit as simply as can be: they are a drawing, not a scene.
        let side = if cells.is_some() { 1 } else { options.light_side };
        Ok(Self { options, view, world: world.with_extended_lights(side), cells })
    }

    fn samples(&self) -> Samples {
        let &Options { width, height, pixel_side: side, .. } = self.options;
        let places = pixel_places(side);
        let of_pixel = |x: f64, y: f64| -> Vec<DVec3> {
            places.iter().map(|[u, v]| self.seen_from(x - 0.5 + u, y - 0.5 + v)).collect()
        };
        Samples { width, height, side, colours: every_pixel(self.options, of_pixel).concat() }
    }

    /// The colour at a point of the picture, the mean over the lens.
    fn seen_from(&self, across: f64, upward: f64) -> DVec3 {
        let rays = self.view.rays(across, upward, self.options.lens_side);
        let count = rays.len() as f64;
        rays.into_iter().map(|ray| self.colour(ray)).sum::<DVec3>() / count
    }

    /// Distance and unit normal of what a ray sees, unless it is the background.
    fn surface(&self, ray: &Ray) -> Option<(f64, DVec3)> {
        let range = self.view.range();
        match &self.cells {
            None => self.world.nearest(ray, range).map(|hit| (hit.t, hit.shading_normal)),
            Some(cells) => cells.first(ray, range).map(|hit| (hit.t, hit.normal)),
        }
    }

    fn colour(&self, ray: Ray) -> DVec3 {
        let (world, options, range) = (&self.world, self.options, self.view.range());
        if let Some(cells) = &self.cells {
            return cells.first(&ray, range).map_or(world.background, |hit| self.cell(&ray, &hit));
        }
        if options.model == Model::Whitted {
            return tree::colour(world, options, ray, range);
        }
        world.nearest(&ray, range).map_or(world.background, |hit| match options.model {
            Model::Flat => world.mixture(&hit).sum(|surface| surface.diffuse),
            _ => shade::local(world, options, &ray, &hit, &world.mixture(&hit)),
        })
    }

    fn cell(&self, ray: &Ray, hit: &CellHit) -> DVec3 {
        let diffuse = crate::cell_colour(hit.count);
        let lit = shade::sum_of_lights(&self.world, ray.at(hit.t), hit.normal, |_| diffuse);
        self.world.ambient * diffuse + lit
    }
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
