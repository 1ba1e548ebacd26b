//! Orders of small particles as sums over partial waves, whose coefficients come from rays.

mod central_ray;
mod potentials;
mod radial_channels;
mod radial_line;
mod radial_rays;
mod waves;

pub use waves::PartialWaves;
