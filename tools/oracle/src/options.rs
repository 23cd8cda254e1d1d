//! What to draw: the command line of assignments 1 to 7 as data.

use crate::{Filter, OracleError};

/// How much of the lighting model is switched on: one step per assignment.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Model {
    /// Assignment 1: the diffuse colour as it is, without any light.
    Flat,
    /// Assignment 2: ambient and diffuse.
    Diffuse,
    /// Assignment 3: ambient, diffuse and highlights.
    Phong,
    /// Assignments 4 to 7: the above with shadows, mirrors and glass.
    #[default]
    Whitted,
}

/// The form of the highlight.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Specular {
    /// Half vector, (N·h)^exponent (Blinn 1977).
    #[default]
    Blinn,
    /// Reflected light vector, (R·V)^exponent (Phong 1975).
    Phong,
}

/// Which cells of the grid hold an object.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum GridFit {
    /// The course's conservative rule (§6.2), the default for the picture.
    #[default]
    Bounds,
    /// Closed overlap of the cell with the triangle, the solid sphere or the solid ellipsoid.
    Exact,
}

/// The picture of `-visualize_grid`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CellPicture {
    /// Cells along x, y and z, each at least 1.
    pub cells: [u32; 3],
    /// The rule of insertion.
    pub fit: GridFit,
}

/// Everything that decides a picture besides the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Pixels per row, at least 1.
    pub width: u32,
    /// Rows, at least 1.
    pub height: u32,
    /// The lighting model.
    pub model: Model,
    /// Light surfaces that are seen from behind, with the normal flipped. `Flat` ignores it.
    pub shade_back: bool,
    /// Form of the highlight, in `Phong` and `Whitted`.
    pub specular: Specular,
    /// Cast shadows, in `Whitted`.
    pub shadows: bool,
    /// Secondary rays are made while depth < bounces, in `Whitted`.
    pub bounces: u32,
    /// A branch of the ray tree whose weight is below this is dropped, in `Whitted`.
    pub weight: f64,
    /// Shadow rays pass transparent surfaces and take their colour; needs `shadows`.
    pub transparent_shadows: bool,
    /// Split light at transparent surfaces by Fresnel's equations, in `Whitted`.
    pub fresnel: bool,
    /// Draw the depth picture between these distances (t of white, t of black).
    pub depth: Option<(f64, f64)>,
    /// Draw the picture of normals.
    pub normals: bool,
    /// Draw the occupied cells of a grid in place of the scene.
    pub grid: Option<CellPicture>,
    /// Samples along each side of a pixel, at least 1: they stand at the centres of equal squares.
    pub pixel_side: u32,
    /// How samples are weighted; without one a pixel is the plain mean of its own.
    pub filter: Option<Filter>,
    /// What a camera's lens is cut into, squared; 1 leaves only its middle, a pinhole.
    pub lens_side: u32,
    /// What each light that has an extent is cut into, squared. 1 makes points of spherical
    /// lights and no lights of emissive surfaces, as in assignments 1 to 6.
    pub light_side: u32,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            width: 100,
            height: 100,
            model: Model::default(),
            shade_back: false,
            specular: Specular::default(),
            shadows: false,
            bounces: 0,
            weight: 0.0,
            transparent_shadows: false,
            fresnel: false,
            depth: None,
            normals: false,
            grid: None,
            pixel_side: 1,
            filter: None,
            lens_side: 16,
            light_side: 1,
        }
    }
}

impl Options {
    /// Refuses options that make no picture: no pixels, an empty depth range, a
    /// weight that is no number, no cells.
    pub(crate) fn check(&self) -> Result<(), OracleError> {
        let refuse = |text| Err(OracleError::Options(text));
        if self.width == 0 || self.height == 0 {
            return refuse("the picture has no pixels");
        }
        if self.depth.is_some_and(|(min, max)| !(max - min).is_normal()) {
            return refuse("the two depths must be different finite numbers");
        }
        if !self.weight.is_finite() || self.weight < 0.0 {
            return refuse("the cut-off weight must be a number of at least 0");
        }
        if self.grid.is_some_and(|g| g.cells.contains(&0)) {
            return refuse("a grid needs at least one cell along each axis");
        }
        if [self.pixel_side, self.lens_side, self.light_side].contains(&0) {
            return refuse("pixels, lenses and lights need at least one sample");
        }
        if self.filter.is_some_and(|filter| !filter.is_sound()) {
            return refuse("a filter's radius must be a finite number above 0");
        }
        Ok(())
    }
}
