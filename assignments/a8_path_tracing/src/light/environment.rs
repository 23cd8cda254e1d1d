//! Light from all around, as a picture.

use common::math::{DVec3, Vec3};
use common::picture::Film;
use std::f64::consts::{PI, TAU};

/// A latitude–longitude picture of the sky: its top row is straight up (+y), its middle looks
/// along +z, and seen from inside it is not mirrored.
pub struct Environment {
    film: Film,
    /// Sums of the brightness of rows up to each, the last being 1.
    rows: Vec<f64>,
    /// The same of the pixels in each row.
    columns: Vec<f64>,
}

impl Environment {
    /// Of a picture. Its negative and infinite values count as none.
    pub fn new(mut film: Film) -> Self {
        for pixel in film.pixels_mut() {
            *pixel = pixel.map(|x| if x.is_finite() { x.max(0.0) } else { 0.0 });
        }
        let (width, height) = (film.width(), film.height());
        let (mut rows, mut columns) = (Vec::new(), Vec::new());
        let mut sum = 0.0;
        for y in 0..height {
            let sine = ((f64::from(y) + 0.5) / f64::from(height) * PI).sin();
            let mut row: Vec<f64> = film.row(y).iter().map(|p| f64::from(p.element_sum())).collect();
            sum += accumulate(&mut row) * sine;
            rows.push(sum);
            columns.extend(row);
        }
        debug_assert_eq!(columns.len(), width as usize * height as usize);
        normalise(&mut rows, sum);
        Self { film, rows, columns }
    }

    /// Whether it is black.
    pub fn is_black(&self) -> bool {
        self.rows.last() == Some(&0.0)
    }

    fn row(&self, y: usize) -> &[f64] {
        let width = self.film.width() as usize;
        &self.columns[y * width..][..width]
    }

    /// A unit direction for a point of the unit square, its radiance and density per steradian.
    pub fn sample(&self, [u, v]: [f64; 2]) -> Option<(DVec3, Vec3, f64)> {
        let (y, within_row) = pick(&self.rows, v)?;
        let (x, within_column) = pick(self.row(y), u)?;
        let (width, height) = (f64::from(self.film.width()), f64::from(self.film.height()));
        let longitude = ((x as f64 + within_column) / width - 0.5) * TAU;
        let from_below = (y as f64 + within_row) / height * PI;
        let (sine, cosine) = from_below.sin_cos();
        let direction = DVec3::new(-longitude.sin() * sine, -cosine, longitude.cos() * sine);
        let pdf = self.density(x, y, sine);
        (pdf > 0.0).then(|| (direction, self.film.get(x as u32, y as u32), pdf))
    }

    /// Radiance in a unit direction, and the density of [`Environment::sample`] there.
    pub fn look(&self, direction: DVec3) -> (Vec3, f64) {
        let (width, height) = (self.film.width() as usize, self.film.height() as usize);
        let across = ((-direction.x).atan2(direction.z) / TAU + 0.5) * width as f64;
        let from_below = (-direction.y).clamp(-1.0, 1.0).acos();
        let up = from_below / PI * height as f64;
        let (x, y) = ((across as usize).min(width - 1), (up as usize).min(height - 1));
        (self.film.get(x as u32, y as u32), self.density(x, y, from_below.sin()))
    }

    fn density(&self, x: usize, y: usize, sine: f64) -> f64 {
        let share = |sums: &[f64], i: usize| sums[i] - if i == 0 { 0.0 } else { sums[i - 1] };
        let chance = share(&self.rows, y) * share(self.row(y), x);
        let pixels = f64::from(self.film.width()) * f64::from(self.film.height());
        if sine > 0.0 { chance * pixels / (TAU * PI * sine) } else { 0.0 }
    }
}

/// Turns values into sums up to each, divided by the last, which is returned.
fn accumulate(values: &mut [f64]) -> f64 {
    let mut sum = 0.0;
    for value in values.iter_mut() {
        sum += *value;
        *value = sum;
    }
    normalise(values, sum);
    sum
}

fn normalise(sums: &mut [f64], total: f64) {
    if total > 0.0 {
        sums.iter_mut().for_each(|sum| *sum /= total);
    }
}

/// Which share a number in [0, 1) falls into, and where in it.
fn pick(sums: &[f64], u: f64) -> Option<(usize, f64)> {
    let index = sums.partition_point(|sum| *sum <= u);
    let share = *sums.get(index)?;
    let below = if index == 0 { 0.0 } else { sums[index - 1] };
    Some((index, ((u - below) / (share - below)).clamp(0.0, 1.0 - f64::EPSILON)))
}
