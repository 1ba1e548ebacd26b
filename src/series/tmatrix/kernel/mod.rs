//! What a T-matrix is made of: the surface and the waves on it, the two methods that join them, how waves turn, and
//! the limits of all that.

pub mod error;

pub(super) mod block;
pub(super) mod least_squares;
pub(super) mod null_field;
pub(super) mod range;
pub(super) mod rotation;
pub(super) mod surface;
pub(super) mod waves;
