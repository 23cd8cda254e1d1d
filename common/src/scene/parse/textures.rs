//! Solid textures, materials that blend two earlier ones.
//!
//! ```text
//! Marble {                        # Wood has the same fields
//!     Transform { Scale 2 2 2 }   # optional
//!     materialIndex 0
//!     materialIndex 1
//!     octaves 3                   # Noise has these four; Checkerboard has no octaves
//!     frequency 3
//!     amplitude 4
//! }
//! ```

use super::Parser;
use super::block::Block;
use super::numbers::Count;
use super::xforms::XFORMS;
use crate::scene::diagnostic::{Fault, Parsed};
use crate::scene::lexer::Token;
use crate::scene::{SolidTexture, SolidTextureKind, Xform};

/// Octave k adds detail of relative size 2⁻ᵏ: behind 32 nothing is left of a 32-bit float.
const MOST_OCTAVES: u32 = 32;

#[derive(Default)]
struct Fields {
    transform: Vec<Xform>,
    children: Vec<u32>,
    octaves: Option<u32>,
    frequency: Option<f32>,
    amplitude: Option<f32>,
}

impl<'a> Parser<'a> {
    /// `index` is the texture's own material index.
    pub(super) fn solid_texture(&mut self, keyword: Token<'a>, index: usize) -> Parsed<SolidTexture> {
        let allowed: &[&str] = match keyword.text {
            "Checkerboard" => &["Transform", "materialIndex"],
            "Noise" => &["Transform", "materialIndex", "octaves"],
            _ => &["Transform", "materialIndex", "octaves", "frequency", "amplitude"],
        };
        let mut block = self.open(keyword)?;
        let mut fields = Fields::default();
        while let Some(field) = self.texture_field_name(&mut block, &fields, allowed)? {
            self.texture_field(&mut fields, field, index)?;
        }
        fields.finish(&block)
    }

    /// `materialIndex` is given twice, everything else once.
    fn texture_field_name(
        &mut self,
        block: &mut Block<'a>,
        fields: &Fields,
        allowed: &[&str],
    ) -> Parsed<Option<Token<'a>>> {
        let field = self.item(block, allowed)?;
        match field {
            Some(field) if field.text != "materialIndex" => block.reject_repeated(field)?,
            Some(field) if fields.children.len() == 2 => {
                return Fault::new(field.span, format!("a third material in `{}`", block.keyword.text))
                    .help("a texture blends exactly two materials")
                    .fail();
            }
            _ => {}
        }
        Ok(field)
    }

    fn texture_field(&mut self, fields: &mut Fields, field: Token<'a>, own: usize) -> Parsed<()> {
        match field.text {
            "Transform" => fields.transform = self.texture_transform(field)?,
            "materialIndex" => fields.children.push(self.earlier_material(field, own)?),
            "octaves" => fields.octaves = Some(self.octaves(field)?),
            "frequency" => fields.frequency = Some(self.single(field)?),
            _ => fields.amplitude = Some(self.single(field)?),
        }
        Ok(())
    }

    /// The list is applied to points and never inverted, so that it may be singular: a `Scale
    /// 1 0 1` makes a checkerboard of columns.
    fn texture_transform(&mut self, keyword: Token<'a>) -> Parsed<Vec<Xform>> {
        let mut block = self.open(keyword)?;
        let mut list = Vec::new();
        while let Some(item) = self.item(&mut block, &XFORMS)? {
            list.push(self.xform(item)?);
        }
        Ok(list)
    }

    fn earlier_material(&mut self, field: Token<'a>, own: usize) -> Parsed<u32> {
        let Count { value, span } = self.count(field)?;
        if (value as usize) < own {
            return Ok(value);
        }
        let message = format!("this texture is material {own}, so it cannot blend material {value}");
        Fault::new(span, message).help("a texture blends materials that stand before it in the file").fail()
    }

    fn octaves(&mut self, field: Token<'a>) -> Parsed<u32> {
        let Count { value, span } = self.count(field)?;
        if value <= MOST_OCTAVES {
            return Ok(value);
        }
        let message = format!("`octaves` must be at most {MOST_OCTAVES}, found `{value}`");
        Fault::new(span, message).fail()
    }
}

impl Fields {
    fn finish(self, block: &Block) -> Parsed<SolidTexture> {
        let missing = match self.children.len() {
            0 => "materialIndex",
            _ => "second materialIndex",
        };
        let children = self.children.clone().try_into().ok();
        Ok(SolidTexture {
            children: block.require(children, missing)?,
            kind: self.kind(block)?,
            transform: self.transform,
            position: block.keyword.position,
        })
    }

    fn kind(&self, block: &Block) -> Parsed<SolidTextureKind> {
        let octaves = || block.require(self.octaves, "octaves");
        let frequency = || block.require(self.frequency, "frequency");
        let amplitude = || block.require(self.amplitude, "amplitude");
        Ok(match block.keyword.text {
            "Checkerboard" => SolidTextureKind::Checkerboard,
            "Noise" => SolidTextureKind::Noise { octaves: octaves()? },
            "Marble" => SolidTextureKind::Marble {
                octaves: octaves()?,
                frequency: frequency()?,
                amplitude: amplitude()?,
            },
            _ => SolidTextureKind::Wood {
                octaves: octaves()?,
                frequency: frequency()?,
                amplitude: amplitude()?,
            },
        })
    }
}
