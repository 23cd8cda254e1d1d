//! The heat picture against the counters of `-stats`.

use crate::{args, file, number, picture, printed, studio};
use a1_ray_casting::{FlatColor, Layer, Studio};
use a4_whitted::WhittedColor;
use a6_kdtree::AccelArgs;
use a6_kdtree::picture::{Heat, heat_color};
use common::camera::screen_position;
use common::counters::Counters;
use common::math::Vec3;
use common::picture::Film;

const STRUCTURES: [&str; 6] =
    ["-accel list", "-grid 7 8 9", "-kdtree median", "-kdtree objects", "-kdtree sah", "-accel bvh"];

/// The colour picture, the work of every pixel, and what was counted in all.
fn work(studio: &Studio, args: &AccelArgs) -> (Film, Film, Counters) {
    let cells = args.grid.cells(studio).unwrap();
    let tracer = args.structure(&studio.geometry, cells).unwrap();
    let whitted = args.grid.whitted.whitted(&studio.scene, tracer.as_accel());
    let layers: [&dyn Layer; 2] = [&WhittedColor { whitted }, &Heat::default()];
    let (mut films, counters) = studio.render(args.cast(), tracer.as_accel(), &layers);
    let heat = films.pop().unwrap();
    (films.pop().unwrap(), heat, counters)
}

fn sum(heat: &Film) -> u64 {
    heat.pixels().iter().map(|p| Heat::work(*p)).sum()
}

#[test]
fn a6t5_the_pixels_add_up_to_the_statistics() {
    for name in ["scene4_06_transparent_bars.txt", "scene5_07_bunny_mesh_1k.txt", "scene5_04_plane_test.txt"]
    {
        let studio = studio(name, 50, 40);
        for structure in STRUCTURES {
            for flags in ["", "-shadows -bounces 3 -threads 1", "-shadows -threads 3 -tile 5 -noskip tile"] {
                let (_, heat, counters) = work(&studio, &args(&format!("{structure} {flags}")));
                assert!(counters.intersections > 0);
                assert_eq!(sum(&heat), counters.cells + counters.intersections, "{name} {structure} {flags}");
            }
        }
    }
}

/// Without shadows and bounces a pixel costs what its own ray costs, asked apart from the others.
#[test]
fn a6t5_a_pixel_costs_what_its_ray_costs() {
    let studio = studio("scene5_07_bunny_mesh_1k.txt", 60, 60);
    for structure in STRUCTURES {
        let args = args(&format!("{structure} -noskip tile"));
        let cells = args.grid.cells(&studio).unwrap();
        let tracer = args.structure(&studio.geometry, cells).unwrap();
        let accel = tracer.as_accel();
        let layers: [&dyn Layer; 2] = [&FlatColor::new(&studio.scene), &Heat::default()];
        let (films, _) = studio.render(args.cast(), accel, &layers);
        let mut costs = Vec::new();
        for (x, y) in (0..60).flat_map(|y| (0..60).map(move |x| (x, y))) {
            let at = screen_position(studio.size, f64::from(x) + 0.5, f64::from(y) + 0.5);
            let mut c = Counters::default();
            accel.nearest(&studio.camera.ray(at), studio.camera.interval, &mut c);
            assert_eq!(Heat::work(films[1].get(x, y)), c.cells + c.intersections, "{structure} {x} {y}");
            costs.push(c.cells + c.intersections);
        }
        let same = costs.iter().all(|c| *c == costs[0]);
        assert_eq!(same, structure == "-accel list", "only the list asks as much of every ray");
    }
}

#[test]
fn a6t5_the_heat_picture_changes_no_other() {
    let folder = tempfile::tempdir().unwrap();
    let scene = file("scene5_07_bunny_mesh_1k.txt");
    let all = format!("-input {} -size 60 60 -shadows -kdtree -stats", scene.display());
    let with = printed(folder.path(), &format!("{all} -output @/with.pfm -normals @/n.pfm -heat @/h.png"));
    let without = printed(folder.path(), &format!("{all} -output @/without.pfm -normals @/m.pfm"));
    assert_eq!(picture(folder.path(), "with.pfm"), picture(folder.path(), "without.pfm"));
    assert_eq!(picture(folder.path(), "n.pfm"), picture(folder.path(), "m.pfm"));
    for name in ["num non-shadow rays", "num shadow rays", "total intersections", "total cells traversed"] {
        assert_eq!(number(&with, name), number(&without, name), "{name}");
    }
    let work = number(&with, "total intersections") + number(&with, "total cells traversed");
    assert_eq!(number(&with, "all pixels"), work);
    assert_eq!(number(&with, "white is"), number(&with, "or more; most"));
}

/// The written colours are those of the counts, on the scale that was asked for.
#[test]
fn a6t5_the_scale_is_what_it_says() {
    let folder = tempfile::tempdir().unwrap();
    let name = "scene5_07_bunny_mesh_1k.txt";
    let flags = "-accel bvh -shadows -size 60 60";
    let (_, counts, _) = work(&studio(name, 60, 60), &args(flags));
    let most = counts.pixels().iter().map(|p| Heat::work(*p)).max().unwrap();
    for hottest in [None, Some(1), Some(most / 2), Some(1000 * most)] {
        let scale = hottest.map(|n| n.to_string()).unwrap_or_default();
        // A heat picture alone is a task, of the colour picture's rays.
        printed(folder.path(), &format!("-input {} {flags} -heat @/heat.pfm {scale}", file(name).display()));
        let heat = picture(folder.path(), "heat.pfm");
        for (pixel, count) in heat.pixels().iter().zip(counts.pixels()) {
            let work = Heat::work(*count);
            assert_eq!(*pixel, heat_color(work, hottest.unwrap_or(most)));
            assert_eq!(*pixel == Vec3::ZERO, work == 0);
            assert_eq!(*pixel == Vec3::ONE, work >= hottest.unwrap_or(most));
        }
    }
}

/// The work on pictures of structures is shown, too.
#[test]
fn a6t5_heat_of_boxes_and_cells() {
    let folder = tempfile::tempdir().unwrap();
    let all = format!("-input {} -size 40 40 -stats", file("scene5_06_bunny_mesh_200.txt").display());
    for flags in ["-visualize_kdtree", "-visualize_grid -grid 9 9 9"] {
        let stats = printed(folder.path(), &format!("{all} -output @/o.png -heat @/h.png {flags}"));
        assert!(number(&stats, "all pixels") > 0.0);
        assert_eq!(number(&stats, "all pixels"), number(&stats, "total cells traversed"), "{flags}");
        assert!(folder.path().join("h.png").exists());
        std::fs::remove_file(folder.path().join("h.png")).unwrap();
    }
}
