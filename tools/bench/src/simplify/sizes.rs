//! How the time of simplification grows with the mesh.

use super::contender::Contender;
use super::{Options, made};
use crate::clock;
use crate::fit::power;
use crate::report::{Better, Cell, Curve, Figure, Section, Table};
use crate::sample::Sample;
use common::cli::{AppError, note};

/// The share of the triangles that is kept.
const RATIO: f64 = 0.1;

/// Times all methods on meshes of growing size: tables of times and of fitted exponents, a figure.
/// Whether results are right is for the other tables to say.
///
/// # Errors
/// If a mesh is unknown, or a method fails.
pub fn measure(options: &Options, contenders: &[Contender], section: &mut Section) -> Result<(), AppError> {
    let mut columns = vec![("triangles", Better::Neither)];
    columns.extend(contenders.iter().map(|c| (c.name, Better::Less)));
    let mut table = Table::new(format!("growth: ms of processor time, ratio {RATIO}"), "mesh", &columns);
    let mut curves: Vec<Curve> = contenders.iter().map(|c| Curve::new(c.name, [])).collect();
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
        table.row(name, std::iter::once(Cell::from(triangles)).chain(times.iter().map(Cell::from)));
        let points = curves.iter_mut().zip(&times);
        points.for_each(|(curve, time)| curve.points.push((triangles as f64, time.median())));
    }
    if table.rows.len() > 1 {
        section.tables.extend([table, exponents(&curves)]);
        let fits = curves.iter().map(|c| Curve::new("", power(&c.points).ends(&c.points))).collect();
        let title = format!("Time of simplification to {RATIO} against triangles");
        section
            .figures
            .push(Figure { fits, ..Figure::new(title, "triangles", "ms of processor time", curves) });
    }
    Ok(())
}

fn exponents(curves: &[Curve]) -> Table {
    let columns = [("b", Better::Less), ("explained", Better::Neither)];
    let mut table = Table::new("growth: fit of ms = a triangles^b", "method", &columns);
    for curve in curves {
        let fit = power(&curve.points);
        table.row(&curve.name, [fit.b, fit.explained].map(Cell::derived));
    }
    table
}
