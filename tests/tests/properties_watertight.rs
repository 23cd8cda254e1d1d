//! accuracy.md, properties 1 and 2: no ray slips through a closed mesh, at any place and size,
//! through any structure, with any instructions.

use a5_grid::{Cells, Fit, Grid};
use a6_kdtree::bvh::Bvh;
use a6_kdtree::kdtree::{KdTree, Options};
use common::accel::{Accel, Job, List};
use common::counters::Counters;
use common::geometry::{Geometry, Hit};
use common::math::{Bounds, DVec3, Interval, Vec3};
use common::ray::Ray;
use common::shape::filter::Filter;
use common::shape::triangle_block::{LANES, TriangleBlock};
use common::shape::{ExactRay, triangle};
use common::simd::{Level, Simd, dispatch};
use tests::property::{
    Draw, Placement, aim, build, closed_meshes, exact_triangle, fan, file_mesh, geometry_of, inside_points,
    lattice_sphere, lumpy_sphere, placed, ray_bits, run, simd_levels, triangle_bits,
};

/// Cells for about one triangle each.
fn grid(geometry: &Geometry) -> Grid<'_> {
    let side = (geometry.len() as f64).cbrt().ceil().clamp(1.0, 40.0) as u32 + 1;
    let bounds = geometry.bounds().expect("a finite mesh");
    Grid::new(geometry, Cells::new([side; 3], &bounds), Fit::Exact).expect("a grid of moderate size")
}

/// A ray from inside hits in front.
fn must_hit(accel: &dyn Accel, ray: &Ray) -> Result<f64, String> {
    let hit = accel.nearest(ray, Interval::FORWARD, &mut Counters::default());
    if hit.is_some() { Ok(0.0) } else { Err(explain(accel.geometry().triangles(), ray)) }
}

/// Rays from inside that are asked together hit in front.
fn must_hit_together(accel: &dyn Accel, rays: &[Ray]) -> Result<f64, String> {
    let mut hits = vec![None; rays.len()];
    accel.nearest_many(rays, Interval::FORWARD, &mut hits, &mut Counters::default());
    match hits.iter().position(Option::is_none) {
        None => Ok(0.0),
        Some(lost) => Err(explain(accel.geometry().triangles(), &rays[lost])),
    }
}

/// A ray that was lost, and the triangles that exact arithmetic says it passes.
fn explain(triangles: &[[Vec3; 3]], ray: &Ray) -> String {
    let passed = triangles.iter().filter(|t| exact_triangle(ray, t).is_some_and(|h| h.t > 0.0));
    let listed: Vec<String> = passed.map(triangle_bits).collect();
    format!("{}\nexactly hit: {}", ray_bits(ray), listed.join("\n"))
}

fn from_inside(draw: &mut Draw, triangles: &[[Vec3; 3]], inside: &[Vec3]) -> Ray {
    let origin = draw.pick(inside);
    aim(draw, triangles, origin)
}

#[test]
fn p01_ten_million_rays_from_inside_all_hit_through_the_grid() {
    let meshes = closed_meshes();
    let share = 10_000_000 / meshes.len() as u64;
    for (name, mesh) in &meshes {
        let place = placed(mesh, 1.0, DVec3::ZERO, (40_000 / mesh.triangles.len()).clamp(4, 64));
        assert!(place.inside.len() >= 4, "{name}: no point inside");
        let geometry = geometry_of(&place.triangles);
        let grid = grid(&geometry);
        run(&format!("p01 grid, {name}"), 101, share, |draw| {
            must_hit(&grid, &from_inside(draw, &place.triangles, &place.inside))
        });
    }
}

/// Half through the kd-tree, half through the hierarchy; there eight at a time, which
/// `must_hit_together` asks for.
#[test]
fn p01_ten_million_rays_from_inside_all_hit_through_the_trees() {
    let meshes = closed_meshes();
    let share = 5_000_000 / meshes.len() as u64;
    for (name, mesh) in &meshes {
        let place = placed(mesh, 1.0, DVec3::ZERO, (40_000 / mesh.triangles.len()).clamp(4, 64));
        let geometry = geometry_of(&place.triangles);
        let (tree, bvh) = (KdTree::new(&geometry, Options::default()), Bvh::new(&geometry));
        run(&format!("p01 kd-tree, {name}"), 103, share, |draw| {
            must_hit(&tree, &from_inside(draw, &place.triangles, &place.inside))
        });
        run(&format!("p01 hierarchy, {name}"), 104, share / 8, |draw| {
            let first = from_inside(draw, &place.triangles, &place.inside);
            let bundled = draw.chance(0.5);
            let rays = [(); 8].map(|()| match bundled {
                true => Ray::new(first.origin, first.direction + (draw.cube() * 0.02).as_vec3()),
                false => from_inside(draw, &place.triangles, &place.inside),
            });
            must_hit_together(&bvh, &rays)
        });
    }
}

#[test]
fn p01_rays_from_inside_all_hit_through_the_list() {
    for (name, mesh) in closed_meshes() {
        let place = placed(&mesh, 1.0, DVec3::ZERO, (40_000 / mesh.triangles.len()).clamp(4, 64));
        let geometry = geometry_of(&place.triangles);
        let list = List::new(&geometry);
        let trials = (50_000_000 / mesh.triangles.len() as u64).clamp(1000, 100_000);
        run(&format!("p01 list, {name}"), 102, trials, |draw| {
            must_hit(&list, &from_inside(draw, &place.triangles, &place.inside))
        });
    }
}

/// Triangles in blocks with what the filter needs.
struct Blocks {
    triangles: Vec<[Vec3; 3]>,
    blocks: Vec<TriangleBlock>,
    bounds: Bounds,
}

impl Blocks {
    fn new(triangles: &[[Vec3; 3]]) -> Self {
        let numbered: Vec<_> = (0u32..).zip(triangles.iter().copied()).collect();
        Self {
            triangles: triangles.to_vec(),
            blocks: numbered.chunks(LANES).map(|c| TriangleBlock::pack(c.iter().copied())).collect(),
            bounds: Bounds::of_points(triangles.iter().flatten().copied()),
        }
    }

    /// How often the line of the ray passes the mesh behind and before its origin.
    fn passages(&self, level: Option<Level>, ray: &Ray) -> [u32; 2] {
        let exact = ExactRay::new(ray);
        let mut passages = [0; 2];
        let mut count = |t: f32| passages[usize::from(t > 0.0)] += 1;
        let Some(level) = level else {
            let hits = self.triangles.iter().filter_map(|t| triangle::intersect(&exact, t));
            hits.for_each(|h| count(h.t));
            return passages;
        };
        let filter = Filter::new(ray, &self.bounds);
        for block in &self.blocks {
            let lanes = dispatch!(level, s => candidates(s, block, &filter));
            let kept = (0..LANES).filter(|lane| lanes >> lane & 1 == 1);
            kept.filter_map(|lane| triangle::intersect(&exact, &block.vertices(lane)))
                .for_each(|h| count(h.t));
        }
        passages
    }

    fn nearest(&self, level: Level, ray: &Ray) -> Option<Hit> {
        let filter = Filter::new(ray, &self.bounds);
        let job = Job { filter: &filter, ray, interval: Interval::FORWARD };
        dispatch!(level, s => job.nearest(s, &self.blocks, None, &mut Counters::default()))
    }
}

#[inline(always)]
fn candidates<S: Simd>(simd: S, block: &TriangleBlock, filter: &Filter) -> u32 {
    block.judge(simd, filter, Interval::ALL).possible
}

/// The scalar kernel and every instruction set.
fn kernels() -> Vec<Option<Level>> {
    simd_levels().into_iter().map(|(_, level)| Some(level)).chain([None]).collect()
}

#[test]
fn p01_a_million_whole_lines_pass_an_odd_number_of_times_each_way() {
    let small = [
        ("cube", file_mesh("cube.obj")),
        ("diamond", file_mesh("diamond.obj")),
        ("bunny_200", file_mesh("bunny_200.obj")),
        ("lumpy sphere", lumpy_sphere(2, 4)),
        ("lattice sphere", lattice_sphere(2, 2)),
        ("split square fans", fan(32, 3)),
    ];
    let share = 1_000_000u64.div_ceil(small.len() as u64);
    for (name, mesh) in &small {
        odd_passages(&format!("p01 parity, {name}"), &placed(mesh, 1.0, DVec3::ZERO, 64), share);
    }
}

fn odd_passages(name: &str, place: &Placement, trials: u64) {
    let (blocks, kernels) = (Blocks::new(&place.triangles), kernels());
    run(name, 103, trials, |draw| {
        let ray = from_inside(draw, &place.triangles, &place.inside);
        let passages = blocks.passages(draw.pick(&kernels), &ray);
        match passages.iter().all(|n| n % 2 == 1) {
            true => Ok(f64::from(passages[1])),
            false => Err(format!("{passages:?} passages\n{}", explain(&place.triangles, &ray))),
        }
    });
}

/// Scale and offset of property 2. The last ones leave a mesh of a few dozen units on a lattice
/// as coarse as 1/64 or 1: corners collapse, the mesh stays closed.
fn placements() -> Vec<(f64, DVec3)> {
    let far = DVec3::new(148_376.0, 1234.0, -223_423.0);
    let scales = [2f64.powi(-60), 2f64.powi(60), 1e-6, 1e-3, 1e3, 1e6];
    let mut all: Vec<_> = scales.iter().map(|&s| (s, DVec3::ZERO)).collect();
    all.extend([1.0, 16.0, 1000.0].map(|s| (s, far)));
    all.extend([(1000.0, DVec3::splat(1e7)), (30.0, DVec3::new(-1e7, 1e7, 3.0)), (1e5, DVec3::X * 1e7)]);
    all.extend([(1e-6, DVec3::new(0.5, 0.25, -0.5) * 1e-4), (1e6, far * 10.0)]);
    all
}

#[test]
fn p02_placed_meshes_have_no_leak_through_any_structure() {
    let meshes = [
        ("lumpy sphere", lumpy_sphere(2, 4)),
        ("lattice sphere", lattice_sphere(2, 2)),
        ("diamond", file_mesh("diamond.obj")),
        ("split square fans", fan(16, 3)),
        ("bunny_200", file_mesh("bunny_200.obj")),
    ];
    for (name, mesh) in &meshes {
        for (scale, offset) in placements() {
            let place = placed(mesh, scale, offset, 32);
            assert!(place.inside.len() >= 4, "{name} × {scale:e} + {offset}: no point inside");
            let geometry = geometry_of(&place.triangles);
            let (list, grid) = (List::new(&geometry), grid(&geometry));
            let (tree, bvh) = (KdTree::new(&geometry, Options::default()), Bvh::new(&geometry));
            let label = format!("{name} × {scale:.1e} + {offset:.0}");
            run(&format!("p02 hits, {label}"), 201, 6_000, |draw| {
                let ray = from_inside(draw, &place.triangles, &place.inside);
                must_hit(&list, &ray)
                    .and(must_hit(&grid, &ray))
                    .and(must_hit(&tree, &ray))
                    .and(must_hit(&bvh, &ray))
            });
            odd_passages(&format!("p02 parity, {label}"), &place, 3_000);
        }
    }
}

/// The filter may keep what it likes, but the nearest hit has the scalar kernel's bits.
#[test]
fn p02_every_instruction_set_finds_the_scalar_hit() {
    let levels = simd_levels();
    assert!(!levels.is_empty());
    // A lattice: half of the rays meet a corner or an edge exactly.
    let mesh = lattice_sphere(2, 2);
    for (scale, offset) in placements() {
        let place = placed(&mesh, scale, offset, 32);
        let blocks = Blocks::new(&place.triangles);
        run(&format!("p02 levels, × {scale:.1e} + {offset:.0}"), 202, 4_000, |draw| {
            let ray = from_inside(draw, &place.triangles, &place.inside);
            let exact = ExactRay::new(&ray);
            let mut best: Option<Hit> = None;
            for (i, t) in (0u32..).zip(&place.triangles) {
                let hit = common::geometry::hit_triangle(t, i, &exact, Interval::FORWARD);
                best = hit.filter(|h| h.precedes(best.as_ref())).or(best);
            }
            match levels.iter().find(|(_, level)| blocks.nearest(*level, &ray) != best) {
                None => Ok(0.0),
                Some((name, _)) => Err(format!("{name} differs from {best:?}\n{}", ray_bits(&ray))),
            }
        });
    }
}

#[test]
fn p02_no_leak_under_nested_transforms() {
    let around = "Transform { Translate 3 -7 11 Rotate { 1 2 3 40 }
        Transform { Scale 2 -0.5 1 ZRotate 33 Group { numObjects 1
        Transform { Matrix { 1 0.5 0 0  0 1 0.25 0  0.125 0 1 0  0 0 0 1 } UniformScale 0.01
        TriangleMesh { obj_file it } } } } }";
    for (name, mesh) in
        [("lumpy", lumpy_sphere(3, 5)), ("fans", fan(64, 6)), ("diamond", file_mesh("diamond.obj"))]
    {
        let geometry = build(around, mesh);
        let inside = inside_points(geometry.triangles(), 32, 12);
        assert!(inside.len() >= 8, "{name}: no point inside");
        let (list, grid) = (List::new(&geometry), grid(&geometry));
        let (tree, bvh) = (KdTree::new(&geometry, Options::default()), Bvh::new(&geometry));
        run(&format!("p02 nested transforms, {name}"), 203, 60_000, |draw| {
            let ray = from_inside(draw, geometry.triangles(), &inside);
            must_hit(&list, &ray)
                .and(must_hit(&grid, &ray))
                .and(must_hit(&tree, &ray))
                .and(must_hit(&bvh, &ray))
        });
    }
}
