//! Ray-traced pictures and their counters do not depend on the number of threads, on the size of
//! tiles, or on the structure.

use super::hash;
use crate::Stress;
use crate::kit::{Named, repository, structures};
use a1_ray_casting::{Layer, Sight};
use a2_transforms::LocalLight;
use a3_phong::Phong;
use a4_whitted::{Rules, Whitted, WhittedColor};
use a5_grid::Fit;
use common::accel::{Accel, List};
use common::camera::{Camera, screen_position};
use common::counters::Counters;
use common::geometry::Geometry;
use common::picture::{Film, Size};
use common::scene::{Scene, load};
use common::tiles::{TileOptions, render};

/// Reflections, refractions and shadows of everything.
const RULES: Rules = Rules {
    shadows: true,
    transparent_shadows: false,
    bounces: 3,
    min_weight: 0.01,
    fresnel: false,
    skip_behind: true,
    skip_dark: true,
    skip_inside: true,
    skip_black: true,
    skip_known: true,
    skip_surface: true,
};

fn picture(scene: &Scene, accel: &dyn Accel, options: &TileOptions) -> (Film, Counters) {
    let size = Size::new(53, 37).expect("a size");
    let camera = Camera::new(&scene.camera);
    let light = LocalLight { scene, shade_back: true };
    let whitted = Whitted { scene, accel, light, phong: Phong::default(), rules: RULES };
    let layer = WhittedColor { whitted };
    let mut rendered = render(
        size,
        1,
        options,
        || (),
        |(), tile, counters: &mut Counters, out| {
            for (x, y) in tile.pixels() {
                let at = screen_position(size, f64::from(x) + 0.5, f64::from(y) + 0.5);
                let ray = camera.ray(at);
                let hit = accel.nearest(&ray, camera.interval, counters);
                out.set(0, x, y, layer.value(&Sight::new(accel.geometry(), ray, hit), counters));
            }
        },
    );
    assert!(rendered.complete);
    (rendered.films.remove(0), rendered.counters)
}

fn bits(film: &Film) -> Vec<u32> {
    (0..37).flat_map(|y| film.row(y).iter().flat_map(|c| c.to_array().map(f32::to_bits))).collect()
}

fn any_threads_and_tiles(name: &str, scene: &Scene, accel: &dyn Accel) -> Vec<u32> {
    let (film, counters) = picture(scene, accel, &TileOptions { threads: Some(1), ..TileOptions::default() });
    let reference = bits(&film);
    for threads in [1, 2, 3, 7, 16] {
        for tile in [None, Some(1), Some(5), Some(16), Some(1000)] {
            let options = TileOptions { threads: Some(threads), tile, ..TileOptions::default() };
            let (film, other) = picture(scene, accel, &options);
            assert_eq!(bits(&film), reference, "{name}: {threads} threads, tiles of {tile:?}");
            assert_eq!(other, counters, "{name}: counters of {threads} threads, tiles of {tile:?}");
        }
    }
    reference
}

/// Pictures of reflections, refractions and shadows: the same bits by any threads, tiles and
/// structure.
pub fn whitted(stress: &Stress) {
    for name in ["scene4_04_reflective_sphere", "scene4_06_transparent_bars", "scene4_14_faceted_gem"] {
        stress.count(format!("p16 pictures of {name}"), || Ok(picture_of(stress, name)));
    }
}

/// Renders a scene every way; returns how many pictures were compared.
fn picture_of(stress: &Stress, name: &str) -> u64 {
    let path = repository().join("scenes").join(format!("{name}.txt"));
    let scene = load(&path).unwrap_or_else(|e| panic!("{e}"));
    let geometry = Geometry::build(&scene).unwrap_or_else(|e| panic!("{name}: {e}"));
    let by_list = any_threads_and_tiles(name, &scene, &List::new(&geometry));
    assert!(by_list.iter().any(|b| *b != by_list[0]), "{name} shows nothing");
    let mut others = structures(&geometry, &[([9, 7, 8], Fit::Exact)]);
    if !stress.tier().is_thorough() {
        // The grid and the hierarchy; what the others hit is asked by property 10.
        others.drain(1..others.len() - 1);
    }
    for Named { name: structure, accel } in &others {
        let others = any_threads_and_tiles(name, &scene, &**accel);
        assert_eq!(others, by_list, "{name}: list and {structure}");
    }
    26 * (1 + others.len() as u64)
}

/// A picture as a number.
pub(super) fn hashed() -> u64 {
    let path = repository().join("scenes/scene4_14_faceted_gem.txt");
    let scene = load(&path).unwrap_or_else(|e| panic!("{e}"));
    let geometry = Geometry::build(&scene).unwrap_or_else(|e| panic!("{e}"));
    hash(bits(&picture(&scene, &List::new(&geometry), &TileOptions::default()).0))
}
