//! Solids as functions: negative inside, positive outside, near the surface about the distance to
//! it.

use glam::{DMat3, DVec3, dvec3};

/// An ellipsoid in any position.
#[derive(Clone, Copy, Debug)]
pub struct Ellipsoid {
    centre: DVec3,
    /// Rows are the unit axes: takes a world vector to the ellipsoid's own axes.
    to_axes: DMat3,
    /// Half lengths along the axes.
    radii: DVec3,
}

impl Ellipsoid {
    /// An ellipsoid whose first axis points along `first`; the second lies in the plane of `first`
    /// and `second`. Neither need have unit length, but they must not be parallel.
    pub fn new(centre: DVec3, first: DVec3, second: DVec3, radii: DVec3) -> Self {
        let x = first.normalize();
        let z = x.cross(second).normalize();
        Ellipsoid { centre, to_axes: DMat3::from_cols(x, z.cross(x), z).transpose(), radii }
    }

    /// Distance to the surface, exact to first order near it: g / |∇g| for g = |q| · (|q| − 1), q =
    /// p / radii up to a factor that is 1 on the surface.
    pub fn distance(&self, p: DVec3) -> f64 {
        let local = self.to_axes * (p - self.centre);
        let q = local / self.radii;
        let (length, slope) = (q.length(), (q / self.radii).length());
        // At the very centre both lengths vanish; any inner value does.
        if slope > 0.0 { length * (length - 1.0) / slope } else { -self.radii.min_element() }
    }
}

/// How a part joins what is already there. The number is the width over which the two flow
/// together.
#[derive(Clone, Copy, Debug)]
pub enum Join {
    /// Adds the part.
    Add(f64),
    /// Takes the part away.
    Cut(f64),
}

/// Parts joined one after the other, in order.
#[derive(Clone, Debug, Default)]
pub struct Solid {
    parts: Vec<Part>,
    /// Width of the widest blend.
    widest: f64,
}

#[derive(Clone, Copy, Debug)]
struct Part {
    shape: Ellipsoid,
    join: Join,
    /// Square of the distance from the centre beyond which the part is not looked at.
    reach_squared: f64,
}

impl Solid {
    /// Joins one more part to the solid.
    pub fn join(&mut self, shape: Ellipsoid, join: Join) {
        self.parts.push(Part { shape, join, reach_squared: 0.0 });
        let (Join::Add(width) | Join::Cut(width)) = join;
        self.widest = self.widest.max(width);
        for part in &mut self.parts {
            let reach = part.shape.radii.max_element() + 1.5 * self.widest;
            part.reach_squared = reach * reach;
        }
    }

    /// About the distance to the surface, negative inside; `f64::MAX` where no part is near.
    ///
    /// A part beyond its reach is skipped. It is farther away than any blend is wide, so this can
    /// neither change the sign anywhere nor the value near the surface; far away the value is too
    /// large.
    pub fn distance(&self, p: DVec3) -> f64 {
        self.parts.iter().fold(f64::MAX, |so_far, part| {
            if p.distance_squared(part.shape.centre) > part.reach_squared {
                return so_far;
            }
            let d = part.shape.distance(p);
            match part.join {
                Join::Add(width) => smooth_min(so_far, d, width),
                Join::Cut(width) => -smooth_min(-so_far, d, width),
            }
        })
    }

    /// The gradient, from differences along the corners of a tetrahedron of size `step`: as exact
    /// as central differences along the axes, with four values instead of six.
    pub fn gradient(&self, p: DVec3, step: f64) -> DVec3 {
        const CORNERS: [DVec3; 4] =
            [dvec3(1.0, -1.0, -1.0), dvec3(-1.0, -1.0, 1.0), dvec3(-1.0, 1.0, -1.0), dvec3(1.0, 1.0, 1.0)];
        CORNERS.iter().map(|&c| c * self.distance(p + c * step)).sum::<DVec3>() / (4.0 * step)
    }
}

/// The smaller of two values, rounded off by a parabola where they differ by less than `width` > 0.
fn smooth_min(a: f64, b: f64, width: f64) -> f64 {
    let overlap = (width - (a - b).abs()).max(0.0);
    a.min(b) - overlap * overlap / (4.0 * width)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distance_to_a_ball_is_exact() {
        let ball = Ellipsoid::new(DVec3::new(1.0, 2.0, 3.0), DVec3::X, DVec3::Y, DVec3::splat(2.0));
        assert!((ball.distance(DVec3::new(1.0, 2.0, 8.0)) - 3.0).abs() < 1e-14);
        assert!((ball.distance(DVec3::new(1.0, 1.0, 3.0)) + 1.0).abs() < 1e-14);
        assert!(ball.distance(DVec3::new(1.0, 2.0, 3.0)) < 0.0);
    }

    #[test]
    fn tilted_ellipsoid_ends_where_its_axes_end() {
        let radii = DVec3::new(3.0, 1.0, 0.5);
        let e = Ellipsoid::new(DVec3::ZERO, DVec3::new(1.0, 1.0, 0.0), DVec3::Y, radii);
        let diagonal = 0.5_f64.sqrt();
        for tip in [
            DVec3::new(3.0 * diagonal, 3.0 * diagonal, 0.0),
            DVec3::new(-diagonal, diagonal, 0.0),
            DVec3::Z * 0.5,
        ] {
            assert!(e.distance(tip).abs() < 1e-12);
        }
    }

    #[test]
    fn smooth_min_only_differs_near_equality_and_never_rises_above_min() {
        assert_eq!(smooth_min(1.0, 3.0, 0.5), 1.0);
        assert_eq!(smooth_min(1.0, 1.0, 0.4), 0.9);
        assert!(smooth_min(1.0, 1.2, 0.4) < 1.0);
    }

    #[test]
    fn a_cut_takes_away() {
        let ball = |x: f64, r: f64| Ellipsoid::new(DVec3::X * x, DVec3::X, DVec3::Y, DVec3::splat(r));
        let mut solid = Solid::default();
        solid.join(ball(0.0, 1.0), Join::Add(0.1));
        assert!(solid.distance(DVec3::X * 0.9) < 0.0);
        solid.join(ball(1.0, 0.5), Join::Cut(0.1));
        assert!(solid.distance(DVec3::X * 0.9) > 0.0);
        assert!(solid.distance(DVec3::ZERO) < 0.0);
    }
}
