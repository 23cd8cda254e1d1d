//! Cameras that make rays, and what a part of the picture can see.

use crate::math::{Bounds, DVec3, Interval};
use crate::picture::Size;
use crate::ray::Ray;
use crate::scene::{CameraKind, CameraSpec};

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
    center: DVec3,
    direction: DVec3,
    right: DVec3,
    up: DVec3,
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
        Self { kind: spec.kind, center: spec.center, direction, right, up, interval }
    }

    /// The ray through a point of the unit screen square; its direction has unit length.
    #[inline]
    pub fn ray(&self, (x, y): (f64, f64)) -> Ray {
        let offset = self.right * (x - 0.5) + self.up * (y - 0.5);
        match self.kind {
            CameraKind::Orthographic { .. } => {
                Ray::new((self.center + offset).as_vec3(), self.direction.as_vec3())
            }
            CameraKind::Perspective { .. } => {
                Ray::new(self.center.as_vec3(), (self.direction + offset).normalize().as_vec3())
            }
        }
    }

    /// Where a point of space appears on the screen; the inverse of [`Camera::ray`].
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
    /// Says "yes" when in doubt: the rays' rounding to `f32` is allowed for.
    pub fn may_see(&self, low: (f64, f64), high: (f64, f64), bounds: &Bounds) -> bool {
        let corners = bounds.corners().map(|c| c.as_dvec3() - self.center);
        let reach = corners.iter().fold(self.center.abs().max_element(), |m, c| m.max(c.length()));
        let slack = reach * 2f64.powi(-20);
        let beyond = |normal: DVec3, from: DVec3| corners.iter().all(|c| normal.dot(*c - from) < -slack);
        let at = |x: f64, y: f64| self.right * (x - 0.5) + self.up * (y - 0.5);
        let (low_edge, high_edge) = (at(low.0, low.1), at(high.0, high.1));
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
mod tests {
    use super::*;
    use crate::math::Vec3;
    use crate::scene::{Position, Screen};

    fn camera(kind: CameraKind) -> Camera {
        Camera::new(&CameraSpec {
            center: DVec3::new(1.0, 2.0, 10.0),
            direction: DVec3::new(0.0, 0.0, -3.0),
            up: DVec3::new(0.5, 2.0, 0.25),
            kind,
            lens: None,
            screen: Screen::Flat,
            position: Position { line: 1, column: 1 },
        })
    }

    #[test]
    fn pixels_are_square_and_centred() {
        let size = Size::new(4, 2).unwrap();
        assert_eq!(screen_position(size, 2.0, 1.0), (0.5, 0.5));
        assert_eq!(screen_position(size, 0.5, 0.5), (0.125, 0.375));
    }

    #[test]
    fn frames_are_right_handed() {
        let c = camera(CameraKind::Orthographic { size: 4.0 });
        let (center, ray) = (c.ray((0.5, 0.5)), c.ray((1.0, 0.5)));
        assert_eq!(center.direction, Vec3::NEG_Z);
        assert!((ray.origin - center.origin).dot(Vec3::X) > 1.9, "right is +x when looking along -z");
        assert!((c.ray((0.5, 1.0)).origin - center.origin).dot(Vec3::Y) > 1.9);
    }

    #[test]
    fn perspective_angle_is_the_full_field() {
        let c = camera(CameraKind::Perspective { angle: 60.0 });
        let edge = (c.ray((0.0, 0.5)).direction, c.ray((1.0, 0.5)).direction);
        assert!((edge.0.dot(edge.1) - 0.5).abs() < 1e-6);
        assert!((edge.0.length() - 1.0).abs() < 1e-6);
    }

    /// A point on a ray projects to where the ray went through the screen, also behind the eye.
    #[test]
    fn projecting_undoes_ray() {
        for kind in [CameraKind::Orthographic { size: 4.0 }, CameraKind::Perspective { angle: 25.0 }] {
            let c = camera(kind);
            for (x, y, t) in [(0.1, 0.9, 3.0), (0.75, 0.5, 0.25), (0.3, 0.2, -2.0)] {
                let ray = c.ray((x, y));
                let p = c.project(ray.at(t));
                let seen = p.screen / p.screen.z;
                assert!((seen.x - x).abs() < 1e-5 && (seen.y - y).abs() < 1e-5, "{kind:?} {seen}");
                assert_eq!(p.depth > 0.0, t > 0.0);
                let sight = c.sight(ray.at(t)) * p.screen.z.signum();
                assert!((sight - ray.direction.as_dvec3()).length() < 1e-5, "{kind:?} {sight}");
            }
        }
        let flat = camera(CameraKind::Orthographic { size: 4.0 });
        assert_eq!(
            flat.project(DVec3::new(1.0, 2.0, 7.0)),
            Projection { screen: DVec3::new(0.5, 0.5, 1.0), depth: 3.0 }
        );
    }

    /// A rectangle that "cannot see" a box has no ray that enters it; and the test is not idle.
    #[test]
    fn may_see_never_denies_a_hit() {
        let size = Size::new(32, 32).unwrap();
        for kind in [CameraKind::Orthographic { size: 4.0 }, CameraKind::Perspective { angle: 25.0 }] {
            let (c, mut denied) = (camera(kind), 0);
            let bounds = Bounds { min: Vec3::new(0.5, 1.5, -1.0), max: Vec3::new(1.3, 2.1, 0.0) };
            for (i, j) in (0..8).flat_map(|i| (0..8).map(move |j| (f64::from(i) * 4.0, f64::from(j) * 4.0))) {
                let sees =
                    c.may_see(screen_position(size, i, j), screen_position(size, i + 4.0, j + 4.0), &bounds);
                denied += u32::from(!sees);
                let enters = (0..=8).flat_map(|a| (0..=8).map(move |b| (a, b))).any(|(a, b)| {
                    let ray = c.ray(screen_position(size, i + f64::from(a) / 2.0, j + f64::from(b) / 2.0));
                    (0..500).any(|k| {
                        let p = ray.at(9.0 + f64::from(k) * 0.01).as_vec3();
                        p.cmpge(bounds.min).all() && p.cmple(bounds.max).all()
                    })
                });
                assert!(sees || !enters, "{kind:?} tile {i} {j}");
            }
            assert!(denied > 30, "{kind:?}: {denied}");
        }
    }
}
