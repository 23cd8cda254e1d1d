//! Moving the camera by flags, without touching the scene.

use common::math::{Bounds, DMat3, DVec3};
use common::scene::{CameraKind, CameraSpec};

/// Steps away from the scene's own camera, taken in the order of the fields. The viewer's keys
/// add up to the same.
#[derive(Clone, Debug, Default, clap::Args)]
#[command(rename_all = "snake_case", next_help_heading = "Camera, moved before the picture is taken")]
pub struct MotionArgs {
    /// Show things F times as large: the field of view narrows, the eye stays
    #[arg(long, value_name = "F")]
    pub zoom: Option<f64>,

    /// Move the screen to F times its distance from the eye: a field of view by another name, as
    /// long as the screen keeps its size
    #[arg(long, value_name = "F")]
    pub move_screen: Option<f64>,

    /// Go round the middle of the scene, still facing it as before: degrees to the right, degrees up
    #[arg(long, num_args = 2, value_names = ["RIGHT", "UP"])]
    pub orbit: Option<Vec<f64>>,

    /// Turn the head: degrees to the right, degrees up
    #[arg(long, num_args = 2, value_names = ["RIGHT", "UP"])]
    pub rotate: Option<Vec<f64>>,

    /// Tilt the head to the right by so many degrees
    #[arg(long, value_name = "DEGREES")]
    pub twist: Option<f64>,

    /// Step aside: to the right, up, and forward, in units of the scene
    #[arg(long, num_args = 3, value_names = ["RIGHT", "UP", "FORWARD"])]
    pub shift: Option<Vec<f64>>,
}

/// Directions of a camera.
struct Frame {
    right: DVec3,
    up: DVec3,
    forward: DVec3,
}

impl Frame {
    fn of(camera: &CameraSpec) -> Self {
        let forward = camera.direction.normalize();
        let right = forward.cross(camera.up).normalize();
        Self { right, up: right.cross(forward), forward }
    }

    /// Turning to the right and then up.
    fn turn(&self, degrees: &[f64]) -> DMat3 {
        let to_the_right = DMat3::from_axis_angle(self.up, -degrees[0].to_radians());
        DMat3::from_axis_angle(to_the_right * self.right, degrees[1].to_radians()) * to_the_right
    }
}

impl MotionArgs {
    /// What is wrong with the numbers, if anything is.
    pub fn fault(&self) -> Option<String> {
        let factor = |name: &str, value: Option<f64>| {
            let bad = value.filter(|f| !(f.is_finite() && *f > 0.0))?;
            Some(format!("-{name} wants a number above 0, not {bad}"))
        };
        let finite = |name: &str, values: &[f64]| {
            let bad = values.iter().find(|x| !x.is_finite())?;
            Some(format!("-{name} wants numbers, not {bad}"))
        };
        factor("zoom", self.zoom)
            .or_else(|| factor("move_screen", self.move_screen))
            .or_else(|| finite("orbit", self.orbit.as_deref().unwrap_or_default()))
            .or_else(|| finite("rotate", self.rotate.as_deref().unwrap_or_default()))
            .or_else(|| finite("twist", self.twist.as_slice()))
            .or_else(|| finite("shift", self.shift.as_deref().unwrap_or_default()))
    }

    /// The camera after all steps. It goes round the middle of `bounds`, or round the origin.
    pub fn moved(&self, camera: &CameraSpec, bounds: Option<Bounds>) -> CameraSpec {
        let mut moved = camera.clone();
        let closer = self.zoom.unwrap_or(1.0) * self.move_screen.unwrap_or(1.0);
        if closer != 1.0 {
            moved.kind = narrowed(camera.kind, closer);
        }
        if let Some(degrees) = &self.orbit {
            let middle = bounds.map_or(DVec3::ZERO, |b| (b.min.as_dvec3() + b.max.as_dvec3()) / 2.0);
            // To go to the right is to turn to the left.
            let turn = Frame::of(&moved).turn(&[-degrees[0], -degrees[1]]);
            moved.center = middle + turn * (moved.center - middle);
            (moved.direction, moved.up) = (turn * moved.direction, turn * Frame::of(&moved).up);
        }
        if let Some(degrees) = &self.rotate {
            let frame = Frame::of(&moved);
            let turn = frame.turn(degrees);
            (moved.direction, moved.up) = (turn * moved.direction, turn * frame.up);
        }
        if let Some(degrees) = self.twist {
            let frame = Frame::of(&moved);
            moved.up = DMat3::from_axis_angle(frame.forward, degrees.to_radians()) * frame.up;
        }
        if let Some(step) = &self.shift {
            let Frame { right, up, forward } = Frame::of(&moved);
            moved.center += right * step[0] + up * step[1] + forward * step[2];
        }
        moved
    }
}

/// The same projection, everything `times` as large.
fn narrowed(kind: CameraKind, times: f64) -> CameraKind {
    match kind {
        CameraKind::Orthographic { size } => CameraKind::Orthographic { size: size / times },
        CameraKind::Perspective { angle } => {
            let half = (angle.to_radians() / 2.0).tan() / times;
            CameraKind::Perspective { angle: 2.0 * half.atan().to_degrees() }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use common::math::Vec3;
    use common::scene::{Position, Screen};

    fn camera() -> CameraSpec {
        CameraSpec {
            center: DVec3::new(0.0, 0.0, 10.0),
            direction: DVec3::new(0.0, 0.0, -2.0),
            up: DVec3::new(0.3, 1.0, 0.1),
            kind: CameraKind::Perspective { angle: 90.0 },
            lens: None,
            screen: Screen::Flat,
            position: Position { line: 1, column: 1 },
        }
    }

    fn level() -> CameraSpec {
        CameraSpec { up: DVec3::Y, ..camera() }
    }

    fn near(a: DVec3, b: DVec3) -> bool {
        (a - b).length() < 1e-9
    }

    #[test]
    fn standing_still_is_the_camera_itself() {
        assert_eq!(MotionArgs::default().moved(&camera(), None), camera());
    }

    #[test]
    fn zooming_narrows_the_field() {
        let zoomed = MotionArgs { zoom: Some(2.0), ..MotionArgs::default() }.moved(&camera(), None);
        let CameraKind::Perspective { angle } = zoomed.kind else { panic!() };
        assert!((angle - 2.0 * 0.5f64.atan().to_degrees()).abs() < 1e-9);
        let both = MotionArgs { zoom: Some(2.0), move_screen: Some(0.5), ..MotionArgs::default() };
        assert_eq!(both.moved(&camera(), None), camera());
    }

    #[test]
    fn going_round_keeps_distance_and_what_is_in_the_middle() {
        let bounds = Bounds { min: Vec3::new(-1.0, 0.0, -1.0), max: Vec3::new(1.0, 0.0, 1.0) };
        let moved = |right, up| {
            MotionArgs { orbit: Some(vec![right, up]), ..MotionArgs::default() }.moved(&level(), Some(bounds))
        };
        assert!(near(moved(90.0, 0.0).center, DVec3::X * 10.0), "{:?}", moved(90.0, 0.0));
        assert!(near(moved(90.0, 0.0).direction, DVec3::X * -2.0));
        assert!(near(moved(0.0, 90.0).center, DVec3::Y * 10.0), "{:?}", moved(0.0, 90.0));
        let odd = moved(33.0, 21.0);
        assert!((odd.center.length() - 10.0).abs() < 1e-9);
        assert!(near(odd.direction.normalize(), -odd.center.normalize()));
    }

    #[test]
    fn turning_twisting_and_stepping_aside() {
        let moved = |args: MotionArgs| args.moved(&level(), None);
        let turned = moved(MotionArgs { rotate: Some(vec![90.0, 0.0]), ..MotionArgs::default() });
        assert!(near(turned.direction, DVec3::X * 2.0) && near(turned.center, level().center));
        let up = moved(MotionArgs { rotate: Some(vec![0.0, 90.0]), ..MotionArgs::default() });
        assert!(near(up.direction, DVec3::Y * 2.0));
        let twisted = moved(MotionArgs { twist: Some(90.0), ..MotionArgs::default() });
        assert!(near(twisted.up, DVec3::X), "{}", twisted.up);
        let aside = moved(MotionArgs { shift: Some(vec![1.0, 2.0, 3.0]), ..MotionArgs::default() });
        assert!(near(aside.center, DVec3::new(1.0, 2.0, 7.0)));
    }
}
