//! Cameras: frames, rays and back again, lenses, what a part of the picture sees.

use super::*;
use crate::math::Vec3;
use crate::scene::Position;

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

/// Whatever point of the lens it passes, a ray meets the one through the middle in the plane in
/// focus; nearer and farther points are spread over a disc of the thin lens's radius.
#[test]
fn a_lens_blurs_what_is_out_of_focus_by_the_thin_lens_equation() {
    for kind in [CameraKind::Perspective { angle: 60.0 }, CameraKind::Orthographic { size: 4.0 }] {
        let mut c = camera(kind);
        c.lens = Some(Lens { aperture: 0.5, focal_distance: 6.0, blades: None });
        let (screen, rim) = ((0.8, 0.3), (0.6, -0.8));
        let (middle, off) = (c.ray(screen), c.ray_through_lens(screen, rim));
        for depth in [1.0, 3.0, 6.0, 24.0] {
            let at = |ray: &Ray| {
                let from = ray.origin.as_dvec3() - c.center;
                let t = (depth - from.dot(c.direction)) / ray.direction.as_dvec3().dot(c.direction);
                ray.origin.as_dvec3() + ray.direction.as_dvec3() * t
            };
            let (blur, expected) = ((at(&off) - at(&middle)).length(), 0.25 * (depth - 6.0).abs() / 6.0);
            assert!((blur - expected).abs() < 1e-5, "{kind:?} at {depth}: {blur} {expected}");
        }
    }
}

#[test]
fn a_curved_screen_has_equal_angles_per_pixel() {
    let mut c = camera(CameraKind::Perspective { angle: 120.0 });
    c.screen = Screen::Curved;
    let direction = |x: f64, y: f64| c.ray((x, y)).direction;
    for i in 0..10 {
        let (a, b) = (f64::from(i) / 10.0, f64::from(i + 1) / 10.0);
        let cosine = 12f32.to_radians().cos();
        assert!((direction(a, 0.5).dot(direction(b, 0.5)) - cosine).abs() < 1e-5);
        assert!((direction(0.5, a).dot(direction(0.5, b)) - cosine).abs() < 1e-5);
        assert!((direction(a, 0.2).length() - 1.0).abs() < 1e-6);
    }
    assert!((direction(0.5, 0.5) - Vec3::NEG_Z).length() < 1e-6);
}

/// Side by side rays get the bits that each gets alone.
#[test]
fn rays_of_many_points_are_those_of_each() {
    let kinds = [CameraKind::Orthographic { size: 4.0 }, CameraKind::Perspective { angle: 73.0 }];
    for (kind, screen) in kinds.into_iter().flat_map(|k| [(k, Screen::Flat), (k, Screen::Curved)]) {
        let mut camera = camera(kind);
        camera.screen = screen;
        for count in [0, 1, 7, 8, 9, 50] {
            let at = |i: i32| (f64::from(i) * 0.618 % 1.0, f64::from(i) * 0.414 % 1.0);
            let points: Vec<_> = (0..count).map(at).collect();
            let (mut all, mut each) = (Vec::new(), Vec::new());
            camera.rays(&points, &mut all);
            each.extend(points.iter().map(|point| camera.ray(*point)));
            assert_eq!(all, each, "{kind:?} {screen:?}");
        }
    }
}
