//! Tokens of the scene format, with their positions.
