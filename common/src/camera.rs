//! Cameras that make rays, and what a part of the picture can see.

use crate::math::{Bounds, DVec3, Interval, Vec3};
use crate::picture::Size;
use crate::ray::Ray;
use crate::scene::{CameraKind, CameraSpec, Lens, Screen};
use crate::simd::{self, Simd, dispatch};

/// Rays that are worked out side by side.
const ABREAST: usize = 8;

/// Position on the unit screen square of the point (x, y) given in pixels from the lower left
/// corner of the picture: the centre of pixel (i, j) is at (i + ½, j + ½), row 0 at the bottom.
///
/// Pixels are square; the unit square spans the larger side of the picture and is cropped
/// symmetrically on the smaller one.
#[inline]
pub fn screen_position(size: Size, x: f64, y: f64) -> (f64, f64) {
    let (w, h) = (f64::from(size.width()), f64::from(size.height()));
    let scale = w.max(h);
    ((x - w / 2.0) / scale + 0.5, (y - h / 2.0) / scale + 0.5)
}

/// A point as a camera sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projection {
    /// Homogeneous position (x·w, y·w, w) on the unit screen square. Linear in the point, so it
    /// is as good for points beside and behind the eye, where w ≤ 0 and dividing makes no sense.
    /// An orthographic camera has w = 1 everywhere.
    pub screen: DVec3,
    /// Distance from the camera's plane along its direction; negative behind it.
    pub depth: f64,
}

/// A camera with its frame worked out, in `f64`; rays are rounded to `f32` once.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    kind: CameraKind,
    screen: Screen,
    center: DVec3,
    direction: DVec3,
    right: DVec3,
    up: DVec3,
    /// The lens; rays of [`Camera::ray`] pass its middle.
    pub lens: Option<Lens>,
    /// Where hits of its rays count: everything for an orthographic camera, which also sees
    /// what lies behind its centre; what is in front for a perspective one.
    pub interval: Interval,
}

impl Camera {
    /// Works out the frame. The parser has made sure that `up` is not parallel to `direction`.
    pub fn new(spec: &CameraSpec) -> Self {
        let direction = spec.direction.normalize();
        let right = direction.cross(spec.up).normalize();
        let up = right.cross(direction).normalize();
        let frame = |spread: f64| (right * spread, up * spread);
        let ((right, up), interval) = match spec.kind {
            CameraKind::Orthographic { size } => (frame(size), Interval::ALL),
            CameraKind::Perspective { angle } => {
                (frame(2.0 * (angle.to_radians() / 2.0).tan()), Interval::FORWARD)
            }
        };
        let (kind, screen, lens) = (spec.kind, spec.screen, spec.lens);
        Self { kind, screen, center: spec.center, direction, right, up, lens, interval }
    }

    /// The ray through a point of the unit screen square; its direction has unit length.
    #[inline]
    pub fn ray(&self, (x, y): (f64, f64)) -> Ray {
        let (origin, direction) = self.line(x, y);
        Ray::new(origin.as_vec3(), direction.as_vec3())
    }

    /// Appends the rays through several points of the unit screen square, each with the bits that
    /// [`Camera::ray`] gives it.
    pub fn rays(&self, points: &[(f64, f64)], rays: &mut Vec<Ray>) {
        match (self.kind, self.screen) {
            (CameraKind::Perspective { .. }, Screen::Flat) => dispatch!(simd::level(), s => s.vectorize(
                #[inline(always)]
                || points.chunks(ABREAST).for_each(|points| self.rays_abreast(points, rays)),
            )),
            _ => rays.extend(points.iter().map(|point| self.ray(*point))),
        }
    }

    /// Up to [`ABREAST`] rays of a perspective camera with a flat screen: what [`Camera::line`]
    /// does, step by step, without fused operations.
    #[inline(always)]
    fn rays_abreast(&self, points: &[(f64, f64)], rays: &mut Vec<Ray>) {
        let mut at = [[0.0; ABREAST]; 2];
        for (k, (x, y)) in points.iter().enumerate().take(ABREAST) {
            (at[0][k], at[1][k]) = (x - 0.5, y - 0.5);
        }
        let (mut way, mut shrink) = ([[0.0; ABREAST]; 3], [0.0; ABREAST]);
        for axis in 0..3 {
            let [ahead, right, up] = [self.direction, self.right, self.up].map(|v| v[axis]);
            for k in 0..ABREAST {
                way[axis][k] = ahead + (right * at[0][k] + up * at[1][k]);
            }
        }
        for k in 0..ABREAST {
            let [x, y, z] = [way[0][k], way[1][k], way[2][k]];
            shrink[k] = 1.0 / (x * x + y * y + z * z).sqrt();
        }
        let mut unit = [[0.0f32; ABREAST]; 3];
        for axis in 0..3 {
            for k in 0..ABREAST {
                unit[axis][k] = (way[axis][k] * shrink[k]) as f32;
            }
        }
        let origin = self.center.as_vec3();
        rays.extend(
            (0..points.len()).map(|k| Ray::new(origin, Vec3::new(unit[0][k], unit[1][k], unit[2][k]))),
        );
    }

    /// The same as [`Camera::ray`] through a point (u, v) of the lens, in units of its radius to the right and up:
    /// it meets the ray through the lens's middle where that is in focus, on a plane for a flat
    /// screen and on a sphere about the eye for a curved one. Without a lens, that ray itself.
    pub fn ray_through_lens(&self, (x, y): (f64, f64), (u, v): (f64, f64)) -> Ray {
        let Some(lens) = self.lens else { return self.ray((x, y)) };
        let (origin, direction) = self.line(x, y);
        let in_focus = match self.screen {
            Screen::Flat => lens.focal_distance / direction.dot(self.direction),
            Screen::Curved => lens.focal_distance,
        };
        let aside = (self.right.normalize() * u + self.up.normalize() * v) * (lens.aperture / 2.0);
        let towards = (direction * in_focus - aside).normalize();
        Ray::new((origin + aside).as_vec3(), towards.as_vec3())
    }

    /// Origin and unit direction of the ray through a point of the screen.
    #[inline]
    fn line(&self, x: f64, y: f64) -> (DVec3, DVec3) {
        match (self.kind, self.screen) {
            (CameraKind::Orthographic { .. }, _) => (self.center + self.on_screen(x, y), self.direction),
            (CameraKind::Perspective { .. }, Screen::Flat) => {
                (self.center, (self.direction + self.on_screen(x, y)).normalize())
            }
            (CameraKind::Perspective { angle }, Screen::Curved) => {
                let (side, ahead) = ((x - 0.5) * angle.to_radians()).sin_cos();
                let (upward, level) = ((y - 0.5) * angle.to_radians()).sin_cos();
                let horizontal = self.direction * ahead + self.right.normalize() * side;
                (self.center, (horizontal * level + self.up.normalize() * upward).normalize())
            }
        }
    }

    #[inline]
    fn on_screen(&self, x: f64, y: f64) -> DVec3 {
        self.right * (x - 0.5) + self.up * (y - 0.5)
    }

    /// Where a point of space appears on the flat screen; there the inverse of [`Camera::ray`].
    pub fn project(&self, point: DVec3) -> Projection {
        let from_center = point - self.center;
        let depth = from_center.dot(self.direction);
        let w = match self.kind {
            CameraKind::Orthographic { .. } => 1.0,
            CameraKind::Perspective { .. } => depth,
        };
        let along = |axis: DVec3| from_center.dot(axis) / axis.length_squared() + 0.5 * w;
        Projection { screen: DVec3::new(along(self.right), along(self.up), w), depth }
    }

    /// Unit direction of the ray that sees a point; zero for the eye itself.
    pub fn sight(&self, point: DVec3) -> DVec3 {
        match self.kind {
            CameraKind::Orthographic { .. } => self.direction,
            CameraKind::Perspective { .. } => (point - self.center).normalize_or_zero(),
        }
    }

    /// Whether some ray through the screen rectangle from `low` to `high` may meet the box.
    /// Says "yes" when in doubt: the rays' rounding to `f32` is allowed for. Rays that do not
    /// pass the middle of a lens are not asked about.
    pub fn may_see(&self, low: (f64, f64), high: (f64, f64), bounds: &Bounds) -> bool {
        if self.screen == Screen::Curved {
            return true;
        }
        let corners = bounds.corners().map(|c| c.as_dvec3() - self.center);
        let reach = corners.iter().fold(self.center.abs().max_element(), |m, c| m.max(c.length()));
        let slack = reach * 2f64.powi(-20);
        let beyond = |normal: DVec3, from: DVec3| corners.iter().all(|c| normal.dot(*c - from) < -slack);
        let (low_edge, high_edge) = (self.on_screen(low.0, low.1), self.on_screen(high.0, high.1));
        let (right, up) = (self.right.normalize(), self.up.normalize());
        if let CameraKind::Orthographic { .. } = self.kind {
            return !(beyond(right, low_edge)
                || beyond(up, low_edge)
                || beyond(-right, high_edge)
                || beyond(-up, high_edge));
        }
        // Side planes pass through the eye; their normals point into the frustum.
        let side = |edge: DVec3, along: DVec3| (self.direction + edge).cross(along).normalize();
        let inward = [
            side(low_edge, up),
            -side(low_edge, right),
            -side(high_edge, up),
            side(high_edge, right),
            self.direction,
        ];
        !inward.into_iter().any(|n| beyond(n, DVec3::ZERO))
    }
}

#[cfg(test)]
mod tests;
