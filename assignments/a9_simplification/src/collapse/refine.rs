//! Moves vertices to where the original wants them.

use crate::collapse::knob::knob;
use crate::collapse::nearest::nearest;
use crate::collapse::quadric::Symmetric;
use crate::collapse::surface::{Surface, NONE};
use common::math::{DVec3, Vec3};

pub(super) struct Sample {
    pub at: DVec3,
    pub weight: f64,
    pub face: u32,
    pub bary: [f64; 3],
    pub seed: u32,
}

fn try_fan(s: &Surface, v: u32, p: DVec3, best: &mut (f64, u32, [f64; 3])) {
    for h in s.fan(v) {
        let f = h >> 2;
        let c = s.faces[f as usize].corners();
        let [x, y, z] = c.map(|i| s.at(i));
        let b = nearest(p, x, y, z);
        let d = (x * b[0] + y * b[1] + z * b[2] - p).length_squared();
        if d < best.0 {
            *best = (d, f, b);
        }
    }
}

pub(super) fn locate(s: &Surface, seed: u32, p: DVec3) -> (f64, u32, [f64; 3]) {
    let mut best = (f64::MAX, NONE, [0.0; 3]);
    let mut v = seed;
    let mut seen = [NONE; 4];
    for slot in 0..4 {
        try_fan(s, v, p, &mut best);
        seen[slot] = v;
        let b = best.2;
        let i = if b[0] >= b[1] && b[0] >= b[2] { 0 } else if b[1] >= b[2] { 1 } else { 2 };
        let w = s.faces[best.1 as usize].corners()[i];
        if seen.contains(&w) {
            break;
        }
        v = w;
    }
    best
}

pub(super) fn refine(s: &mut Surface, places: &[Vec3], tris: &[[u32; 3]], root: &[u32]) {
    let rounds = knob("ROUNDS", 1.0) as usize;
    let inner = knob("INNER", 2.0) as usize;
    let relax = knob("RELAX", 1.0);
    let power = knob("POWER", 0.3);
    let tik = knob("RTIK", 1e-3);
    let ftik = knob("FTIK", 0.03);
    let cap = knob("CAP", 100.0);
    let centroids = knob("CENTROIDS", 1.0) > 0.0;
    let verbose = std::env::var("VERBOSE").is_ok();
    let mut area = vec![0f64; places.len()];
    let at = |v: u32| places[v as usize].as_dvec3() * s.scale;
    let mut samples: Vec<Sample> = Vec::new();
    for t in tris {
        let [a, b, c] = t.map(at);
        let w = (b - a).cross(c - a).length();
        for &v in t { area[v as usize] += w; }
        if centroids {
            samples.push(Sample { at: (a + b + c) / 3.0, weight: w * knob("CW", 2.25), face: 0, bary: [0.0; 3], seed: root[t[0] as usize] });
        }
    }
    for v in 0..places.len() as u32 {
        samples.push(Sample { at: at(v), weight: area[v as usize] * if centroids { knob("VW", 0.25) } else { 1.0 }, face: 0, bary: [0.0; 3], seed: root[v as usize] });
    }
    for round in 0..rounds {
        let mut sum = (0.0, 0.0, 0.0f64);
        for x in &mut samples {
            let seed = if round == 0 { x.seed } else {
                let b = x.bary;
                let i = if b[0] >= b[1] && b[0] >= b[2] { 0 } else if b[1] >= b[2] { 1 } else { 2 };
                s.faces[x.face as usize].corners()[i]
            };
            let (d, f, b) = locate(s, seed, x.at);
            x.face = f;
            x.bary = b;
            sum = (sum.0 + d * x.weight, sum.1 + x.weight, sum.2.max(d));
        }
        let rms2 = sum.0 / sum.1;
        if verbose { eprintln!("round {round} rms {} max {}", rms2.sqrt(), sum.2.sqrt()); }
        if std::env::var("NOMOVE").is_ok() { return; }
        for _ in 0..inner {
            let mut q = vec![(Symmetric::default(), DVec3::ZERO); s.points.len()];
            for x in &samples {
                let c = s.faces[x.face as usize].corners();
                let [a, b, d] = c.map(|i| s.at(i));
                let r = x.at - (a * x.bary[0] + b * x.bary[1] + d * x.bary[2]);
                let inside = x.bary.iter().all(|&b| b > 0.0);
                let n = if inside { (b - a).cross(d - a).normalize_or_zero() } else { r.normalize_or_zero() };
                let nr = n.dot(r);
                let w = x.weight * if power > 0.0 { 1.0 + power * (nr * nr / rms2).min(cap) } else { 1.0 };
                let out = Symmetric::outer(n, w);
                for i in 0..3 {
                    let k = x.bary[i];
                    if k > 0.0 {
                        let e = &mut q[c[i] as usize];
                        e.0 += Symmetric(out.0.map(|y| y * k));
                        e.1 += n * (w * nr * k);
                    }
                }
            }
            for v in 0..s.points.len() as u32 {
                if s.points[v as usize].out == NONE || s.on_boundary(v) { continue }
                let (mut m, g) = q[v as usize];
                let t = m.trace();
                if !(t > 0.0) { continue }
                let from = s.at(v);
                let fan: f64 = s.fan(v).map(|h| (s.at(s.end(h)) - from).cross(s.at(s.start(super::surface::previous(h))) - from).length()).sum();
                m.add_diagonal(t * tik + fan * ftik);
                let step = m.solve(g) * relax;
                for k in [1.0, 0.5] {
                    let to = from + step * k;
                    let ok = s.fan(v).all(|h| {
                        let (p, q) = (s.at(s.end(h)), s.at(s.start(super::surface::previous(h))));
                        let (n0, n1) = ((p - from).cross(q - from), (p - to).cross(q - to));
                        let d = n0.dot(n1);
                        d > 0.0 && d * d > 0.25 * n0.length_squared() * n1.length_squared()
                    });
                    if ok {
                        s.points[v as usize].at = s.round(to);
                        break;
                    }
                }
            }
        }
    }
}
