//! The shapes.
//!
//! ```text
//! Sphere { center 0 0 0  radius 1 }
//! Plane { normal 0 1 0  offset -2 }              # with `radius` and `center`: a disc (ours)
//! Triangle { vertex0 0 0 0  vertex1 1 0 0  vertex2 0 1 0 }
//! TriangleMesh { obj_file cube.obj  smooth 1 }   # `smooth` is our extension
//! ```
//!
//! A triangle without area is accepted: it is a legal limit case of a scene that moves, and no
//! ray ever hits it. A radius of zero is not: nobody means it.

use super::Parser;
use super::numbers::Count;
use crate::mesh::Mesh;
use crate::scene::diagnostic::{Fault, Parsed};
use crate::scene::lexer::Token;
use crate::scene::{Disc, ShapeSpec};
use std::sync::Arc;

/// The keywords.
pub(super) const SHAPES: [&str; 4] = ["Sphere", "Plane", "Triangle", "TriangleMesh"];

impl<'a> Parser<'a> {
    pub(super) fn shape(&mut self, keyword: Token<'a>) -> Parsed<ShapeSpec> {
        match keyword.text {
            "Sphere" => self.sphere(keyword),
            "Plane" => self.plane(keyword),
            "Triangle" => self.triangle(keyword),
            _ => self.triangle_mesh(keyword),
        }
    }

    fn sphere(&mut self, keyword: Token<'a>) -> Parsed<ShapeSpec> {
        let mut block = self.open(keyword)?;
        let (mut center, mut radius) = (None, None);
        while let Some(field) = self.field(&mut block, &["center", "radius"])? {
            match field.text {
                "center" => center = Some(self.vector(field)?),
                _ => radius = Some(self.positive(field)?),
            }
        }
        Ok(ShapeSpec::Sphere {
            center: block.require(center, "center")?,
            radius: block.require(radius, "radius")?,
        })
    }

    fn plane(&mut self, keyword: Token<'a>) -> Parsed<ShapeSpec> {
        let mut block = self.open(keyword)?;
        let (mut normal, mut offset, mut center, mut radius) = (None, None, None, None);
        while let Some(field) = self.field(&mut block, &["normal", "offset", "center", "radius"])? {
            match field.text {
                "normal" => normal = Some(self.direction(field)?),
                "offset" => offset = Some(self.number(field)?),
                "center" => center = Some(self.vector(field)?),
                _ => radius = Some(self.positive(field)?),
            }
        }
        let disc = match (center, radius) {
            (None, None) => None,
            _ => Some(Disc {
                center: block.require(center, "center")?,
                radius: block.require(radius, "radius")?,
            }),
        };
        Ok(ShapeSpec::Plane {
            normal: block.require(normal, "normal")?,
            offset: block.require(offset, "offset")?,
            disc,
        })
    }

    fn triangle(&mut self, keyword: Token<'a>) -> Parsed<ShapeSpec> {
        const FIELDS: [&str; 3] = ["vertex0", "vertex1", "vertex2"];
        let mut block = self.open(keyword)?;
        let mut vertices = [None; 3];
        while let Some(field) = self.field(&mut block, &FIELDS)? {
            let index = FIELDS.iter().position(|name| *name == field.text).unwrap_or(2);
            vertices[index] = Some(self.vector(field)?);
        }
        Ok(ShapeSpec::Triangle {
            vertices: [
                block.require(vertices[0], FIELDS[0])?,
                block.require(vertices[1], FIELDS[1])?,
                block.require(vertices[2], FIELDS[2])?,
            ],
        })
    }

    fn triangle_mesh(&mut self, keyword: Token<'a>) -> Parsed<ShapeSpec> {
        let mut block = self.open(keyword)?;
        let (mut mesh, mut smooth) = (None, false);
        while let Some(field) = self.field(&mut block, &["obj_file", "smooth"])? {
            match field.text {
                "obj_file" => mesh = Some(self.mesh(field)?),
                _ => smooth = self.flag(field)?,
            }
        }
        Ok(ShapeSpec::Mesh { mesh: block.require(mesh, "obj_file")?, smooth })
    }

    /// Index of the mesh that a file name stands for; the same mesh has the same index.
    fn mesh(&mut self, field: Token<'a>) -> Parsed<u32> {
        let name = self.name(field)?;
        let mesh = self
            .source
            .mesh(name.text)
            .map_err(|error| Fault::new(name.span, format!("cannot use this mesh: {error}")))?;
        Ok(self.mesh_index(mesh))
    }

    fn mesh_index(&mut self, mesh: Arc<Mesh>) -> u32 {
        let known = self.meshes.iter().position(|other| Arc::ptr_eq(other, &mesh));
        known.unwrap_or_else(|| {
            self.meshes.push(mesh);
            self.meshes.len() - 1
        }) as u32
    }

    fn flag(&mut self, field: Token<'a>) -> Parsed<bool> {
        let Count { value, span } = self.count(field)?;
        match value {
            0 => Ok(false),
            1 => Ok(true),
            _ => Fault::new(span, format!("`{}` must be 0 or 1, found `{value}`", field.text)).fail(),
        }
    }
}
