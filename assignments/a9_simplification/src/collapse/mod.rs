//! Edge collapse.

mod build;
mod engine;
pub mod knob;
mod memoryless;
mod merge;
mod nearest;
mod refine;
mod quadric;
mod queue;
mod ring;
mod surface;
mod weld;

use common::mesh::Mesh;
use surface::NONE;

pub fn probe(mesh: &Mesh, target: usize) -> Mesh {
    let t = std::time::Instant::now();
    let verbose = std::env::var("VERBOSE").is_ok();
    let welded = weld::weld(&mesh.positions, &mesh.triangles);
    if verbose { eprintln!("weld {:?}", t.elapsed()); }
    let tri = mesh.triangles.iter().map(|t| t.map(|i| welded.point_of[i as usize])).filter(|[a, b, c]| a != b && b != c && c != a);
    let tri: Vec<_> = tri.collect();
    let built = build::build(&welded.places, tri.iter().copied());
    if verbose { eprintln!("build {:?} copies {}", t.elapsed(), built.copies.len()); }
    let cost = memoryless::Memoryless::new(&built.surface);
    let mut engine = engine::Engine::new(built, cost);
    if verbose { eprintln!("priced {:?}", t.elapsed()); }
    let ok = engine.run(target);
    if verbose { eprintln!("run {:?} {ok} {:?}", t.elapsed(), engine.stats); }
    if knob::knob("ROUNDS", 1.0) > 0.0 {
        let mut root = engine.parent.clone();
        for i in 0..root.len() {
            let mut r = i as u32;
            while root[r as usize] != r { r = root[r as usize]; }
            let mut j = i as u32;
            while root[j as usize] != r { let n = root[j as usize]; root[j as usize] = r; j = n; }
        }
        refine::refine(&mut engine.surface, &welded.places, &tri, &root);
        if verbose { eprintln!("refined {:?}", t.elapsed()); }
    }
    let s = &engine.surface;
    let mut map = vec![NONE; s.points.len()];
    let mut out = Mesh::default();
    for f in &s.faces {
        if f.is_gone() { continue }
        out.triangles.push(f.corners().map(|c| {
            if map[c as usize] == NONE {
                map[c as usize] = out.positions.len() as u32;
                out.positions.push(s.points[c as usize].at);
            }
            map[c as usize]
        }));
    }
    out
}
