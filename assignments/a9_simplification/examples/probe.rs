use common::math::Vec3;
use common::mesh::Mesh;
use std::io::Write;

fn cpu() -> f64 {
    let s = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap();
    s.split(' ').next().unwrap().parse::<f64>().unwrap() * 1e-9
}
pub fn load(path: &str) -> Mesh {
    if path.ends_with(".raw") {
        let b = std::fs::read(path).unwrap();
        let i = |k: usize| i32::from_le_bytes(b[k..k + 4].try_into().unwrap()) as usize;
        let (nv, nf) = (i(0), i(4));
        let f = |k: usize| f64::from_le_bytes(b[8 + 8 * k..16 + 8 * k].try_into().unwrap()) as f32;
        Mesh {
            positions: (0..nv).map(|v| Vec3::new(f(3 * v), f(3 * v + 1), f(3 * v + 2))).collect(),
            triangles: (0..nf).map(|t| [0, 1, 2].map(|c| i(8 + 24 * nv + 4 * (3 * t + c)) as u32)).collect(),
            ..Mesh::default()
        }
    } else if path.ends_with(".obj") {
        common::mesh::read_obj(std::path::Path::new(path)).unwrap()
    } else {
        let g = path.parse::<modeller::generated::Recipe>().unwrap().make();
        Mesh {
            positions: g.positions.into_iter().map(Vec3::from_array).collect(),
            triangles: g.triangles,
            ..Mesh::default()
        }
    }
}
fn save(path: &str, m: &Mesh) {
    let mut b = Vec::new();
    for n in [m.positions.len(), m.triangles.len()] {
        b.extend((n as i32).to_le_bytes());
    }
    for p in &m.positions {
        for c in p.to_array() {
            b.extend((c as f64).to_le_bytes());
        }
    }
    for t in &m.triangles {
        for &c in t {
            b.extend((c as i32).to_le_bytes());
        }
    }
    std::fs::File::create(path).unwrap().write_all(&b).unwrap();
}
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let m = load(&a[1]);
    if a[2] == "save" {
        save(&a[3], &m);
        return;
    }
    let ratio: f64 = a[2].parse().unwrap();
    let reps: usize = a.get(4).map_or(1, |s| s.parse().unwrap());
    let method = match std::env::var("M").as_deref() {
        Ok("qem") => a9_simplification::Method::Qem,
        Ok("melax") => a9_simplification::Method::Melax,
        _ => a9_simplification::Method::Memoryless,
    };
    let goal = if ratio < 0.0 {
        a9_simplification::Goal::Error(-ratio)
    } else {
        a9_simplification::Goal::Ratio(ratio)
    };
    let hwm = || {
        std::fs::read_to_string("/proc/self/status")
            .unwrap()
            .lines()
            .find(|l| l.starts_with("VmHWM"))
            .unwrap()
            .split_whitespace()
            .nth(1)
            .unwrap()
            .parse::<f64>()
            .unwrap()
            * 1024.0
    };
    let rss = std::fs::read_to_string("/proc/self/status")
        .unwrap()
        .lines()
        .find(|l| l.starts_with("VmRSS"))
        .unwrap()
        .split_whitespace()
        .nth(1)
        .unwrap()
        .parse::<f64>()
        .unwrap()
        * 1024.0;
    let mut best = f64::MAX;
    let mut out = None;
    for _ in 0..reps {
        let t = cpu();
        out = a9_simplification::simplify(
            &m,
            &[goal],
            &a9_simplification::Settings { method, bound: std::env::var("B").is_ok() },
        )
        .unwrap()
        .pop();
        best = best.min(cpu() - t);
    }
    let out = out.unwrap();
    println!("bytes/triangle {:.0}", (hwm() - rss) / m.triangles.len() as f64);
    save(&a[3], &out.mesh);
    let b = common::math::Bounds::of_points(m.positions.iter().copied());
    println!(
        "{} {} -> {} cpu {:.4} error {:.2} {:?} {:?}",
        a[1],
        m.triangles.len(),
        out.mesh.triangles.len(),
        best,
        out.error.unwrap_or(0.0) / b.size().as_dvec3().length() * 1e4,
        out.stopped,
        out.irregular
    );
}
