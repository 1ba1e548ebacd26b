//! Scattering planes at several azimuths: cut into matching segments, checked for smoothness, and
//! interpolated to any azimuth.

mod axis_waves;
pub mod azimuthal_smoothness;
mod blend;
pub mod cut_layout;
mod formulas;
pub mod guides;
pub mod matching;
pub mod order_planes;
mod places;
pub mod plane_set;
pub mod segments;
