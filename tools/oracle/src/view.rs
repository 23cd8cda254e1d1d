//! From pixels to rays: cameras with and without a lens, flat and curved screens (course rules
//! §1.5, §3.1 and §4.1).

use crate::sampling::lens_places;
use crate::{OracleError, Range, Ray};
use common::math::DVec3;
use common::scene::{CameraKind, CameraSpec, Lens, Screen};

/// A camera looking at a picture of a given size.
#[derive(Clone, Debug)]
pub struct View {
    center: DVec3,
    direction: DVec3,
    right: DVec3,
    up: DVec3,
    kind: CameraKind,
    screen: Screen,
    lens: Option<Lens>,
    width: f64,
    height: f64,
}

impl View {
    /// Prepares a camera for pictures of `width` × `height` pixels.
    ///
    /// Refuses an `up` parallel to `direction`.
    pub fn new(camera: &CameraSpec, width: u32, height: u32) -> Result<Self, OracleError> {
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
            screen: camera.screen,
            lens: camera.lens,
            width: f64::from(width),
            height: f64::from(height),
        })
    }

    /// The ray through a point of the picture measured in pixels from its lower left corner:
    /// the centre of pixel (i, j) is (i + ½, j + ½). The direction has unit length. If there is a
    /// lens, the ray passes its middle.
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
                let direction = match self.screen {
                    Screen::Flat => {
                        let side = 2.0 * (angle.to_radians() / 2.0).tan();
                        self.direction + side * on_screen
                    }
                    Screen::Curved => self.turned(x * angle.to_radians(), y * angle.to_radians()),
                };
                Ray { origin: self.center, direction: direction.normalize() }
            }
        }
    }

    /// The camera's direction turned to the right by `yaw`, then up by `pitch`.
    fn turned(&self, yaw: f64, pitch: f64) -> DVec3 {
        let level = yaw.cos() * self.direction + yaw.sin() * self.right;
        pitch.cos() * level + pitch.sin() * self.up
    }

    /// The rays through a point of the picture and about `side`² places of the lens; one, if
    /// there is none. They all meet where the ray through the middle is in focus: on a plane
    /// before a flat screen, on a sphere around the eye before a curved one.
    pub fn rays(&self, across: f64, upward: f64, side: u32) -> Vec<Ray> {
        let middle = self.ray(across, upward);
        let Some(lens) = self.lens else { return vec![middle] };
        let depth = match self.screen {
            Screen::Flat => middle.direction.dot(self.direction),
            Screen::Curved => 1.0,
        };
        let in_focus = middle.at(lens.focal_distance / depth);
        let through = |place: DVec3| {
            let aside = lens.aperture / 2.0 * (place.x * self.right + place.y * self.up);
            let origin = middle.origin + aside;
            Ray { origin, direction: (in_focus - origin).normalize() }
        };
        lens_places(&lens, side).into_iter().map(through).collect()
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
