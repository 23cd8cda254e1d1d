//! From flags to pictures on disk.

use crate::film::{Identity, Sums, checkpoint};
use crate::fingerprint::fingerprint;
use crate::light::Lights;
use crate::numbers::Numbers;
use crate::outputs::Outputs;
use crate::path::{PathTracer, Rules};
use crate::plan::Plan;
use crate::render::{End, Estimator, Pace, Rendering, Tally, spared, trace_spared};
use crate::{Integrator, PathArgs};
use a1_ray_casting::{Report, Studio};
use a6_kdtree::texture::TexturedScene;
use a6_kdtree::{AccelArgs, Step};
use a7_sampling::Sampled;
use common::accel::Accel;
use common::atomic::place;
use common::cli::{self, AppError, Skip, interrupt};
use common::tiles::TileOptions;
use std::path::Path;
use std::time::Duration;

/// Least time between two pictures of a rendering that goes on.
const BETWEEN_PICTURES: Duration = Duration::from_secs(1);

/// Least time between two checkpoints.
const BETWEEN_CHECKPOINTS: Duration = Duration::from_secs(10);

/// The whole program: reads the scene, renders what was asked for, writes it.
///
/// # Errors
/// Bad usage, an unreadable scene or checkpoint, an unwritable file.
pub fn run(args: &PathArgs) -> Result<(), AppError> {
    args.sampling.check()?;
    args.plan(args.cast().size()?)?;
    args.warn();
    let outputs = Outputs::new(args.cast().output.as_ref(), &args.files)?;
    args.check_resumed(&outputs)?;
    let mut accel = args.accel();
    let cast = &mut accel.grid.whitted.phong.diffuse.cast;
    cast.further_outputs.extend(outputs.aovs.iter().map(|(_, path)| path.clone()));
    cast.further_files.extend(outputs.checkpoint.clone());
    a6_kdtree::perform(&accel, &Traced { args })
}

/// This step: paths through every pixel.
pub struct Traced<'a> {
    /// The flags.
    pub args: &'a PathArgs,
}

impl Step for Traced<'_> {
    fn adjust(&self, studio: &mut Studio) -> Result<(), AppError> {
        Sampled { args: &self.args.sampling }.adjust(studio)
    }

    fn draw(
        &self,
        args: &AccelArgs,
        studio: &Studio,
        scene: &TexturedScene,
        accel: &dyn Accel,
        report: &mut Report,
    ) -> Result<(), AppError> {
        let plan = self.args.plan(studio.size)?;
        let outputs = Outputs::new(self.args.cast().output.as_ref(), &self.args.files)?;
        if outputs.any() || args.cast().general.program.stats {
            let lights = Lights::load(&studio.geometry, scene)?;
            if self.args.rules().integrator == Integrator::Naive && lights.has_points() {
                cli::warn("-integrator naive: lights without a surface stay dark, as no path meets them");
            }
            let numbers = Numbers::new(plan.pattern, plan.spp, studio.size, plan.seed);
            let tracer = PathTracer::new(studio, scene, accel, lights, numbers, self.args.rules());
            self.args.render(&tracer, studio, &plan, &outputs, report)?;
        }
        args.expose_side_pictures(studio, accel, report)
    }
}

impl PathArgs {
    /// What paths may do.
    pub fn rules(&self) -> Rules {
        let skips = |kind| self.cast().general.skips(kind);
        Rules {
            integrator: self.follow.integrator,
            bounces: self.sampling.accel.grid.whitted.bounces,
            roulette_depth: self.follow.rr_depth,
            skip_behind: skips(Skip::Behind),
            skip_specular: skips(Skip::Specular),
            skip_surface: skips(Skip::Surface),
        }
    }

    /// What is gone on from must not be written over by a picture.
    fn check_resumed(&self, outputs: &Outputs) -> Result<(), AppError> {
        let Some(resumed) = &self.part.resume else { return Ok(()) };
        let mut pictures = outputs.picture.iter().chain(outputs.aovs.iter().map(|(_, path)| path));
        match pictures.find(|path| place(path) == place(resumed)) {
            Some(path) => Err(AppError::Usage(format!(
                "{} is the checkpoint to go on from; a picture would destroy it",
                path.display()
            ))),
            None => Ok(()),
        }
    }

    /// Renders, and writes what was rendered, while it goes on and at the end.
    fn render<E: Estimator>(
        &self,
        estimator: &E,
        studio: &Studio,
        plan: &Plan,
        outputs: &Outputs,
        report: &mut Report,
    ) -> Result<(), AppError> {
        let keeps = outputs.checkpoint.is_some() || self.part.resume.is_some();
        // Only checkpoints need the number, and to find it the pictures of textures are read again.
        let scene = if keeps { fingerprint(&studio.scene)? } else { 0 };
        let identity = self.identity(plan, scene);
        let mut sums = match &self.part.resume {
            Some(path) => resumed(path, &identity, plan)?,
            None => Sums::new(plan.frame, plan.layout, plan.first)?,
        };
        let stop = interrupt::watch();
        let options = TileOptions { stop: Some(stop), ..self.cast().general.tile_options("paths") };
        let rendering = Rendering { goal: plan.goal, options };
        let (mut picture, mut kept) = (Pace::new(BETWEEN_PICTURES), Pace::new(BETWEEN_CHECKPOINTS));
        let end = plan.goal.end;
        let tally = report.time("render", || {
            rendering.run(estimator, &mut sums, |sums| {
                if sums.samples.end < end {
                    picture.when_due(|| outputs.refresh_picture(sums));
                    kept.when_due(|| outputs.refresh_checkpoint(&identity, sums));
                }
            })
        });
        report.counters += tally.counters;
        if tally.end != End::Stopped && plan.goal.time.is_none() {
            self.count_spared(estimator, &sums, &rendering, report);
        }
        report.notes.extend(notes(&tally, &sums));
        tell_of_end(&tally, &sums)?;
        report.time("write", || outputs.write(&identity, &sums))
    }
}

impl PathArgs {
    /// Counts the samples that pixels were spared; or traces them, if they are not to be skipped.
    fn count_spared<E: Estimator>(
        &self,
        estimator: &E,
        sums: &Sums,
        rendering: &Rendering,
        report: &mut Report,
    ) {
        if self.cast().general.skips(Skip::Converged) {
            report.counters.skipped_converged += spared(sums, &rendering.goal);
            return;
        }
        let trace = || trace_spared(estimator, sums, &rendering.goal, &rendering.options);
        let counters = report.time("samples that were not needed", trace);
        report.counters += counters;
    }
}

/// The sums of a checkpoint, to be gone on with.
fn resumed(path: &Path, identity: &Identity, plan: &Plan) -> Result<Sums, AppError> {
    let old = checkpoint::read(path)?;
    let file = path.display();
    let refused = |why: String| Err(AppError::Usage(format!("'{file}' cannot be gone on with: {why}")));
    if let Some([fact, there, here]) = old.identity.difference(identity) {
        return refused(format!("it was made with {fact} {there}, and here it is {here}"));
    }
    let sums = old.sums;
    if sums.frame != plan.frame {
        let crop = sums.frame.crop;
        let (x0, y0, x1, y1) = (crop.x0, crop.y0, crop.x1, crop.y1);
        return refused(format!("it shows other pixels, those of -crop {x0} {y0} {x1} {y1}"));
    }
    if sums.layout != plan.layout {
        return refused("it keeps other sums".to_owned());
    }
    if sums.samples.start != plan.first {
        return refused(format!("its first sample is {}, and here it is {}", sums.samples.start, plan.first));
    }
    if sums.samples.end > plan.goal.end {
        let (has, wanted) = (sums.samples.end, plan.goal.end);
        return refused(format!(
            "it has the samples below {has} already, and only those below {wanted} are wanted"
        ));
    }
    Ok(sums)
}

/// What there is to say at the end, beside the statistics.
fn tell_of_end(tally: &Tally, sums: &Sums) -> Result<(), AppError> {
    if tally.end == End::Stopped {
        if sums.done() == 0 {
            return Err(AppError::Input(
                "interrupted before every pixel had a sample: nothing is written".into(),
            ));
        }
        cli::note(&format!("interrupted: pixels have {} samples", sums.done()));
    }
    if sums.dropped > 0 {
        cli::warn(&format!("{} samples were no numbers, and count as black", sums.dropped));
    }
    Ok(())
}

/// What `-stats` says of the samples.
fn notes(tally: &Tally, sums: &Sums) -> [String; 3] {
    let rate = tally.paths as f64 / tally.time.as_secs_f64().max(1e-9);
    let (least, most) = (sums.taken().iter().min(), sums.taken().iter().max());
    let all: u64 = sums.taken().iter().map(|n| u64::from(*n)).sum();
    let pixels = sums.taken().len();
    let possible = pixels as u64 * u64::from(sums.done());
    [
        format!("paths: {} in {} passes, {rate:.0} per second", tally.paths, tally.passes),
        format!(
            "samples per pixel: least {}, mean {:.1}, most {}; {} of {pixels} pixels converged, {} paths skipped",
            least.unwrap_or(&0),
            all as f64 / pixels as f64,
            most.unwrap_or(&0),
            pixels - sums.active(),
            possible - all
        ),
        format!(
            "skipped: lights not asked for mirrors and glass {}; paths ended by roulette {}",
            tally.counters.skipped_light_specular, tally.counters.ended_by_roulette
        ),
    ]
}
