//! The program `a9_simplification`, run as its users run it.

mod shapes;

use a9_simplification::files::{read, write};
use common::math::Vec3;
use common::mesh::Mesh;
use common::picture::{self, Transfer};
use std::fs;
use tests::battery::{GOOD, accepted, refused, scratch};
use tests::binary::{Binary, Outcome, Scratch};

const PROGRAM: Binary = Binary { path: env!("CARGO_BIN_EXE_a9_simplification"), assignment: 9 };

/// A scratch folder with a scene, a cube, an old picture, and a ball of 800 triangles.
fn folder() -> Scratch {
    let scratch = scratch(b"");
    write(&scratch.file("ball.ply"), &shapes::ball(10, 1.0)).unwrap();
    fs::write(scratch.file("bad.obj"), "v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n").unwrap();
    scratch
}

fn run(scratch: &Scratch, line: &str) -> Outcome {
    accepted(&PROGRAM, scratch, &line.split_whitespace().collect::<Vec<_>>())
}

fn faces(scratch: &Scratch, name: &str) -> usize {
    read(&scratch.file(name)).unwrap_or_else(|error| panic!("{error}")).triangles.len()
}

#[test]
fn a9t7_wrong_command_lines_are_refused() {
    for (line, needles) in [
        ("", &["-input"][..]),
        ("-input ball.ply -output o.obj", &["when to stop?", "-ratio R, -faces N, -error E"]),
        ("-input ball.ply -ratio 0.5", &["nothing to do: give -output, -render, -report or -stats"]),
        ("-input ball.ply -output o.obj -ratio 1.5", &["'1.5'", "-ratio", "a share is 0 to 1"]),
        ("-input ball.ply -output o.obj -ratio -0.5", &["a share is 0 to 1"]),
        ("-input ball.ply -output o.obj -ratio nan", &["a share is 0 to 1"]),
        ("-input ball.ply -output o.obj -ratio half", &["'half'", "not a number"]),
        ("-input ball.ply -output o.obj -error -1", &["a distance is at least 0"]),
        ("-input ball.ply -output o.obj -error inf", &["a distance is at least 0"]),
        ("-input ball.ply -output o.obj -faces -3", &["-3", "-faces"]),
        ("-input ball.ply -output o.obj -faces 2.5", &["2.5", "-faces"]),
        ("-input ball.ply -output o.obj -faces 10 -ratio 0.5", &["-faces", "cannot be used with"]),
        ("-input ball.ply -output o.obj -levels 0.5 2", &["'2'", "a share is 0 to 1"]),
        ("-input ball.ply -output o.obj -levels 0.5 0.5", &["two files", "o_0.5.obj"]),
        ("-input ball.ply -output o.obj -ratio 0.5 -method fast", &["'fast'", "qem, memoryless, melax"]),
        ("-input ball.ply -output o.obj -ratio 0.5 -ration 1", &["'-ration'"]),
        ("-input ball.ply -output o.txt -ratio 0.5", &["'o.txt'", ".obj .ply .stl"]),
        ("-input ball.ply -output ball.ply -ratio 0.5", &["ball.ply", "is read"]),
        ("-input ball.ply -output ./ball.ply -ratio 0.5", &["ball.ply", "is read"]),
        ("-input ball.ply -output nowhere/o.obj -ratio 0.5", &["nowhere/o.obj", "no folder"]),
        ("-input ball.ply -report ball.ply -ratio 0.5", &["ball.ply", "is read"]),
        ("-input ball.ply -output o.obj -report ./o.obj -ratio 0.5", &["two files"]),
        ("-input ball.ply -report folder.tga -ratio 0.5", &["folder.tga", "is a folder"]),
        ("-input ball.ply -render o.bmp -ratio 0.5", &["o.bmp", ".tga .png"]),
        ("-input ball.ply -render o.png 0 -ratio 0.5", &["HOTTEST", "not `0`"]),
        ("-input ball.ply -render o.png nan -ratio 0.5", &["HOTTEST", "not `nan`"]),
        ("-input ball.ply -render o.png -size 0 5 -ratio 0.5", &["0 x 5"]),
        ("-input ball.ply -compare cube.obj -output o.obj", &["-compare makes no mesh"]),
        ("-input ball.ply -compare cube.obj", &["nothing to do"]),
        ("-input ball.ply -compare cube.obj -report ./cube.obj", &["is read"]),
        ("-input ball.ply -compare none.obj -stats", &["none.obj: "]),
        ("-input none.ply -output o.obj -ratio 0.5", &["none.ply: "]),
        ("-input bad.obj -output o.obj -ratio 0.5", &["bad.obj:3: `nan`"]),
        ("-input good.txt -output o.tga", &["when to stop?"]),
        ("-input good.txt -output o.tga -levels 0.5 0.1", &["-levels is for a mesh", "taken for a scene"]),
        ("-input good.txt -output o.tga -compare cube.obj", &["-compare is for a mesh"]),
        ("-input good.txt -render o.tga -ratio 0.5", &["-render is for a mesh"]),
        ("-input good.txt -output o.obj -ratio 0.5", &["'o.obj'", ".tga .png"]),
        ("-input good.txt -output good.txt -ratio 0.5", &["good.txt", "is read"]),
        ("-input good.txt -output o.tga -report ./o.tga -ratio 0.5", &["two files"]),
        ("-input good.txt -ratio 0.5", &["nothing to do"]),
        ("-input none.txt -output o.tga -ratio 0.5", &["there is no such scene file"]),
    ] {
        refused(&PROGRAM, &folder(), &line.split_whitespace().collect::<Vec<_>>(), needles);
    }
}

#[test]
fn a9t7_every_goal_is_met_and_every_kind_is_written() {
    let scratch = folder();
    for (flags, most) in [
        ("-ratio 0.25 -output a.obj", 200),
        ("-faces 100 -output a.obj", 100),
        ("-ratio 1 -output a.ply", 800),
        ("-error 0 -output a.ply", 800),
        ("-error 0.02 -output a.stl", 300),
        ("-ratio 0.5 -method qem -output a.obj", 400),
        ("-ratio 0.5 -method melax -output a.obj", 400),
    ] {
        let outcome = run(&scratch, &format!("-input ball.ply {flags}"));
        assert!(outcome.stdout.is_empty() && outcome.stderr.is_empty(), "{flags}: {}", outcome.stderr);
        let left = faces(&scratch, flags.split(' ').next_back().unwrap());
        assert!(left <= most && left >= 4, "{flags}: {left}");
    }
}

/// What cannot be reached is no failure, but is said.
#[test]
fn a9t7_a_goal_out_of_reach_is_warned_of() {
    let scratch = folder();
    let outcome = run(&scratch, "-input ball.ply -faces 0 -output a.obj");
    assert!(outcome.stderr.starts_with("warning: stopped at "), "{}", outcome.stderr);
    assert!(outcome.stderr.contains("no edge is left that may go"), "{}", outcome.stderr);
    assert!(faces(&scratch, "a.obj") >= 4);
}

#[test]
fn a9t7_levels_are_files_of_their_own_from_one_run() {
    let scratch = folder();
    run(&scratch, "-input ball.ply -levels 0.5 0.1 -output a.obj -render p.png -size 20 20 -report r.json");
    assert_eq!([faces(&scratch, "a_0.5.obj"), faces(&scratch, "a_0.1.obj")], [400, 80]);
    for name in ["p_0.5.png", "p_0.1.png"] {
        let film = picture::read(&scratch.file(name), Transfer::Linear).unwrap();
        assert_eq!((film.width(), film.height()), (60, 20));
    }
    let report = fs::read_to_string(scratch.file("r.json")).unwrap();
    assert_eq!(report.matches("\"goal\":{\"ratio\":").count(), 2, "{report}");
    assert_eq!(report.matches('{').count(), report.matches('}').count());
    assert!(!scratch.file("a.obj").exists() && !scratch.file("p.png").exists());
}

#[test]
fn a9t7_reports_say_what_was_measured() {
    let scratch = folder();
    let stats = run(&scratch, "-input ball.ply -ratio 0.25 -stats -report r.txt -samples 5000").stdout;
    let report = fs::read_to_string(scratch.file("r.txt")).unwrap();
    let timeless = |text: &str| text.lines().filter(|l| !l.starts_with("time:")).collect::<String>();
    assert_eq!(timeless(&stats), timeless(&report));
    for needle in [
        "ball.ply, method memoryless",
        "at 5000 points",
        "hausdorff",
        "euler",
        "ratio 0.25 reached",
        "simplify",
    ] {
        assert!(stats.contains(needle), "{needle}\n{stats}");
    }
    assert!(!stats.contains("broken"), "{stats}");
    run(&scratch, "-input ball.ply -ratio 0.25 -report r.JSON");
    let report = fs::read_to_string(scratch.file("r.JSON")).unwrap();
    for needle in
        ["\"faces\":200,", "\"stopped\":\"reached\"", "\"flipped_faces\":0", "\"broken\":[]", "\"rms\":"]
    {
        assert!(report.contains(needle), "{needle}\n{report}");
    }
}

#[test]
fn a9t7_meshes_of_others_are_measured() {
    let scratch = folder();
    let mut torn = shapes::ball(10, 1.0);
    torn.triangles.truncate(700);
    write(&scratch.file("torn.obj"), &torn).unwrap();
    let stats = run(&scratch, "-input ball.ply -compare torn.obj -stats").stdout;
    assert!(stats.contains("700 triangles, as it was given"), "{stats}");
    assert!(stats.contains("broken: Euler characteristic: 2 before, 1 now"), "{stats}");
    let same = run(&scratch, "-input ball.ply -compare ball.ply -stats -render p.png 0.1 -size 9 9 -verbose");
    assert!(same.stderr.contains("black 0, white 1.000e-1 of the diagonal or more"), "{}", same.stderr);
}

/// The picture: what was there, what is there, and black where they are one.
#[test]
fn a9t7_pictures_show_before_and_after_and_where_they_differ() {
    let scratch = folder();
    run(&scratch, "-input ball.ply -compare ball.ply -render p.png -size 40 40");
    let film = picture::read(&scratch.file("p.png"), Transfer::Linear).unwrap();
    let part = |k: u32| -> Vec<_> { (0..1600).map(|i| film.get(40 * k + i % 40, i / 40)).collect() };
    assert!(part(0) == part(1), "before and after are one");
    let background = film.get(0, 0);
    let ball = |k: u32| part(k).iter().filter(|c| **c != background).count();
    assert!(ball(0) > 700 && ball(0) == ball(2), "{} {}", ball(0), ball(2));
    run(&scratch, "-input ball.ply -compare cube.obj -render p.png -size 40 40");
    let film = picture::read(&scratch.file("p.png"), Transfer::Linear).unwrap();
    assert!(film.pixels().iter().any(|c| c.min_element() > 0.99), "white is the largest distance");
}

#[test]
fn a9t7_the_number_of_threads_changes_no_file() {
    let made = |threads: u32| {
        let scratch = folder();
        let flags = format!("-ratio 0.2 -output a.obj -render p.png -size 30 30 -threads {threads}");
        run(&scratch, &format!("-input ball.ply {flags}"));
        (fs::read(scratch.file("a.obj")).unwrap(), fs::read(scratch.file("p.png")).unwrap())
    };
    let one = made(1);
    assert!(made(2) == one && made(5) == one);
}

/// At ratio 1 a scene's picture is that of assignment 6; at less it is another, drawn by the same
/// flags.
#[test]
fn a9t7_scenes_are_drawn_with_fewer_triangles() {
    let scratch = folder();
    let mesh = read(&scratch.file("ball.ply")).unwrap();
    write(&scratch.file("cube.obj"), &mesh).unwrap();
    let flags = "-input good.txt -size 30 20 -shadows -output";
    run(&scratch, &format!("{flags} all.tga -ratio 1"));
    let outcome = run(&scratch, &format!("{flags} few.tga -ratio 0.05 -stats -report r.json"));
    assert!(outcome.stdout.contains("mesh 1: 40 triangles, ratio 0.05 reached"), "{}", outcome.stdout);
    assert!(outcome.stdout.contains("time: simplify"), "{}", outcome.stdout);
    assert!(fs::read_to_string(scratch.file("r.json")).unwrap().starts_with("[{\"input\":\"mesh 1\""));
    let words = format!("a6_kdtree {flags} plain.tga")
        .replace("good.txt", &scratch.file("good.txt").display().to_string());
    let words = words.replace("plain.tga", &scratch.file("plain.tga").display().to_string());
    let parsed = common::cli::try_parse_from::<a6_kdtree::Program>(words.split_whitespace()).unwrap();
    a6_kdtree::run(&parsed.options.args).unwrap();
    let [all, few, plain] = ["all.tga", "few.tga", "plain.tga"].map(|n| fs::read(scratch.file(n)).unwrap());
    assert!(all == plain, "ratio 1 changes the picture");
    assert!(few != plain);
    assert_eq!(GOOD.matches("cube.obj").count(), 1);
}

#[test]
fn a9t7_scenes_without_meshes_are_drawn_with_a_warning() {
    let scratch = folder();
    let text = GOOD.replace("numObjects 3", "numObjects 2");
    let (before, after) = (text.find("    Transform {").unwrap(), text.rfind('}').unwrap());
    fs::write(scratch.file("bare.txt"), text[..before].to_owned() + &text[after..]).unwrap();
    let outcome = run(&scratch, "-input bare.txt -output a.tga -ratio 0.5 -size 9 9");
    assert!(outcome.stderr.contains("warning: there is no mesh in this scene"), "{}", outcome.stderr);
}

/// What is no surface, or hardly one: simplified as far as may be, and told of.
#[test]
fn a9t7_odd_meshes_are_handled() {
    let scratch = folder();
    let (o, x, y, z) = (Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z);
    let mut doubled = shapes::cube();
    doubled.triangles.push(doubled.triangles[0]);
    for (name, mesh, warning) in [
        ("one.obj", shapes::mesh(vec![o, x, y], vec![[0, 1, 2]]), "stopped at 1 triangles"),
        ("book.obj", shapes::mesh(vec![o, z, x, y, -x], vec![[0, 1, 2], [0, 1, 3], [0, 1, 4]]), "no surface"),
        ("tie.obj", shapes::mesh(vec![o, x, x + y, -x, -x - y], vec![[0, 1, 2], [0, 3, 4]]), "no surface"),
        ("doubled.obj", doubled, "1 triangles that are there twice, left out"),
        ("flat.obj", shapes::square(9, 0.0, 0.0), ""),
        ("inverted.obj", shapes::moved(shapes::ball(5, 1.0), |p| -p), ""),
        ("small.obj", shapes::moved(shapes::ball(5, 1.0), |p| p * 1e-18), ""),
        ("far.obj", shapes::moved(shapes::ball(5, 1.0), |p| p + Vec3::splat(1000.0)), ""),
    ] {
        write(&scratch.file(name), &mesh).unwrap();
        for method in ["qem", "memoryless", "melax"] {
            let line = format!("-input {name} -output o.ply -ratio 0.1 -samples 500 -stats -method {method}");
            let outcome = run(&scratch, &line);
            assert!(outcome.stderr.contains(warning), "{line}: {}", outcome.stderr);
            assert!(!outcome.stdout.contains("broken"), "{line}: {}", outcome.stdout);
            assert!(faces(&scratch, "o.ply") >= 1);
        }
    }
}

/// Texture coordinates reach the file: where they are the position, they still are within a quarter
/// of what two vertices were apart.
#[test]
fn a9t7_attributes_have_a_value_for_every_vertex() {
    let scratch = folder();
    let sheet = shapes::square(12, 0.0, 0.0);
    let uvs = sheet.positions.iter().map(|p| common::math::Vec2::new(p.x, p.y)).collect();
    write(&scratch.file("sheet.ply"), &Mesh { uvs, ..sheet }).unwrap();
    run(&scratch, "-input sheet.ply -output o.ply -ratio 0.3");
    let found = read(&scratch.file("o.ply")).unwrap();
    assert_eq!(found.uvs.len(), found.positions.len());
    for (p, uv) in found.positions.iter().zip(&found.uvs) {
        assert!((p.truncate() - *uv).length() < 0.25 / 12.0, "{p} {uv}");
    }
}

#[test]
fn a9t7_help_text() {
    let help = accepted(&PROGRAM, &scratch(b""), &["-help"]).stdout;
    insta::assert_snapshot!("help", help);
}
