//! The tree of objects.
//!
//! ```text
//! Group {
//!     numObjects 2
//!     MaterialIndex 0             # in force to the end of the file, or to the next one
//!     Sphere { … }
//!     Transform {
//!         Translate 0 1 0         # any number of entries, see xforms.rs
//!         Group { … }             # then exactly one object
//!     }
//! }
//! ```
//!
//! Groups and transforms being read are on a stack of their own, so that the depth of the tree
//! is limited by memory and not by the call stack.

use super::Parser;
use super::block::{Block, found};
use super::numbers::Count;
use super::shapes::SHAPES;
use super::tally::Tally;
use super::xforms::XFORMS;
use crate::scene::diagnostic::{Fault, Parsed};
use crate::scene::lexer::{Span, Token, TokenKind};
use crate::scene::{Node, NodeKind};

/// A group or transform whose closing brace has not come yet.
struct Frame<'a> {
    node: u32,
    block: Block<'a>,
    content: Content,
}

enum Content {
    Group(Tally),
    /// The place of the one object, once it has come.
    Transform(Option<Span>),
}

/// The tree as far as it has been read.
struct Tree<'a> {
    nodes: Vec<Node>,
    stack: Vec<Frame<'a>>,
    /// Set by the latest `MaterialIndex`, wherever it stood.
    material: Option<u32>,
}

impl<'a> Parser<'a> {
    /// Reads the file's outermost group and all that is in it.
    pub(super) fn objects(&mut self, keyword: Token<'a>) -> Parsed<Vec<Node>> {
        let mut tree = Tree { nodes: Vec::new(), stack: Vec::new(), material: None };
        self.object(&mut tree, keyword)?;
        while let Some(frame) = tree.stack.last() {
            let allowed = frame.content.allowed();
            let token = self.lexer.next();
            match token.kind {
                TokenKind::Close => tree.close(token)?,
                TokenKind::Word if allowed.contains(&token.text) => self.entry(&mut tree, token)?,
                _ => return self.stray(&tree, token, &allowed).fail(),
            }
        }
        Ok(tree.nodes)
    }

    fn entry(&mut self, tree: &mut Tree<'a>, keyword: Token<'a>) -> Parsed<()> {
        if keyword.text == "MaterialIndex" {
            tree.material = Some(self.material_index(keyword)?);
            return Ok(());
        }
        if !XFORMS.contains(&keyword.text) {
            tree.expect_object(keyword)?;
            return self.object(tree, keyword);
        }
        let xform = self.invertible_xform(keyword)?;
        tree.push_xform(xform);
        Ok(())
    }

    fn object(&mut self, tree: &mut Tree<'a>, keyword: Token<'a>) -> Parsed<()> {
        match keyword.text {
            "Group" => {
                let block = self.open(keyword)?;
                let tally = self.tally(&block, "numObjects", "object")?;
                tree.enter(block, NodeKind::Group, Content::Group(tally));
            }
            "Transform" => {
                let block = self.open(keyword)?;
                tree.enter(block, NodeKind::Transform(Vec::new()), Content::Transform(None));
            }
            _ => {
                let material = self.current_material(tree, keyword)?;
                let shape = self.shape(keyword)?;
                tree.add(keyword, NodeKind::Shape { shape, material });
            }
        }
        Ok(())
    }

    fn current_material(&self, tree: &Tree, keyword: Token<'a>) -> Parsed<u32> {
        tree.material.ok_or_else(|| {
            let message = format!("this `{}` has no material", keyword.text);
            Box::new(Fault::new(keyword.span, message).help("put a `MaterialIndex` before the first shape"))
        })
    }

    fn material_index(&mut self, field: Token<'a>) -> Parsed<u32> {
        let Count { value, span } = self.count(field)?;
        let Some(materials) = &self.materials else {
            return Fault::new(field.span, "`MaterialIndex` before the `Materials` block")
                .help("the `Materials` block must stand before the `Group` that uses it")
                .fail();
        };
        if (value as usize) < materials.len() {
            return Ok(value);
        }
        let range = match materials.len() {
            0 => "the file has no materials".to_owned(),
            1 => "the file has one material, with index 0".to_owned(),
            n => format!("the file has {n} materials, with indices 0 to {}", n - 1),
        };
        Fault::new(span, format!("there is no material {value}")).help(range).fail()
    }

    fn stray(&self, tree: &Tree<'a>, token: Token<'a>, allowed: &[&str]) -> Fault {
        let Some(frame) = tree.stack.last() else {
            return self.unexpected(token, "an object", allowed);
        };
        let opener = frame.block.keyword;
        if let Content::Transform(Some(object)) = frame.content {
            return Fault::new(
                token.span,
                format!("expected `}}` after the one object of `Transform`, found {}", found(token)),
            )
            .context(object, "this is its object");
        }
        if token.kind == TokenKind::End {
            return Fault::new(token.span, format!("the file ends inside of this `{}`", opener.text))
                .label("expected `}`")
                .context(opener.span, "block opened here");
        }
        let what = match frame.content {
            Content::Group(_) => "an object or `MaterialIndex`",
            Content::Transform(_) => "a transform or the object",
        };
        self.unexpected(token, what, allowed)
    }
}

impl Content {
    fn allowed(&self) -> Vec<&'static str> {
        let objects = ["Group", "Transform"].into_iter().chain(SHAPES);
        let entries = objects.chain(["MaterialIndex"]);
        match self {
            Self::Group(_) => entries.collect(),
            Self::Transform(None) => XFORMS.into_iter().chain(entries).collect(),
            Self::Transform(Some(_)) => Vec::new(),
        }
    }
}

impl<'a> Tree<'a> {
    /// Checks that the innermost block takes one more object.
    fn expect_object(&mut self, keyword: Token<'a>) -> Parsed<()> {
        match self.stack.last_mut().map(|frame| &mut frame.content) {
            Some(Content::Group(tally)) => tally.one_more(keyword.span)?,
            Some(Content::Transform(object)) => *object = Some(keyword.span),
            None => {}
        }
        Ok(())
    }

    fn add(&mut self, keyword: Token<'a>, kind: NodeKind) -> u32 {
        self.nodes.push(Node {
            parent: self.stack.last().map(|frame| frame.node),
            kind,
            position: keyword.position,
        });
        self.nodes.len() as u32 - 1
    }

    fn enter(&mut self, block: Block<'a>, kind: NodeKind, content: Content) {
        let node = self.add(block.keyword, kind);
        self.stack.push(Frame { node, block, content });
    }

    fn push_xform(&mut self, xform: crate::scene::Xform) {
        let Some(frame) = self.stack.last() else {
            return;
        };
        if let NodeKind::Transform(list) = &mut self.nodes[frame.node as usize].kind {
            list.push(xform);
        }
    }

    fn close(&mut self, brace: Token<'a>) -> Parsed<()> {
        let Some(frame) = self.stack.pop() else {
            return Ok(());
        };
        match frame.content {
            Content::Group(tally) => tally.finish(brace.span),
            Content::Transform(Some(_)) => Ok(()),
            Content::Transform(None) => Fault::new(brace.span, "this `Transform` has no object")
                .label("expected an object before this")
                .context(frame.block.keyword.span, "block opened here")
                .fail(),
        }
    }
}
