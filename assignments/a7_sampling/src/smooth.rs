//! Smoothing a finished picture, for comparison: it hides edges and adds nothing that was not
//! seen.

use common::math::Vec3;
use common::picture::Film;

/// Weights of a pixel and its eight neighbours, over 16.
const WEIGHTS: [[f32; 3]; 3] = [[1.0, 2.0, 1.0], [2.0, 4.0, 2.0], [1.0, 2.0, 1.0]];

/// Every pixel becomes the weighted mean of itself and its neighbours, with weights 1 2 1, 2 4 2,
/// 1 2 1; beyond the border there are none. With a threshold only pixels change that differ by
/// more than it from one of their neighbours, in some channel.
pub fn smoothed(film: &Film, threshold: Option<f32>) -> Film {
    Film::from_fn(film.size(), |x, y| {
        let own = film.get(x, y);
        let differs =
            |limit: f32| neighbours(film, x, y).any(|(_, color)| (color - own).abs().max_element() > limit);
        if threshold.is_some_and(|limit| !differs(limit)) {
            return own;
        }
        let sum = neighbours(film, x, y).fold((Vec3::ZERO, 0.0), |(sum, weights), (weight, color)| {
            (sum + color * weight, weights + weight)
        });
        sum.0 / sum.1
    })
}

/// A pixel and those around it, with their weights.
fn neighbours(film: &Film, x: u32, y: u32) -> impl Iterator<Item = (f32, Vec3)> + '_ {
    let near = |at: u32, end: u32, step: u32| (at + step).checked_sub(1).filter(|n| *n < end);
    (0..9u32).filter_map(move |i| {
        let (column, row) = (i % 3, i / 3);
        let at = (near(x, film.width(), column)?, near(y, film.height(), row)?);
        Some((WEIGHTS[row as usize][column as usize], film.get(at.0, at.1)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use common::picture::Size;

    fn step() -> Film {
        Film::from_fn(Size::new(6, 4).unwrap(), |x, _| Vec3::splat(if x < 3 { 0.0 } else { 1.0 }))
    }

    #[test]
    fn an_edge_becomes_a_ramp_and_flat_parts_stay() {
        let film = smoothed(&step(), None);
        let row: Vec<f32> = film.row(2).iter().map(|c| c.x).collect();
        assert_eq!(row, [0.0, 0.0, 0.25, 0.75, 1.0, 1.0]);
        assert_eq!(film.row(0)[2].x, 0.25, "at the border too");
    }

    #[test]
    fn a_threshold_leaves_small_steps_alone() {
        assert_eq!(smoothed(&step(), Some(1.0)), step());
        assert_eq!(smoothed(&step(), Some(0.99)), smoothed(&step(), None));
    }
}
