//! Which light to ask: by power, distance and the side it shines to, in logarithmic time.
//!
//! A tree of lights (Conty Estevez & Kulla, "Importance sampling of many lights with adaptive tree
//! splitting", 2018): every node knows how much its lights can send at most to a point, and the
//! way down takes either child in proportion to that.

use common::math::{Bounds, Vec3};

/// Some lights, as one.
#[derive(Clone, Copy, Debug)]
pub struct Cluster {
    /// Around all of them.
    pub bounds: Bounds,
    /// Sum of what they send.
    pub power: f32,
    /// Middle of the directions that they face, unit.
    pub axis: Vec3,
    /// Cosine of the widest angle between the axis and a direction faced; −1 for all round.
    pub cos_spread: f32,
}

/// One light of a tree: a number, and what the tree must know of it.
#[derive(Clone, Copy, Debug)]
pub struct Leaf {
    /// Number of the light, as [`LightTree::choose`] returns it.
    pub light: u32,
    /// The light.
    pub cluster: Cluster,
}

#[derive(Clone, Copy, Debug)]
enum Below {
    Light(u32),
    /// The second child; the first is the next node.
    Children(u32),
}

/// Lights at places, so that one can be chosen.
#[derive(Debug, Default)]
pub struct LightTree {
    nodes: Vec<(Cluster, Below)>,
    /// Node of each light.
    node_of: Vec<u32>,
    /// Node above each node.
    parent: Vec<u32>,
}

/// A point that wants light, and the side that it wants it from.
#[derive(Clone, Copy, Debug)]
pub struct Receiver {
    /// Where it is.
    pub point: Vec3,
    /// Unit normal: light from behind does not count. Zero if light from everywhere does.
    pub normal: Vec3,
}

impl Cluster {
    /// Both.
    pub fn union(&self, other: &Self) -> Self {
        let (axis, cos_spread) = cone_around((self.axis, self.cos_spread), (other.axis, other.cos_spread));
        let bounds = self.bounds.union(&other.bounds);
        Self { bounds, power: self.power + other.power, axis, cos_spread }
    }

    /// An upper bound, but for a factor that is the same for all, of what arrives at a point;
    /// 0 only if nothing can.
    #[inline]
    pub fn importance(&self, at: &Receiver) -> f32 {
        let center = (self.bounds.min + self.bounds.max) * 0.5;
        let half_diagonal = self.bounds.size().length() * 0.5;
        let to_center = center - at.point;
        let squared = to_center.length_squared();
        // From within the sphere around it, lights may be in any direction.
        if squared <= half_diagonal * half_diagonal {
            return self.power / (half_diagonal * half_diagonal).max(f32::MIN_POSITIVE);
        }
        let distance = squared.sqrt();
        let towards = to_center / distance;
        let sine = half_diagonal / distance;
        let cosine = (1.0 - sine * sine).max(0.0).sqrt();
        let everywhere = at.normal == Vec3::ZERO;
        let receiving = if everywhere { 1.0 } else { widened(at.normal.dot(towards), cosine, sine) };
        let spread = self.cos_spread;
        let sending = if spread <= -1.0 {
            1.0
        } else {
            let spread_sine = (1.0 - spread * spread).max(0.0).sqrt();
            let off_axis = -self.axis.dot(towards);
            let off_cone = widened(off_axis, spread, spread_sine);
            widened(off_cone, cosine, sine)
        };
        self.power * receiving.max(0.0) * sending.max(0.0) / squared
    }
}

/// Cosine of an angle made smaller by another, down to none. Both are given by cosines, the second
/// by its sine too.
#[inline]
fn widened(cosine: f32, by_cosine: f32, by_sine: f32) -> f32 {
    if cosine >= by_cosine {
        return 1.0;
    }
    cosine * by_cosine + (1.0 - cosine * cosine).max(0.0).sqrt() * by_sine
}

/// The narrowest cone around two, as axis and cosine.
fn cone_around(a: (Vec3, f32), b: (Vec3, f32)) -> (Vec3, f32) {
    let angle = |cosine: f32| cosine.clamp(-1.0, 1.0).acos();
    let ((wide, wide_cos), (narrow, narrow_cos)) = if a.1 <= b.1 { (a, b) } else { (b, a) };
    let between = angle(wide.dot(narrow));
    let (wide_angle, narrow_angle) = (angle(wide_cos), angle(narrow_cos));
    if wide_angle >= between + narrow_angle {
        return (wide, wide_cos);
    }
    let spread = (wide_angle + between + narrow_angle) / 2.0;
    let across = wide.cross(narrow).normalize_or_zero();
    if spread >= std::f32::consts::PI || across == Vec3::ZERO {
        return (wide, -1.0);
    }
    let turn = spread - wide_angle;
    // Wide's axis, turned towards narrow's.
    let side = across.cross(wide);
    // A little wider than computed, for the rounding.
    ((wide * turn.cos() + side * turn.sin()).normalize(), (spread + 1e-5).min(std::f32::consts::PI).cos())
}

impl LightTree {
    /// Of some lights, numbered below `count`.
    pub fn new(mut leaves: Vec<Leaf>, count: usize) -> Self {
        let mut tree = Self { nodes: Vec::new(), node_of: vec![u32::MAX; count], parent: Vec::new() };
        if !leaves.is_empty() {
            tree.build(&mut leaves, u32::MAX);
        }
        tree
    }

    fn build(&mut self, leaves: &mut [Leaf], parent: u32) {
        let node = self.nodes.len();
        self.parent.push(parent);
        let all = leaves.iter().map(|leaf| leaf.cluster).reduce(|a, b| a.union(&b));
        let all = all.expect("never built of nothing");
        if let [leaf] = leaves {
            self.node_of[leaf.light as usize] = node as u32;
            self.nodes.push((all, Below::Light(leaf.light)));
            return;
        }
        self.nodes.push((all, Below::Children(0)));
        let middle = split(leaves);
        let (left, right) = leaves.split_at_mut(middle);
        self.build(left, node as u32);
        self.nodes[node].1 = Below::Children(self.nodes.len() as u32);
        self.build(right, node as u32);
    }

    /// Whether there is no light.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// A light, its probability, and what is left of the number in [0, 1) that chose it; `None` if
    /// no light can reach the point.
    #[inline]
    pub fn choose(&self, at: &Receiver, mut u: f64) -> Option<(u32, f32, f64)> {
        let (mut node, mut probability) = (0usize, 1.0);
        loop {
            let second = match self.nodes.get(node)?.1 {
                Below::Light(light) => return Some((light, probability, u)),
                Below::Children(second) => second as usize,
            };
            let first = self.first_share(node, second, at)?;
            let share = if u < f64::from(first) {
                u /= f64::from(first);
                node += 1;
                first
            } else {
                u = (u - f64::from(first)) / (1.0 - f64::from(first));
                node = second;
                1.0 - first
            };
            u = u.clamp(0.0, 1.0 - f64::EPSILON);
            probability *= share;
        }
    }

    /// The probability that [`LightTree::choose`] takes this light; 0 for one that is not in it.
    #[inline]
    pub fn probability(&self, at: &Receiver, light: u32) -> f32 {
        let mut node = self.node_of[light as usize];
        let mut probability = if node == u32::MAX { 0.0 } else { 1.0 };
        while let Some(&above) = self.parent.get(node as usize) {
            let Some((_, Below::Children(second))) = self.nodes.get(above as usize) else { break };
            let first = self.first_share(above as usize, *second as usize, at);
            let Some(first) = first else { return 0.0 };
            probability *= if node == *second { 1.0 - first } else { first };
            node = above;
        }
        probability
    }

    /// Share of the first child; `None` if neither can reach the point.
    #[inline]
    fn first_share(&self, node: usize, second: usize, at: &Receiver) -> Option<f32> {
        let first = self.nodes[node + 1].0.importance(at);
        let second = self.nodes[second].0.importance(at);
        let sum = first + second;
        (sum > 0.0 && sum.is_finite()).then(|| first / sum)
    }
}

/// Puts lights into two groups, so that both are small and bright rather than large and dark: in
/// the order along an axis, where power times surface summed over both is least.
fn split(leaves: &mut [Leaf]) -> usize {
    let middle = |leaf: &Leaf| leaf.cluster.bounds.min + leaf.cluster.bounds.max;
    let axis = Bounds::of_points(leaves.iter().map(middle)).longest_axis();
    leaves.sort_by(|a, b| middle(a)[axis].total_cmp(&middle(b)[axis]).then(a.light.cmp(&b.light)));
    let cost = |c: &Cluster| {
        let s = c.bounds.size();
        let surface = s.x * s.y + s.y * s.z + s.z * s.x + s.length_squared() * 0.01;
        f64::from(c.power) * f64::from(surface) * f64::from(2.0 - c.cos_spread)
    };
    let mut after: Vec<f64> = vec![0.0; leaves.len()];
    let mut sum: Option<Cluster> = None;
    for (i, leaf) in leaves.iter().enumerate().rev() {
        let all = sum.map_or(leaf.cluster, |s| s.union(&leaf.cluster));
        after[i] = cost(&all);
        sum = Some(all);
    }
    let (mut best, mut before) = ((f64::INFINITY, leaves.len() / 2), leaves[0].cluster);
    for i in 1..leaves.len() {
        let total = cost(&before) + after[i];
        if total < best.0 {
            best = (total, i);
        }
        before = before.union(&leaves[i].cluster);
    }
    // So lopsided a tree would be deep; halves are nearly as good then.
    let least = leaves.len() / 16;
    if best.1 < least.max(1) || best.1 > leaves.len() - least.max(1) { leaves.len() / 2 } else { best.1 }
}
