//! Integrals over the impact parameters of one scattering plane, where no formula for single rays holds: near
//! grazing incidence, near total reflection, and about the axis.

pub mod glory;
pub mod integrand;
pub mod met_fields;
pub mod near_critical;
pub mod near_grazing;
pub mod near_grazing_layout;
mod prefactor;
mod ray_channels;
pub mod rays;
mod smooth_part;
