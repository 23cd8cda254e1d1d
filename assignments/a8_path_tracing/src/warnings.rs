//! Flags of lower steps that paths have no use for.

use crate::PathArgs;
use a3_phong::Specular;
use a6_kdtree::AccelArgs;
use common::cli;

impl PathArgs {
    /// Warns of flags that have no effect.
    pub(crate) fn warn(&self) {
        for (given, flag, why) in self.useless() {
            if given {
                cli::warn(&format!("{flag} has no effect: {why}"));
            }
        }
    }

    /// Flags that have no effect, whether they are given, and why they have none.
    fn useless(&self) -> Vec<(bool, &'static str, &'static str)> {
        let sampling = &self.sampling;
        let (pattern, filter, effects) = (&sampling.pattern, &sampling.filter, &sampling.effects);
        let (whitted, accel) = (&sampling.accel.grid.whitted, &sampling.accel);
        let cast = self.cast();
        let course_filter = filter.box_filter.or(filter.tent_filter).or(filter.gaussian_filter).is_some();
        let course_number =
            pattern.random_samples.or(pattern.uniform_samples).or(pattern.jittered_samples).is_some();
        let cells = accel.grid.shows_cells() || accel.visualize_kdtree;
        let side = cast.depth.is_some() || whitted.phong.diffuse.normals.is_some() || accel.heat.is_some();
        let own = !self.files.aov.is_empty() || self.files.checkpoint.is_some() || self.part.crop.is_some();
        vec![
            (whitted.shadows, "-shadows", "paths find shadows by themselves"),
            (whitted.transparent_shadows, "-transparent_shadows", "light takes its own way through glass"),
            (whitted.phong.diffuse.shade_back, "-shade_back", "surfaces have two sides for paths"),
            (whitted.phong.specular != Specular::default(), "-specular", "paths have one form of gloss"),
            (whitted.weight.is_some(), "-weight", "paths end at random, by -rr_depth"),
            (whitted.fresnel, "-fresnel", "glass always follows Fresnel's equations here"),
            (whitted.trace.is_some(), "-trace", "it prints the trees of assignment 4; paths have none"),
            (pattern.adaptive.is_some(), "-adaptive", "-error is what ends paths"),
            (pattern.samples_image.is_some(), "-samples_image", "it goes with -adaptive"),
            (pattern.render_samples.is_some(), "-render_samples", "assignment 7 paints samples"),
            (filter.render_filter.is_some(), "-render_filter", "assignment 7 draws filters"),
            (course_filter || filter.filter.is_some(), "a filter", "pixels are plain means of their samples"),
            (effects.light_samples.is_some(), "-light_samples", "a path asks one light at a time"),
            (effects.hard_lights, "-hard_lights", "lights have the size that they have"),
            (effects.smooth, "-smooth", "it would hide what paths are"),
            (effects.smooth_edges.is_some(), "-smooth_edges", "it would hide what paths are"),
            (course_number && self.goal.spp.is_some(), "the number of the course's pattern", "-spp is given"),
            (pattern.samples.is_some() && self.goal.spp.is_some(), "-samples", "-spp is given"),
            (cells && own, "-aov, -checkpoint or -crop", "cells are shown, which no path looks for"),
            (side && self.part.crop.is_some(), "-crop on -depth, -normals and -heat", "they show the whole"),
        ]
    }

    /// The flags of assignments 1 to 6 without what has been warned of, so that they do not warn
    /// of it again.
    pub(crate) fn accel(&self) -> AccelArgs {
        let mut all = self.sampling.accel.clone();
        let whitted = &mut all.grid.whitted;
        (whitted.shadows, whitted.transparent_shadows, whitted.fresnel) = (false, false, false);
        // What is no weight at all is refused below.
        whitted.weight = whitted.weight.filter(|weight| !(*weight >= 0.0 && weight.is_finite()));
        whitted.trace = None;
        // The picture is the same to the last bit; only the statistics tell of cells.
        all.fastest = !self.cast().general.program.stats;
        all
    }
}
