//! Points on the unit circle from square roots alone.

use glam::DVec2;

/// (cos, sin) of 22.5°, a sixteenth of a turn: 45° halved.
pub fn sixteenth_turn() -> DVec2 {
    let cos_45 = 0.5_f64.sqrt();
    DVec2::new(((1.0 + cos_45) / 2.0).sqrt(), ((1.0 - cos_45) / 2.0).sqrt())
}

/// (cos, sin) of 12°, a thirtieth of a turn: 72° − 60°, of which the pentagon gives the first and
/// the triangle the second.
pub fn thirtieth_turn() -> DVec2 {
    let cos_72 = (5.0_f64.sqrt() - 1.0) / 4.0;
    let seventy_two = DVec2::new(cos_72, (1.0 - cos_72 * cos_72).sqrt());
    let minus_sixty = DVec2::new(0.5, -0.75_f64.sqrt());
    seventy_two.rotate(minus_sixty)
}

/// `count` points of the unit circle, counter-clockwise from (1, 0), each `step` (a unit complex
/// number) on from the last.
pub fn points(step: DVec2, count: usize) -> Vec<DVec2> {
    std::iter::successors(Some(DVec2::X), |p| Some(p.rotate(step))).take(count).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_close_the_circle() {
        for (step, count) in [(sixteenth_turn(), 16), (thirtieth_turn(), 30)] {
            let round = points(step, count + 1);
            assert!((round[count] - DVec2::X).length() < 1e-14);
            assert!(round[1..count].iter().all(|p| (*p - DVec2::X).length() > 0.2), "no earlier return");
        }
    }
}
