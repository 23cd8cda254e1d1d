//! The one pass over an OBJ file that reads vertices and faces and checks everything.

use super::super::{Mesh, MeshError};
use super::tokens::{Tokens, integer, quoted};
use crate::math::Vec3;

/// What the pass found.
pub(super) struct Plain {
    /// Vertices and triangles, those without area included; `degenerate` counts the faces of
    /// fewer than three vertices.
    pub mesh: Mesh,
    /// Some face refers to texture coordinates or normals.
    pub uses_attributes: bool,
}

/// The three lists that faces refer to.
const LISTS: [&str; 3] = ["vertex", "texture coordinate", "normal"];

struct Reader<'a> {
    tokens: Tokens<'a>,
    mesh: Mesh,
    /// Lengths of the lists so far.
    counts: [i64; 3],
    /// References to what had not come yet: list, index from 1, line.
    forward: Vec<(u8, i64, usize)>,
    uses_attributes: bool,
}

/// Reads and checks a whole file.
pub(super) fn read(bytes: &[u8]) -> Result<Plain, MeshError> {
    let mut reader = Reader {
        tokens: Tokens::new(bytes),
        mesh: Mesh::default(),
        counts: [0; 3],
        forward: Vec::new(),
        uses_attributes: false,
    };
    while let Some(keyword) = reader.tokens.keyword() {
        match keyword {
            b"v" => reader.vertex()?,
            b"f" => reader.face()?,
            b"vt" => reader.attribute(1, 2)?,
            b"vn" => reader.attribute(2, 3)?,
            _ => reader.tokens.skip_statement(),
        }
    }
    reader.check_forward_references()?;
    Ok(Plain { mesh: reader.mesh, uses_attributes: reader.uses_attributes })
}

impl Reader<'_> {
    /// `v x y z`, with a divisor `w` or a colour `r g b` behind it if the file likes.
    #[inline]
    fn vertex(&mut self) -> Result<(), MeshError> {
        let mut point = Vec3::from_array(self.numbers::<3>()?);
        if let Some(fourth) = self.tokens.number()? {
            point = self.long_vertex(point, fourth)?;
        }
        self.mesh.positions.push(point);
        self.counts[0] += 1;
        Ok(())
    }

    fn long_vertex(&mut self, point: Vec3, fourth: f32) -> Result<Vec3, MeshError> {
        let mut extra = 1;
        while self.tokens.number()?.is_some() {
            extra += 1;
        }
        match extra {
            1 => {
                let divided = point / fourth;
                let good = divided.is_finite();
                let message = || "the vertex divided by its w is not finite";
                good.then_some(divided).ok_or_else(|| self.tokens.error(message()))
            }
            3 => Ok(point),
            n => {
                let message = "a vertex has 3 numbers, 4 with w or 6 with a colour, found";
                Err(self.tokens.error(format!("{message} {}", 3 + n)))
            }
        }
    }

    /// `vt` or `vn`: checked and counted here, read by tobj. More numbers than needed are fine.
    fn attribute(&mut self, list: usize, needed: usize) -> Result<(), MeshError> {
        match needed {
            2 => self.numbers::<2>().map(|_| ())?,
            _ => self.numbers::<3>().map(|_| ())?,
        }
        self.counts[list] += 1;
        self.tokens.skip_statement();
        Ok(())
    }

    #[inline]
    fn numbers<const N: usize>(&mut self) -> Result<[f32; N], MeshError> {
        let mut values = [0.0; N];
        for (found, value) in values.iter_mut().enumerate() {
            let Some(number) = self.tokens.number()? else {
                return Err(self.tokens.error(format!("expected {N} numbers, found {found}")));
            };
            *value = number;
        }
        Ok(values)
    }

    /// `f a b c …`: a fan of triangles around the first corner.
    #[inline]
    fn face(&mut self) -> Result<(), MeshError> {
        let Some(first) = self.corner()? else {
            return Err(self.tokens.error("a face without vertices"));
        };
        let mut before = self.corner()?;
        let mut triangles = 0;
        while let Some(corner) = self.corner()? {
            let second = before.unwrap_or(corner);
            self.mesh.triangles.push([first, second, corner]);
            before = Some(corner);
            triangles += 1;
        }
        if triangles == 0 {
            self.mesh.degenerate += 1;
        }
        Ok(())
    }

    /// The next corner of a face as an index from 0.
    #[inline]
    fn corner(&mut self) -> Result<Option<u32>, MeshError> {
        match self.tokens.plain_index() {
            Some(index) => self.resolve(0, index).map(Some),
            None => self.corner_with_attributes(),
        }
    }

    /// `v/vt`, `v//vn` or `v/vt/vn`.
    fn corner_with_attributes(&mut self) -> Result<Option<u32>, MeshError> {
        let Some(word) = self.tokens.word() else {
            return Ok(None);
        };
        let bad =
            |reader: &Self| reader.tokens.error(format!("expected a vertex index, found {}", quoted(word)));
        let mut vertex = None;
        for (list, part) in word.split(|&b| b == b'/').enumerate() {
            if part.is_empty() && list > 0 {
                continue;
            }
            let whole = integer(part).filter(|(_, length)| *length == part.len() && list < 3);
            let (index, _) = whole.ok_or_else(|| bad(self))?;
            let resolved = self.resolve(list, index)?;
            self.uses_attributes |= list > 0;
            vertex.get_or_insert(resolved);
        }
        vertex.map(Some).ok_or_else(|| bad(self))
    }

    /// Turns an index from 1, or from −1 backwards, into one from 0.
    #[inline]
    fn resolve(&mut self, list: usize, index: i64) -> Result<u32, MeshError> {
        let count = self.counts[list];
        let from_one = if index < 0 { count + 1 + index } else { index };
        if from_one < 1 {
            return Err(out_of_range(list, index, count, self.tokens.line));
        }
        if from_one > count {
            self.forward.push((list as u8, index, self.tokens.line));
        }
        // A forward reference too large for 32 bits is an error at the end of the file anyway.
        Ok((from_one - 1) as u32)
    }

    fn check_forward_references(&self) -> Result<(), MeshError> {
        let mut bad = self.forward.iter().filter(|(list, index, _)| *index > self.counts[*list as usize]);
        match bad.next() {
            None => Ok(()),
            Some(&(list, index, line)) => {
                let list = list as usize;
                Err(out_of_range(list, index, self.counts[list], line))
            }
        }
    }
}

fn out_of_range(list: usize, index: i64, count: i64, line: usize) -> MeshError {
    let name = LISTS[list];
    let message = match (index, count) {
        (0, _) => format!("{name} index 0: indices count from 1"),
        (_, 0) => format!("{name} index {index}, but there are none"),
        _ => format!("{name} index {index} is out of range: there are {count}"),
    };
    MeshError::at_line(line, message)
}
