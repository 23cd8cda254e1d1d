//! A4T4: the tree of rays behind one pixel, written down.

use common::geometry::Hit;
use common::math::Vec3;
use common::ray::Ray;
use std::fmt::{Display, Formatter, Result};

/// What a ray is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RayKind {
    /// From the camera.
    Camera,
    /// Off a mirror.
    Mirrored,
    /// Into or out of glass.
    Refracted,
    /// Towards a light.
    Shadow,
}

/// Watches rays while they are traced.
pub trait Recorder {
    /// How rays refer to their parent.
    type Id: Copy + Default;

    /// A camera, mirrored or refracted ray and what it met.
    fn ray(&mut self, parent: Self::Id, kind: RayKind, ray: &Ray, hit: Option<Hit>, weight: f32) -> Self::Id;

    /// A shadow ray and the share of light that came through.
    fn shadow(&mut self, parent: Self::Id, ray: &Ray, share: Vec3);
}

/// Does not watch, and costs nothing.
pub struct NoRecord;

impl Recorder for NoRecord {
    type Id = ();

    #[inline(always)]
    fn ray(&mut self, (): (), _: RayKind, _: &Ray, _: Option<Hit>, _: f32) {}

    #[inline(always)]
    fn shadow(&mut self, (): (), _: &Ray, _: Vec3) {}
}

/// One ray of a [`RayTree`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayNode {
    /// Index of the ray that made this one; its own index for the camera ray.
    pub parent: usize,
    /// What it is for.
    pub kind: RayKind,
    /// The ray itself.
    pub ray: Ray,
    /// What it met; always `None` for shadow rays.
    pub hit: Option<Hit>,
    /// Its weight, or for a shadow ray the share of light that came through.
    pub share: Vec3,
}

/// All rays of one pixel in the order they were traced, parents first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RayTree {
    /// The rays.
    pub nodes: Vec<RayNode>,
}

impl Recorder for RayTree {
    type Id = usize;

    fn ray(&mut self, parent: usize, kind: RayKind, ray: &Ray, hit: Option<Hit>, weight: f32) -> usize {
        self.nodes.push(RayNode { parent, kind, ray: *ray, hit, share: Vec3::splat(weight) });
        self.nodes.len() - 1
    }

    fn shadow(&mut self, parent: usize, ray: &Ray, share: Vec3) {
        self.nodes.push(RayNode { parent, kind: RayKind::Shadow, ray: *ray, hit: None, share });
    }
}

impl RayTree {
    /// For every ray the rays it made, in the order they were traced.
    fn children(&self) -> Vec<Vec<usize>> {
        let mut children = vec![Vec::new(); self.nodes.len()];
        for (i, node) in self.nodes.iter().enumerate().skip(1) {
            children[node.parent].push(i);
        }
        children
    }
}

impl Display for RayNode {
    fn fmt(&self, f: &mut Formatter) -> Result {
        let (o, d) = (self.ray.origin, self.ray.direction);
        let name = format!("{:?}", self.kind).to_lowercase();
        write!(f, "{name} from ({:.5} {:.5} {:.5})", o.x, o.y, o.z)?;
        write!(f, " along ({:.5} {:.5} {:.5})", d.x, d.y, d.z)?;
        match (self.kind, self.hit) {
            (RayKind::Shadow, _) if self.share == Vec3::ZERO => write!(f, ": blocked"),
            (RayKind::Shadow, _) if self.share == Vec3::ONE => write!(f, ": free"),
            (RayKind::Shadow, _) => write!(f, ": coloured {}", self.share),
            (_, Some(h)) => {
                write!(f, ": primitive {} at t {:.5}, weight {:.5}", h.primitive, h.t, self.share.x)
            }
            (_, None) => write!(f, ": background, weight {:.5}", self.share.x),
        }
    }
}

impl Display for RayTree {
    fn fmt(&self, f: &mut Formatter) -> Result {
        // Depth first without recursion: a tree may be as deep as the number of bounces.
        let children = self.children();
        let mut waiting: Vec<(usize, usize)> = self.nodes.first().map(|_| (0, 0)).into_iter().collect();
        while let Some((i, depth)) = waiting.pop() {
            writeln!(f, "{:indent$}{}", "", self.nodes[i], indent = 2 * depth)?;
            waiting.extend(children[i].iter().rev().map(|&c| (c, depth + 1)));
        }
        Ok(())
    }
}
