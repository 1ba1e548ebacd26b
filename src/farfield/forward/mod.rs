//! What goes straight on: the diffraction of the shadow, and its penumbra with external reflection.

pub mod diffraction;
pub mod penumbra;
pub mod penumbra_layout;
pub mod penumbra_profile;
pub mod wave;
