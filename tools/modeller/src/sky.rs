//! The sky of `scenes/`: a picture of all directions, as a light.
//!
//! Latitude and longitude: 64 × 32 pixels, the top row straight up, linear radiance, a portable
//! float map. Above the horizon it is pale at the rim and blue at the top, below it there is earth;
//! a sun of 3 × 3 pixels gives a flat floor about as much light as all the rest.

/// Pixels along the horizon, and from below to above.
pub const SIZE: [usize; 2] = [64, 32];

/// Name of the file.
pub const NAME: &str = "sky.pfm";

type Color = [f64; 3];

const RIM: Color = [0.9, 0.85, 0.75];
const TOP: Color = [0.12, 0.25, 0.6];
const EARTH: Color = [0.18, 0.15, 0.12];
const SUN: Color = [36.0, 30.0, 21.0];

/// First and last column, and row from below, of the sun.
const SUN_AT: [[usize; 2]; 2] = [[13, 15], [24, 26]];

/// Radiance of a pixel; `y` counts from below.
pub fn radiance(x: usize, y: usize) -> Color {
    let horizon = SIZE[1] / 2;
    if [x, y].iter().zip(SUN_AT).all(|(at, [low, high])| (low..=high).contains(at)) {
        return SUN;
    }
    if y < horizon {
        return EARTH;
    }
    let height = ((y - horizon) as f64 + 0.5) / horizon as f64;
    // Most of the change is near the rim.
    let share = (1.0 - height) * (1.0 - height);
    let glow = glow(x, y);
    [0, 1, 2].map(|c| RIM[c] * share + TOP[c] * (1.0 - share) + glow * SUN[c] / SUN[0])
}

/// Brightness around the sun: it falls with the square of the distance in pixels.
fn glow(x: usize, y: usize) -> f64 {
    let middle = |[low, high]: [usize; 2]| (low + high) as f64 / 2.0;
    let (across, up) = (x as f64 - middle(SUN_AT[0]), y as f64 - middle(SUN_AT[1]));
    4.0 / (4.0 + across * across + up * up)
}

/// The file.
pub fn bytes() -> Vec<u8> {
    let [width, height] = SIZE;
    let mut bytes = format!("PF\n{width} {height}\n-1.0\n").into_bytes();
    for y in 0..height {
        for x in 0..width {
            bytes.extend(radiance(x, y).into_iter().flat_map(|c| (c as f32).to_le_bytes()));
        }
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Light on a flat floor, in parts of π: of a row of the upper half by the exact integral of
    /// the cosine over its solid angle.
    fn irradiance(of: impl Fn(usize, usize) -> f64) -> f64 {
        let [width, height] = SIZE;
        let edge = |y: usize| (std::f64::consts::PI * (y as f64 / height as f64 - 0.5)).sin().powi(2);
        let row = |y: usize| (edge(y + 1) - edge(y)) / width as f64;
        (height / 2..height).map(|y| (0..width).map(|x| of(x, y)).sum::<f64>() * row(y)).sum()
    }

    #[test]
    fn the_sun_gives_about_as_much_as_the_rest() {
        let is_sun = |x: usize, y: usize| radiance(x, y)[0] == SUN[0];
        let sun = irradiance(|x, y| if is_sun(x, y) { radiance(x, y)[1] } else { 0.0 });
        let rest = irradiance(|x, y| if is_sun(x, y) { 0.0 } else { radiance(x, y)[1] });
        assert!((0.7..1.4).contains(&(sun / rest)), "{sun} and {rest}");
    }

    #[test]
    fn the_file_is_as_long_as_its_header_says() {
        let [width, height] = SIZE;
        assert_eq!(bytes().len(), "PF\n64 32\n-1.0\n".len() + width * height * 12);
    }
}
