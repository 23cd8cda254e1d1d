//! The invariants of both levels, checked one by one.

use super::Instances;
use super::part::{Part, Source, corners};
use super::placement::Placement;
use common::geometry::PlacedMesh;
use common::math::Bounds;

impl Instances<'_> {
    /// Every primitive is in one part and every part in the tree at the top; each tree is right,
    /// and the corners of each copy are where its placement says, as exactly as it says.
    pub(super) fn check(&self) -> Result<(), String> {
        let boxes: Vec<Bounds> = self.parts.iter().map(|part| part.bounds).collect();
        self.top.check_over(0, &boxes, |_| unreachable!("no triangles at the top"))?;
        let mut seen = vec![0u32; self.geometry.triangles().len()];
        for part in &self.parts {
            self.check_part(part, &mut seen)?;
        }
        if seen.iter().any(|n| *n != 1) {
            return Err("a triangle is in no part or in two".to_owned());
        }
        (0..self.trees.len()).try_for_each(|tree| self.check_tree(tree))
    }

    fn check_tree(&self, index: usize) -> Result<(), String> {
        let tree = self.tree(index);
        let (numbers, triangles) = (self.geometry.triangle_numbers(), self.geometry.triangles());
        let solids: Vec<Bounds> = self.geometry.solids().iter().map(|s| s.bounds).collect();
        let (list, solids) = match &self.trees[index].source {
            Source::Mesh(mesh) => {
                let placed = |i: u32| (i as usize, corners(mesh, i as usize));
                return tree.check_over(mesh.triangles.len(), &[], placed);
            }
            Source::Loose(list) => (list, &solids[..]),
            Source::Triangles(list) => (list, &[][..]),
        };
        tree.check_over(list.len(), solids, |number| {
            let place = list.partition_point(|&i| numbers[i as usize] < number);
            (place, triangles[list[place] as usize])
        })
    }

    /// Counts the part's triangles, each of which must lie in its box.
    fn check_part(&self, part: &Part, seen: &mut [u32]) -> Result<(), String> {
        let places: Vec<usize> = match (&self.trees[part.tree].source, &part.placement) {
            (Source::Loose(list) | Source::Triangles(list), None) => {
                list.iter().map(|&i| i as usize).collect()
            }
            (Source::Mesh(_), Some(placement)) => {
                let placed = self.geometry.placed_meshes().find(|p| p.start == placement.start);
                let placed = placed.ok_or("a part is a copy of no mesh")?;
                check_placement(placed, placement, &self.geometry.triangles()[placed.triangles()])?;
                placed.triangles().collect()
            }
            _ => return Err("a part's tree is in another space".to_owned()),
        };
        for place in places {
            let own = Bounds::of_points(self.geometry.triangles()[place]);
            if part.bounds.union(&own) != part.bounds {
                return Err(format!("triangle {place} reaches out of its part"));
            }
            seen[place] += 1;
        }
        Ok(())
    }
}

/// The corners in the world, taken back, are as near to the mesh's as the placement promises.
fn check_placement(
    placed: &PlacedMesh,
    placement: &Placement,
    world: &[[common::math::Vec3; 3]],
) -> Result<(), String> {
    let order = placed.order();
    for (triangle, baked) in world.iter().enumerate() {
        let own = corners(&placed.mesh, triangle);
        for (corner, &from) in baked.iter().zip(&order) {
            let back = placed.to_world.inverse_point(corner.as_dvec3());
            let off = (back - own[from].as_dvec3()).abs().max_element();
            if off > placement.corner {
                return Err(format!("triangle {triangle} of a copy is {off:e} from where it should be"));
            }
        }
    }
    Ok(())
}
