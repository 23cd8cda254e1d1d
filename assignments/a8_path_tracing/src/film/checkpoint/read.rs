//! Reading checkpoints: nothing in a file is believed before it has been checked.

use super::bytes::{Fault, Reader, checksum};
use super::{Checkpoint, LONGEST_FACT, MAGIC, MOST_FACTS, STOPPED, VERSION};
use crate::film::{Frame, Identity, Layout, MAX_SAMPLES, Sums, fixed};
use common::picture::Size;
use common::tiles::Tile;
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// Why a file is no checkpoint.
#[derive(Debug, thiserror::Error)]
pub enum CheckpointError {
    /// The system refused to read it.
    #[error("cannot read checkpoint '{}'", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// It is something else, or damaged.
    #[error("'{}' is not a checkpoint that can be used: at byte {at}, {what}", path.display())]
    Bad {
        /// The file.
        path: PathBuf,
        /// Where, from 0.
        at: usize,
        /// What is wrong there.
        what: String,
    },
}

/// Reads a checkpoint.
///
/// # Errors
/// A file that cannot be read, is no checkpoint, or is damaged.
pub fn read(path: &Path) -> Result<Checkpoint, CheckpointError> {
    let bytes = bytes_of(path).map_err(|source| CheckpointError::Read { path: path.to_owned(), source })?;
    decode(&bytes).map_err(|Fault { at, what }| CheckpointError::Bad { path: path.to_owned(), at, what })
}

/// All of a file that begins as a checkpoint does; of others (`/dev/zero`) only the beginning.
fn bytes_of(path: &Path) -> io::Result<Vec<u8>> {
    let mut file = File::open(path)?;
    let mut bytes = Vec::new();
    (&mut file).take(MAGIC.len() as u64).read_to_end(&mut bytes)?;
    if bytes == MAGIC {
        file.read_to_end(&mut bytes)?;
    }
    Ok(bytes)
}

/// What comes before the sums.
struct Header {
    frame: Frame,
    layout: Layout,
    samples: std::ops::Range<u32>,
    surveyed: u32,
    dropped: u64,
    identity: Identity,
}

/// The checkpoint that these bytes are, as [`super::encode`] makes them.
///
/// # Errors
/// The first byte that cannot be right, and why.
pub fn decode(bytes: &[u8]) -> Result<Checkpoint, Fault> {
    let mut reader = Reader::new(bytes);
    let header = header(&mut reader)?;
    let pixels = header.frame.crop.area();
    // At most 2²⁸ pixels of 13 numbers: no overflow.
    let expected = reader.at as u64 + pixels as u64 * (4 + 16 * header.layout.stride() as u64) + 8;
    if bytes.len() as u64 != expected {
        return Reader::fault(bytes.len(), format!("the file ends, but should have {expected} bytes"));
    }
    let (content, sum) = bytes.split_at(bytes.len() - 8);
    if checksum(content).to_le_bytes() != *sum {
        return Reader::fault(content.len(), "the checksum does not fit: the file is damaged");
    }
    let counts_at = reader.at;
    let counts = reader.take(pixels * 4)?.chunks_exact(4);
    let counts: Vec<u32> =
        counts.map(|word| u32::from_le_bytes(word.try_into().expect("four bytes"))).collect();
    let values = content[reader.at..].chunks_exact(16);
    let sums = Sums {
        frame: header.frame,
        layout: header.layout,
        samples: header.samples,
        dropped: header.dropped,
        surveyed: header.surveyed,
        taken: counts.iter().map(|count| count & !STOPPED).collect(),
        stopped: counts.iter().map(|count| count & STOPPED != 0).collect(),
        values: values.map(|word| i128::from_le_bytes(word.try_into().expect("16 bytes"))).collect(),
    };
    check_counts(&sums, counts_at)?;
    check_values(&sums, reader.at)?;
    Ok(Checkpoint { identity: header.identity, sums })
}

fn header(reader: &mut Reader) -> Result<Header, Fault> {
    if reader.take(MAGIC.len()).ok() != Some(MAGIC) {
        return Reader::fault(0, "it does not begin as a checkpoint does");
    }
    match reader.u32()? {
        VERSION => {}
        other => return Reader::fault(8, format!("version {other} is not known, only {VERSION}")),
    }
    let frame = frame(reader)?;
    let at = reader.at;
    let samples = reader.u32()?..reader.u32()?;
    if samples.start > samples.end || samples.end > MAX_SAMPLES {
        return Reader::fault(at, format!("samples {} to {} cannot be", samples.start, samples.end));
    }
    let at = reader.at;
    let Some(layout) = Layout::of_bits(reader.u32()?) else {
        return Reader::fault(at, "what is kept of a pixel is not known");
    };
    let (looked_at, surveyed) = (reader.at, reader.u32()?);
    let at = reader.at;
    let facts = reader.u32()?;
    if facts > MOST_FACTS {
        return Reader::fault(at, format!("{facts} facts are too many"));
    }
    let dropped = reader.u64()?;
    let mut identity = Identity::default();
    for _ in 0..facts {
        identity.facts.push((reader.text(LONGEST_FACT)?, reader.text(LONGEST_FACT)?));
    }
    let done = samples.end - samples.start;
    if surveyed > done || dropped > frame.crop.area() as u64 * u64::from(done) {
        return Reader::fault(looked_at, "there are fewer samples than were looked at");
    }
    Ok(Header { frame, layout, samples, surveyed, dropped, identity })
}

fn frame(reader: &mut Reader) -> Result<Frame, Fault> {
    let at = reader.at;
    let (width, height) = (reader.u32()?, reader.u32()?);
    let size = Size::new(i64::from(width), i64::from(height))
        .or_else(|error| Reader::fault(at, error.to_string()))?;
    let at = reader.at;
    let crop = Tile { x0: reader.u32()?, y0: reader.u32()?, x1: reader.u32()?, y1: reader.u32()? };
    let inside = crop.x0 < crop.x1 && crop.x1 <= width && crop.y0 < crop.y1 && crop.y1 <= height;
    if !inside {
        return Reader::fault(at, "the part lies outside of the picture");
    }
    Ok(Frame { size, crop })
}

/// Pixels have all samples, unless they are stopped.
fn check_counts(sums: &Sums, at: usize) -> Result<(), Fault> {
    let wrong = |taken: u32, stopped: bool| if stopped { taken > sums.done() } else { taken != sums.done() };
    let mut counts = sums.taken.iter().zip(&sums.stopped);
    match counts.position(|(taken, stopped)| wrong(*taken, *stopped)) {
        Some(number) => Reader::fault(at + 4 * number, "a pixel has another number of samples"),
        None => Ok(()),
    }
}

/// No sum is larger than its samples can make it; so further ones cannot overflow.
fn check_values(sums: &Sums, at: usize) -> Result<(), Fault> {
    let most = i128::from(sums.done()) << (fixed::FRACTION_BITS + 31);
    match sums.values.iter().position(|value| value.unsigned_abs() > most.unsigned_abs()) {
        Some(number) => Reader::fault(at + 16 * number, "a sum is larger than its samples can be"),
        None => Ok(()),
    }
}
