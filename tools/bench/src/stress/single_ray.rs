//! One ray against a mesh, by every structure and by exact arithmetic.

use ::stress::kit::{Named, exact_triangle, geometry_of, ray_bits, structures};
use a5_grid::Fit;
use common::accel::{Accel, List};
use common::cli::{AppError, say};
use common::counters::Counters;
use common::geometry::Hit;
use common::math::{Interval, Vec3};
use common::mesh::read_obj;
use common::ray::Ray;
use std::path::Path;

/// A float, in decimal or as its bits.
///
/// # Errors
/// If it is neither.
pub fn number(text: &str) -> Result<f32, String> {
    let bits = text.strip_prefix("0x").or_else(|| text.strip_prefix("0X"));
    let number = match bits {
        Some(digits) => u32::from_str_radix(digits, 16).ok().map(f32::from_bits),
        None => text.parse().ok(),
    };
    number.ok_or_else(|| "want a decimal number, or eight hexadecimal digits after 0x".to_owned())
}

/// Prints the answer of each, a line each.
///
/// # Errors
/// If the mesh cannot be read, or the answers differ.
pub fn answers(mesh: &Path, numbers: &[f32]) -> Result<(), AppError> {
    let mesh = read_obj(mesh)?;
    let &[ox, oy, oz, dx, dy, dz] = numbers else {
        return Err(AppError::Usage("a ray has six numbers".to_owned()));
    };
    let ray = Ray::new(Vec3::new(ox, oy, oz), Vec3::new(dx, dy, dz));
    let corners = |t: &[u32; 3]| t.map(|i| mesh.positions[i as usize]);
    let triangles: Vec<[Vec3; 3]> = mesh.triangles.iter().map(corners).collect();
    say(&ray_bits(&ray));
    let geometry = geometry_of(&triangles);
    let side = (triangles.len() as f64).cbrt().ceil().clamp(1.0, 100.0) as u32;
    let all = structures(&geometry, &[([side; 3], Fit::Exact)]);
    let find = |accel: &dyn Accel| accel.nearest(&ray, Interval::FORWARD, &mut Counters::default());
    let truth = exact(&ray, &triangles);
    say(&format!("{:<24} {}", "exact", truth.map_or("nothing".to_owned(), |(i, t)| words(i, t))));
    let list = find(&List::new(&geometry));
    let mut differ = list.map(|hit| hit.primitive) != truth.map(|(number, _)| number);
    let print = |name: &str, hit: &Option<Hit>| {
        let words = hit.map_or("nothing".to_owned(), |hit| {
            format!("{}, u {} v {}", words(hit.primitive, f64::from(hit.t)), hit.u, hit.v)
        });
        say(&format!("{name:<24} {words}"));
    };
    print("list", &list);
    for Named { name, accel } in &all {
        let hit = find(&**accel);
        print(name, &hit);
        differ |= hit != list;
    }
    if differ { Err(AppError::CheckFailed("the answers differ".to_owned())) } else { Ok(()) }
}

fn words(triangle: u32, t: f64) -> String {
    format!("triangle {triangle}, t {t}")
}

/// The first triangle that exact arithmetic says is hit in front: least t (as a float, which is
/// how ties are seen), then lowest number.
fn exact(ray: &Ray, triangles: &[[Vec3; 3]]) -> Option<(u32, f64)> {
    if !ray.is_usable() {
        return None;
    }
    let hits = (0u32..).zip(triangles).filter_map(|(number, t)| Some((number, exact_triangle(ray, t)?.t)));
    let ahead = hits.filter(|(_, t)| Interval::FORWARD.contains(*t as f32));
    ahead.min_by(|a, b| (a.1 as f32).total_cmp(&(b.1 as f32)).then(a.0.cmp(&b.0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_decimals_or_bits() {
        assert_eq!(number("-1.5"), Ok(-1.5));
        assert_eq!(number("0x3f800000"), Ok(1.0));
        assert_eq!(number("0x80000000").map(f32::to_bits), Ok(1 << 31));
        assert!(number("0xzz").is_err() && number("one").is_err());
    }

    #[test]
    fn all_answer_alike_on_a_cube() {
        let cube = ::stress::kit::repository().join("scenes/meshes/cube.obj");
        for ray in [
            [0.0, 0.0, 5.0, 0.0, 0.0, -1.0],
            [5.0, 5.0, 5.0, -1.0, -1.0, -1.0],
            [0.0, 9.0, 0.0, 1.0, 0.0, 0.0],
        ] {
            answers(&cube, &ray).unwrap_or_else(|error| panic!("{}", error.report()));
        }
        assert!(answers(Path::new("nowhere.obj"), &[0.0; 6]).is_err());
    }
}
