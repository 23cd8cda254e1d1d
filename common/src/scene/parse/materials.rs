//! The materials block.
//!
//! ```text
//! Materials {
//!     numMaterials 2
//!     PhongMaterial {                 # `Material` is another name for it
//!         diffuseColor 0.1 0.1 0.1
//!         specularColor 1 1 1   exponent 50
//!         reflectiveColor 0.3 0.3 0.3
//!         transparentColor 0.6 0.6 0.6   indexOfRefraction 1.5
//!         emissiveColor 0 0 0   absorption 0 0 0          # our extensions
//!         ImageTexture { file brick.png  scale 2 2 }
//!     }
//!     Checkerboard { … }              # see textures.rs
//! }
//! ```

use super::Parser;
use crate::scene::diagnostic::Parsed;
use crate::scene::lexer::Token;
use crate::scene::{ImageTexture, Material, PhongMaterial};

const MATERIALS: [&str; 6] = ["Material", "PhongMaterial", "Checkerboard", "Noise", "Marble", "Wood"];

const PHONG_FIELDS: [&str; 9] = [
    "diffuseColor",
    "specularColor",
    "exponent",
    "reflectiveColor",
    "transparentColor",
    "indexOfRefraction",
    "emissiveColor",
    "absorption",
    "ImageTexture",
];

impl<'a> Parser<'a> {
    pub(super) fn materials_block(&mut self, keyword: Token<'a>) -> Parsed<Vec<Material>> {
        let mut block = self.open(keyword)?;
        let mut tally = self.tally(&block, "numMaterials", "material")?;
        let mut materials = Vec::new();
        while let Some(item) = self.item(&mut block, &MATERIALS)? {
            tally.one_more(item.span)?;
            materials.push(match item.text {
                "Material" | "PhongMaterial" => Material::Phong(self.phong(item)?),
                _ => Material::Solid(self.solid_texture(item, materials.len())?),
            });
        }
        tally.finish(block.close)?;
        Ok(materials)
    }

    fn phong(&mut self, keyword: Token<'a>) -> Parsed<PhongMaterial> {
        let mut block = self.open(keyword)?;
        let mut material = PhongMaterial::default();
        while let Some(field) = self.field(&mut block, &PHONG_FIELDS)? {
            self.phong_field(&mut material, field)?;
        }
        Ok(material)
    }

    fn phong_field(&mut self, material: &mut PhongMaterial, field: Token<'a>) -> Parsed<()> {
        match field.text {
            "diffuseColor" => material.diffuse = self.color(field)?,
            "specularColor" => material.specular = self.color(field)?,
            "exponent" => material.exponent = self.not_negative(field)? as f32,
            "reflectiveColor" => material.reflective = self.color(field)?,
            "transparentColor" => material.transparent = self.color(field)?,
            "indexOfRefraction" => material.index_of_refraction = self.positive(field)? as f32,
            "emissiveColor" => material.emissive = self.color(field)?,
            "absorption" => material.absorption = self.color(field)?,
            _ => material.image = Some(self.image_texture(field)?),
        }
        Ok(())
    }

    fn image_texture(&mut self, keyword: Token<'a>) -> Parsed<ImageTexture> {
        let mut block = self.open(keyword)?;
        let (mut file, mut scale) = (None, [1.0, 1.0]);
        while let Some(field) = self.field(&mut block, &["file", "scale"])? {
            match field.text {
                "file" => file = Some(self.picture(field)?),
                _ => scale = self.numbers(field)?.map(|s| s as f32),
            }
        }
        Ok(ImageTexture { file: block.require(file, "file")?, scale, position: keyword.position })
    }
}
