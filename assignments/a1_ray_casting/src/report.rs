//! What `-stats` prints.

use crate::CastArgs;
use common::cli;
use common::counters::Counters;
use common::math::Bounds;
use common::picture::Size;
use std::fmt::{Display, Formatter, Result};
use std::time::{Duration, Instant};

/// Counters, times, and what was built or skipped.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// Wall-clock time of each phase, in the order they happened.
    pub phases: Vec<(&'static str, Duration)>,
    /// What was counted.
    pub counters: Counters,
    /// Size of the pictures.
    pub size: Option<Size>,
    /// Box of the finite objects.
    pub bounds: Option<Bounds>,
    /// Cells of the grid along each axis, if there is one.
    pub cells: Option<[u32; 3]>,
    /// What was built or left out because the scene does not need it, and why.
    pub notes: Vec<String>,
}

impl Report {
    /// Runs one phase and notes how long it took.
    pub fn time<T>(&mut self, phase: &'static str, work: impl FnOnce() -> T) -> T {
        let started = Instant::now();
        let result = work();
        self.phases.push((phase, started.elapsed()));
        result
    }

    /// Prints itself if `-stats` asks for it.
    pub fn print_if_wanted(&self, args: &CastArgs) {
        if args.general.program.stats {
            cli::say(&self.to_string());
        }
    }

    fn ratio(&self, of: u64) -> f64 {
        let rays = self.counters.rays + self.counters.shadow_rays;
        if rays == 0 { 0.0 } else { of as f64 / rays as f64 }
    }

    fn course_block(&self, f: &mut Formatter) -> Result {
        let c = &self.counters;
        let total: Duration = self.phases.iter().map(|(_, time)| *time).sum();
        let (w, h) = self.size.map_or((0, 0), |s| (s.width(), s.height()));
        let pixels = f64::from(w) * f64::from(h);
        writeln!(f, "  total time                 {:.3} s", total.as_secs_f64())?;
        writeln!(f, "  num pixels                 {pixels} ({w}x{h})")?;
        match self.bounds {
            Some(b) => writeln!(f, "  scene bounds               {} -> {}", b.min, b.max)?,
            None => writeln!(f, "  scene bounds               NULL")?,
        }
        match self.cells {
            Some([x, y, z]) => {
                let all = u64::from(x) * u64::from(y) * u64::from(z);
                writeln!(f, "  num grid cells             {all} ({x}x{y}x{z})")?;
            }
            None => writeln!(f, "  num grid cells             NULL")?,
        }
        writeln!(f, "  num non-shadow rays        {}", c.rays)?;
        writeln!(f, "  num shadow rays            {}", c.shadow_rays)?;
        writeln!(f, "  total intersections        {}", c.intersections)?;
        writeln!(f, "  total cells traversed      {}", c.cells)?;
        let rays = (c.rays + c.shadow_rays) as f64;
        writeln!(f, "  rays per second            {:.0}", rays / self.seconds("render").max(1e-9))?;
        writeln!(f, "  rays per pixel             {:.3}", rays / pixels.max(1.0))?;
        writeln!(f, "  intersections per ray      {:.3}", self.ratio(c.intersections))?;
        writeln!(f, "  cells traversed per ray    {:.3}", self.ratio(c.cells))
    }

    fn seconds(&self, phase: &str) -> f64 {
        self.phases.iter().filter(|(name, _)| *name == phase).map(|(_, t)| t.as_secs_f64()).sum()
    }

    fn skipped(&self) -> [(&'static str, u64); 18] {
        let c = &self.counters;
        [
            ("decided in double precision", c.exact_tests),
            ("skipped: camera rays of empty tiles", c.skipped_empty_tile),
            ("skipped: shadow rays, light behind", c.skipped_shadow_behind),
            ("skipped: shadow rays, light dark", c.skipped_shadow_dark),
            ("skipped: shadow rays, inside a body", c.skipped_shadow_inside),
            ("skipped: secondary rays, black", c.skipped_black_secondary),
            ("skipped: secondary rays, known", c.skipped_known_secondary),
            ("dropped: secondary rays, weight", c.skipped_below_weight),
            ("surface points worked out", c.surfaces),
            ("skipped: surface points, not wanted", c.skipped_surface),
            ("pictures rendered", c.pictures),
            ("spheres with a matrix", c.matrices),
            ("skipped: matrices, baked or none", c.skipped_matrix),
            ("mesh files read", c.mesh_files),
            ("skipped: mesh files, read before", c.skipped_mesh_file),
            ("structures built", c.structures),
            ("skipped: structures, not needed", c.skipped_structure),
            ("skipped: samples, error small", c.skipped_converged),
        ]
    }
}

impl Display for Report {
    fn fmt(&self, f: &mut Formatter) -> Result {
        writeln!(f, "********************************************")?;
        writeln!(f, "RAY TRACING STATISTICS")?;
        self.course_block(f)?;
        writeln!(f, "  -- what was done and what was not --")?;
        for (name, count) in self.skipped() {
            writeln!(f, "  {name:<36} {count}")?;
        }
        for note in &self.notes {
            writeln!(f, "  {note}")?;
        }
        for (name, time) in &self.phases {
            writeln!(f, "  time: {name:<12} {:9.3} ms", time.as_secs_f64() * 1e3)?;
        }
        write!(f, "********************************************")
    }
}
