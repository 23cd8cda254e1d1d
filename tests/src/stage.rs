//! A scene on stage: opened with the flags of assignment 5, to be rendered through any structure.

use crate::program::parsed_words;
use crate::workspace_file;
use a1_ray_casting::{Layer, Sight, Studio};
use a2_transforms::Normals;
use a4_whitted::WhittedColor;
use a5_grid::{Cells, GridArgs, Program, Structure};
use common::accel::Accel;
use common::cli::{GeneralArgs, Skip};
use common::counters::Counters;
use common::math::Vec3;
use common::picture::Film;
use std::path::Path;

/// A scene and the flags that it was opened with.
pub struct Stage {
    /// The flags.
    pub args: GridArgs,
    /// The scene.
    pub studio: Studio,
}

/// The films of one rendering, linear light in single precision.
pub struct Films {
    /// Colour; then parameter and number of the hit; its barycentric weights; its normal.
    pub layers: [Film; 4],
    /// What was counted.
    pub counters: Counters,
}

/// Names of [`Films::layers`], for messages.
const LAYERS: [&str; 4] = ["colour", "hit (t, primitive)", "hit (u, v)", "normal"];

/// The bare hit: t and the primitive's number, exact below 2²⁴.
struct HitNumbers;

impl Layer for HitNumbers {
    fn value(&self, sight: &Sight, _: &mut Counters) -> Vec3 {
        sight.hit.map_or(Vec3::NEG_ONE, |hit| Vec3::new(hit.t, hit.primitive as f32, 1.0))
    }
}

/// The place of the hit inside its triangle.
struct HitPlace;

impl Layer for HitPlace {
    fn value(&self, sight: &Sight, _: &mut Counters) -> Vec3 {
        sight.hit.map_or(Vec3::NEG_ONE, |hit| Vec3::new(hit.u, hit.v, 1.0))
    }
}

impl Stage {
    /// Opens a scene file of the workspace (or an absolute one) with further flags, written as
    /// on a command line.
    ///
    /// # Panics
    /// If flags or scene are refused.
    pub fn open(scene: impl AsRef<Path>, flags: &str) -> Self {
        let scene = workspace_file(scene).display().to_string();
        let given = ["a5_grid", "-input", &scene].into_iter().chain(flags.split_whitespace());
        let args = parsed_words::<Program>(&given.map(str::to_owned).collect::<Vec<_>>()).args;
        let opened = Studio::open(args.cast(), &[]);
        let (studio, _) = opened.unwrap_or_else(|error| panic!("{scene}\n{}", error.report()));
        Self { args, studio }
    }

    /// The flags that no picture depends on, to be changed.
    pub fn general(&mut self) -> &mut GeneralArgs {
        &mut self.args.whitted.phong.diffuse.cast.general
    }

    /// The same stage, but doing one kind of needless work.
    pub fn not_skipping(mut self, skip: Skip) -> Self {
        self.general().noskip.push(skip);
        self
    }

    /// The list of all primitives.
    ///
    /// # Panics
    /// Never: a list can always be built.
    pub fn list(&self) -> Structure<'_> {
        self.args.structure(&self.studio.geometry, None).unwrap_or_else(|error| panic!("{}", error.report()))
    }

    /// A grid over the finite primitives; `None` if there are none.
    ///
    /// # Panics
    /// If it would be too large.
    pub fn grid(&self, cells: [u32; 3]) -> Option<Structure<'_>> {
        let cells = Cells::new(cells, &self.studio.geometry.bounds()?);
        let grid = self.args.structure(&self.studio.geometry, Some(cells));
        Some(grid.unwrap_or_else(|error| panic!("{}", error.report())))
    }

    /// Renders the pictures of this scene through a structure.
    pub fn films(&self, accel: &dyn Accel) -> Films {
        let color = WhittedColor { whitted: self.args.whitted.whitted(&self.studio.scene, accel) };
        let layers: [&dyn Layer; 4] = [&color, &HitNumbers, &HitPlace, &Normals];
        let (films, counters) = self.studio.render(self.args.cast(), accel, &layers);
        let layers = films.try_into().unwrap_or_else(|_| unreachable!("one film per layer"));
        Films { layers, counters }
    }
}

impl Films {
    /// The first difference, to the last bit, in words; `None` if there is none.
    pub fn first_difference(&self, other: &Self) -> Option<String> {
        let pairs = LAYERS.iter().zip(self.layers.iter().zip(&other.layers));
        pairs.into_iter().find_map(|(name, (a, b))| {
            let bits = |color: &Vec3| color.to_array().map(f32::to_bits);
            let differs = |&i: &usize| bits(&a.pixels()[i]) != bits(&b.pixels()[i]);
            let all = || (0..a.pixels().len()).filter(differs);
            let first = all().next()?;
            let (x, y) = (first % a.width() as usize, first / a.width() as usize);
            let (one, two) = (a.pixels()[first], b.pixels()[first]);
            Some(format!("{name}: {} pixels differ, first ({x}, {y}): {one} and {two}", all().count()))
        })
    }
}
