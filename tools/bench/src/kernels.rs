//! One part at a time: reading a mesh, building a grid, tracing rays on one thread.

use crate::clock;
use crate::report::{Better, Cell, Section, Table};
use crate::sample::Sample;
use a5_grid::{Cells, Fit, Grid};
use common::accel::{Accel, List};
use common::camera::{Camera, screen_position};
use common::cli::AppError;
use common::counters::Counters;
use common::geometry::{Geometry, Hit};
use common::mesh::read_obj;
use common::picture::Size;
use common::ray::Ray;
use common::scene;
use std::hint::black_box;
use std::path::PathBuf;

const SCENE: &str = "scene5_09_bunny_mesh_40k.txt";
const MESH: &str = "meshes/bunny_40k.obj";

/// What to measure.
#[derive(clap::Args)]
pub struct Options {
    /// Rounds; every round runs every part once
    #[arg(long, default_value_t = 31)]
    rounds: usize,
    /// The folder of the scenes
    #[arg(long, value_name = "FOLDER", default_value = "scenes")]
    scenes: PathBuf,
}

/// One timed part: a name, how many units of work one round does, and the unit.
type Part<'a> = (&'static str, f64, &'static str, Box<dyn FnMut() + 'a>);

/// Times every part `rounds` times, in turn.
///
/// # Errors
/// If the scene cannot be read, or grid and list disagree.
pub fn measure(options: &Options) -> Result<Section, AppError> {
    let scene = scene::load(&options.scenes.join(SCENE))?;
    let mesh = options.scenes.join(MESH);
    let geometry = Geometry::build(&scene)?;
    let bounds = geometry.bounds().ok_or_else(|| AppError::Usage("the scene is empty".to_owned()))?;
    let cells = || Cells::new([40, 40, 33], &bounds);
    let grid = Grid::new(&geometry, cells(), Fit::Exact).map_err(AppError::Usage)?;
    let list = List::new(&geometry);
    let camera = Camera::new(&scene.camera);
    let rays = camera_rays(&camera, 200)?;
    verify(&grid, &list, &camera, &rays)?;
    let megabytes = std::fs::metadata(&mesh)?.len() as f64 / 1e6;
    let few: Vec<Ray> = rays.iter().copied().step_by(400).collect();
    let trace = |accel: &dyn Accel, rays: &[Ray]| {
        let mut counters = Counters::default();
        for ray in rays {
            black_box(accel.nearest(ray, camera.interval, &mut counters));
        }
    };
    let parts: Vec<Part> = vec![
        ("read bunny_40k.obj", megabytes, "MB/s", Box::new(|| drop(black_box(read_obj(&mesh))))),
        (
            "build grid 40x40x33, exact",
            0.04,
            "M triangles/s",
            Box::new(|| {
                drop(black_box(Grid::new(&geometry, cells(), Fit::Exact)));
            }),
        ),
        (
            "trace 40,000 camera rays, grid",
            rays.len() as f64 / 1e6,
            "Mrays/s",
            Box::new(|| trace(&grid, &rays)),
        ),
        (
            "trace 100 camera rays, list",
            few.len() as f64 * 0.04,
            "M tests/s",
            Box::new(|| trace(&list, &few)),
        ),
    ];
    time(options.rounds.max(1), parts)
}

fn camera_rays(camera: &Camera, side: u32) -> Result<Vec<Ray>, AppError> {
    let size = Size::new(i64::from(side), i64::from(side))?;
    let pixels = (0..side).flat_map(|y| (0..side).map(move |x| (f64::from(x) + 0.5, f64::from(y) + 0.5)));
    Ok(pixels.map(|(x, y)| camera.ray(screen_position(size, x, y))).collect())
}

/// Grid and list must name the same hits before their speed means anything.
fn verify(grid: &Grid, list: &List, camera: &Camera, rays: &[Ray]) -> Result<(), AppError> {
    let mut counters = Counters::default();
    let mut hit =
        |accel: &dyn Accel, ray: &Ray| -> Option<Hit> { accel.nearest(ray, camera.interval, &mut counters) };
    match rays.iter().step_by(37).find(|ray| hit(grid, ray) != hit(list, ray)) {
        Some(ray) => Err(AppError::CheckFailed(format!("grid and list disagree on {ray:?}"))),
        None => Ok(()),
    }
}

/// Times every part once a round, after a first round that warms up.
fn time(rounds: usize, mut parts: Vec<Part>) -> Result<Section, AppError> {
    let mut samples = vec![<[Sample; 2]>::default(); parts.len()];
    for round in 0..=rounds {
        for ((_, _, _, work), [wall, cpu]) in parts.iter_mut().zip(&mut samples) {
            let ((), span) = clock::time(work)?;
            if round > 0 {
                wall.add(span.wall);
                cpu.add(span.cpu);
            }
        }
    }
    let columns = [
        ("wall ms", Better::Less),
        ("processor ms", Better::Less),
        ("rate, by the processor", Better::More),
        ("unit", Better::Neither),
    ];
    let mut table = Table::new("one part at a time", "part", &columns);
    for ((name, units, unit, _), [wall, cpu]) in parts.iter().zip(&samples) {
        let rate = cpu.map(|ms| units / (ms / 1e3));
        table.row(*name, [wall.into(), cpu.into(), Cell::from(&rate), Cell::from(*unit)]);
    }
    Ok(Section {
        part: "kernels",
        title: "Reading, building, tracing, one part at a time".to_owned(),
        remarks: vec!["median (quartiles)".to_owned()],
        tables: vec![table],
        ..Section::default()
    })
}
