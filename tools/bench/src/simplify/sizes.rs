//! How the time of simplification grows with the mesh.

use super::contender::Contender;
use super::{Options, made};
use crate::clock;
use crate::report::Section;
use crate::sample::Sample;
use crate::scaling::Scaling;
use common::cli::{AppError, note};

/// The share of the triangles that is kept.
const RATIO: f64 = 0.1;

/// Times all methods on meshes of growing size. Whether results are right is for the other tables to
/// say.
///
/// # Errors
/// If a mesh is unknown, or a method fails.
pub fn measure(options: &Options, contenders: &[Contender], section: &mut Section) -> Result<(), AppError> {
    let names: Vec<&str> = contenders.iter().map(|c| c.name).collect();
    let mut scaling = Scaling::new(&format!("Simplification to {RATIO}"), &names);
    for name in options.sizes.iter().filter(|name| !name.is_empty()) {
        let mesh = made(name)?;
        let triangles = mesh.triangles.len();
        note(&format!("{name}: {triangles} triangles, time only"));
        let mut times = vec![Sample::default(); contenders.len()];
        for _ in 0..options.rounds.max(1) {
            for (contender, time) in contenders.iter().zip(&mut times) {
                let (result, span) = clock::time(|| (contender.run)(&mesh, RATIO, false))?;
                result?;
                time.add(span.cpu);
            }
        }
        scaling.add(name, triangles, &times);
    }
    scaling.show(section);
    Ok(())
}
