//! The program `a8_path_tracing`, run as its users run it.

use a8_path_tracing::film::checkpoint;
use common::picture::{Film, Transfer, read};
use std::fs;
use std::time::{Duration, Instant};
use tests::battery::{accepted, odd, refused, scenes, scratch, usage};
use tests::binary::{Binary, Outcome, Scratch};

const PROGRAM: Binary = Binary { path: env!("CARGO_BIN_EXE_a8_path_tracing"), assignment: 8 };

fn run(scratch: &Scratch, line: &str) -> Outcome {
    accepted(&PROGRAM, scratch, &line.split_whitespace().collect::<Vec<_>>())
}

fn bytes(scratch: &Scratch, name: &str) -> Vec<u8> {
    fs::read(scratch.file(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn picture(scratch: &Scratch, name: &str) -> Film {
    read(&scratch.file(name), Transfer::Linear).unwrap_or_else(|error| panic!("{error}"))
}

// The battery of all ray tracers, but for the course's command lines, of which there are none for
// this assignment, and for how 8-bit pictures are coded, which is another way here.

#[test]
fn classic_mistakes_in_scenes_are_refused() {
    scenes::classic_mistakes(&PROGRAM);
}

#[test]
fn what_is_no_scene_is_refused() {
    scenes::not_a_scene(&PROGRAM);
}

#[test]
fn wrong_meshes_are_refused() {
    scenes::wrong_meshes(&PROGRAM);
}

#[test]
fn wrong_flags_are_refused() {
    usage::wrong_flags(&PROGRAM);
}

#[test]
fn wrong_numbers_are_refused() {
    usage::wrong_numbers(&PROGRAM);
}

#[test]
fn wrong_outputs_are_refused() {
    usage::wrong_outputs(&PROGRAM);
}

#[test]
fn other_spellings_are_accepted() {
    odd::spellings(&PROGRAM);
    odd::scenes(&PROGRAM);
}

#[test]
fn a_closed_stdout_is_no_error() {
    odd::closed_stdout(&PROGRAM);
}

#[test]
fn help_and_version() {
    odd::help(&PROGRAM);
    let scratch = scratch(b"");
    let help = run(&scratch, "-merge -help").stdout;
    assert!(help.contains("-merge") && help.contains("-checkpoint") && !help.contains("-spp <"), "{help}");
}

#[test]
fn eight_bits_take_the_curve_unless_told_not_to() {
    let scratch = scratch(b"");
    let draw = |name: &str, flags: &str| {
        run(&scratch, &format!("-input good.txt -size 24 16 -spp 4 -output {name} {flags}"));
        picture(&scratch, name)
    };
    let light = draw("o.pfm", "");
    assert_eq!(light, draw("o.exr", "-linear"));
    let levels = |transfer: Transfer| {
        Film::from_fn(light.size(), |x, y| {
            common::math::Vec3::from(transfer.levels(light.get(x, y)).map(|level| f32::from(level) / 255.0))
        })
    };
    for name in ["o.tga", "o.png", "o.ppm"] {
        assert_eq!(draw(name, ""), levels(Transfer::Srgb), "{name}");
        assert_eq!(draw(name, "-linear"), levels(Transfer::Linear), "{name}");
    }
}

#[test]
fn wrong_values_are_refused() {
    usage::own_flags(
        &PROGRAM,
        &[
            ("-output o.tga -spp 0", &["'0'", "-spp"]),
            ("-output o.tga -spp many", &["'many'", "-spp"]),
            ("-output o.tga -time 0", &["-time", "above 0, not 0"]),
            ("-output o.tga -time nan", &["-time", "NaN"]),
            ("-output o.tga -time -1", &["-time", "-1"]),
            ("-output o.tga -time 1 -sampler jittered", &["can go on", "sobol"]),
            ("-output o.tga -error 0", &["-error", "above 0, not 0"]),
            ("-output o.tga -error nan", &["-error", "NaN"]),
            ("-output o.tga -error 0.1 -sampler blue_noise", &["can go on"]),
            ("-output o.tga -error 0.1 -crop 0 0 9 9", &["-error", "-crop", "cannot"]),
            ("-output o.tga -error 0.1 -spp_range 0 9", &["-error", "-spp_range", "cannot"]),
            ("-output o.tga -crop 5 0 5 9", &["-crop 5 0 5 9", "no pixels"]),
            ("-output o.tga -crop 0 0 101 9", &["-crop 0 0 101 9", "100 x 100"]),
            ("-output o.tga -crop 0 0 9", &["-crop", "4"]),
            ("-output o.tga -crop -1 0 9 9", &["'-1'", "-crop"]),
            ("-output o.tga -spp_range 5 5", &["-spp_range", "5 to 5"]),
            ("-output o.tga -spp_range 0 65 -spp 64", &["sample 64 is none of 64"]),
            ("-output o.tga -spp_range 0 8 -sampler jittered", &["-spp_range", "needs -spp"]),
            ("-output o.tga -aov albedo", &["-aov wants a kind and a picture"]),
            ("-output o.tga -aov colour a.tga", &["`colour`", "albedo, normal, depth"]),
            ("-output o.tga -aov depth a.doc", &["a.doc"]),
            ("-output o.tga -aov depth ./o.tga", &["two pictures"]),
            ("-output o.tga -checkpoint good.txt", &["good.txt", "is the scene"]),
            ("-output o.tga -checkpoint o.tga", &["two files", "o.tga"]),
            ("-output o.tga -checkpoint nowhere/a", &["'nowhere/a'", "no folder"]),
            ("-output old.tga -resume old.tga", &["old.tga", "destroy"]),
            ("-output o.tga -resume none.ckpt", &["none.ckpt"]),
            ("-output o.tga -resume good.txt", &["good.txt", "at byte 0"]),
            ("-output o.tga -integrator bidir", &["'bidir'", "naive, nee, mis"]),
            ("-resume good.txt", &["nothing to do"]),
        ],
    );
}

#[test]
fn what_has_no_effect_is_told() {
    let scratch = scratch(b"");
    let told = |flags: &str| {
        run(&scratch, &format!("-input good.txt -output o.tga -size 9 9 -spp 1 {flags}")).stderr
    };
    for flag in [
        "-shadows",
        "-transparent_shadows",
        "-shade_back",
        "-fresnel",
        "-weight 0.1",
        "-specular phong",
        "-trace 1 1",
        "-adaptive 0.1",
        "-samples 4",
        "-render_samples s.tga 2",
        "-light_samples 3",
        "-hard_lights",
        "-smooth",
        "-smooth_edges 0.1",
    ] {
        let stderr = told(flag);
        let name = flag.split(' ').next().unwrap();
        assert_eq!(stderr.lines().count(), 1, "{stderr}");
        assert!(stderr.starts_with(&format!("warning: {name} has no effect")), "{stderr}");
    }
    assert_eq!(told("-integrator nee"), "");
    assert!(told("-integrator naive").contains("no path meets them"), "good.txt has a point light");
    assert!(told("-box_filter 1").starts_with("warning: a filter has no effect"));
    assert!(told("-random_samples 4").contains("-spp is given"));
    assert_eq!(told("-seed 3 -sampler halton -bounces 2 -rr_depth 3 -accel list"), "");
}

#[test]
fn rests_parts_and_threads_change_no_byte() {
    let scratch = scratch(b"");
    let draw = |flags: &str| run(&scratch, &format!("-input good.txt -size 40 30 -aov depth d.pfm {flags}"));
    draw("-spp 24 -output whole.exr -checkpoint whole.ckpt");
    draw("-spp 5 -checkpoint a.ckpt -threads 1");
    draw("-spp 24 -resume a.ckpt -checkpoint a.ckpt -threads 3 -tile 7 -output a.exr");
    assert!(bytes(&scratch, "a.ckpt") == bytes(&scratch, "whole.ckpt"));
    assert!(bytes(&scratch, "a.exr") == bytes(&scratch, "whole.exr"));
    let parts = [
        ("-crop 0 0 13 30 -spp_range 0 24", "p.ckpt"),
        ("-crop 13 0 40 30 -spp_range 9 24", "q.ckpt"),
        ("-crop 13 0 40 30 -spp_range 0 9", "r.ckpt"),
    ];
    parts.iter().for_each(|(part, file)| drop(draw(&format!("{part} -checkpoint {file}"))));
    run(&scratch, "-merge p.ckpt q.ckpt r.ckpt -output m.exr -checkpoint m.ckpt -aov depth m.pfm");
    assert!(bytes(&scratch, "m.ckpt") == bytes(&scratch, "whole.ckpt"));
    assert!(bytes(&scratch, "m.exr") == bytes(&scratch, "whole.exr"));
    run(&scratch, "-merge q.ckpt r.ckpt -output crop.exr -quiet");
    let (whole, crop) = (picture(&scratch, "whole.exr"), picture(&scratch, "crop.exr"));
    assert_eq!((crop.width(), crop.height()), (27, 30));
    assert_eq!(crop, Film::from_fn(crop.size(), |x, y| whole.get(x + 13, y)));
    assert_eq!(picture(&scratch, "m.pfm").size(), whole.size());
    for (line, needles) in [
        ("-merge p.ckpt q.ckpt -output n.exr", &["samples 0 to 8 of pixels 13 0 40 30 are in none"][..]),
        ("-merge p.ckpt -output n.exr -aov albedo n.pfm", &["albedo was not kept"]),
        ("-merge q.ckpt q.ckpt -output n.exr", &["both in 'q.ckpt'"]),
        ("-merge p.ckpt q.ckpt r.ckpt", &["nothing to do"]),
        ("-merge -output n.exr", &["-merge wants the files"]),
        ("-merge p.ckpt good.txt -output n.exr", &["good.txt", "at byte 0"]),
        ("-merge p.ckpt -output p.ckpt", &["p.ckpt", "written over"]),
        ("-merge p.ckpt -output n.doc", &["n.doc"]),
        ("-merge p.ckpt -input good.txt", &["-input"]),
    ] {
        refused(&PROGRAM, &scratch, &line.split_whitespace().collect::<Vec<_>>(), needles);
    }
}

#[test]
fn other_scenes_and_flags_are_not_gone_on_with() {
    let scratch = scratch(b"");
    run(&scratch, "-input good.txt -size 20 10 -spp 4 -checkpoint a.ckpt");
    fs::write(scratch.file("other.txt"), tests::battery::GOOD.replace("radius 1", "radius 1.001")).unwrap();
    let damaged = bytes(&scratch, "a.ckpt");
    fs::write(scratch.file("short.ckpt"), &damaged[..damaged.len() / 2]).unwrap();
    for (flags, needles) in [
        ("-input other.txt -resume a.ckpt", &["a.ckpt", "a scene of fingerprint"][..]),
        ("-input good.txt -resume a.ckpt -zoom 2", &["a scene of fingerprint"]),
        ("-input good.txt -resume a.ckpt -seed 7", &["-seed 0, and here it is 7"]),
        ("-input good.txt -resume a.ckpt -size 10 10", &["-size 20 x 10"]),
        ("-input good.txt -resume a.ckpt -sampler random", &["-sampler sobol"]),
        ("-input good.txt -resume a.ckpt -bounces 2", &["-bounces without limit"]),
        ("-input good.txt -resume a.ckpt -rr_depth 9", &["-rr_depth"]),
        ("-input good.txt -resume a.ckpt -integrator naive", &["-integrator mis"]),
        ("-input good.txt -resume a.ckpt -error 0.1", &["-error none, and here it is 0.1"]),
        ("-input good.txt -resume a.ckpt -aov depth d.pfm", &["-aov none"]),
        ("-input good.txt -resume a.ckpt -crop 0 0 5 5", &["-crop 0 0 20 10"]),
        ("-input good.txt -resume a.ckpt -spp_range 2 9", &["first sample is 0"]),
        ("-input good.txt -resume a.ckpt -spp 3", &["below 4 already"]),
        ("-input good.txt -resume short.ckpt", &["short.ckpt", "at byte", "should have"]),
    ] {
        let line = format!("-size 20 10 -output o.tga {flags}");
        refused(&PROGRAM, &scratch, &line.split_whitespace().collect::<Vec<_>>(), needles);
    }
    run(&scratch, "-input good.txt -size 20 10 -spp 4 -resume a.ckpt -output same.tga");
}

#[test]
fn statistics_tell_of_samples() {
    let scratch = scratch(b"");
    let stats = run(&scratch, "-input good.txt -size 20 10 -spp 9 -stats").stdout;
    assert!(stats.contains("paths: 1800 in 5 passes"), "{stats}");
    assert!(
        stats.contains("samples per pixel: least 9, mean 9.0, most 9; 0 of 200 pixels converged"),
        "{stats}"
    );
    // The first survey comes with 16 samples; whatever they see, an error of 1000 is not theirs.
    let stats = run(&scratch, "-input good.txt -size 20 10 -error 1000 -stats").stdout;
    assert!(stats.contains("least 16, mean 16.0, most 16; 200 of 200 pixels converged"), "{stats}");
}

#[cfg(unix)]
fn send(signal: &str, child: &std::process::Child) {
    let sent = std::process::Command::new("kill").args([signal, &child.id().to_string()]).status();
    assert!(sent.expect("there is a `kill`").success());
}

#[cfg(unix)]
#[test]
fn ctrl_c_keeps_what_is_done() {
    what_is_done_is_kept("-INT");
}

/// As engines send it whose time is over.
#[cfg(unix)]
#[test]
fn sigterm_keeps_what_is_done() {
    what_is_done_is_kept("-TERM");
}

#[cfg(unix)]
fn what_is_done_is_kept(signal: &str) {
    use std::process::Stdio;
    let scratch = scratch(b"");
    let flags = "-input good.txt -size 64 64";
    let line = format!("{flags} -time 600 -output o.exr -checkpoint o.ckpt");
    let args: Vec<&str> = line.split_whitespace().collect();
    let mut command = PROGRAM.command(scratch.path(), &args);
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    let started = Instant::now();
    // The picture is there while rendering goes on.
    while !scratch.file("o.exr").exists() {
        assert!(started.elapsed() < Duration::from_secs(60), "no picture after a minute");
        assert!(child.try_wait().unwrap().is_none(), "it ended by itself");
        std::thread::sleep(Duration::from_millis(20));
    }
    send(signal, &child);
    let outcome = child.wait_with_output().unwrap();
    let stderr = String::from_utf8_lossy(&outcome.stderr);
    assert_eq!(outcome.status.code(), Some(0), "{stderr}");
    let done = checkpoint::read(&scratch.file("o.ckpt")).unwrap().sums.done();
    assert!(stderr.contains(&format!("interrupted: pixels have {done} samples")), "{done}: {stderr}");
    // Just as many at one go.
    run(&scratch, &format!("{flags} -spp {done} -output again.exr -checkpoint again.ckpt"));
    assert!(bytes(&scratch, "again.ckpt") == bytes(&scratch, "o.ckpt"));
    assert!(bytes(&scratch, "again.exr") == bytes(&scratch, "o.exr"));
}

#[test]
fn help_text() {
    let help = accepted(&PROGRAM, &scratch(b""), &["-help"]).stdout;
    insta::assert_snapshot!("help", help);
}

#[test]
fn help_text_of_merging() {
    let help = accepted(&PROGRAM, &scratch(b""), &["-merge", "-help"]).stdout;
    insta::assert_snapshot!("help_merge", help);
}
