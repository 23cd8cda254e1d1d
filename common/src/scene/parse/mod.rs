//! The parser of the scene format: the top level and the state all blocks share.
//!
//! ```text
//! PerspectiveCamera { … }     exactly one camera
//! Background { … }            optional, like Lights and Materials
//! Lights { … }
//! Materials { … }             before the Group that uses them
//! Group { … }                 exactly one
//! ```
//!
//! Descent by hand over the tokens. Nothing recurses: groups and transforms, the only things
//! that nest, have a stack of their own in `objects.rs`.

mod background;
mod block;
mod camera;
mod lights;
mod materials;
mod numbers;
mod objects;
mod shapes;
mod tally;
mod textures;
mod xforms;

use super::diagnostic::{Fault, Parsed};
use super::lexer::{Lexer, Span, Token, TokenKind};
use super::load::MeshSource;
use super::{CameraSpec, LightSpec, Material, Node, Scene};
use crate::mesh::Mesh;
use background::BackgroundFields;
use std::sync::Arc;

/// What the top level of a file may hold.
const BLOCKS: [&str; 6] =
    ["OrthographicCamera", "PerspectiveCamera", "Background", "Lights", "Materials", "Group"];

/// Parses a whole scene text.
pub(super) fn parse<'a>(text: &'a str, meshes: &'a mut dyn MeshSource) -> Parsed<Scene> {
    let mut parser = Parser::new(text, meshes);
    let mut blocks = Blocks::default();
    loop {
        let token = parser.lexer.next();
        match token.kind {
            TokenKind::End => return parser.finish(blocks, token),
            TokenKind::Word if BLOCKS.contains(&token.text) => parser.block(&mut blocks, token)?,
            _ => return parser.unexpected(token, "a block", &BLOCKS).fail(),
        }
    }
}

/// State shared by all blocks.
pub(super) struct Parser<'a> {
    lexer: Lexer<'a>,
    source: &'a mut dyn MeshSource,
    meshes: Vec<Arc<Mesh>>,
    /// `None` until the Materials block has been read.
    materials: Option<Vec<Material>>,
}

/// The blocks read so far, each with the place of its keyword.
#[derive(Default)]
struct Blocks {
    camera: Option<(Span, CameraSpec)>,
    background: Option<(Span, BackgroundFields)>,
    lights: Option<(Span, Vec<LightSpec>)>,
    materials: Option<Span>,
    group: Option<(Span, Vec<Node>)>,
}

impl<'a> Parser<'a> {
    fn new(text: &'a str, source: &'a mut dyn MeshSource) -> Self {
        Self { lexer: Lexer::new(text), source, meshes: Vec::new(), materials: None }
    }

    fn block(&mut self, blocks: &mut Blocks, keyword: Token<'a>) -> Parsed<()> {
        blocks.reject_second(keyword)?;
        let span = keyword.span;
        match keyword.text {
            "Background" => blocks.background = Some((span, self.background(keyword)?)),
            "Lights" => blocks.lights = Some((span, self.lights(keyword)?)),
            "Materials" => {
                self.materials = Some(self.materials_block(keyword)?);
                blocks.materials = Some(span);
            }
            "Group" => blocks.group = Some((span, self.objects(keyword)?)),
            _ => blocks.camera = Some((span, self.camera(keyword)?)),
        }
        Ok(())
    }

    fn finish(self, blocks: Blocks, end: Token<'a>) -> Parsed<Scene> {
        let Some((_, camera)) = blocks.camera else {
            return Fault::new(end.span, "this file has no camera")
                .help("add a `PerspectiveCamera { … }` or an `OrthographicCamera { … }`")
                .fail();
        };
        let Some((_, nodes)) = blocks.group else {
            return Fault::new(end.span, "this file has no `Group`, so there is nothing to see")
                .help("add `Group { numObjects … }` with the objects")
                .fail();
        };
        let lights = blocks.lights.map(|(_, lights)| lights).unwrap_or_default();
        let background = blocks.background.map(|(_, fields)| fields).unwrap_or_default();
        Ok(Scene {
            camera,
            background: background.with_defaults(lights.is_empty()),
            lights,
            materials: self.materials.unwrap_or_default(),
            nodes,
            meshes: self.meshes,
        })
    }
}

impl Blocks {
    fn reject_second(&self, keyword: Token) -> Parsed<()> {
        let first = match keyword.text {
            "Background" => self.background.as_ref().map(|(span, _)| *span),
            "Lights" => self.lights.as_ref().map(|(span, _)| *span),
            "Materials" => self.materials,
            "Group" => self.group.as_ref().map(|(span, _)| *span),
            _ => self.camera.as_ref().map(|(span, _)| *span),
        };
        let Some(first) = first else { return Ok(()) };
        let message = match keyword.text {
            "OrthographicCamera" | "PerspectiveCamera" => "a second camera".to_owned(),
            other => format!("a second `{other}` block"),
        };
        Fault::new(keyword.span, message).context(first, "first given here").fail()
    }
}
