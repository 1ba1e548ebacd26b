//! Rays of one order that leave in one scattering plane: exit angle by launch point, its landmarks, and the
//! folds where it turns back.

pub mod curve;
pub mod fold;
mod follow;
pub(crate) mod guide;
pub mod landmark;
mod node;
pub mod pair_values;
mod root_path;
pub mod scan;
pub mod scattering_plane;
pub(crate) mod sparse_rays;
