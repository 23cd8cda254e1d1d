//! Writing checkpoints.

use super::bytes::checksum;
use super::{Checkpoint, MAGIC, STOPPED, VERSION};
use crate::film::{Identity, Sums};
use common::atomic::{self, Unwritable};
use std::path::Path;

/// The bytes of a checkpoint, see [`super`].
pub fn encode(identity: &Identity, sums: &Sums) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(sums.values.len() * 16 + sums.taken.len() * 4 + 1024);
    bytes.extend(MAGIC);
    let (size, crop) = (sums.frame.size, sums.frame.crop);
    let words = [VERSION, size.width(), size.height(), crop.x0, crop.y0, crop.x1, crop.y1];
    let counts = [sums.samples.start, sums.samples.end, sums.layout.bits(), sums.surveyed];
    words.into_iter().chain(counts).for_each(|word| bytes.extend(word.to_le_bytes()));
    bytes.extend((identity.facts.len() as u32).to_le_bytes());
    bytes.extend(sums.dropped.to_le_bytes());
    for text in identity.facts.iter().flat_map(|(name, value)| [name, value]) {
        bytes.extend((text.len() as u32).to_le_bytes());
        bytes.extend(text.as_bytes());
    }
    for (taken, stopped) in sums.taken.iter().zip(&sums.stopped) {
        bytes.extend_from_slice(&(taken | if *stopped { STOPPED } else { 0 }).to_le_bytes());
    }
    sums.values.iter().for_each(|value| bytes.extend_from_slice(&value.to_le_bytes()));
    bytes.extend(checksum(&bytes).to_le_bytes());
    bytes
}

/// Writes a checkpoint; an old file is replaced only by a complete new one.
///
/// # Errors
/// If the system refuses; an old file is then still there.
pub fn write(path: &Path, identity: &Identity, sums: &Sums) -> Result<(), Unwritable> {
    let bytes = encode(identity, sums);
    atomic::replace(path, &bytes).map_err(|source| Unwritable::refused(path, source))
}

impl Checkpoint {
    /// The same as bytes.
    pub fn encode(&self) -> Vec<u8> {
        encode(&self.identity, &self.sums)
    }
}
