//! Tests of the simplification itself: what must hold whatever the mesh.

mod attributes;
mod bound;
mod exact;
mod flips;
mod irregular;
mod rabbit;
mod shapes;
mod tips;
mod topology;
mod whole;
