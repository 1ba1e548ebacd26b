//! Exact spheres that are not homogeneous: any number of layers, or any radial profile n(r) + ik(r).
//!
//! Inside, each partial wave is a field and its conjugate, both continuous wherever the index jumps
//! (ρ = kr, r in units of the outer radius, `n` the index relative to the outside):
//! ```text
//! b_l (TE)   p = ψ,  c = ψ'          ψ″ = -(n² - l(l+1)/ρ²) ψ
//! a_l (TM)   p = φ,  c = φ'/n²       (φ'/n²)' = -(1 - l(l+1)/(n²ρ²)) φ
//! ```
//! `layers` carries (p, c) over a layer of constant index with Riccati–Bessel functions, `profile`
//! over short steps of a smooth index (Magnus 1954; fourth order); both end in the same matching to
//! the wave outside (`matching`).
//!
//! ```
//! use gonio::series::layered::{Layer, Layered};
//! use num_complex::Complex64;
//!
//! let core = Layer { radius: 0.8, index: Complex64::new(1.333, 0.0) };
//! let shell = Layer { radius: 1.0, index: Complex64::new(1.31, 0.0) };
//! let coated = Layered::layers(100.0, &[core, shell])?;
//! assert_eq!(coated.efficiencies().q_abs, 0.0);
//! # Ok::<(), gonio::series::SeriesError>(())
//! ```

mod bessel;
mod body;
mod layers;
mod matching;
pub mod mean;
mod nodes;
mod profile;
mod radial_index;
mod sphere;
mod steps;

pub use layers::{Layer, MAX_LAYERS};
pub use radial_index::RadialIndex;
pub use sphere::Layered;
