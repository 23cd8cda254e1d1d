//! Single triangles; what holds for all of them is in `tools/stress`.

use super::*;
use crate::ray::Ray;

fn hit(o: [f32; 3], d: [f32; 3], v: [[f32; 3]; 3]) -> Option<TriangleHit> {
    intersect(&ExactRay::new(&Ray::new(o.into(), d.into())), &v.map(Vec3::from))
}

const UNIT: [[f32; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

#[test]
fn middle_has_t_u_v() {
    let h = hit([0.25, 0.5, 2.0], [0.0, 0.0, -2.0], UNIT).unwrap();
    assert_eq!(h, TriangleHit { t: 1.0, u: 0.25, v: 0.5 });
    assert!(hit([0.25, 0.5, -2.0], [0.0, 0.0, 2.0], UNIT).is_some(), "the back is hit too");
    assert!(hit([0.75, 0.5, 2.0], [0.0, 0.0, -1.0], UNIT).is_none());
}

#[test]
fn shared_edges_and_corners_belong_to_one() {
    let other = [[1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    for x in [0.0, 0.25, 0.5, 0.75, 1.0] {
        let ray = ([x, 1.0 - x, 1.0], [0.0, 0.0, -1.0]);
        let hits = [UNIT, other].iter().filter(|v| hit(ray.0, ray.1, **v).is_some()).count();
        let corner = x == 0.0 || x == 1.0;
        assert!(hits == 1 || corner && hits == 0, "x = {x}: {hits} hits");
    }
}

#[test]
fn no_area_and_edge_on_are_missed() {
    assert!(hit([0.5, 0.5, 1.0], [0.0, 0.0, -1.0], [[0.0; 3], [1.0, 1.0, 0.0], [2.0, 2.0, 0.0]]).is_none());
    assert!(hit([-1.0, 0.25, 0.0], [1.0, 0.0, 0.0], UNIT).is_none());
    assert!(hit([0.0; 3], [0.0, 0.0, 1.0], [[0.0; 3]; 3]).is_none());
}

/// The signs of this sliver's weights are certain in `f64`, but their values were off by
/// 10⁻⁵, and t with them: it was 0.9999926.
#[test]
fn thin_triangles_have_precise_t() {
    let f = f32::from_bits;
    let o = [f(0x3ff6_54fa), f(0xbf69_9e9c), f(0x3faf_b259)];
    let d = [f(0xbff6_54fa), f(0x3f69_9e9c), f(0xc000_a320)];
    let h = hit(
        o,
        d,
        [
            [f(0x2c6e_71d3), f(0x2bc7_d538), f(0x3e94_4e43)],
            [f(0xac40_9d0b), f(0x2b29_31bb), f(0xbf44_667e)],
            [f(0x2bf6_55c7), f(0x2c2e_5150), f(0xbee5_2230)],
        ],
    );
    assert_eq!(h.map(|h| h.t), Some(1.0));
}

#[test]
fn the_whole_range_of_f32() {
    for scale in [1e-45, 1e-38, 1e-20, 1.0, 1e20, 1e38] {
        let v = UNIT.map(|p| p.map(|x| x * scale));
        let h = hit([0.0, 0.0, scale], [0.0, 0.0, -1.0], v.map(|p| [p[0] - 0.0, p[1], p[2]]));
        assert!(h.is_none_or(|h| h.t.is_finite()), "{scale}");
        let h = hit([scale * 0.25, scale * 0.25, -scale], [0.0, 0.0, 1e-30], v);
        assert!(scale < 1e-40 || h.is_some(), "{scale}");
    }
}
