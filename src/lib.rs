//! **gonio**: the virtual gonioreflectometer.
//!
//! It measures, on a computer, how one particle scatters light. A wavefront of rays is traced
//! through a drop of real shape, with phase and polarisation, interference and diffraction, and
//! comes out as a tabulated phase function. Spheres can also be solved exactly (Lorenz–Mie).
//!
//! ```
//! use gonio::scene::{Scene, SceneFile};
//! use gonio::simulate;
//!
//! // a raindrop of 0.5 mm, the sun at 20°: the built-in scene, with fewer samples
//! let keys: SceneFile = toml::from_str(
//!     "[light]
//!      wavelengths_nm = [650]
//!      [table]
//!      theta_deg = { from = 130, to = 150, count = 81 }
//!      azimuth_deg = [0]",
//! )?;
//! let table = simulate::table(&Scene::built_in(&keys)?)?;
//! let slab = &table.slabs[0];
//! let brightest = (0..81).max_by(|&a, &b| slab.values[(0, a, 0)].total_cmp(&slab.values[(0, b, 0)]));
//! let bow = table.header.axes.theta[brightest.unwrap_or(0)].to_degrees();
//! assert!((bow - 139.3).abs() < 1.5, "the primary rainbow is at {bow}°");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Start reading at [`simulate`], the main path on one page; [`optics`] states every convention;
//! [`phase_table`] is what all computation produces and all output reads. Tutorials, theory, glossary,
//! and the references of scenes and files are pages of [`docs`].
//!
//! Floors of the house, top first (a module imports only from floors below its own):
//! `cli` · `figures`, `compare` · `render` · `lee`, `batch`, [`scatter`] · `simulate` · `plan`, `tabulate` ·
//! `farfield`, [`facets`], [`radar`] · `series`, `export` · `hdf5`, [`population`], [`transfer`] · `scene`, `phase_table`, `trace`, [`sun_disc`] · `optics`,
//! `medium`, `shape`, `color`, `size_distribution`, [`cancel`] · `math`, `pending_file`, [`fault`].
//!
//! Features, all on by default: `hdf5` (tables as files, exports, batches; brings C code), `cli` (the program),
//! `pictures` (previews and diagrams as PNG and SVG, report pages), `tmatrix` (T-matrices, refused without it). Without
//! them the physics builds for `wasm32-unknown-unknown`.

pub mod cancel;
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
pub mod population;
pub mod transfer;

pub mod series;

#[cfg(feature = "hdf5")]
pub mod export;
pub mod facets;
pub mod farfield;
pub mod radar;

pub mod plan;
mod tabulate;

pub mod simulate;

#[cfg(feature = "hdf5")]
pub mod batch;
pub mod lee;
pub mod scatter;

pub mod render;

pub mod compare;
#[cfg(all(feature = "hdf5", feature = "pictures"))]
pub mod figures;

#[cfg(any(doc, doctest, test))]
pub mod docs;
