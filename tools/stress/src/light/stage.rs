//! Scenes given as text, rendered through the library as the program does it.

use a1_ray_casting::Studio;
use a6_kdtree::texture::TexturedScene;
use a8_path_tracing::film::{Sums, develop};
use a8_path_tracing::light::Lights;
use a8_path_tracing::numbers::Numbers;
use a8_path_tracing::render::Rendering;
use a8_path_tracing::{PathArgs, PathTracer, Program};
use common::counters::Counters;
use common::math::DVec3;
use common::mesh::Mesh;
use common::picture::Film;
use common::tiles::TileOptions;
use std::fmt::Write as _;
use tests::binary::Scratch;
use tests::program::parsed_words;

/// A scene and the flags that it was opened with.
pub struct Stage {
    args: PathArgs,
    /// The scene.
    pub studio: Studio,
    scratch: Scratch,
}

/// A plain scene without its camera: a background, materials, and one group of objects.
pub fn scene(camera: &str, background: &str, lights: &[&str], materials: &[&str], objects: &str) -> String {
    let materials: String = materials.iter().fold(String::new(), |mut all, material| {
        let _ = writeln!(all, "Material {{ {material} }}");
        all
    });
    let objects_count = objects.lines().filter(|line| line.contains('{')).count();
    format!(
        "{camera}\nBackground {{ color {background} }}\nLights {{ numLights {} {} }}\n\
         Materials {{ numMaterials {} {materials} }}\nGroup {{ numObjects {objects_count} MaterialIndex 0\n{objects}\n}}\n",
        lights.len(),
        lights.join("\n"),
        materials.lines().count(),
    )
}

/// The text of an OBJ file.
pub fn obj(mesh: &Mesh) -> String {
    let mut text = String::new();
    for p in &mesh.positions {
        let _ = writeln!(text, "v {} {} {}", p.x, p.y, p.z);
    }
    for [a, b, c] in &mesh.triangles {
        let _ = writeln!(text, "f {} {} {}", a + 1, b + 1, c + 1);
    }
    text
}

impl Stage {
    /// Opens a scene with flags of the program; other `files` lie beside it.
    pub fn new(scene: &str, files: &[(&str, &[u8])], flags: &str) -> Self {
        let all: Vec<(&str, &[u8])> =
            [("scene.txt", scene.as_bytes())].into_iter().chain(files.iter().copied()).collect();
        let scratch = Scratch::new(&all);
        let input = scratch.file("scene.txt").display().to_string();
        let words = ["a8_path_tracing", "-input", &input].into_iter().chain(flags.split_whitespace());
        let args = parsed_words::<Program>(&words.map(str::to_owned).collect::<Vec<_>>()).args;
        let opened = Studio::open_textured(args.cast(), &[]);
        let (studio, _) = opened.unwrap_or_else(|error| panic!("{scene}\n{}", error.report()));
        Self { args, studio, scratch }
    }

    /// Lends the scene's lights.
    pub fn with_lights<R>(&self, work: impl FnOnce(&Lights) -> R) -> R {
        let world = self.world();
        work(&self.lights(&world))
    }

    fn world(&self) -> TexturedScene<'_> {
        let file = self.scratch.file("scene.txt");
        TexturedScene::load(&self.studio.scene, &self.studio.geometry, &file).expect("textures can be read")
    }

    fn lights<'s>(&'s self, world: &'s TexturedScene<'s>) -> Lights<'s> {
        Lights::load(&self.studio.geometry, world).expect("the sky can be read")
    }

    /// Renders up to each of some numbers of samples, one after the other, on one thread.
    pub fn sums(&self, seed: u64, ends: &[u32]) -> (Sums, Counters) {
        self.sums_with(seed, ends, TileOptions { threads: Some(1), ..TileOptions::default() })
    }

    /// The same with threads and tiles of choice.
    pub fn sums_with(&self, seed: u64, ends: &[u32], options: TileOptions) -> (Sums, Counters) {
        let plan = self.args.plan(self.studio.size).unwrap_or_else(|error| panic!("{}", error.report()));
        let accel = self.args.sampling.accel.structure(&self.studio.geometry, None);
        let accel = accel.unwrap_or_else(|error| panic!("{}", error.report()));
        let world = self.world();
        let numbers = Numbers::new(plan.pattern, plan.spp, self.studio.size, seed);
        let lights = self.lights(&world);
        let tracer =
            PathTracer::new(&self.studio, &world, accel.as_accel(), lights, numbers, self.args.rules());
        let mut sums = Sums::new(plan.frame, plan.layout, plan.first).expect("a small picture");
        let mut counters = Counters::default();
        for &end in ends {
            let goal = a8_path_tracing::Goal { end, ..plan.goal };
            counters += Rendering { goal, options }.run(&tracer, &mut sums, |_| {}).counters;
        }
        (sums, counters)
    }

    /// The picture by `-spp` samples.
    pub fn film(&self, seed: u64) -> Film {
        let plan = self.args.plan(self.studio.size).unwrap_or_else(|error| panic!("{}", error.report()));
        develop::radiance(&self.sums(seed, &[plan.goal.end]).0)
    }

    /// The mean of its pixels.
    pub fn mean(&self, seed: u64) -> DVec3 {
        mean(&self.film(seed))
    }
}

/// The mean of all pixels.
pub fn mean(film: &Film) -> DVec3 {
    film.pixels().iter().map(|p| p.as_dvec3()).sum::<DVec3>() / film.pixels().len() as f64
}

/// Mean of some numbers, and its standard error.
pub fn mean_and_error(values: &[f64]) -> (f64, f64) {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let variance = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (n - 1.0);
    (mean, (variance / n).sqrt())
}
