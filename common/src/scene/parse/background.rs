//! The background block.
//!
//! ```text
//! Background {
//!     color 0.2 0 0.6            # default 0.5 0.5 0.5
//!     ambientLight 0.1 0.1 0.1   # default 0 0 0, or 1 1 1 in a file without lights
//!     environment sky.hdr        # our extension
//! }
//! ```

use super::Parser;
use crate::math::Vec3;
use crate::scene::Background;
use crate::scene::diagnostic::{Fault, Parsed};
use crate::scene::lexer::Token;
use std::path::PathBuf;

/// The fields given; what is missing depends on whether lights follow.
#[derive(Default)]
pub(super) struct BackgroundFields {
    color: Option<Vec3>,
    ambient_light: Option<Vec3>,
    environment: Option<PathBuf>,
}

impl BackgroundFields {
    /// Fills in the defaults, once it is known whether the file has lights.
    pub fn with_defaults(self, no_lights: bool) -> Background {
        let ambient = if no_lights { Vec3::ONE } else { Vec3::ZERO };
        Background {
            color: self.color.unwrap_or(Vec3::splat(0.5)),
            ambient_light: self.ambient_light.unwrap_or(ambient),
            environment: self.environment,
        }
    }
}

impl<'a> Parser<'a> {
    pub(super) fn background(&mut self, keyword: Token<'a>) -> Parsed<BackgroundFields> {
        let mut block = self.open(keyword)?;
        let mut fields = BackgroundFields::default();
        while let Some(field) = self.field(&mut block, &["color", "ambientLight", "environment"])? {
            match field.text {
                "color" => fields.color = Some(self.color(field)?),
                "ambientLight" => fields.ambient_light = Some(self.color(field)?),
                _ => fields.environment = Some(self.picture(field)?),
            }
        }
        Ok(fields)
    }

    /// A picture file name, resolved to the file it stands for.
    pub(super) fn picture(&mut self, field: Token<'a>) -> Parsed<PathBuf> {
        let name = self.name(field)?;
        self.source.picture(name.text).map_err(|message| Box::new(Fault::new(name.span, message)))
    }
}
