//! Meshes and ray sets as raw little-endian files, the layout that other programs read, too.
//!
//! `M.v.f32` vertices, `M.f.u32` triangles, `M.SET.rays.f32` origins and directions,
//! `M.SET.gt.f64` true t (+∞ for a miss), `M.SET.gtprim.u32` true triangles.

use super::sets::RaySet;
use crate::truth::{MISS, Tree, Truth};
use crate::world::World;
use common::cli::AppError;
use common::math::Vec3;
use common::mesh::{Mesh, read_obj};
use common::ray::Ray;
use std::fs;
use std::path::{Path, PathBuf};

/// The mesh of an OBJ file, or of `PREFIX.v.f32` and `PREFIX.f.u32`.
///
/// # Errors
/// If a file cannot be read or is no mesh.
pub fn read_world(file: &Path) -> Result<World, AppError> {
    let name = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
    if file.extension().is_some_and(|e| e == "obj") {
        return World::new(&name, read_obj(file)?);
    }
    let prefix = prefix_of(file);
    let numbers = read(&beside(&prefix, "v.f32"), f32::from_le_bytes)?;
    let indices = read(&beside(&prefix, "f.u32"), u32::from_le_bytes)?;
    let positions: Vec<Vec3> = triples(&numbers).map(Vec3::from_array).collect();
    let triangles: Vec<[u32; 3]> = triples(&indices).collect();
    let bad = |what: &str| AppError::Usage(format!("{}: {what}", prefix.display()));
    if positions.len() * 3 != numbers.len() || triangles.len() * 3 != indices.len() {
        return Err(bad("vertices and triangles have three numbers each"));
    }
    if positions.iter().any(|p| !p.is_finite()) {
        return Err(bad("a vertex is not finite"));
    }
    if indices.iter().any(|&i| i as usize >= positions.len()) {
        return Err(bad("a triangle names a vertex that there is not"));
    }
    World::new(&name.replace(".v.f32", ""), Mesh { positions, triangles, ..Mesh::default() })
}

/// The ray set of `M.SET.rays.f32`, with the truth that lies beside it or, if none does, with
/// what `truth` finds. Rays of a set called `shadow` end at t = 1.
///
/// # Errors
/// If a file cannot be read, or has not as many answers as there are rays.
pub fn read_set(file: &Path, truth: &Tree) -> Result<RaySet, AppError> {
    let numbers = read(file, f32::from_le_bytes)?;
    let bad = |what: &str| AppError::Usage(format!("{}: {what}", file.display()));
    let stem = file.to_string_lossy().into_owned();
    let stem = stem.strip_suffix(".rays.f32").ok_or_else(|| bad("ray sets are called M.SET.rays.f32"))?;
    if numbers.len() % 6 != 0 {
        return Err(bad("a ray has six numbers"));
    }
    let vectors: Vec<Vec3> = triples(&numbers).map(Vec3::from_array).collect();
    let rays: Vec<Ray> = vectors.chunks(2).map(|v| Ray::new(v[0], v[1])).collect();
    let name = stem.rsplit(['.', '/']).next().unwrap_or(stem).to_owned();
    let reach = if name == "shadow" { 1.0 } else { f32::INFINITY };
    let known = read_truth(Path::new(stem), rays.len())?;
    let named = |t: &Truth| !t.is_hit() || (t.primitive as usize) < truth.triangles();
    if known.iter().flatten().any(|t| !named(t)) {
        return Err(bad("the truth names a triangle that there is not"));
    }
    let truth = known.unwrap_or_else(|| truth.trace(&rays, f64::from(reach)));
    Ok(RaySet { name, rays, reach, truth })
}

/// All ray sets that lie beside a mesh.
///
/// # Errors
/// If the folder cannot be read.
pub fn sets_beside(mesh: &Path) -> Result<Vec<PathBuf>, AppError> {
    let prefix = prefix_of(mesh);
    let folder = prefix.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let stem = format!("{}.", prefix.file_name().unwrap_or_default().to_string_lossy());
    let entries = fs::read_dir(folder)?.collect::<Result<Vec<_>, _>>()?;
    let mut found: Vec<PathBuf> = entries.into_iter().map(|e| e.path()).collect();
    found.retain(|p| {
        let name = p.file_name().unwrap_or_default().to_string_lossy();
        name.starts_with(&stem) && name.ends_with(".rays.f32")
    });
    found.sort();
    Ok(found)
}

/// Writes a mesh and its ray sets into a folder, for other programs to be put on the same work.
///
/// # Errors
/// If a file cannot be written.
pub fn write_all(folder: &Path, world: &World, sets: &[RaySet]) -> Result<(), AppError> {
    fs::create_dir_all(folder)?;
    let prefix = folder.join(&world.name);
    let positions = world.mesh.positions.iter().flat_map(|p| p.to_array());
    write(&beside(&prefix, "v.f32"), positions.map(f32::to_le_bytes))?;
    let corners = world.mesh.triangles.iter().flatten().copied();
    write(&beside(&prefix, "f.u32"), corners.map(u32::to_le_bytes))?;
    for set in sets {
        let numbers = set.rays.iter().flat_map(|r| [r.origin, r.direction]).flat_map(|v| v.to_array());
        write(&beside(&prefix, &format!("{}.rays.f32", set.name)), numbers.map(f32::to_le_bytes))?;
        let t = set.truth.iter().map(|truth| truth.t.to_le_bytes());
        write(&beside(&prefix, &format!("{}.gt.f64", set.name)), t)?;
        let primitives = set.truth.iter().map(|truth| truth.primitive.to_le_bytes());
        write(&beside(&prefix, &format!("{}.gtprim.u32", set.name)), primitives)?;
    }
    Ok(())
}

/// What rays hit, if both files are there.
fn read_truth(stem: &Path, count: usize) -> Result<Option<Vec<Truth>>, AppError> {
    let (times, primitives) = (beside(stem, "gt.f64"), beside(stem, "gtprim.u32"));
    if !times.is_file() || !primitives.is_file() {
        return Ok(None);
    }
    let (times, primitives) = (read(&times, f64::from_le_bytes)?, read(&primitives, u32::from_le_bytes)?);
    if times.len() != count || primitives.len() != count {
        return Err(AppError::Usage(format!("{}: not as many answers as rays", stem.display())));
    }
    let both = times.into_iter().zip(primitives);
    Ok(Some(
        both.map(|(t, primitive)| Truth { t, primitive: if t.is_finite() { primitive } else { MISS } })
            .collect(),
    ))
}

/// `dir/M` for `dir/M`, `dir/M.v.f32` and `dir/M.obj`.
fn prefix_of(file: &Path) -> PathBuf {
    let text = file.to_string_lossy();
    let cut = [".v.f32", ".f.u32", ".obj"].iter().find_map(|suffix| text.strip_suffix(suffix));
    PathBuf::from(cut.unwrap_or(&text))
}

/// `prefix.suffix`; a dot in the prefix's own name stays.
fn beside(prefix: &Path, suffix: &str) -> PathBuf {
    let mut name = prefix.as_os_str().to_owned();
    name.push(".");
    name.push(suffix);
    PathBuf::from(name)
}

fn read<T, const N: usize>(file: &Path, number: fn([u8; N]) -> T) -> Result<Vec<T>, AppError> {
    let bytes =
        fs::read(file).map_err(|e| AppError::Usage(format!("cannot read {}: {e}", file.display())))?;
    let (whole, rest) = bytes.as_chunks::<N>();
    if !rest.is_empty() {
        return Err(AppError::Usage(format!("{}: cut off in the middle of a number", file.display())));
    }
    Ok(whole.iter().map(|b| number(*b)).collect())
}

fn write<const N: usize>(file: &Path, numbers: impl Iterator<Item = [u8; N]>) -> Result<(), AppError> {
    let bytes: Vec<u8> = numbers.flatten().collect();
    Ok(fs::write(file, bytes)?)
}

fn triples<T: Copy>(numbers: &[T]) -> impl Iterator<Item = [T; 3]> {
    numbers.as_chunks::<3>().0.iter().copied()
}

#[cfg(test)]
mod tests;
