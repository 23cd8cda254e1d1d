//! A6T5: pictures of structures and of the work they do.
//!
//! [`BoxPicture`] shows the boxes of a kd-tree's leaves, [`Heat`] what every pixel costs with
//! whatever structure is in use.

mod boxes;
mod heat;

pub use boxes::{BoxPicture, Entered, first_box};
pub use heat::{Heat, heat_color};
