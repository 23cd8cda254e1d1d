//! The lights block.
//!
//! ```text
//! Lights {
//!     numLights 3
//!     DirectionalLight { direction -0.5 -0.5 -1  color 1 1 1 }
//!     PointLight { position 0 5 0  color 1 1 1  attenuation 1 0 0 }
//!     SphereLight { center 0 5 0  radius 1  color 1 1 1 }     # our extension
//! }
//! ```

use super::Parser;
use crate::math::{DVec3, Vec3};
use crate::scene::diagnostic::Parsed;
use crate::scene::lexer::Token;
use crate::scene::{LightKind, LightSpec};

const LIGHTS: [&str; 3] = ["DirectionalLight", "PointLight", "SphereLight"];

#[derive(Default)]
struct Fields {
    color: Option<Vec3>,
    /// `direction`, `position` or `center`.
    place: Option<DVec3>,
    radius: Option<f64>,
    attenuation: Option<[f32; 3]>,
}

impl<'a> Parser<'a> {
    pub(super) fn lights(&mut self, keyword: Token<'a>) -> Parsed<Vec<LightSpec>> {
        let mut block = self.open(keyword)?;
        let mut tally = self.tally(&block, "numLights", "light")?;
        let mut lights = Vec::new();
        while let Some(light) = self.item(&mut block, &LIGHTS)? {
            tally.one_more(light.span)?;
            lights.push(self.light(light)?);
        }
        tally.finish(block.close)?;
        Ok(lights)
    }

    fn light(&mut self, keyword: Token<'a>) -> Parsed<LightSpec> {
        let (place, allowed): (_, &[&str]) = match keyword.text {
            "DirectionalLight" => ("direction", &["direction", "color"]),
            "PointLight" => ("position", &["position", "color", "attenuation"]),
            _ => ("center", &["center", "radius", "color", "attenuation"]),
        };
        let mut block = self.open(keyword)?;
        let mut fields = Fields::default();
        while let Some(field) = self.field(&mut block, allowed)? {
            self.light_field(&mut fields, field)?;
        }
        let place = block.require(fields.place, place)?;
        let attenuation = fields.attenuation.unwrap_or([1.0, 0.0, 0.0]);
        let kind = match keyword.text {
            "DirectionalLight" => LightKind::Directional { direction: place.normalize() },
            "PointLight" => LightKind::Point { position: place, attenuation },
            _ => LightKind::Sphere {
                center: place,
                radius: block.require(fields.radius, "radius")?,
                attenuation,
            },
        };
        Ok(LightSpec { color: block.require(fields.color, "color")?, kind, position: keyword.position })
    }

    fn light_field(&mut self, fields: &mut Fields, field: Token<'a>) -> Parsed<()> {
        match field.text {
            "color" => fields.color = Some(self.color(field)?),
            "direction" => fields.place = Some(self.direction(field)?),
            "radius" => fields.radius = Some(self.positive(field)?),
            "attenuation" => fields.attenuation = Some(self.numbers(field)?.map(|a| a as f32)),
            _ => fields.place = Some(self.vector(field)?),
        }
        Ok(())
    }
}
