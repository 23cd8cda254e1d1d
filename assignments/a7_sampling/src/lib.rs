pub mod film;
pub mod filter;
pub mod sampler;
