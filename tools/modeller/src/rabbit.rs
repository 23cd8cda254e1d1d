//! The rabbit: one animal as an implicit solid, polygonised finely. What lies in `scenes/meshes` is
//! made from that by assignment 9.
//!
//! It is modelled in tenths of the scene's unit, standing on y = 0, head towards −x and turned a
//! little to +z.

use crate::implicit::{Ellipsoid, Join, Join::Add, Join::Cut, Solid};
use crate::mesh::{Bounds, Mesh};
use crate::polygonise::polygonise;
use crate::relax::relax;
use glam::{DVec3, dvec3};

/// The box that the cameras of the bunny scenes are made for.
pub const BOX: Bounds = Bounds { min: dvec3(-0.189, 0.067, -0.123), max: dvec3(0.122, 0.374, 0.118) };

/// Cell size of the polygonisation.
const CELL: f64 = 0.036;
/// A box with room for the whole model.
const SPACE: Bounds = Bounds { min: dvec3(-2.1, -0.2, -1.5), max: dvec3(2.1, 4.0, 1.5) };
/// The rabbit with many more triangles than any scene uses, numbered along a curve through space.
pub fn fine() -> Mesh {
    let solid = rabbit();
    let mut mesh = polygonise(|p| solid.distance(p), SPACE, CELL);
    relax(&mut mesh, &solid, 3);
    mesh.fit(BOX);
    mesh.order_spatially();
    mesh
}

/// The whole animal.
pub fn rabbit() -> Solid {
    let body = Frame::new(DVec3::ZERO, -DVec3::X);
    let head = Frame::new(dvec3(-0.98, 1.86, 0.05), dvec3(-1.0, -0.12, 1.05));
    let mut solid = Solid::default();
    add_all(&mut solid, &body, &TRUNK);
    add_all(&mut solid, &body, &LEGS);
    add_all(&mut solid, &head, &SKULL);
    add_all(&mut solid, &head, &EARS);
    solid
}

/// A place and three directions: the head is modelled facing forward and then turned as a whole.
struct Frame {
    origin: DVec3,
    forward: DVec3,
    up: DVec3,
    side: DVec3,
}

impl Frame {
    /// Faces `forward`, which must not be vertical.
    fn new(origin: DVec3, forward: DVec3) -> Self {
        let forward = forward.normalize();
        let side = forward.cross(DVec3::Y).normalize();
        Frame { origin, forward, up: side.cross(forward), side }
    }

    fn direction(&self, v: DVec3) -> DVec3 {
        self.forward * v.x + self.up * v.y + self.side * v.z
    }
}

/// How often a part occurs.
#[derive(Clone, Copy, PartialEq)]
enum Copies {
    /// In the middle.
    One,
    /// As given, and mirrored to the other side.
    Pair,
}
use Copies::{One, Pair};

/// An ellipsoid in a frame; every triple is (forward, up, sideward).
struct Part {
    centre: [f64; 3],
    /// Direction of the first axis.
    first: [f64; 3],
    /// The second axis lies in the plane of this direction and the first.
    second: [f64; 3],
    /// Half lengths along first, second and third axis.
    radii: [f64; 3],
    join: Join,
    copies: Copies,
}

fn add_all(solid: &mut Solid, frame: &Frame, parts: &[Part]) {
    for part in parts {
        add(solid, frame, part, 1.0);
        if part.copies == Pair {
            add(solid, frame, part, -1.0);
        }
    }
}

/// Joins `part`, or for `side` = −1 its mirror image.
fn add(solid: &mut Solid, frame: &Frame, part: &Part, side: f64) {
    let place = |[x, y, z]: [f64; 3]| frame.direction(dvec3(x, y, side * z));
    let centre = frame.origin + place(part.centre);
    let shape = Ellipsoid::new(centre, place(part.first), place(part.second), part.radii.into());
    solid.join(shape, part.join);
}

const fn part(
    centre: [f64; 3],
    first: [f64; 3],
    second: [f64; 3],
    radii: [f64; 3],
    join: Join,
    copies: Copies,
) -> Part {
    Part { centre, first, second, radii, join, copies }
}

const AHEAD: [f64; 3] = [1.0, 0.0, 0.0];
const UP: [f64; 3] = [0.0, 1.0, 0.0];
/// Hind feet point outwards a little.
const SPLAY: [f64; 3] = [1.0, 0.0, 0.15];
/// Where the eyes look.
const GAZE: [f64; 3] = [0.35, 0.1, 1.0];
/// Lower and upper half of an ear, and the side its hollow faces.
const EAR: [f64; 3] = [-0.22, 1.0, 0.2];
const TIP: [f64; 3] = [-0.55, 1.0, 0.36];
const HOLLOW: [f64; 3] = [0.72, 0.0, 0.7];

#[rustfmt::skip]
const TRUNK: [Part; 4] = [
    /* rump      */ part([-0.45, 0.95, 0.0], [1.0, 0.1, 0.0], UP, [1.0, 0.93, 0.86], Add(0.1), One),
    /* chest     */ part([0.35, 0.95, 0.0], [0.5, 1.0, 0.0], UP, [0.82, 0.6, 0.6], Add(0.5), One),
    /* neck      */ part([0.72, 1.35, 0.0], [0.4, 1.0, 0.0], UP, [0.5, 0.4, 0.42], Add(0.4), One),
    /* tail      */ part([-1.5, 0.62, 0.0], AHEAD, UP, [0.3, 0.3, 0.3], Add(0.08), One),
];

#[rustfmt::skip]
const LEGS: [Part; 10] = [
    /* haunch    */ part([-0.62, 0.66, 0.72], [1.0, 0.5, 0.0], UP, [0.68, 0.6, 0.42], Add(0.15), Pair),
    /* hind foot */ part([-0.12, 0.15, 0.88], SPLAY, UP, [0.62, 0.16, 0.23], Add(0.12), Pair),
    /* toes      */ part([0.33, 0.13, 0.82], AHEAD, UP, [0.15, 0.11, 0.085], Add(0.025), Pair),
                    part([0.38, 0.13, 0.96], AHEAD, UP, [0.15, 0.11, 0.085], Add(0.025), Pair),
                    part([0.33, 0.13, 1.1], AHEAD, UP, [0.15, 0.11, 0.085], Add(0.025), Pair),
    /* fore leg  */ part([0.72, 0.6, 0.34], [0.12, 1.0, 0.0], AHEAD, [0.62, 0.24, 0.22], Add(0.2), Pair),
    /* paw       */ part([0.86, 0.14, 0.36], AHEAD, UP, [0.3, 0.15, 0.2], Add(0.12), Pair),
    /* toes      */ part([1.03, 0.12, 0.24], AHEAD, UP, [0.15, 0.11, 0.085], Add(0.025), Pair),
                    part([1.08, 0.12, 0.36], AHEAD, UP, [0.15, 0.11, 0.085], Add(0.025), Pair),
                    part([1.03, 0.12, 0.48], AHEAD, UP, [0.15, 0.11, 0.085], Add(0.025), Pair),
];

#[rustfmt::skip]
const SKULL: [Part; 7] = [
    /* skull     */ part([0.0, 0.0, 0.0], AHEAD, UP, [0.56, 0.5, 0.46], Add(0.25), One),
    /* snout     */ part([0.4, -0.13, 0.0], AHEAD, UP, [0.34, 0.28, 0.27], Add(0.2), One),
    /* cheek     */ part([0.25, -0.22, 0.24], AHEAD, UP, [0.3, 0.25, 0.22], Add(0.15), Pair),
    /* socket    */ part([0.32, 0.13, 0.5], GAZE, UP, [0.15, 0.15, 0.2], Cut(0.08), Pair),
    /* eye       */ part([0.264, 0.115, 0.335], GAZE, UP, [0.13, 0.12, 0.14], Add(0.03), Pair),
    /* muzzle    */ part([0.62, -0.2, 0.1], AHEAD, UP, [0.14, 0.12, 0.12], Add(0.05), Pair),
    /* nose      */ part([0.73, -0.05, 0.0], AHEAD, UP, [0.07, 0.06, 0.1], Add(0.04), One),
];

#[rustfmt::skip]
const EARS: [Part; 4] = [
    /* ear       */ part([-0.21, 0.8, 0.284], EAR, HOLLOW, [0.58, 0.14, 0.24], Add(0.15), Pair),
    /* tip       */ part([-0.354, 1.26, 0.4], TIP, HOLLOW, [0.58, 0.12, 0.25], Add(0.1), Pair),
    /* hollow    */ part([-0.12, 0.92, 0.41], EAR, HOLLOW, [0.44, 0.11, 0.15], Cut(0.06), Pair),
    /* its tip   */ part([-0.26, 1.26, 0.491], TIP, HOLLOW, [0.44, 0.1, 0.16], Cut(0.06), Pair),
];
