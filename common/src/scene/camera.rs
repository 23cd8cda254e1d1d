//! The two cameras of the format, as written.

use super::Position;
use crate::math::DVec3;

/// A camera as the scene file gives it; directions need not have unit length.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraSpec {
    /// Centre of the image plane (orthographic) or eye point (perspective).
    pub center: DVec3,
    /// Viewing direction, any length but zero.
    pub direction: DVec3,
    /// Roughly upward; must not be parallel to `direction`.
    pub up: DVec3,
    /// Projection with its one parameter.
    pub kind: CameraKind,
    /// Thin lens, if the file gives one (an extension).
    pub lens: Option<Lens>,
    /// Flat or curved screen (an extension; flat by default).
    pub screen: Screen,
    /// Where the camera's keyword stands.
    pub position: Position,
}

/// The projection and its parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CameraKind {
    /// Parallel rays through a square of this side length.
    Orthographic {
        /// Side of the square that the unit screen square spans, in scene units.
        size: f64,
    },
    /// Rays from one eye point.
    Perspective {
        /// Full field of view across the unit screen square, in degrees, in (0, 180).
        angle: f64,
    },
}

/// A thin lens.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lens {
    /// Diameter of the aperture in scene units.
    pub aperture: f64,
    /// Distance from the eye to the plane in focus, in scene units.
    pub focal_distance: f64,
    /// Corners of the aperture: a regular polygon with this many, at least 3, the first on the
    /// lens's upward axis; a disc if not given.
    pub blades: Option<u32>,
}

/// Shape of the screen that pixels lie on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Screen {
    /// A plane: equal distances per pixel.
    #[default]
    Flat,
    /// A sphere around the eye: equal angles per pixel.
    Curved,
}
