//! What a good tree is worth: build time against render time, the textbook's tree against
//! medians against surface area heuristic against hierarchy against no tree at all, on five views of one mesh.

mod stage;

use crate::clock::{self, Span};
use crate::report::{Better, Cell, Curve, Figure, Section, Table};
use crate::sample::Sample;
use crate::world::World;
use a1_ray_casting::Studio;
use a4_whitted::{WhittedArgs, WhittedColor};
use a6_kdtree::bvh::Bvh;
use a6_kdtree::kdtree::{KdTree, Options as TreeOptions, Rule};
use common::accel::{Accel, List};
use common::cli::{self, AppError};
use common::counters::Counters;
use common::geometry::Geometry;
use common::picture::{Film, Size};
use stage::VIEWS;

/// Pixels in a row and rows of the pictures without a tree; their time is scaled up.
const PART: u32 = 16;

/// Seconds; what is built in less stands here in the figure, whose axis has no place for 0.
const LEAST: f64 = 1e-6;

/// What to measure.
#[derive(clap::Args)]
pub struct Options {
    /// The mesh: a recipe such as sphere200k, or a file.obj
    #[arg(long, default_value = "sphere200k")]
    mesh: String,
    /// Pixels in a row and rows of them
    #[arg(long, default_value_t = 500, value_parser = clap::value_parser!(u32).range(1..=4096))]
    side: u32,
    /// Rounds; every round builds and renders everything once
    #[arg(long, default_value_t = 3)]
    rounds: usize,
}

/// How hits are found.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Nothing,
    Kd(Rule),
    Bvh,
}

const KINDS: [(&str, Kind); 6] = [
    ("no tree", Kind::Nothing),
    ("kd textbook", Kind::Kd(Rule::Textbook)),
    ("kd median", Kind::Kd(Rule::Median)),
    ("kd objects", Kind::Kd(Rule::Objects)),
    ("kd SAH", Kind::Kd(Rule::Sah)),
    ("bvh", Kind::Bvh),
];

impl Kind {
    fn build<'g>(self, geometry: &'g Geometry) -> Box<dyn Accel + 'g> {
        match self {
            Self::Nothing => Box::new(List::new(geometry)),
            Self::Kd(rule) => Box::new(KdTree::new(geometry, TreeOptions { rule, ..TreeOptions::default() })),
            Self::Bvh => Box::new(Bvh::new(geometry)),
        }
    }
}

/// Seconds of processor time.
#[derive(Clone, Default)]
struct Cost {
    build: Sample,
    views: [Sample; VIEWS as usize],
    work: Counters,
}

/// Measures all structures.
///
/// # Errors
/// If the mesh is unknown, or two structures make different pictures.
pub fn measure(options: &Options) -> Result<Section, AppError> {
    let world = World::named(&options.mesh)?;
    cli::set_quiet(true);
    let mut studio = stage::studio(&world, options.side)?;
    let args = whitted()?;
    let mut costs = vec![Cost::default(); KINDS.len()];
    for _ in 0..options.rounds.max(1) {
        round(&mut studio, &args, &mut costs)?;
    }
    Ok(section(&world, options.side, &costs))
}

/// The flags of all pictures; one thread, so that processor time is that of the picture alone.
fn whitted() -> Result<WhittedArgs, AppError> {
    let words = "a4_whitted -input unused -output unused -shadows -bounces 4 -weight 0.01 -threads 1";
    let parsed = cli::try_parse_from::<a4_whitted::Program>(words.split(' '));
    Ok(parsed.map_err(|stop| AppError::Usage(stop.text))?.options.args)
}

fn round(studio: &mut Studio, args: &WhittedArgs, costs: &mut [Cost]) -> Result<(), AppError> {
    // A copy, so that the camera can turn while structures hold on to the primitives.
    let geometry = studio.geometry.clone();
    let mut built = Vec::new();
    for ((_, kind), cost) in KINDS.iter().zip(costs.iter_mut()) {
        let (accel, span) = clock::time(|| kind.build(&geometry))?;
        cost.build.add(span.cpu / 1e3);
        built.push(accel);
    }
    for view in 0..VIEWS {
        stage::zoom(studio, view);
        let mut first: Option<Film> = None;
        for (((name, kind), cost), accel) in KINDS.iter().zip(costs.iter_mut()).zip(&built) {
            let (film, counters, span) = shoot(studio, args, &**accel, *kind)?;
            cost.views[view as usize].add(span.cpu / 1e3);
            cost.work = counters;
            if *kind == Kind::Nothing {
                continue;
            }
            if first.get_or_insert_with(|| film.clone()).pixels() != film.pixels() {
                return Err(AppError::CheckFailed(format!("{name} makes another picture of view {view}")));
            }
        }
    }
    Ok(())
}

/// One picture; without a tree a small one, its time scaled to the full size.
fn shoot(
    studio: &mut Studio,
    args: &WhittedArgs,
    accel: &dyn Accel,
    kind: Kind,
) -> Result<(Film, Counters, Span), AppError> {
    let full = studio.size;
    if kind == Kind::Nothing {
        let side = i64::from(PART.min(full.width()));
        studio.size = Size::new(side, side)?;
    }
    let layer = WhittedColor { whitted: args.whitted(&studio.scene, accel) };
    let ((mut films, counters), span) = clock::time(|| studio.render(args.cast(), accel, &[&layer]))?;
    let scale = full.pixels() as f64 / studio.size.pixels() as f64;
    studio.size = full;
    let film = films.pop().ok_or_else(|| AppError::CheckFailed("no picture was made".to_owned()))?;
    Ok((film, counters, Span { wall: span.wall * scale, cpu: span.cpu * scale }))
}

fn section(world: &World, side: u32, costs: &[Cost]) -> Section {
    let views: Vec<String> = (1..=VIEWS).map(|v| format!("view {v}, s")).collect();
    let columns: Vec<_> = std::iter::once("build, s")
        .chain(views.iter().map(String::as_str))
        .map(|name| (name, Better::Less))
        .chain([("nodes per ray", Better::Less), ("tests per ray", Better::Less)])
        .collect();
    let mut table = Table::of_rivals("structures", "", &columns);
    for ((name, kind), cost) in KINDS.iter().zip(costs) {
        let part =
            if *kind == Kind::Nothing { format!(" (from {PART}x{PART} pixels)") } else { String::new() };
        let rays = (cost.work.rays + cost.work.shadow_rays).max(1) as f64;
        let work = [cost.work.cells, cost.work.intersections].map(|n| Cell::from(n as f64 / rays));
        let times = std::iter::once(&cost.build).chain(&cost.views).map(Cell::from);
        table.row(format!("{name}{part}"), times.chain(work));
    }
    table.mark_front("build, s", views.last().map_or("", String::as_str), |_| true);
    let title = format!("{}: building against five pictures", world.name);
    let point = |(name, cost): (&str, &Cost)| {
        let pictures = cost.views.iter().map(Sample::median).sum();
        Curve::new(name, [(cost.build.median().max(LEAST), pictures)])
    };
    let curves = KINDS.iter().map(|(name, _)| *name).zip(costs).map(point).collect();
    let figure = Figure::new(title, "build, processor seconds", "five pictures, processor seconds", curves);
    Section {
        part: "trees",
        title: "What a good tree is worth: build time against render time".to_owned(),
        remarks: vec![
            format!(
                "{}: {} triangles, {} mirror balls, mirror floor, 2 lamps, {side}x{side}, shadows, 4 bounces",
                world.name,
                world.triangles(),
                stage::BALLS
            ),
            format!(
                "processor time, one thread: median (quartiles); nodes and tests are those of view {VIEWS}"
            ),
        ],
        tables: vec![table],
        figures: vec![figure.with_front(Better::Less)],
        ..Section::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_structures_make_the_same_pictures_and_all_is_timed() {
        let world = World::named("sphere1k").unwrap();
        let mut studio = stage::studio(&world, 24).unwrap();
        let mut costs = vec![Cost::default(); KINDS.len()];
        round(&mut studio, &whitted().unwrap(), &mut costs).unwrap();
        // Not measured would be NaN; 0 is what a clock of some milliseconds may say of so little.
        assert!(costs.iter().all(|c| c.views.iter().all(|v| v.median() >= 0.0)));
        assert!(costs.iter().all(|c| c.work.rays > 256 && c.work.shadow_rays > 0));
        let tests = |k: usize| costs[k].work.intersections / costs[k].work.rays;
        assert!(tests(4) < tests(0) / 10, "the tree saves nothing: {} {}", tests(4), tests(0));
        let section = section(&world, 24, &costs);
        assert_eq!((section.table("structures").rows.len(), section.figures[0].curves.len()), (6, 6));
    }
}
