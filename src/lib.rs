//! **gonio**: the virtual gonioreflectometer.
//!
//! It measures, on a computer, how one particle scatters light. A wavefront of rays is traced
//! through a drop of real shape, with phase and polarisation, interference and diffraction, and
//! comes out as a tabulated phase function. Spheres can also be solved exactly (Lorenz–Mie).
//!
//! Start reading at [`simulate`], the main path on one page; [`optics`] states every convention;
//! [`phase_table`] is what all computation produces and all output reads.
//!
//! Floors of the house, top first (a module imports only from floors below its own):
//! `cli` · `compare` · `render` · `lee`, `batch`, [`scatter`] · `simulate` · `plan`, `tabulate` ·
//! `farfield` · `series`, `export` · `hdf5` · `scene`, `phase_table`, `trace`, [`sun_disc`] · `optics`,
//! `medium`, `shape`, `color`, `size_distribution` · `math`, `pending_file`, [`fault`].

pub mod fault;
pub mod math;
pub mod pending_file;

pub mod color;
pub mod medium;
pub mod optics;
pub mod shape;
pub mod size_distribution;

pub mod phase_table;
pub mod scene;
pub mod sun_disc;
pub mod trace;

#[cfg(feature = "hdf5")]
pub mod hdf5;
pub mod series;

#[cfg(feature = "hdf5")]
pub mod export;
pub mod farfield;

pub mod plan;
pub mod tabulate;

pub mod simulate;

#[cfg(feature = "hdf5")]
pub mod batch;
pub mod lee;
pub mod scatter;

pub mod render;

pub mod compare;
