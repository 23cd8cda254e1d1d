//! The camera block.
//!
//! ```text
//! PerspectiveCamera {
//!     center 0 0 10
//!     direction 0 0 -1
//!     up 0 1 0
//!     angle 30            # degrees; an OrthographicCamera has `size` instead
//!     aperture 0.5        # our extensions: thin lens
//!     focalDistance 10
//!     blades 6            # its aperture a hexagon; round if not given
//!     screen curved       # and screen
//! }
//! ```

use super::Parser;
use super::block::{Block, found};
use crate::math::DVec3;
use crate::scene::diagnostic::{Fault, Parsed};
use crate::scene::lexer::Token;
use crate::scene::suggest::nearest;
use crate::scene::{CameraKind, CameraSpec, Lens, Screen};

/// Sine of the angle up to which `up` counts as parallel to `direction`: only what rounding
/// does to vectors that were meant to be parallel.
const PARALLEL: f64 = 1e-12;

#[derive(Default)]
struct Fields {
    center: Option<DVec3>,
    direction: Option<DVec3>,
    up: Option<DVec3>,
    size: Option<f64>,
    angle: Option<f64>,
    aperture: Option<f64>,
    focal_distance: Option<f64>,
    blades: Option<u32>,
    screen: Screen,
}

impl<'a> Parser<'a> {
    pub(super) fn camera(&mut self, keyword: Token<'a>) -> Parsed<CameraSpec> {
        let extent = match keyword.text {
            "OrthographicCamera" => "size",
            _ => "angle",
        };
        let allowed = ["center", "direction", "up", extent, "aperture", "focalDistance", "blades", "screen"];
        let mut block = self.open(keyword)?;
        let mut fields = Fields::default();
        while let Some(field) = self.field(&mut block, &allowed)? {
            self.camera_field(&mut fields, field)?;
        }
        fields.finish(&block)
    }

    fn camera_field(&mut self, fields: &mut Fields, field: Token<'a>) -> Parsed<()> {
        match field.text {
            "center" => fields.center = Some(self.vector(field)?),
            "direction" => fields.direction = Some(self.direction(field)?),
            "up" => fields.up = Some(self.direction(field)?),
            "size" => fields.size = Some(self.positive(field)?),
            "angle" => fields.angle = Some(self.field_of_view(field)?),
            "aperture" => fields.aperture = Some(self.not_negative(field)?),
            "focalDistance" => fields.focal_distance = Some(self.positive(field)?),
            "blades" => fields.blades = Some(self.blades(field)?),
            _ => fields.screen = self.screen()?,
        }
        Ok(())
    }

    fn blades(&mut self, field: Token<'a>) -> Parsed<u32> {
        let whole = |n: f64| n.fract() == 0.0 && (3.0..=100.0).contains(&n);
        Ok(self.bounded(field, "a whole number from 3 to 100", whole)? as u32)
    }

    fn field_of_view(&mut self, field: Token<'a>) -> Parsed<f64> {
        self.bounded(field, "between 0 and 180 degrees (both excluded)", |angle| {
            angle as f32 > 0.0 && (angle as f32) < 180.0
        })
    }

    fn screen(&mut self) -> Parsed<Screen> {
        let token = self.lexer.next();
        match token.text {
            "flat" => Ok(Screen::Flat),
            "curved" => Ok(Screen::Curved),
            other => {
                let message = format!("expected `flat` or `curved` for `screen`, found {}", found(token));
                let help = nearest(other, ["flat", "curved"]);
                Fault::new(token.span, message)
                    .help_if_any(help.map(|name| format!("did you mean `{name}`?")))
                    .fail()
            }
        }
    }
}

impl Fields {
    fn finish(self, block: &Block) -> Parsed<CameraSpec> {
        let center = block.require(self.center, "center")?;
        let direction = block.require(self.direction, "direction")?;
        let up = block.require(self.up, "up")?;
        reject_parallel(block, direction, up)?;
        self.reject_curved_box(block)?;
        Ok(CameraSpec {
            center,
            direction,
            up,
            kind: self.kind(block)?,
            lens: self.lens(block)?,
            screen: self.screen,
            position: block.keyword.position,
        })
    }

    /// Equal angles per pixel make no sense where all rays are parallel.
    fn reject_curved_box(&self, block: &Block) -> Parsed<()> {
        if self.screen == Screen::Flat || block.keyword.text != "OrthographicCamera" {
            return Ok(());
        }
        let span = block.place_of("screen").unwrap_or(block.close);
        Fault::new(span, "an orthographic camera has no curved screen: its rays are parallel").fail()
    }

    fn kind(&self, block: &Block) -> Parsed<CameraKind> {
        Ok(match block.keyword.text {
            "OrthographicCamera" => CameraKind::Orthographic { size: block.require(self.size, "size")? },
            _ => CameraKind::Perspective { angle: block.require(self.angle, "angle")? },
        })
    }

    /// Aperture and distance or none of the lens.
    fn lens(&self, block: &Block) -> Parsed<Option<Lens>> {
        if self.aperture.is_none() && self.focal_distance.is_none() && self.blades.is_none() {
            return Ok(None);
        }
        Ok(Some(Lens {
            aperture: block.require(self.aperture, "aperture")?,
            focal_distance: block.require(self.focal_distance, "focalDistance")?,
            blades: self.blades,
        }))
    }
}

fn reject_parallel(block: &Block, direction: DVec3, up: DVec3) -> Parsed<()> {
    let sine = direction.normalize().cross(up.normalize()).length();
    if sine > PARALLEL {
        return Ok(());
    }
    let up_span = block.place_of("up").unwrap_or(block.close);
    let mut fault = Fault::new(up_span, "`up` must not be parallel to `direction`");
    if let Some(span) = block.place_of("direction") {
        fault = fault.context(span, "direction given here");
    }
    fault.fail()
}
