//! From pixels to rays: the two cameras (course rules §3.1 and §4.1).

use crate::{OracleError, Range, Ray};
use common::math::DVec3;
use common::scene::{CameraKind, CameraSpec, Screen};

/// A camera looking at a picture of a given size.
#[derive(Clone, Debug)]
pub struct View {
    center: DVec3,
    direction: DVec3,
    right: DVec3,
    up: DVec3,
    kind: CameraKind,
    width: f64,
    height: f64,
}

impl View {
    /// Prepares a camera for pictures of `width` × `height` pixels.
    ///
    /// Refuses an `up` parallel to `direction`, and lenses and curved screens, which belong to
    /// assignment 7.
    pub fn new(camera: &CameraSpec, width: u32, height: u32) -> Result<Self, OracleError> {
        refuse_later(camera)?;
        let direction = camera.direction.normalize();
        let right = direction.cross(camera.up).normalize();
        let up = right.cross(direction);
        if !up.is_finite() {
            return Err(OracleError::Camera(camera.position));
        }
        Ok(Self {
            center: camera.center,
            direction,
            right,
            up,
            kind: camera.kind,
            width: f64::from(width),
            height: f64::from(height),
        })
    }

    /// The ray through a point of the picture measured in pixels from its lower left corner:
    /// the centre of pixel (i, j) is (i + ½, j + ½). The direction has unit length.
    pub fn ray(&self, across: f64, upward: f64) -> Ray {
        // Screen coordinates minus one half: the larger side spans [−½, ½].
        let larger = self.width.max(self.height);
        let x = (across - self.width / 2.0) / larger;
        let y = (upward - self.height / 2.0) / larger;
        let on_screen = x * self.right + y * self.up;
        match self.kind {
            CameraKind::Orthographic { size } => {
                Ray { origin: self.center + size * on_screen, direction: self.direction }
            }
            CameraKind::Perspective { angle } => {
                let side = 2.0 * (angle.to_radians() / 2.0).tan();
                Ray { origin: self.center, direction: (self.direction + side * on_screen).normalize() }
            }
        }
    }

    /// The part of its rays that the camera sees: the whole line for the orthographic one,
    /// t > 0 for the perspective one.
    pub fn range(&self) -> Range {
        match self.kind {
            CameraKind::Orthographic { .. } => Range::LINE,
            CameraKind::Perspective { .. } => Range::FORWARD,
        }
    }
}

fn refuse_later(camera: &CameraSpec) -> Result<(), OracleError> {
    let later = |what| Err(OracleError::Later { what, assignment: 7, position: camera.position });
    if camera.lens.is_some() {
        return later("a camera with a lens");
    }
    if camera.screen != Screen::Flat {
        return later("a curved screen");
    }
    Ok(())
}
