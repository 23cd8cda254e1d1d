//! The flags of assignment 9, on top of those of assignments 1 to 6.

use crate::files::Kind;
use crate::goal::{Goal, Method};
use crate::measure::SAMPLES;
use a1_ray_casting::CastArgs;
use a6_kdtree::AccelArgs;
use common::cli::AppError;
use std::path::{Path, PathBuf};

/// Fewer triangles, the least error for them. A mesh (.obj .ply .stl) is simplified, measured,
/// shown and written; a scene is drawn with all its meshes simplified, by the flags of assignments
/// 1 to 6.
#[derive(clap::Parser)]
#[command(
    name = "a9_simplification",
    version,
    rename_all = "snake_case",
    mut_arg("input", |arg| arg.help("Mesh (.obj .ply .stl) or scene file to read").value_name("MESH|SCENE")),
    mut_arg("output", |arg| arg.help("Mesh to write (.obj .ply .stl), or picture of the scene").value_name("FILE")),
    mut_arg("size", |arg| arg.help("Width and height in pixels of the scene's pictures, or of each of the three parts of -render").default_values(["300", "300"])),
    after_help = "Examples:\n  \
        a9_simplification -input scenes/meshes/bunny_40k.obj -output bunny.ply -ratio 0.1 -stats\n  \
        a9_simplification -input scenes/meshes/bunny_40k.obj -output bunny.obj -levels 0.5 0.1 0.01 -report bunny.json\n  \
        a9_simplification -input scenes/meshes/bunny_40k.obj -error 0.001 -render bunny.png\n  \
        a9_simplification -input scenes/meshes/bunny_40k.obj -compare bunny.ply -stats\n  \
        a9_simplification -input scenes/scene5_09_bunny_mesh_40k.txt -ratio 0.01 -output out.tga -size 200 200 -shadows"
)]
pub struct Program {
    /// All flags.
    #[command(flatten)]
    pub args: SimplifyArgs,
}

/// What to do with a mesh.
#[derive(Clone, Debug, clap::Args)]
#[command(rename_all = "snake_case", next_help_heading = "Assignment 9: simplification")]
#[group(id = "goal", multiple = false)]
pub struct Goals {
    /// Keep this share of the triangles, 0 to 1
    #[arg(long, value_name = "R", value_parser = share)]
    pub ratio: Option<f64>,

    /// Keep at most this many triangles (in a scene: of each mesh)
    #[arg(long, value_name = "N")]
    pub faces: Option<usize>,

    /// Stop before the surface is farther off than this share of the diagonal of the mesh's box
    #[arg(long, value_name = "E", value_parser = distance)]
    pub error: Option<f64>,

    /// Several shares in one run; R stands in the name of each file, as in out_0.5.obj
    #[arg(long, value_name = "R", num_args = 1.., value_parser = share)]
    pub levels: Option<Vec<f64>>,

    /// Simplify nothing: measure how far this mesh is from the input, and what it is like
    #[arg(long, value_name = "MESH")]
    pub compare: Option<PathBuf>,
}

/// How, and what is told of it.
#[derive(Clone, Debug, clap::Args)]
#[command(rename_all = "snake_case", next_help_heading = "Assignment 9: simplification")]
pub struct SimplifyArgs {
    /// When to stop.
    #[command(flatten)]
    pub goals: Goals,

    /// What a step costs
    #[arg(long, value_name = "METHOD", value_enum, default_value_t)]
    pub method: Method,

    /// Write what was measured, as text or (.json) JSON: triangles, times, distances both ways,
    /// shapes, topology before and after
    #[arg(long, value_name = "FILE")]
    pub report: Option<PathBuf>,

    /// Points of either surface at which distances are measured, besides vertices and edges
    #[arg(long, value_name = "N", default_value_t = SAMPLES)]
    pub samples: usize,

    /// Picture of the mesh before, after, and before again in colours for the distance to what it
    /// became: from black over red and yellow to white for HOTTEST, a share of the diagonal of its
    /// box (the largest in the picture if not given)
    #[arg(long, num_args = 1..=2, value_names = ["PICTURE", "HOTTEST"])]
    pub render: Option<Vec<String>>,

    /// Flags of assignments 1 to 6.
    #[command(flatten)]
    pub accel: AccelArgs,
}

fn number(text: &str) -> Result<f64, String> {
    text.parse().map_err(|_| "not a number".to_owned())
}

fn share(text: &str) -> Result<f64, String> {
    let value = number(text)?;
    if (0.0..=1.0).contains(&value) { Ok(value) } else { Err("a share is 0 to 1".to_owned()) }
}

fn distance(text: &str) -> Result<f64, String> {
    let value = number(text)?;
    if value.is_finite() && value >= 0.0 { Ok(value) } else { Err("a distance is at least 0".to_owned()) }
}

impl SimplifyArgs {
    /// Flags of assignment 1.
    pub fn cast(&self) -> &CastArgs {
        self.accel.cast()
    }

    /// The file to read.
    pub fn input(&self) -> &Path {
        &self.cast().input
    }

    /// Whether the input is a mesh; else it is a scene.
    pub fn is_mesh(&self) -> bool {
        Kind::of_path(self.input()).is_some()
    }

    /// The picture of `-render`, and the distance that is white there if given.
    ///
    /// # Errors
    /// If that is no distance above 0.
    pub fn picture(&self) -> Result<Option<(&Path, Option<f64>)>, AppError> {
        let Some(values) = &self.render else { return Ok(None) };
        let Some(text) = values.get(1) else { return Ok(Some((Path::new(&values[0]), None))) };
        let hottest = text.parse().ok().filter(|x: &f64| x.is_finite() && *x > 0.0);
        let wrong = || AppError::Usage(format!("-render: HOTTEST must be a number above 0, not `{text}`"));
        Ok(Some((Path::new(&values[0]), Some(hottest.ok_or_else(wrong)?))))
    }

    /// Whether something is to be measured.
    pub fn measures(&self) -> bool {
        self.report.is_some() || self.cast().general.program.stats
    }

    /// Runs work on as many threads as `-threads` says.
    ///
    /// # Errors
    /// If the system has not that many to spare.
    pub fn on_threads<T: Send>(&self, work: impl FnOnce() -> T + Send) -> Result<T, AppError> {
        let threads = self.cast().general.program.threads.unwrap_or(0) as usize;
        Ok(rayon::ThreadPoolBuilder::new().num_threads(threads).build()?.install(work))
    }
}

impl Goals {
    /// The shares of `-levels`, largest first, as one run passes them.
    pub fn levels(&self) -> Vec<f64> {
        let mut levels = self.levels.clone().unwrap_or_default();
        levels.sort_by(|a, b| b.total_cmp(a));
        levels
    }

    /// When to stop; several only by `-levels`.
    ///
    /// # Errors
    /// If nothing says when.
    pub fn list(&self) -> Result<Vec<Goal>, AppError> {
        let one = self.ratio.map(Goal::Ratio).or(self.faces.map(Goal::Faces)).or(self.error.map(Goal::Error));
        let goals: Vec<Goal> = one.into_iter().chain(self.levels().into_iter().map(Goal::Ratio)).collect();
        if goals.is_empty() {
            let text = "when to stop? give -ratio R, -faces N, -error E or -levels R...";
            return Err(AppError::Usage(text.to_owned()));
        }
        Ok(goals)
    }
}
