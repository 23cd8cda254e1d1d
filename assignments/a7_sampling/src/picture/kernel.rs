//! A7T2: a kernel as a picture.

use super::zoomed;
use crate::filter::Kernel;
use common::cli::AppError;
use common::math::Vec3;
use common::picture::{Film, Size};

const GROUND: Vec3 = Vec3::new(0.0, 0.0, 0.5);

/// The kernel of the centre pixel as grey, white being the weight at its centre, over the pixels
/// whose samples count; negative weights are red. Blue lines between pixels.
///
/// # Errors
/// If the picture would be too large.
pub fn kernel_picture(kernel: Kernel, size: Size, zoom: u32) -> Result<Film, AppError> {
    let (center, support) = ((size.width() / 2, size.height() / 2), kernel.support() as u32);
    let counts = |cell: u32, center: u32, end: u32| cell.abs_diff(center) <= support && cell < end;
    let shade = |x: u32, y: u32| {
        if x.is_multiple_of(zoom) || y.is_multiple_of(zoom) {
            return Vec3::Z;
        }
        if !counts(x / zoom, center.0, size.width()) || !counts(y / zoom, center.1, size.height()) {
            return GROUND;
        }
        let offset = |at: u32, center: u32| (f64::from(at) + 0.5) / f64::from(zoom) - f64::from(center) - 0.5;
        let weight = kernel.weight(offset(x, center.0), offset(y, center.1)) / kernel.weight(0.0, 0.0);
        if weight < 0.0 { Vec3::X * -weight as f32 } else { Vec3::splat(weight as f32) }
    };
    Ok(Film::from_fn(zoomed(size, zoom, 1)?, shade))
}
