//! Textures and smooth normals for every input: shares are shares, and numbers stay numbers.

use a1_ray_casting::World;
use a6_kdtree::texture::{Image, Pattern, TexturedScene, noise};
use common::geometry::{Geometry, Surface, hit_triangle};
use common::math::{DMat4, DVec3, Interval, Vec2, Vec3};
use common::mesh::Mesh;
use common::picture::{Film, Size};
use common::ray::Ray;
use common::scene::{Material, PhongMaterial, Position, Scene, SolidTexture, SolidTextureKind, Xform};
use common::shape::ExactRay;
use proptest::prelude::*;
use std::path::Path;
use stress::kit::scene_of;

/// Any finite number: half of them of sizes that scenes have.
fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![-100.0..100.0f64, any::<i16>().prop_map(f64::from), finite()]
}

fn finite() -> impl Strategy<Value = f64> {
    any::<f64>().prop_filter("a finite number", |x| x.is_finite())
}

fn point() -> impl Strategy<Value = DVec3> {
    [coordinate(), coordinate(), coordinate()].prop_map(DVec3::from_array)
}

/// What the parser lets through: up to 32 octaves, any numbers that single precision has.
fn kind() -> impl Strategy<Value = SolidTextureKind> {
    let single = || prop_oneof![-10.0..10.0f32, any::<f32>().prop_filter("finite", |x| x.is_finite())];
    (0..4, 0..=32u32, single(), single()).prop_map(|(kind, octaves, frequency, amplitude)| match kind {
        0 => SolidTextureKind::Checkerboard,
        1 => SolidTextureKind::Noise { octaves },
        2 => SolidTextureKind::Marble { octaves, frequency, amplitude },
        _ => SolidTextureKind::Wood { octaves, frequency, amplitude },
    })
}

fn transform() -> impl Strategy<Value = Vec<Xform>> {
    let xform = prop_oneof![
        point().prop_map(Xform::Translate),
        point().prop_map(Xform::Scale),
        (-360.0..360.0f64).prop_map(|degrees| Xform::Rotate(DVec3::new(1.0, 2.0, 3.0), degrees)),
    ];
    proptest::collection::vec(xform, 0..4)
}

/// A texture that blends two of the `below` materials before it.
fn texture(below: usize) -> impl Strategy<Value = SolidTexture> {
    let position = Position { line: 1, column: 1 };
    (kind(), transform(), [0..below as u32, 0..below as u32])
        .prop_map(move |(kind, transform, children)| SolidTexture { kind, transform, children, position })
}

/// Three plain materials and as many textures as fit.
fn materials() -> impl Strategy<Value = Vec<Material>> {
    let plain = |level| PhongMaterial { diffuse: Vec3::splat(level), ..PhongMaterial::default() };
    let textures: Vec<_> = (3..12).map(texture).collect();
    textures.prop_map(move |textures| {
        let plain = [0.0, 0.5, 1.0].map(|level| Material::Phong(plain(level)));
        plain.into_iter().chain(textures.into_iter().map(Material::Solid)).collect()
    })
}

fn somewhere(point: DVec3, material: u32) -> Surface {
    let (normal, geometric_normal) = (Vec3::Y, DVec3::Y);
    let (error, primitive, weights) = (DVec3::ZERO, 0, [0.0; 2]);
    Surface { point, error, normal, geometric_normal, material, primitive, weights }
}

/// One triangle with normals and texture coordinates at its corners.
fn triangle() -> impl Strategy<Value = Mesh> {
    let vectors = || [-1.0..1.0f32, -1.0..1.0f32, -1.0..1.0f32].prop_map(Vec3::from_array);
    let normals = prop_oneof![vectors(), Just(Vec3::ZERO), Just(Vec3::X), Just(-Vec3::X)];
    let corners = proptest::collection::vec((vectors(), normals, vectors()), 3);
    corners.prop_map(|corners| Mesh {
        positions: corners.iter().map(|c| c.0).collect(),
        triangles: vec![[0, 1, 2]],
        normals: corners.iter().map(|c| c.1).collect(),
        uvs: corners.iter().map(|c| Vec2::new(c.2.x, c.2.y)).collect(),
        degenerate: 0,
    })
}

/// A scene without objects, whose materials are these.
fn scene_with(materials: Vec<Material>) -> Scene {
    Scene { materials, ..scene_of("Sphere { center 0 0 0 radius 1 }", Mesh::default()) }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_pattern_is_a_share_everywhere(texture in texture(1), point in point()) {
        let value = Pattern::new(&texture).value(point);
        prop_assert!((0.0..=1.0).contains(&value), "{value}");
        if texture.kind == SolidTextureKind::Checkerboard {
            prop_assert!(value == 0.0 || value == 1.0);
        }
    }

    #[test]
    fn the_weights_of_nested_blends_sum_to_one(materials in materials(), point in point()) {
        let scene = scene_with(materials);
        let geometry = Geometry::default();
        let textured = TexturedScene::load(&scene, &geometry, Path::new("none")).unwrap();
        for material in 0..scene.materials.len() as u32 {
            let mixture = textured.at(&somewhere(point, material));
            let weights: Vec<f32> = mixture.parts().map(|(weight, _)| weight).collect();
            prop_assert!(weights.iter().all(|w| 0.0 < *w && *w <= 1.0), "{weights:?}");
            prop_assert!((weights.iter().sum::<f32>() - 1.0).abs() < 1e-6, "{weights:?}");
            prop_assert!(weights.len() <= 3, "each plain material comes up once");
            let color = mixture.blend(|m| m.diffuse).x;
            prop_assert!((0.0..=1.000_001).contains(&color), "{color}");
        }
    }

    #[test]
    fn noise_is_bounded_and_zero_on_the_lattice(point in point()) {
        prop_assert!(noise(point).abs() < 1.04);
        prop_assert_eq!(noise(point.floor()), 0.0);
    }

    /// The colour never leaves the range of the picture's own, and a whole picture further it is
    /// the same.
    #[test]
    fn pictures_have_a_color_for_every_coordinate(
        levels in proptest::collection::vec(0.0..1.0f32, 12),
        (w, shift) in (1..=6u32, any::<i8>()),
        (u, v) in (coordinate(), coordinate()),
    ) {
        let size = Size::new(w.into(), 2).unwrap();
        let film = Film::from_fn(size, |x, y| Vec3::splat(levels[(x + 6 * y) as usize]));
        let shown = film.pixels().iter().map(|c| c.x);
        let (low, high) = shown.fold((1.0f32, 0.0f32), |(l, h), x| (l.min(x), h.max(x)));
        let image = Image::new(film);
        let color = image.at(u, v).x;
        prop_assert!(low - 1e-6 <= color && color <= high + 1e-6, "{color} of {low}…{high}");
        if u.abs() < 1000.0 {
            prop_assert!((image.at(u + f64::from(shift), v).x - color).abs() < 1e-4);
        }
    }

    /// Unit length, and whoever sees the front of the triangle sees the front of the normal.
    #[test]
    fn smooth_normals_face_whoever_the_triangle_faces(
        mesh in triangle(),
        (a, b) in (0.0..1.0f32, 0.0..1.0f32),
        from in [-2.0..2.0f32, -2.0..2.0f32, -2.0..2.0f32],
        scale in [0.01..10.0f64, -10.0..-0.01f64, 0.01..10.0f64],
    ) {
        let [sx, sy, sz] = scale;
        let object = format!("Transform {{ Scale {sx} {sy} {sz} TriangleMesh {{ obj_file it smooth 1 }} }}");
        let scene = scene_of(&object, mesh.clone());
        let geometry = Geometry::build(&scene).unwrap();
        let [p, q, r] = geometry.triangles()[0];
        let target = p + ((q - p) * a + (r - p) * (1.0 - a)) * b;
        let ray = Ray::new(Vec3::from_array(from), target - Vec3::from_array(from));
        let hit = hit_triangle(&geometry.triangles()[0], 0, &ExactRay::new(&ray), Interval::FORWARD);
        if let Some(hit) = hit {
            let seen = geometry.surface(&ray, &hit);
            let (smooth, flat) =
                (seen.normal.dot(ray.direction), seen.geometric_normal.dot(ray.direction.as_dvec3()));
            prop_assert!((seen.normal.length() - 1.0).abs() < 1e-5, "{}", seen.normal);
            prop_assert_eq!(smooth > 0.0, flat > 0.0, "{} {}", smooth, flat);
            prop_assert!(geometry.uv(&seen).iter().all(|c| *c == 0.0), "no picture, no coordinates");
        }
    }

    /// A matrix takes its place in the list like any other transform, unless it cannot hold the
    /// product.
    #[test]
    fn a_pattern_goes_with_the_product_of_its_list(list in transform(), kind in kind(), point in point()) {
        let product = list.iter().fold(DMat4::IDENTITY, |m, x| m * x.matrix());
        prop_assume!(product.is_finite());
        let position = Position { line: 1, column: 1 };
        let of = |transform| Pattern::new(&SolidTexture { kind, transform, children: [0; 2], position });
        prop_assert_eq!(of(list).value(point), of(vec![Xform::Matrix(product)]).value(point));
    }
}
