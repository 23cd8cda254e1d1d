//! Sums kept in a file, to be gone on with or put together with others.
//!
//! All numbers are little-endian:
//!
//! | bytes | what |
//! |---|---|
//! | 8 | `RAYSTEPS`, then 4: version, 1 |
//! | 8 | width and height of the whole picture |
//! | 16 | the part: x0, y0, x1, y1, upper bounds excluded |
//! | 8 | first sample, one past the last |
//! | 12 | which numbers are kept ([`crate::film::Layout::bits`]), when errors were last looked at, facts |
//! | 8 | samples that were no numbers |
//! | … | every fact of the [`Identity`]: length and text of its name, then of its value |
//! | 4 each | samples that each pixel has, row by row from the bottom; the top bit is set if it is stopped |
//! | 16 each | the sums, pixel by pixel |
//! | 8 | checksum of all before |

mod bytes;
mod read;
mod write;

pub(crate) use bytes::checksum;
pub use read::{CheckpointError, decode, read};
pub use write::{encode, write};

use super::{Identity, Sums};

/// First bytes of a file.
const MAGIC: &[u8; 8] = b"RAYSTEPS";

/// Version of the format.
const VERSION: u32 = 1;

/// Most facts of an identity, and most bytes of one.
const MOST_FACTS: u32 = 256;
const LONGEST_FACT: u32 = 4096;

/// Bit of a pixel's count that tells that it is stopped.
const STOPPED: u32 = 1 << 31;

/// What a file holds.
#[derive(Clone, Debug, PartialEq)]
pub struct Checkpoint {
    /// What it is a rendering of.
    pub identity: Identity,
    /// As far as it has come.
    pub sums: Sums,
}
