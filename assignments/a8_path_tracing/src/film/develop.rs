//! From sums to pictures.

use super::{Aov, Sums};
use common::math::Vec3;
use common::picture::{Film, Kind, Transfer};
use std::path::Path;

/// Mean radiance, linear light; the size is that of the part.
pub fn radiance(sums: &Sums) -> Film {
    of_pixels(sums, |number| sums.radiance(number))
}

/// A picture of an AOV for a file of this name; `None` if the sums have none. Files of floats get
/// the means as they are. In 8-bit files normals are halved and moved from [−1, 1] to [0, 1], and
/// depths are grey from white (nearest) to dark (farthest), black where nothing was met.
pub fn aov(sums: &Sums, aov: Aov, path: &Path) -> Option<Film> {
    sums.layout.place(aov)?;
    let value = |number: usize| sums.aov(aov, number).unwrap_or_default();
    // What has no suffix is a stream, which gets a TGA.
    let is_float = Kind::of_path(path).is_ok_and(Kind::is_float);
    Some(match aov {
        Aov::Normal if !is_float => of_pixels(sums, |number| value(number) * 0.5 + 0.5),
        Aov::Depth if !is_float => grey_depth(sums, value),
        _ => of_pixels(sums, value),
    })
}

/// How an AOV is coded in 8-bit files, where `color` is how the picture is.
pub fn transfer(aov: Aov, color: Transfer) -> Transfer {
    if aov == Aov::Albedo { color } else { Transfer::Linear }
}

/// Grey of what is farthest: not black, which is where nothing is.
const FARTHEST: f32 = 0.1;

fn grey_depth(sums: &Sums, depth: impl Fn(usize) -> Vec3) -> Film {
    let met = (0..sums.taken().len()).map(|number| depth(number).x).filter(|depth| *depth != 0.0);
    let (nearest, farthest) =
        met.fold((f32::INFINITY, f32::NEG_INFINITY), |(near, far), depth| (near.min(depth), far.max(depth)));
    let grey = |depth: f32| {
        if depth == 0.0 {
            return 0.0;
        }
        let share = if farthest > nearest { (farthest - depth) / (farthest - nearest) } else { 1.0 };
        FARTHEST + (1.0 - FARTHEST) * share
    };
    of_pixels(sums, |number| Vec3::splat(grey(depth(number).x)))
}

fn of_pixels(sums: &Sums, value: impl Fn(usize) -> Vec3) -> Film {
    let mut film = Film::new(sums.frame.crop_size());
    for (number, pixel) in film.pixels_mut().iter_mut().enumerate() {
        *pixel = value(number);
    }
    film
}
