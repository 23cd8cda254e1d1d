//! Pictures of extended lights and lenses against what optics says they are.

mod stage;

use common::math::Vec3;
use stage::picture;
use std::f64::consts::PI;

/// Greatest difference relative to what is expected, over the channels.
fn relative(found: Vec3, expected: Vec3) -> f32 {
    ((found - expected).abs() / expected.abs().max(Vec3::splat(1e-6))).max_element()
}

/// A floor, seen from one unit above, and what hangs over it.
fn floor(lights: &str, objects: &str, count: u32) -> String {
    format!(
        "PerspectiveCamera {{ center 0 1 0 direction 0 -1 0 up 0 0 1 angle 60 }}
         Background {{ color 0 0 0 ambientLight 0 0 0 }}
         {lights}
         Materials {{ numMaterials 2
            Material {{ diffuseColor 0.5 0.5 0.5 }}
            Material {{ diffuseColor 0 0 0 emissiveColor 3 2 1 }} }}
         Group {{ numObjects {count}
            MaterialIndex 0 Plane {{ normal 0 1 0 offset 0 }}
            {objects} }}"
    )
}

/// Where the centre of column `i` of `n` looks at the floor; positive to the right.
fn place(i: u32, n: u32) -> f64 {
    2.0 * 30f64.to_radians().tan() * ((f64::from(i) + 0.5) / f64::from(n) - 0.5)
}

/// The part of a disc on one side of a line, which passes its centre at `offset` radii.
fn segment(offset: f64) -> f64 {
    let x = offset.clamp(-1.0, 1.0);
    (x.acos() - x * (1.0 - x * x).sqrt()) / PI
}

/// Half of the sky is covered above the eye: on the floor the light sphere rises behind the edge.
/// How much of it is seen from a point is the part of a disc cut by a line.
#[test]
fn a7t5_penumbra_is_the_visible_part_of_the_sphere() {
    let (radius, height, edge) = (0.3, 10.0, 5.0);
    let light =
        format!("Lights {{ numLights 1 SphereLight {{ center 0 {height} 0 radius {radius} color 1 1 1 }} }}");
    // To the right is −x for this camera, so the cover is on the right.
    let cover = format!(
        "Triangle {{ vertex0 0 {edge} -99 vertex1 0 {edge} 99 vertex2 -99 {edge} -99 }}
         Triangle {{ vertex0 -99 {edge} -99 vertex1 0 {edge} 99 vertex2 -99 {edge} 99 }}"
    );
    let scene = floor(&light, &cover, 3);
    for flags in ["-jittered_samples 16 -light_samples 16", "-sampler sobol -samples 32 -light_samples 8"] {
        let film = picture(&scene, &format!("-size 96 3 -shadows {flags}"));
        let (mut worst, mut sum, mut partly) = (0.0f64, 0.0, 0);
        for i in 0..96 {
            let x = -place(i, 96);
            let (to_edge, to_light) = ((x / edge).atan(), (x / height).atan());
            let cosine = to_light.cos();
            let sine = radius * cosine / height;
            let visible = 1.0 - segment((to_edge - to_light).sin() / sine);
            partly += u32::from(visible > 0.01 && visible < 0.99);
            let off = f64::from(film.get(i, 1).x) - 0.5 * cosine * visible;
            worst = worst.max(off.abs());
            sum += off;
        }
        assert!(partly > 30, "only {partly} pixels lie in the penumbra");
        assert!(worst < 0.02 && (sum / 96.0).abs() < 0.001, "{flags}: worst {worst}, mean {}", sum / 96.0);
    }
}

/// Unblocked, a sphere of radiance L at distance d gives a matt floor kd·L·(r/d)²·cos θ, a square
/// what its form factor says.
#[test]
fn a7t5_shining_shapes_give_what_their_form_factors_say() {
    let sphere = floor("", "MaterialIndex 1 Sphere { center 0 5 0 radius 1 }", 2);
    let film = picture(&sphere, "-size 33 3 -shadows -sampler sobol -samples 64 -light_samples 4");
    for i in 0..33 {
        let distance_squared = 25.0 + place(i, 33).powi(2);
        let expected = 0.5 / distance_squared * (5.0 / distance_squared.sqrt());
        let expected = Vec3::new(3.0, 2.0, 1.0) * expected as f32;
        assert!(relative(film.get(i, 1), expected) < 0.01, "{i}: {} {expected}", film.get(i, 1));
    }
    // A square of side 4 at height 3, facing down.
    let square = "MaterialIndex 1
        Triangle { vertex0 -2 3 -2 vertex1 2 3 -2 vertex2 2 3 2 }
        Triangle { vertex0 -2 3 -2 vertex1 2 3 2 vertex2 -2 3 2 }";
    let a: f64 = 2.0 / 3.0;
    let slant = (1.0 + a * a).sqrt();
    let form_factor = 4.0 / PI * (a / slant) * (a / slant).atan();
    let film =
        picture(&floor("", square, 3), "-size 33 33 -shadows -sampler sobol -samples 64 -light_samples 16");
    let expected = Vec3::new(3.0, 2.0, 1.0) * (0.5 * form_factor) as f32;
    let found = film.get(16, 16);
    assert!(relative(found, expected) < 0.01, "{found} {expected}");
    // From behind it gives nothing.
    let turned = square.replace("vertex1", "v").replace("vertex2", "vertex1").replace(" v ", " vertex2 ");
    let film = picture(&floor("", &turned, 3), "-size 9 9 -shadows -samples 16");
    assert_eq!(film.get(4, 4), Vec3::ZERO);
}

/// A ball out of focus is spread over a disc (or a polygon) of the thin lens's radius: the second
/// moment of its picture tells.
#[test]
fn a7t4_blur_has_the_radius_of_the_thin_lens_equation() {
    let scene = |lens: &str, depth: f64| {
        format!(
            "PerspectiveCamera {{ center 0 0 0 direction 0 0 -1 up 0 1 0 angle 40 {lens} }}
             Background {{ color 0 0 0 }}
             Materials {{ numMaterials 1 Material {{ diffuseColor 1 1 1 }} }}
             Group {{ numObjects 1 MaterialIndex 0 Sphere {{ center 0 0 -{depth} radius 0.2 }} }}"
        )
    };
    let (aperture, focus, n) = (0.5, 8.0, 101u32);
    for (blades, moment_of_shape) in [("", 0.5), ("blades 5", (2.0 + (2.0 * PI / 5.0).cos()) / 6.0)] {
        let lens = format!("aperture {aperture} focalDistance {focus} {blades}");
        for depth in [4.0, 8.0, 16.0] {
            let film = picture(&scene(&lens, depth), &format!("-size {n} {n} -sampler sobol -samples 256"));
            let (mut light, mut moment) = (0.0, 0.0);
            for (x, y) in (0..n).flat_map(|y| (0..n).map(move |x| (x, y))) {
                let center = f64::from(n) / 2.0;
                let (dx, dy) = (f64::from(x) + 0.5 - center, f64::from(y) + 0.5 - center);
                let value = f64::from(film.get(x, y).x);
                light += value;
                moment += value * (dx * dx + dy * dy);
            }
            let pixel = |length: f64, at: f64| length * f64::from(n) / (2.0 * at * 20f64.to_radians().tan());
            let blur = pixel(aperture / 2.0 * (depth - focus).abs() / depth, focus);
            // The ball's own disc, the blur, and the pixels, which are squares.
            let own = pixel(0.2, depth);
            let expected = own * own / 2.0 + blur * blur * moment_of_shape + 1.0 / 6.0;
            let off = (moment / light / expected - 1.0).abs();
            assert!(off < 0.02, "{blades} at {depth}: {} {expected}", moment / light);
        }
    }
}

/// Far away a light sphere is a point light; `-hard_lights` makes it one anywhere.
#[test]
fn a7t5_small_light_spheres_are_point_lights() {
    let block = "Triangle { vertex0 0 5 -99 vertex1 0 5 99 vertex2 -99 5 -99 }";
    let scene = |light: &str| floor(&format!("Lights {{ numLights 1 {light} }}"), block, 2);
    let flags = "-size 40 40 -shadows -uniform_samples 4";
    let attenuation = "attenuation 0.5 0.1 0";
    let point =
        picture(&scene(&format!("PointLight {{ position 0.2 8 0 color 1 1 1 {attenuation} }}")), flags);
    let sphere = scene(&format!("SphereLight {{ center 0.2 8 0 radius 0.7 color 1 1 1 {attenuation} }}"));
    assert_eq!(picture(&sphere, &format!("{flags} -hard_lights")), point);
    let tiny = scene(&format!("SphereLight {{ center 0.2 8 0 radius 0.0001 color 1 1 1 {attenuation} }}"));
    let found = picture(&tiny, flags);
    let differing =
        found.pixels().iter().zip(point.pixels()).filter(|(a, b)| relative(**a, **b) > 1e-3).count();
    assert!(differing < 8, "{differing}");
    let soft = picture(&sphere, flags);
    let differing =
        soft.pixels().iter().zip(point.pixels()).filter(|(a, b)| relative(**a, **b) > 1e-2).count();
    assert!(differing > 100, "{differing}");
}
