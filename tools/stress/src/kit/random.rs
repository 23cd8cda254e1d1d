//! Random numbers for trials: the same on every machine.

use common::math::{DVec3, Vec3};
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg32;

/// A seeded stream of draws.
pub struct Draw(Pcg32);

impl Draw {
    /// The stream that belongs to a seed.
    pub fn new(seed: u64) -> Self {
        Self(Pcg32::seed_from_u64(seed))
    }

    /// Uniform in [0, 1), 32 bits.
    pub fn unit(&mut self) -> f64 {
        f64::from(self.0.next_u32()) / 2f64.powi(32)
    }

    /// Uniform between two numbers.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Any 32 bits.
    pub fn bits(&mut self) -> u32 {
        self.0.next_u32()
    }

    /// Below `count`, which is not 0.
    pub fn below(&mut self, count: usize) -> usize {
        (self.unit() * count as f64) as usize
    }

    /// One of some things.
    pub fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[self.below(from.len())]
    }

    /// True in `share` of all cases.
    pub fn chance(&mut self, share: f64) -> bool {
        self.unit() < share
    }

    /// 10 to a power uniform between two exponents.
    pub fn magnitude(&mut self, low: f64, high: f64) -> f64 {
        10f64.powf(self.between(low, high))
    }

    /// Uniform in the cube [−1, 1)³.
    pub fn cube(&mut self) -> DVec3 {
        DVec3::new(self.between(-1.0, 1.0), self.between(-1.0, 1.0), self.between(-1.0, 1.0))
    }

    /// A uniform unit vector.
    pub fn direction(&mut self) -> DVec3 {
        loop {
            let p = self.cube();
            if (0.01..1.0).contains(&p.length_squared()) {
                return p.normalize();
            }
        }
    }

    /// A point of the box between two corners.
    pub fn point(&mut self, min: Vec3, max: Vec3) -> Vec3 {
        let (min, max) = (min.as_dvec3(), max.as_dvec3());
        let share = (self.cube() + DVec3::ONE) / 2.0;
        (min + (max - min) * share).as_vec3()
    }

    /// An exactly representable share k/2⁶ in (0, 1).
    pub fn dyadic_share(&mut self) -> f64 {
        (1 + self.below(63)) as f64 / 64.0
    }
}
