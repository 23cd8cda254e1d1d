//! What is skipped, each with a scene where that matters.

/// A kind of needless work and where it shows.
pub struct Case {
    /// What is not done.
    pub item: &'static str,
    /// What `-noskip` calls it; empty if the work exists nowhere, so that there is no switch.
    pub switch: &'static str,
    /// Which program.
    pub program: &'static str,
    /// The scene: a file of `scenes/`, or its text.
    pub scene: &'static str,
    /// Flags, without `-input`, `-threads` and the picture.
    pub flags: &'static str,
    /// The flag that the picture is given to.
    pub picture: &'static str,
    /// The line of `-stats` that tells how much was done.
    pub counter: &'static str,
}

/// Balls on a floor, two of three lights useless.
const DARK: &str = "
PerspectiveCamera { center 0 1 6 direction 0 0 -1 up 0 1 0 angle 40 }
Background { color 0.1 0.2 0.3 ambientLight 0.1 0.1 0.1 }
Lights { numLights 3
    DirectionalLight { direction 0 0 -1 color 0 0 0 }
    DirectionalLight { direction -1 -2 -1 color 0.7 0.6 0.5 }
    PointLight { position 2 3 4 color 1 1 1 attenuation -1 0 0 } }
Materials { numMaterials 1 PhongMaterial { diffuseColor 1 1 1 } }
Group { numObjects 2 MaterialIndex 0
    Sphere { center 0 1 0 radius 1 }
    Plane { normal 0 1 0 offset 0 } }";

/// Nothing but mirrors under a lamp.
const MIRRORS: &str = "
PerspectiveCamera { center 0 1 6 direction 0 -0.1 -1 up 0 1 0 angle 40 }
Background { color 0.5 0.6 0.7 }
Lights { numLights 1 PointLight { position 2 5 4 color 1 1 1 } }
Materials { numMaterials 1 PhongMaterial { diffuseColor 0 0 0 reflectiveColor 0.9 0.9 0.9 } }
Group { numObjects 3 MaterialIndex 0
    Sphere { center -1 1 0 radius 1 } Sphere { center 1 1 0 radius 1 }
    Plane { normal 0 1 0 offset 0 } }";

/// Eight rabbits of one file, four of them behind the camera.
const COPIES: &str = "
PerspectiveCamera { center 0 1 6 direction 0 -0.1 -1 up 0 1 0 angle 40 }
Lights { numLights 1 DirectionalLight { direction -1 -2 -3 color 0.8 0.8 0.8 } }
Materials { numMaterials 1 PhongMaterial { diffuseColor 0.8 0.7 0.6 } }
Group { numObjects 8 MaterialIndex 0
    Transform { Translate -1.5 0 0 UniformScale 8 TriangleMesh { obj_file MESH } }
    Transform { Translate 0 0 0 UniformScale 8 TriangleMesh { obj_file MESH } }
    Transform { Translate 1.5 0 0 UniformScale 8 TriangleMesh { obj_file MESH } }
    Transform { Translate 0 0 -2 UniformScale 8 TriangleMesh { obj_file MESH } }
    Transform { Translate -1.5 0 20 UniformScale 8 TriangleMesh { obj_file MESH } }
    Transform { Translate 0 0 20 UniformScale 8 TriangleMesh { obj_file MESH } }
    Transform { Translate 1.5 0 20 UniformScale 8 TriangleMesh { obj_file MESH } }
    Transform { Translate 0 0 22 UniformScale 8 TriangleMesh { obj_file MESH } } }";

/// A vase, and a rabbit behind the camera.
const REACHED: &str = "
PerspectiveCamera { center 0 1 6 direction 0 -0.1 -1 up 0 1 0 angle 40 }
Lights { numLights 1 DirectionalLight { direction -1 -2 -3 color 0.8 0.8 0.8 } }
Materials { numMaterials 1 PhongMaterial { diffuseColor 0.8 0.7 0.6 } }
Group { numObjects 2 MaterialIndex 0
    TriangleMesh { obj_file scenes/meshes/vase.obj }
    Transform { Translate 0 0 20 UniformScale 8 TriangleMesh { obj_file MESH } } }";

/// A rabbit behind the camera.
const BEHIND: &str = "
PerspectiveCamera { center 0 1 6 direction 0 0 -1 up 0 1 0 angle 40 }
Materials { numMaterials 1 PhongMaterial { diffuseColor 0.8 0.7 0.6 } }
Group { numObjects 1 MaterialIndex 0
    Transform { Translate 0 0 20 UniformScale 8 TriangleMesh { obj_file MESH } } }";

/// The mesh that MESH stands for.
pub const MESH: &str = "scenes/meshes/bunny_40k.obj";

const BALLS: &str = "scene4_04_reflective_sphere.txt";
const GLASS: &str = "scene4_09_transparent_sphere_2.0.txt";
const GEM: &str = "scene4_14_faceted_gem.txt";

/// A case drawn by assignment 5 with its picture given to `-output`.
const fn plain(
    item: &'static str,
    switch: &'static str,
    scene: &'static str,
    flags: &'static str,
    counter: &'static str,
) -> Case {
    Case { item, switch, program: "a5_grid", scene, flags, picture: "-output", counter }
}

/// The same by another program.
const fn by(program: &'static str, case: Case) -> Case {
    Case { program, ..case }
}

const SHADOW: &str = "num shadow rays";
const RAYS: &str = "num non-shadow rays";
const POINTS: &str = "surface points worked out";
const BUILT: &str = "structures built";

/// All that accuracy.md names, in its order, and what else is skipped.
pub const CASES: [Case; 21] = [
    plain("shadow rays to lights that give nothing", "dark", DARK, "-size 200 200 -shadows", SHADOW),
    plain(
        "shadow rays to lights behind the surface",
        "behind",
        "scene4_02_colored_shadows.txt",
        "-size 200 200 -shadows",
        SHADOW,
    ),
    plain(
        "shadow rays from inside closed bodies",
        "inside",
        GEM,
        "-size 200 200 -shadows -shade_back -bounces 4",
        SHADOW,
    ),
    plain("shadow rays without -shadows", "", "scene4_02_colored_shadows.txt", "-size 200 200", SHADOW),
    by(
        "a8_path_tracing",
        plain(
            "lights chosen for mirrors and glass",
            "specular",
            MIRRORS,
            "-size 64 64 -spp 16",
            "skipped: lights not asked for mirrors and glass",
        ),
    ),
    plain(
        "last rays inside closed bodies",
        "known",
        GEM,
        "-size 200 200 -shadows -shade_back -bounces 4",
        RAYS,
    ),
    plain("secondary rays of black weight", "black", BALLS, "-size 200 200 -shadows -bounces 3", RAYS),
    plain(
        "points and normals of what is not shaded: one for each hit",
        "",
        "scene5_07_bunny_mesh_1k.txt",
        "-size 100 100 -shadows",
        POINTS,
    ),
    by(
        "a1_ray_casting",
        plain("points and normals of flat colours", "surface", BALLS, "-size 400 400", POINTS),
    ),
    plain(
        "points and normals on the way of shadow rays",
        "surface",
        GLASS,
        "-size 200 200 -shadows -transparent_shadows",
        POINTS,
    ),
    by(
        "a6_kdtree",
        plain("trees over a handful of primitives", "handful", BALLS, "-size 200 200 -shadows", BUILT),
    ),
    by("a6_kdtree", plain("trees that no ray asks for", "lazy", BEHIND, "-size 200 200", BUILT)),
    by(
        "a6_kdtree",
        plain(
            "trees of meshes that no ray reaches",
            "lazy",
            REACHED,
            "-size 200 200 -accel instances",
            BUILT,
        ),
    ),
    plain(
        "a grid of hits for a picture of cells",
        "lazy",
        "scene5_09_bunny_mesh_40k.txt",
        "-size 200 200 -grid 40 40 33 -visualize_grid",
        BUILT,
    ),
    by("a6_kdtree", plain("mesh files read again", "shared", COPIES, "-size 200 200", "mesh files read")),
    plain(
        "matrices of spheres under rigid transforms or none",
        "",
        BALLS,
        "-size 200 200",
        "spheres with a matrix",
    ),
    by(
        "a6_kdtree",
        plain(
            "planes in trees: held of two balls and a plane",
            "",
            BALLS,
            "-size 100 100 -kdtree",
            "references",
        ),
    ),
    plain("depth and normals unasked", "pictures", BALLS, "-size 400 400", "pictures rendered"),
    plain("camera rays of tiles that see nothing", "tile", "scene2_09_bunny_200.txt", "-size 200 200", RAYS),
    by(
        "a7_sampling",
        plain(
            "samples of pixels that are good enough, assignment 7",
            "converged",
            BALLS,
            "-size 48 48 -shadows -bounces 2 -adaptive 0.02 -samples 64",
            RAYS,
        ),
    ),
    by(
        "a8_path_tracing",
        plain(
            "samples of pixels that are good enough, assignment 8",
            "converged",
            DARK,
            "-size 32 32 -spp 256 -error 0.03",
            RAYS,
        ),
    ),
];

impl Case {
    /// Whether its scene is a file of `scenes/`.
    pub fn has_file(&self) -> bool {
        self.scene.ends_with(".txt")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::ValueEnum;
    use common::cli::Skip;

    #[test]
    fn every_switch_has_a_case_and_every_case_a_switch() {
        let named = |name: &str| CASES.iter().any(|case| case.switch == name);
        for skip in Skip::value_variants() {
            let value = skip.to_possible_value().expect("none is hidden");
            assert!(named(value.get_name()), "{} is shown nowhere", value.get_name());
        }
        for case in CASES.iter().filter(|case| !case.switch.is_empty()) {
            assert!(Skip::from_str(case.switch, false).is_ok(), "{}", case.switch);
        }
    }
}
