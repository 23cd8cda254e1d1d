//! The light that a source sends to a point.

use common::math::{DVec3, Vec3};
use common::scene::{LightKind, LightSpec};

/// Where light comes from, for the shadow ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source {
    /// From infinitely far, in this unit direction (towards the light).
    Direction(DVec3),
    /// From this point.
    Point(DVec3),
}

/// Light arriving at a point, were nothing in between.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Incident {
    /// Unit vector towards the light; zero if the point is the light's own position.
    pub direction: Vec3,
    /// Linear RGB that arrives.
    pub color: Vec3,
    /// Where it comes from.
    pub source: Source,
}

/// Where the light of a source comes from. Light spheres send it from their centre.
#[inline]
pub fn source(light: &LightSpec) -> Source {
    match light.kind {
        LightKind::Directional { direction } => Source::Direction(-direction),
        LightKind::Point { position, .. } | LightKind::Sphere { center: position, .. } => {
            Source::Point(position)
        }
    }
}

/// The light that arrives at `point` from one source. Light spheres send it from their centre.
#[inline(always)]
pub fn incident(light: &LightSpec, point: DVec3) -> Incident {
    match light.kind {
        LightKind::Directional { direction } => {
            let towards = -direction;
            let source = Source::Direction(towards);
            Incident { direction: towards.as_vec3(), color: light.color, source }
        }
        LightKind::Point { position, attenuation }
        | LightKind::Sphere { center: position, attenuation, .. } => {
            let to_light = position - point;
            let color = light.color * falloff(attenuation, to_light.length());
            let direction = to_light.normalize_or_zero().as_vec3();
            Incident { direction, color, source: Source::Point(position) }
        }
    }
}

/// What is left of light at a distance: 1 / (a0 + a1·d + a2·d²), and 0 where that would not be a positive number.
#[inline(always)]
pub fn falloff([a0, a1, a2]: [f32; 3], distance: f64) -> f32 {
    let denominator = f64::from(a0) + f64::from(a1) * distance + f64::from(a2) * distance * distance;
    if denominator > 0.0 { (1.0 / denominator) as f32 } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use common::scene::Position;

    fn light(kind: LightKind) -> LightSpec {
        LightSpec { color: Vec3::new(1.0, 0.5, 0.0), kind, position: Position { line: 1, column: 1 } }
    }

    #[test]
    fn a2t2_directional_light_travels_along_its_direction() {
        let sun = light(LightKind::Directional { direction: DVec3::NEG_Y });
        let arriving = incident(&sun, DVec3::splat(1e6));
        assert_eq!((arriving.direction, arriving.color), (Vec3::Y, sun.color));
    }

    #[test]
    fn a2t2_point_light_falls_off() {
        let lamp = |attenuation| light(LightKind::Point { position: DVec3::Y * 2.0, attenuation });
        let at = |attenuation| incident(&lamp(attenuation), DVec3::ZERO).color.x;
        assert_eq!(at([1.0, 0.0, 0.0]), 1.0);
        assert_eq!(at([0.0, 0.25, 0.0]), 2.0);
        assert_eq!(at([0.0, 0.0, 0.5]), 0.5);
        assert_eq!(at([-1.0, 0.0, 0.0]), 0.0, "a negative denominator gives nothing");
        assert_eq!(incident(&lamp([1.0, 0.0, 0.0]), DVec3::Y * 2.0).direction, Vec3::ZERO);
    }
}
