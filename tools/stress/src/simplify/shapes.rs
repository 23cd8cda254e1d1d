//! Meshes that are no surface, each with what must be said of it.

use crate::kit::convex_sphere;
use common::math::Vec3;
use common::mesh::Mesh;
use std::f32::consts::TAU;

/// Two meshes in one, sharing no numbers.
fn both(a: &Mesh, b: &Mesh) -> Mesh {
    let first = a.positions.len() as u32;
    let mut all = a.clone();
    all.positions.extend(&b.positions);
    all.triangles.extend(b.triangles.iter().map(|t| t.map(|i| i + first)));
    all
}

/// Two balls that have one corner in common: a bow-tie.
fn bow_tie() -> Mesh {
    let ball = convex_sphere(3);
    let corner = ball.positions[ball.triangles[0][0] as usize];
    let mut other = ball.clone();
    other.positions.iter_mut().for_each(|p| *p = corner * 2.0 - *p);
    other.triangles.iter_mut().for_each(|t| t.swap(1, 2));
    both(&ball, &other)
}

/// A ball with a third triangle at one of its edges.
fn fin() -> Mesh {
    let mut ball = convex_sphere(3);
    let [a, b, _] = ball.triangles[0];
    let tip = (ball.positions[a as usize] + ball.positions[b as usize]) * 1.5;
    ball.positions.push(tip);
    ball.triangles.push([a, b, ball.positions.len() as u32 - 1]);
    ball
}

/// A strip that is joined to itself after half a turn.
fn mobius() -> Mesh {
    const LENGTH: u32 = 60;
    const WIDTH: u32 = 6;
    let place = |i: u32, j: u32| {
        // The last column is the first one upside down, to the bit.
        let (i, j) = if i == LENGTH { (0, WIDTH - j) } else { (i, j) };
        let (around, aside) = (TAU * i as f32 / LENGTH as f32, j as f32 / WIDTH as f32 - 0.5);
        let (sine, cosine) = (around / 2.0).sin_cos();
        let r = 2.0 + aside * cosine;
        Vec3::new(around.cos() * r, around.sin() * r, aside * sine)
    };
    let columns = WIDTH + 1;
    let positions = (0..=LENGTH).flat_map(|i| (0..columns).map(move |j| place(i, j))).collect();
    let square = |i: u32, j: u32| {
        let a = i * columns + j;
        [[a, a + columns, a + columns + 1], [a, a + columns + 1, a + 1]]
    };
    let triangles = (0..LENGTH).flat_map(|i| (0..WIDTH).flat_map(move |j| square(i, j))).collect();
    Mesh { positions, triangles, ..Mesh::default() }
}

/// A ball of which every other triangle shows its back.
fn inverted() -> Mesh {
    let mut ball = convex_sphere(3);
    ball.triangles.iter_mut().step_by(2).for_each(|t| t.swap(0, 1));
    ball
}

/// Meshes with points that must be held where they are.
pub fn irregular() -> Vec<(&'static str, Mesh)> {
    vec![("bow-tie", bow_tie()), ("fin", fin()), ("Möbius", mobius()), ("inverted", inverted())]
}
