//! The far field: from rays that left the particle to amplitudes in any direction.
//!
//! Stages, each replaceable: sheets of rays cut into [`patch`]es, held in a [`collecting_sphere`];
//! [`interference`] of all patches that contain a direction; diffraction by the
//! [`gaussian_filter`] of Sadeghi et al. 2012; [`forward_diffraction`] by the silhouette.

pub mod collecting_sphere;
pub mod direction;
pub mod forward_diffraction;
pub mod gaussian_filter;
pub mod interference;
pub mod patch;

pub use collecting_sphere::CollectingSphere;
pub use direction::Direction;
