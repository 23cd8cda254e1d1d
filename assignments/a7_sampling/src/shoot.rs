//! From flags to pictures on disk.

use crate::aperture::Aperture;
use crate::light::SoftLights;
use crate::picture::{SamplesPicture, counts_picture, kernel_picture};
use crate::sampler::{Pattern, Pixel};
use crate::{Exposure, Sample, Sampler, SamplingArgs, Shade, smoothed};
use a1_ray_casting::{Report, Sight, Studio, World};
use a4_whitted::{NoRecord, Whitted};
use a6_kdtree::texture::TexturedScene;
use a6_kdtree::{AccelArgs, Plain, Step};
use common::accel::Accel;
use common::camera::Camera;
use common::cli::{self, AppError};
use common::counters::Counters;
use common::math::Vec3;
use common::picture::{Transfer, write};

/// Looks at extended lights that a pixel should come to.
const LOOKS_PER_PIXEL: u32 = 16;

/// The whole program: reads the scene, renders what was asked for, writes it.
///
/// # Errors
/// Bad usage, an unreadable scene, an unwritable picture.
pub fn run(args: &SamplingArgs) -> Result<(), AppError> {
    args.check()?;
    a6_kdtree::perform(&args.with_outputs()?, &Sampled { args })
}

/// This step: as many rays for a pixel as the flags ask for.
pub struct Sampled<'a> {
    /// The flags.
    pub args: &'a SamplingArgs,
}

/// Whitted's light, with lights that have an extent.
pub struct SoftWhitted<'a> {
    /// What follows rays.
    pub whitted: Whitted<'a>,
    /// The lights; `None` for points and directions only.
    pub lights: Option<SoftLights<'a>>,
}

impl Shade for SoftWhitted<'_> {
    fn radiances(
        &self,
        sights: &[Sight],
        samples: &[(Pixel, u32)],
        counters: &mut Counters,
        radiances: &mut [Vec3],
    ) {
        let whitted = &self.whitted;
        match &self.lights {
            None => whitted.radiances_of_points(sights, counters, radiances),
            Some(lights) => {
                let of_sample = |(pixel, sample): &(Pixel, u32)| lights.of_sample(*pixel, *sample);
                let mut lamps: Vec<_> = samples.iter().map(of_sample).collect();
                whitted.radiances(sights, &mut lamps, counters, &mut NoRecord, radiances);
            }
        }
    }
}

impl Step for Sampled<'_> {
    fn adjust(&self, studio: &mut Studio) -> Result<(), AppError> {
        let camera = &mut studio.scene.camera;
        *camera = self.args.motion.moved(camera, studio.geometry.bounds());
        camera.lens = self.args.effects.lens(camera)?;
        studio.camera = Camera::new(camera);
        Ok(())
    }

    fn draw(
        &self,
        args: &AccelArgs,
        studio: &Studio,
        scene: &TexturedScene,
        accel: &dyn Accel,
        report: &mut Report,
    ) -> Result<(), AppError> {
        let (whitted, lights) = (&args.grid.whitted, self.lights(studio, scene));
        self.draw_kernel(studio, report)?;
        if studio.camera.lens.is_some() && self.args.pattern.choice().is_none() {
            cli::warn("the lens has no effect without samples: give -samples N");
        }
        if self.is_plain(lights.as_ref()) {
            return Plain.draw(args, studio, scene, accel, report);
        }
        let shade = SoftWhitted { whitted: whitted.whitted(scene, accel), lights };
        whitted.print_ray_tree(studio, &shade.whitted, report)?;
        self.draw_samples(args, studio, accel, &shade, report)?;
        args.expose_side_pictures(studio, accel, report)
    }
}

impl Sampled<'_> {
    /// Whether the steps below draw this as it is.
    fn is_plain(&self, lights: Option<&SoftLights>) -> bool {
        let args = self.args;
        let smooths = args.effects.smooth || args.effects.smooth_edges.is_some();
        let samples = args.pattern.choice().is_some() || args.pattern.render_samples.is_some();
        let filters = args.filter.kernel().is_ok_and(|kernel| kernel.is_some());
        !samples && !filters && !smooths && lights.is_none()
    }

    /// Pattern and number of samples, one at the centre if nothing is said.
    fn pattern(&self) -> (Pattern, u32) {
        self.args.pattern.choice().unwrap_or((Pattern::Uniform, 1))
    }

    /// So many points of a pattern for every pixel of the picture.
    fn sampler(&self, studio: &Studio, pattern: Pattern, samples: u32) -> Box<dyn Sampler> {
        let side = studio.size.width().max(studio.size.height());
        pattern.sampler(samples, side, self.args.pattern.seed)
    }

    /// The scene's lights if any of them has an extent.
    fn lights<'s>(&self, studio: &'s Studio, scene: &'s TexturedScene<'s>) -> Option<SoftLights<'s>> {
        if self.args.effects.hard_lights {
            return None;
        }
        let samples = self.pattern().1;
        let each = self.args.effects.light_samples.unwrap_or(LOOKS_PER_PIXEL.div_ceil(samples));
        // One sample at the centre says nothing of where to look at lights.
        let pattern = self.args.pattern.choice().map_or(Pattern::default(), |(pattern, _)| pattern);
        let sampler = self.sampler(studio, pattern, samples.saturating_mul(each));
        let world: &dyn World = scene;
        let lights = SoftLights::new(&studio.geometry, world, each, sampler);
        if lights.endless() > 0 {
            cli::warn("a plane without a rim shines: it is seen, but lights nothing");
        }
        (lights.extended() > 0).then_some(lights)
    }

    /// The picture of the kernel, if asked for.
    fn draw_kernel(&self, studio: &Studio, report: &mut Report) -> Result<(), AppError> {
        let filter = &self.args.filter;
        let (Some((file, zoom)), Some(kernel)) = (filter.picture()?, filter.kernel()?) else { return Ok(()) };
        let film = kernel_picture(kernel, studio.size, zoom)?;
        Ok(report.time("write", || write(&file, &film, Transfer::Linear))?)
    }

    /// The colour picture and that of the samples, as far as they are asked for.
    fn draw_samples(
        &self,
        args: &AccelArgs,
        studio: &Studio,
        accel: &dyn Accel,
        shade: &dyn Shade,
        report: &mut Report,
    ) -> Result<(), AppError> {
        let (cast, plan, effects) = (args.cast(), &self.args.pattern, &self.args.effects);
        let dots = plan.picture()?;
        let wanted = cast.output.is_some() || dots.is_some() || plan.samples_image.is_some();
        if !wanted && !cast.general.program.stats {
            return Ok(());
        }
        let (pattern, samples) = self.pattern();
        let sampler = self.sampler(studio, pattern, samples);
        let lens = studio.camera.lens.filter(|_| plan.choice().is_some());
        let exposure = Exposure {
            studio,
            cast,
            accel,
            shade,
            sampler: &*sampler,
            aperture: lens.map(|lens| Aperture::new(lens.blades)),
            kernel: self.args.filter.kernel()?,
        };
        let painted = dots.as_ref().map(|(_, zoom)| SamplesPicture::new(studio.size, *zoom)).transpose()?;
        let paint = |samples: &[Sample]| {
            if let Some(picture) = &painted {
                picture.paint(samples);
            }
        };
        let watch = painted.is_some().then_some(&paint as crate::Watch);
        let (mut film, counts, note) = match plan.plan() {
            None => {
                let (film, counters) = report.time("render", || exposure.picture(samples, watch));
                report.counters += counters;
                (film, None, format!("samples: {samples} per pixel, {pattern:?}"))
            }
            Some(adaptive) => {
                let (film, survey, counters) =
                    report.time("render", || adaptive.picture(&exposure, watch))?;
                report.counters += counters;
                let note = format!("{pattern:?}, error {}: {}", adaptive.error, adaptive.describe(&survey));
                (film, Some(survey.counts()), note)
            }
        };
        report.notes.push(note);
        if effects.smooth || effects.smooth_edges.is_some() {
            film = smoothed(&film, effects.smooth_edges);
        }
        report.time("write", || {
            if let Some(path) = &cast.output {
                write(path, &film, Transfer::Linear)?;
            }
            if let (Some((path, _)), Some(picture)) = (&dots, painted) {
                write(path, &picture.into_film(), Transfer::Linear)?;
            }
            if let (Some(path), Some(counts)) = (&plan.samples_image, counts) {
                write(path, &counts_picture(studio.size, &counts), Transfer::Linear)?;
            }
            Ok(())
        })
    }
}
