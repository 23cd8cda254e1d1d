//! Property 7: what is near but not the same is told apart.

use super::leaving::EPS;
use crate::Stress;
use crate::kit::{build, ray_bits};
use common::accel::{Accel, List};
use common::counters::Counters;
use common::math::Interval;
use common::mesh::Mesh;
use common::ray::Ray;

/// Two planes 64 eps·S apart: what leaves the lower one upward meets the upper one, and what
/// leaves the upper one upward meets nothing.
pub fn close_planes(stress: &Stress) {
    stress.run("p07 two planes", 702, 100_000, |draw| {
        let n = draw.direction();
        let reach = draw.magnitude(-6.0, 7.0);
        let low = draw.between(-1.0, 1.0) * reach;
        let gap = 64.0 * EPS * reach;
        let plane = |offset: f64| format!("Plane {{ normal {} {} {} offset {offset} }}", n.x, n.y, n.z);
        let geometry =
            build(&format!("Group {{ numObjects 2 {} {} }}", plane(low), plane(low + gap)), Mesh::default());
        let list = List::new(&geometry);
        let onto = n * low + n.any_orthonormal_vector() * reach * draw.unit() / 2.0;
        let from_below = Ray::new((onto - n * reach).as_vec3(), n.as_vec3());
        let hits = [Interval::FORWARD, Interval { min: reach as f32, max: f32::INFINITY }];
        let find = |ray: &Ray, i: Interval| list.nearest(ray, i, &mut Counters::default());
        let lower = find(&from_below, hits[0]).filter(|h| h.primitive == 0);
        let Some(lower) = lower else { return Err(format!("lower plane missed\n{}", ray_bits(&from_below))) };
        let direction = (n + n.any_orthonormal_vector() * draw.between(0.0, 3.0)).normalize().as_vec3();
        let surface = geometry.surface(&from_below, &lower);
        let between = Ray::new(surface.leave(direction.as_dvec3()), direction);
        let Some(upper) = find(&between, Interval::FORWARD).filter(|h| h.primitive == 1) else {
            return Err(format!("the upper plane leaks\n{}", ray_bits(&between)));
        };
        let above = geometry.surface(&between, &upper).leave(direction.as_dvec3());
        let free = find(&Ray::new(above, direction), Interval::FORWARD);
        if free.is_some() { Err(format!("false shadow\n{}", ray_bits(&between))) } else { Ok(0.0) }
    });
}
