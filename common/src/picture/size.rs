//! The size of a picture, checked once.

use std::fmt;

/// Most pixels that a picture may have: 2²⁸, which is 3 GiB of film.
pub const MAX_PIXELS: u64 = 1 << 28;

/// Width and height in pixels, both at least 1, with at most [`MAX_PIXELS`] in all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    width: u32,
    height: u32,
}

/// Why a width and a height make no picture.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SizeError {
    /// One of the sides is zero or negative.
    #[error("a picture of {width} x {height} pixels has no pixels; both sides must be at least 1")]
    Empty {
        /// The width asked for.
        width: i64,
        /// The height asked for.
        height: i64,
    },
    /// More than [`MAX_PIXELS`].
    #[error(
        "a picture of {width} x {height} pixels is too large; \
         width times height may be at most {MAX_PIXELS} (16384 x 16384)"
    )]
    TooLarge {
        /// The width asked for.
        width: i64,
        /// The height asked for.
        height: i64,
    },
}

impl Size {
    /// Checks a width and a height as a user typed them.
    ///
    /// # Errors
    /// [`SizeError`] if a side is below 1 or there are more than [`MAX_PIXELS`] pixels.
    pub fn new(width: i64, height: i64) -> Result<Self, SizeError> {
        if width < 1 || height < 1 {
            return Err(SizeError::Empty { width, height });
        }
        match (u32::try_from(width), u32::try_from(height)) {
            (Ok(w), Ok(h)) if u64::from(w) * u64::from(h) <= MAX_PIXELS => Ok(Self { width: w, height: h }),
            _ => Err(SizeError::TooLarge { width, height }),
        }
    }

    /// Width in pixels, at least 1.
    pub fn width(self) -> u32 {
        self.width
    }

    /// Height in pixels, at least 1.
    pub fn height(self) -> u32 {
        self.height
    }

    /// Number of pixels, 1 to [`MAX_PIXELS`].
    pub fn pixels(self) -> usize {
        self.width as usize * self.height as usize
    }
}

impl fmt::Display for Size {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} x {}", self.width, self.height)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sides_below_one_are_refused() {
        for (width, height) in [(0, 5), (5, 0), (-5, 5), (5, i64::MIN)] {
            assert_eq!(Size::new(width, height), Err(SizeError::Empty { width, height }));
        }
    }

    #[test]
    fn the_limit_is_on_the_product_and_cannot_overflow() {
        assert_eq!(Size::new(16_384, 16_384).unwrap().pixels() as u64, MAX_PIXELS);
        assert_eq!(Size::new(1, 1 << 28).unwrap().pixels() as u64, MAX_PIXELS);
        for (width, height) in [(16_384, 16_385), (1_000_000_000_000, 1), (i64::MAX, i64::MAX)] {
            assert_eq!(Size::new(width, height), Err(SizeError::TooLarge { width, height }));
        }
    }
}
