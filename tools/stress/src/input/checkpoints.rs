//! Checkpoints of path tracing.

use super::family::{Sample, refusal};
use crate::light::stage::{Stage, scene};
use a8_path_tracing::film::checkpoint::{decode, encode};
use a8_path_tracing::film::{Frame, Identity, Layout, Sums};
use common::picture::Size;

fn small(flags: &str) -> Vec<u8> {
    let camera = "OrthographicCamera { center 0 0 9  direction 0 0 -1  up 0 1 0  size 3 }";
    let text = scene(camera, "0.5 0.5 0.5", &[], &["diffuseColor 1 1 1"], "Sphere { center 0 0 0 radius 1 }");
    let sums = Stage::new(&text, &[], &format!("-size 3 2 -spp 2 {flags}")).sums(1, &[2]).0;
    encode(&Identity::default().with("scene", "a ball").with("seed", 1), &sums)
}

/// Small ones, and headers that promise as many pixels as can be.
pub fn samples() -> Vec<Sample> {
    let mut all = vec![small(""), small("-aov albedo albedo.exr -aov normal normal.exr")];
    let one = Frame::whole(Size::new(1, 1).expect("a size"));
    all.push(encode(&Identity::default(), &Sums::new(one, Layout::default(), 0).expect("a pixel")));
    for side in [1u32 << 14, 65_535, u32::MAX] {
        let mut promise = all[0].clone();
        // After magic and version: size, then crop.
        for (i, word) in [side, side, 0, 0, side, side].into_iter().enumerate() {
            promise[12 + 4 * i..16 + 4 * i].copy_from_slice(&word.to_le_bytes());
        }
        all.push(promise);
    }
    all.into_iter().enumerate().map(|(i, bytes)| Sample { name: format!("{i}.ckpt"), bytes }).collect()
}

/// A checkpoint, or a refusal with a place in the file.
pub fn read(_: &str, bytes: &[u8]) -> Result<(), String> {
    match decode(bytes) {
        Ok(_) => Ok(()),
        Err(fault) if fault.at > bytes.len() => Err(format!("byte {} of {}", fault.at, bytes.len())),
        Err(fault) => refusal(&fault.what),
    }
}
