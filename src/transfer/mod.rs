//! Light scattered many times in a plane-parallel layer of particles over a ground.
//!
//! A layer so thin that light changes linearly across it (`thin`) is laid upon itself again and again (`adding`), for
//! each order of a Fourier series in azimuth and with all Stokes parameters: the doubling method of van de Hulst, in the
//! form of de Haan, Bosma & Hovenier 1987. Particles enter by their [`Expansion`] in generalised spherical functions
//! (`phase_matrix`), whose forward peak counts as light not scattered (`truncation`); light scattered once is taken out of the
//! sum and put in again by the exact phase function (Nakajima & Tanaka 1988), so that bows stay sharp.
//!
//! ```
//! use gonio::transfer::{Expansion, Fineness, Layer, Side};
//!
//! // nothing is absorbed: what does not come back goes down
//! let phase = Expansion::henyey_greenstein(0.75, 64);
//! let layer = Layer { optical_depth: 1.0, albedo: 1.0, phase: &phase, peak: 0.0, ground_albedo: 0.0 };
//! let light = layer.light(0.5, &[], &Fineness { streams: 12, ..Fineness::default() })?;
//! assert!((light.reflected + light.downward - 1.0).abs() < 1e-6);
//! // straight up from above, with light scattered once
//! let phase_function = 0.25 / std::f64::consts::PI * (1.0 - 0.75f64.powi(2))
//!     / (1.0 + 0.75f64.powi(2) + 2.0 * 0.75 * 0.5).powf(1.5);
//! let radiance = light.more(Side::Lit, 1.0, 0.0)[0] + phase_function * light.once(Side::Lit, 1.0);
//! assert!(radiance > 0.0);
//! # Ok::<(), gonio::transfer::TransferError>(())
//! ```

mod adding;
mod error;
mod expansion;
mod layer;
mod light;
mod phase_matrix;
mod quadrature;
mod single;
mod slab;
mod thin;
mod truncation;

pub use error::TransferError;
pub use expansion::Expansion;
pub use layer::{Fineness, Layer, Polarisation};
pub use light::Light;
pub use single::{Side, once};
