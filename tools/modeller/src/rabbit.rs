//! The rabbit: one animal as an implicit solid, polygonised once and reduced to four levels of detail.
//!
//! It is modelled in tenths of the scene's unit, standing on y = 0, head towards −x and a little to +z.

use crate::implicit::{Ellipsoid, Join, Solid};
use crate::mesh::{Bounds, Mesh};
use crate::polygonise::polygonise;
use crate::reduce::reduce;
use crate::relax::relax;
use glam::{DVec3, dvec3};

/// The box that the cameras of the bunny scenes are made for.
pub const BOX: Bounds = Bounds {
    min: dvec3(-0.189, 0.067, -0.123),
    max: dvec3(0.122, 0.374, 0.118),
};

/// Cell size of the first, fine polygonisation.
const CELL: f64 = 0.036;

/// The rabbit with each of the given numbers of triangles, which must be even and fall from level to level.
pub fn levels<const N: usize>(counts: [usize; N]) -> [Mesh; N] {
    let solid = rabbit();
    let space = Bounds {
        min: dvec3(-2.1, -0.2, -1.5),
        max: dvec3(2.1, 4.0, 1.5),
    };
    let mut mesh = polygonise(|p| solid.distance(p), space, CELL);
    relax(&mut mesh, &solid, 3);
    counts.map(|count| {
        mesh = reduce(&mesh, count);
        // Evening out is for fine levels only: coarse ones need their long thin triangles on the ears.
        if count >= 5000 {
            relax(&mut mesh, &solid, 4);
        }
        let mut level = mesh.clone();
        level.fit(BOX);
        level.order_spatially();
        level
    })
}

/// A place and three directions: the head is modelled facing along `forward` and then turned as a whole.
struct Frame {
    origin: DVec3,
    forward: DVec3,
    up: DVec3,
    side: DVec3,
}

impl Frame {
    fn new(origin: DVec3, forward: DVec3, up: DVec3) -> Self {
        let forward = forward.normalize();
        let side = forward.cross(up).normalize();
        Frame {
            origin,
            forward,
            up: side.cross(forward),
            side,
        }
    }

    fn direction(&self, v: DVec3) -> DVec3 {
        self.forward * v.x + self.up * v.y + self.side * v.z
    }

    fn point(&self, v: DVec3) -> DVec3 {
        self.origin + self.direction(v)
    }
}

/// The whole animal.
pub fn rabbit() -> Solid {
    let mut solid = Solid::default();
    let body = Frame::new(DVec3::ZERO, -DVec3::X, DVec3::Y);
    trunk(&mut solid, &body);
    legs(&mut solid, &body);
    let head = Frame::new(dvec3(-0.98, 1.86, 0.05), dvec3(-1.0, -0.16, 0.3), DVec3::Y);
    skull(&mut solid, &head);
    ears(&mut solid, &head);
    solid
}

/// Adds an ellipsoid given in a frame: centre, direction of its first axis, radii (first, upward, sideward).
fn add(solid: &mut Solid, frame: &Frame, centre: DVec3, first: DVec3, radii: DVec3, width: f64) {
    let part = Ellipsoid::new(frame.point(centre), frame.direction(first), frame.up, radii);
    solid.join(part, Join::Add(width));
}

fn trunk(solid: &mut Solid, body: &Frame) {
    let level = dvec3(1.0, 0.0, 0.0);
    add(
        solid,
        body,
        dvec3(-0.45, 0.95, 0.0),
        dvec3(1.0, 0.1, 0.0),
        dvec3(1.0, 0.93, 0.86),
        0.1,
    );
    add(
        solid,
        body,
        dvec3(0.35, 0.95, 0.0),
        dvec3(0.5, 1.0, 0.0),
        dvec3(0.82, 0.6, 0.6),
        0.5,
    );
    add(
        solid,
        body,
        dvec3(0.72, 1.35, 0.0),
        dvec3(0.4, 1.0, 0.0),
        dvec3(0.5, 0.4, 0.42),
        0.4,
    );
    add(
        solid,
        body,
        dvec3(-1.5, 0.62, 0.0),
        level,
        dvec3(0.3, 0.3, 0.3),
        0.08,
    );
}

fn legs(solid: &mut Solid, body: &Frame) {
    let level = dvec3(1.0, 0.0, 0.0);
    for side in [-1.0, 1.0] {
        let outward = dvec3(1.0, 0.0, side * 0.15);
        add(
            solid,
            body,
            dvec3(-0.62, 0.66, side * 0.72),
            dvec3(1.0, 0.5, 0.0),
            dvec3(0.68, 0.6, 0.42),
            0.15,
        );
        add(
            solid,
            body,
            dvec3(-0.12, 0.15, side * 0.88),
            outward,
            dvec3(0.62, 0.16, 0.23),
            0.12,
        );
        toes(solid, body, dvec3(0.38, 0.13, side * 0.96), 0.14);
        add(
            solid,
            body,
            dvec3(0.72, 0.6, side * 0.34),
            dvec3(0.12, 1.0, 0.0),
            dvec3(0.62, 0.24, 0.22),
            0.2,
        );
        add(
            solid,
            body,
            dvec3(0.86, 0.14, side * 0.36),
            level,
            dvec3(0.3, 0.15, 0.2),
            0.12,
        );
        toes(solid, body, dvec3(1.08, 0.12, side * 0.36), 0.12);
    }
}

/// Three toes side by side, the middle one at `centre`.
fn toes(solid: &mut Solid, body: &Frame, centre: DVec3, apart: f64) {
    for place in [-1.0, 0.0, 1.0] {
        let back = if place == 0.0 { 0.0 } else { -0.05 };
        let toe = centre + dvec3(back, 0.0, place * apart);
        add(
            solid,
            body,
            toe,
            dvec3(1.0, 0.0, 0.0),
            dvec3(0.15, 0.11, 0.085),
            0.025,
        );
    }
}

fn skull(solid: &mut Solid, head: &Frame) {
    let level = dvec3(1.0, 0.0, 0.0);
    add(
        solid,
        head,
        dvec3(0.0, 0.0, 0.0),
        level,
        dvec3(0.56, 0.5, 0.46),
        0.25,
    );
    add(
        solid,
        head,
        dvec3(0.4, -0.13, 0.0),
        level,
        dvec3(0.34, 0.28, 0.27),
        0.2,
    );
    for side in [-1.0, 1.0] {
        add(
            solid,
            head,
            dvec3(0.25, -0.22, side * 0.24),
            level,
            dvec3(0.3, 0.25, 0.22),
            0.15,
        );
        eye(
            solid,
            head,
            dvec3(0.28, 0.12, side * 0.38),
            dvec3(0.35, 0.1, side),
        );
    }
    // The muzzle: two soft halves, a groove between them and the nose above it.
    for side in [-1.0, 1.0] {
        add(
            solid,
            head,
            dvec3(0.62, -0.2, side * 0.1),
            level,
            dvec3(0.14, 0.12, 0.12),
            0.05,
        );
    }
    add(
        solid,
        head,
        dvec3(0.73, -0.05, 0.0),
        level,
        dvec3(0.07, 0.06, 0.1),
        0.04,
    );
}

/// A ball in a shallow socket.
fn eye(solid: &mut Solid, head: &Frame, centre: DVec3, outward: DVec3) {
    let part = |out: f64, radii: DVec3| {
        Ellipsoid::new(
            head.point(centre + outward * out),
            head.direction(outward),
            head.up,
            radii,
        )
    };
    solid.join(part(0.12, dvec3(0.15, 0.15, 0.2)), Join::Cut(0.08));
    solid.join(part(-0.04, dvec3(0.11, 0.11, 0.12)), Join::Add(0.015));
}

fn ears(solid: &mut Solid, head: &Frame) {
    for side in [-1.0, 1.0] {
        let root = dvec3(-0.12, 0.38, side * 0.2);
        let low = dvec3(-0.22, 1.0, side * 0.2);
        let high = dvec3(-0.62, 1.0, side * 0.26);
        // The ear's hollow faces forward and outward.
        let facing = dvec3(0.72, 0.0, side * 0.7);
        let (first, second) = (root + low * 0.42, root + low * 0.78 + high * 0.1);
        ear_part(
            solid,
            head,
            first,
            low,
            facing,
            dvec3(0.58, 0.14, 0.24),
            Join::Add(0.15),
        );
        ear_part(
            solid,
            head,
            second,
            high,
            facing,
            dvec3(0.58, 0.12, 0.25),
            Join::Add(0.1),
        );
        ear_part(
            solid,
            head,
            first + facing * 0.15,
            low,
            facing,
            dvec3(0.5, 0.11, 0.15),
            Join::Cut(0.06),
        );
        ear_part(
            solid,
            head,
            second + facing * 0.13,
            high,
            facing,
            dvec3(0.44, 0.1, 0.16),
            Join::Cut(0.06),
        );
    }
}

/// Joins an ellipsoid that is long `along`, thin towards `facing`; radii (length, thickness, breadth).
fn ear_part(
    solid: &mut Solid,
    head: &Frame,
    centre: DVec3,
    along: DVec3,
    facing: DVec3,
    radii: DVec3,
    join: Join,
) {
    let part = Ellipsoid::new(
        head.point(centre),
        head.direction(along),
        head.direction(facing),
        radii,
    );
    solid.join(part, join);
}
