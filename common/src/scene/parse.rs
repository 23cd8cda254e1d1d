//! Recursive-descent parser of the scene format.
