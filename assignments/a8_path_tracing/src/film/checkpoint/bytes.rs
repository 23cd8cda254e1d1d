//! Numbers as bytes, and the checksum.

use a7_sampling::sampler::hash::mix;

/// A number for bytes that any change of up to eight bytes in a row changes for certain: every
/// step is one-to-one, both in the bytes and in what came before.
pub fn checksum(bytes: &[u8]) -> u64 {
    let mut words = bytes.chunks_exact(8);
    let mut sum = mix(bytes.len() as u64);
    for word in &mut words {
        let word = u64::from_le_bytes(word.try_into().expect("eight bytes"));
        sum = mix(sum.rotate_left(1) ^ word);
    }
    let mut last = [0; 8];
    last[..words.remainder().len()].copy_from_slice(words.remainder());
    mix(sum.rotate_left(1) ^ u64::from_le_bytes(last))
}

/// Reads numbers one after the other.
pub struct Reader<'a> {
    bytes: &'a [u8],
    /// Where the next number begins.
    pub at: usize,
}

/// Where and why there is no number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// Byte from the beginning of the file.
    pub at: usize,
    /// What is wrong there.
    pub what: String,
}

impl<'a> Reader<'a> {
    /// Begins at the first byte.
    pub fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0 }
    }

    /// What is wrong with what begins at a byte.
    pub fn fault<T>(at: usize, what: impl Into<String>) -> Result<T, Fault> {
        Err(Fault { at, what: what.into() })
    }

    /// The next bytes.
    pub fn take(&mut self, count: usize) -> Result<&'a [u8], Fault> {
        let rest = &self.bytes[self.at..];
        if rest.len() < count {
            return Self::fault(self.bytes.len(), "the file ends in the middle of its header");
        }
        self.at += count;
        Ok(&rest[..count])
    }

    /// The next number of 32 bits.
    pub fn u32(&mut self) -> Result<u32, Fault> {
        Ok(u32::from_le_bytes(self.take(4)?.try_into().expect("four bytes")))
    }

    /// The next number of 64 bits.
    pub fn u64(&mut self) -> Result<u64, Fault> {
        Ok(u64::from_le_bytes(self.take(8)?.try_into().expect("eight bytes")))
    }

    /// The next text, its length before it.
    pub fn text(&mut self, longest: u32) -> Result<String, Fault> {
        let at = self.at;
        let len = self.u32()?;
        if len > longest {
            return Self::fault(at, format!("a text of {len} bytes is too long"));
        }
        let bytes = self.take(len as usize)?;
        String::from_utf8(bytes.to_vec()).or_else(|_| Self::fault(at, "a text is not UTF-8"))
    }
}
