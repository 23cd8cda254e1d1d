//! Reference pictures: drawn by the oracle, kept as PNG files.
//!
//! A reference holds the levels that the course's rule gives for the oracle's double-precision
//! colours, trunc(255·c). Pictures are known by name: command lines that differ only in flags
//! of the window or the preview write the same file, and share its reference.

use crate::{CommandLine, Picture, PictureKind, workspace_file};
use common::math::{DVec3, Vec3};
use common::picture::{Film, PictureError, Size, Transfer, read, write};
use common::scene::{self, Scene};
use oracle::{
    CellPicture, Filter, GridFit, Model, Options, OracleError, Raster, filter_picture, samples_picture,
};
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Where references are kept.
pub fn folder() -> PathBuf {
    workspace_file("tests/references")
}

/// The file of a picture's reference.
pub fn path(picture: &Picture) -> PathBuf {
    folder().join(format!("{}.png", picture.stem()))
}

/// The reference as it is kept.
///
/// # Errors
/// If there is none, or it is no picture.
pub fn kept(picture: &Picture) -> Result<Film, PictureError> {
    read(&path(picture), Transfer::Linear)
}

/// Keeps `film` as the reference of a picture.
///
/// # Errors
/// If the file cannot be written.
pub fn keep(picture: &Picture, film: &Film) -> Result<(), PictureError> {
    write(&path(picture), film, Transfer::Linear)
}

/// What the oracle is to draw for a command line.
pub fn options(line: &CommandLine) -> Options {
    let [width, height] = line.numbers("-size").unwrap_or([100, 100]);
    let cells = |cells| CellPicture { cells, fit: GridFit::Bounds };
    let shows_cells = line.has("-visualize_grid") || line.has("-visualize_grid_count");
    Options {
        width,
        height,
        model: model(line.assignment),
        shade_back: line.has("-shade_back"),
        shadows: line.has("-shadows"),
        bounces: line.numbers("-bounces").map_or(0, |[n]| n),
        weight: line.numbers("-weight").map_or(0.0, |[w]| w),
        transparent_shadows: line.has("-transparent_shadows"),
        depth: line.values("-depth").map(|[min, max, _]| (number(min), number(max))),
        normals: line.has("-normals"),
        grid: line.numbers("-grid").filter(|_| shows_cells).map(cells),
        pixel_side: line.numbers("-uniform_samples").map_or(1, |[n]: [u32; 1]| n.isqrt()),
        filter: filter(line),
        ..Options::default()
    }
}

fn filter(line: &CommandLine) -> Option<Filter> {
    let of = |flag, make: fn(f64) -> Filter| line.numbers(flag).map(|[radius]| make(radius));
    let (r#box, tent) = (of("-box_filter", Filter::Box), of("-tent_filter", Filter::Tent));
    r#box.or(tent).or(of("-gaussian_filter", Filter::Gaussian))
}

fn number(text: &str) -> f64 {
    text.parse().unwrap_or_else(|_| panic!("`{text}` is no number"))
}

fn model(assignment: u8) -> Model {
    match assignment {
        1 => Model::Flat,
        2 => Model::Diffuse,
        3 => Model::Phong,
        _ => Model::Whitted,
    }
}

/// The pictures of a command line, drawn by the oracle.
///
/// # Panics
/// If the scene cannot be read or the oracle refuses it.
pub fn drawn(line: &CommandLine) -> Vec<(Picture, Film)> {
    let pictures = line.pictures();
    if pictures.is_empty() {
        return Vec::new();
    }
    let scene = scene::load(&line.scene_file()).unwrap_or_else(|error| panic!("{line}\n{error}"));
    let rasters = rasters(line, &scene).unwrap_or_else(|error| panic!("{line}\n{error}"));
    let film = |picture: &Picture| film(&rasters[&picture.kind]);
    pictures.into_iter().map(|picture| (picture.clone(), film(&picture))).collect()
}

/// What the oracle draws for a line, more than what is asked for where that comes along.
fn rasters(line: &CommandLine, scene: &Scene) -> Result<BTreeMap<PictureKind, Raster>, OracleError> {
    let (options, mut all) = (options(line), BTreeMap::new());
    if let Some([_, zoom]) = line.values("-render_filter") {
        all.insert(PictureKind::Filter, filter_picture(&options, zoom_factor(zoom))?);
    }
    if let Some([_, zoom]) = line.values("-render_samples") {
        let samples = oracle::samples(scene, &options)?;
        all.insert(PictureKind::Samples, samples_picture(&samples, zoom_factor(zoom))?);
    }
    if line.pictures().iter().any(|picture| !all.contains_key(&picture.kind)) {
        let drawn = oracle::render(scene, &options)?;
        all.insert(PictureKind::Color, drawn.colour);
        all.extend(drawn.depth.map(|raster| (PictureKind::Depth, raster)));
        all.extend(drawn.normals.map(|raster| (PictureKind::Normals, raster)));
    }
    Ok(all)
}

fn zoom_factor(text: &str) -> u32 {
    text.parse().unwrap_or_else(|_| panic!("`{text}` is no number"))
}

/// The levels of the oracle's colours. Quantised before the rounding to single precision, which
/// could lift a colour over the edge of a level.
fn film(raster: &Raster) -> Film {
    let size = Size::new(raster.width.into(), raster.height.into()).expect("the oracle has drawn it");
    Film::from_fn(size, |x, y| light(levels(raster.pixel(x, y))))
}

/// The course's rule: trunc(255·c), clamped to 0…255.
fn levels(color: DVec3) -> [u8; 3] {
    color.to_array().map(|c| (c * 255.0) as u8)
}

/// Light that is written as exactly these levels.
fn light(levels: [u8; 3]) -> Vec3 {
    Vec3::from_array(levels.map(|level| Transfer::Linear.light(level)))
}
