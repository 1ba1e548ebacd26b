//! Databases of scatterers for programs of radiative transfer in the air: Legendre moments by size.

mod database;
pub mod eradiate;
pub mod libradtran;
pub mod sasktran2;
pub mod size_grid;
mod source;
