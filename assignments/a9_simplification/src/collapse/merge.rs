//! Drawing an edge together.

use crate::collapse::surface::{NONE, Point, Surface, next, previous};
use common::math::Vec3;

impl Surface {
    /// Draws the edge of `h` together: its end becomes its start, which moves to `place`.
    pub(super) fn collapse(&mut self, h: u32, place: Vec3) {
        let (kept, gone) = (self.start(h), self.end(h));
        let twin = self.twin(h);
        let out = self.out_after(h);
        self.give_fan(gone, kept);
        self.remove_face(h);
        if twin != NONE {
            self.remove_face(twin);
        }
        self.points[kept as usize] = Point { at: place, out };
        self.points[gone as usize].out = NONE;
    }

    /// The half-edge by which to leave the merged point; see [`Point::out`].
    fn out_after(&self, h: u32) -> u32 {
        let [of_start, of_end] = [self.start(h), self.end(h)].map(|p| self.points[p as usize].out);
        let twin = self.twin(h);
        // What becomes of the far sides of the two faces when they are glued to the near ones.
        let beyond_left = self.twin(previous(h));
        if twin == NONE || self.twin(of_end) == NONE {
            return if of_end == next(h) { beyond_left } else { of_end };
        }
        if self.twin(of_start) == NONE {
            return if of_start == next(twin) { self.twin(previous(twin)) } else { of_start };
        }
        beyond_left
    }

    fn give_fan(&mut self, from: u32, to: u32) {
        let first = self.points[from as usize].out;
        let mut h = first;
        loop {
            self.set_start(h, to);
            h = self.turn(h);
            if h == first || h == NONE {
                break;
            }
        }
    }

    /// Removes the face of `h`, whose other two sides become one edge.
    fn remove_face(&mut self, h: u32) {
        let (after, before) = (next(h), previous(h));
        let (left, right) = (self.twin(after), self.twin(before));
        let opposite = self.start(before) as usize;
        if self.points[opposite].out == before {
            self.points[opposite].out = left;
        }
        self.pair(left, right);
        self.kill(h >> 2);
    }
}
