//! `ifs`: the program of assignment 0.

use a0_ifs::{ChaosGame, Options, load, play};
use common::cli::{self, AppError};
use common::picture::{self, Size, Transfer};
use std::process::ExitCode;
use std::time::Instant;

fn main() -> ExitCode {
    cli::run(|| draw(&cli::parse()))
}

fn draw(options: &Options) -> Result<(), AppError> {
    let size = Size::new(options.size, options.size)?;
    picture::check_output(&options.output, size)?;
    let ifs = load(&options.input)?;
    let started = Instant::now();
    let game = ChaosGame::new(&ifs, options.iters, options.seed);
    let loop_options = options.program.loop_options("points");
    let dots = play(&game, options.points, size, &loop_options);
    let seconds = started.elapsed().as_secs_f64();
    let filled = dots.count();
    if filled == 0 && options.points > 0 {
        cli::warn("no point ended inside the picture: do the maps stay within the unit square?");
    }
    picture::write(&options.output, &dots.film(), Transfer::Linear)?;
    if options.program.stats {
        cli::say(&format!(
            "maps {}  points {}  draws per point {}  pixels {}  black {filled}  time {:.3} ms",
            ifs.maps().len(),
            options.points,
            game.draws(),
            size.pixels(),
            seconds * 1e3
        ));
    }
    Ok(())
}
