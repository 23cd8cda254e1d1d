//! The directions in which a sphere is seen.

use crate::aperture::disc;
use common::math::DVec3;
use common::shape::sphere::Sphere;
use std::f64::consts::TAU;

/// The cone that a sphere fills, as seen from a point outside; from inside, all directions.
#[derive(Clone, Copy, Debug)]
pub struct Cone {
    to_center: DVec3,
    distance: f64,
    radius: f64,
    /// 1 − cos of half its angle; 2 from inside.
    height: f64,
}

impl Cone {
    /// Of a sphere seen from `point`.
    pub fn new(sphere: &Sphere, point: DVec3) -> Self {
        let to_center = sphere.center - point;
        let (distance, radius) = (to_center.length(), sphere.radius);
        let sine_squared = (radius / distance).powi(2);
        // 1 − √(1 − s²) without taking a difference of almost equal numbers.
        let outside = distance > radius;
        let height = if outside { sine_squared / (1.0 + (1.0 - sine_squared).sqrt()) } else { 2.0 };
        Self { to_center, distance, radius, height }
    }

    /// Whether the point that looks is outside the sphere.
    pub fn is_outside(&self) -> bool {
        self.height < 2.0
    }

    /// Its solid angle in steradian.
    pub fn solid_angle(&self) -> f64 {
        TAU * self.height
    }

    /// The unit direction for a point of the unit square, uniform over the cone, and the distance
    /// of the sphere in that direction (of its far side, from inside).
    pub fn direction(&self, uv: [f64; 2]) -> (DVec3, f64) {
        let (x, y) = disc(uv);
        let squared = x * x + y * y;
        let down = self.height * squared;
        // The disc's radius is √squared; the cone's sine at this height is √(down·(2 − down)).
        let spread = (self.height * (2.0 - down)).max(0.0).sqrt();
        let axis = (self.to_center / self.distance).normalize_or(DVec3::Z);
        let (a, b) = axis.any_orthonormal_pair();
        let direction = (a * (x * spread) + b * (y * spread) + axis * (1.0 - down)).normalize();
        let cosine = 1.0 - down;
        let sine_squared = down * (2.0 - down);
        let half_chord = (self.radius.powi(2) - self.distance.powi(2) * sine_squared).max(0.0).sqrt();
        let along = self.distance * cosine;
        (direction, if self.is_outside() { along - half_chord } else { along + half_chord })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SPHERE: Sphere = Sphere { center: DVec3::new(1.0, 2.0, 3.0), radius: 0.7 };

    fn grid(n: u32) -> impl Iterator<Item = [f64; 2]> {
        let at = move |i: u32| (f64::from(i) + 0.5) / f64::from(n);
        (0..n * n).map(move |i| [at(i % n), at(i / n)])
    }

    #[test]
    fn a7t5_directions_meet_the_sphere_where_they_say() {
        for point in [DVec3::ZERO, DVec3::new(1.0, 2.0, 2.2), DVec3::new(1.0, 2.3, 3.2), SPHERE.center] {
            let cone = Cone::new(&SPHERE, point);
            for uv in grid(20) {
                let (direction, distance) = cone.direction(uv);
                let off = (point + direction * distance - SPHERE.center).length() - SPHERE.radius;
                assert!(off.abs() < 1e-7 && distance > 0.0, "{point} {uv:?} {off}");
            }
        }
    }

    /// Uniform over the cone: the mean cosine to its axis is 1 − height/2, that of all others 0.
    #[test]
    fn a7t5_directions_are_uniform_over_the_solid_angle() {
        for point in [DVec3::ZERO, DVec3::new(1.0, 2.0, 2.2), DVec3::new(-500.0, 2.0, 3.0)] {
            let cone = Cone::new(&SPHERE, point);
            let axis = cone.to_center.normalize();
            let mean: DVec3 = grid(100).map(|uv| cone.direction(uv).0).sum::<DVec3>() / 1e4;
            let expected = axis * (1.0 - cone.height / 2.0);
            assert!((mean - expected).length() < 1e-4 * cone.height.sqrt(), "{point}: {mean} {expected}");
        }
        let exact = TAU * (1.0 - (1.0 - 0.7f64.powi(2) / 14.0).sqrt());
        assert!((Cone::new(&SPHERE, DVec3::ZERO).solid_angle() - exact).abs() < 1e-12);
    }

    #[test]
    fn a7t5_from_inside_all_directions_count_alike() {
        let cone = Cone::new(&SPHERE, SPHERE.center + DVec3::X * 0.3);
        let mean: DVec3 = grid(100).map(|uv| cone.direction(uv).0).sum::<DVec3>() / 1e4;
        assert!(mean.length() < 1e-3 && (cone.solid_angle() - 2.0 * TAU).abs() < 1e-12, "{mean}");
    }
}
