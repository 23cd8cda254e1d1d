//! The skips, and that instruction sets change no bit: what needs the program itself. The numbered
//! properties are in `tools/stress`.

mod abreast;
mod determinism;
mod skips;
