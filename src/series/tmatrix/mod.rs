//! T-matrices: exact scattering by bodies of revolution (spheroids, raindrops) up to some hundred
//! wavelengths around, where ray pictures end.
//!
//! The T-matrix takes the regular spherical waves of any incident light to the outgoing ones of what
//! is scattered (Waterman 1971; Mishchenko, Travis & Lacis 2002). It belongs to the body, so that one
//! serves all directions and orientations. [`TMatrix::new`] finds it by the null-field method, by least
//! squares on the surface where that stalls, and refuses where both do; [`TMatrix::error`] says how
//! well it is known.
//!
//! ```
//! use gonio::series::tmatrix::{Scattered, TMatrix};
//! use gonio::shape::Shape;
//! use num_complex::Complex64;
//!
//! let shape = Shape::spheroid(0.8, 0.0)?;
//! let t = TMatrix::new(&shape, 3.0, Complex64::new(1.333, 0.0), 1e-6)?;
//! let q = Scattered::new(&t, 0.0).efficiencies();
//! assert!((q.q_ext - q.q_sca).abs() < 1e-9, "nothing is absorbed");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod far_field;
mod kernel;
mod matrix;
mod random;
mod sections;
mod solve;
mod stated;
mod table;

pub use far_field::{Azimuth, FixedEfficiencies, Scattered};
pub use kernel::error::{NoMean, TMatrixError};
pub use kernel::range::{Expectation, Solver};
pub use matrix::TMatrix;
pub use random::RandomOrientation;
pub use sections::Sections;
pub use solve::{Outlook, check, expectation, outlook};
pub use stated::StatedError;
pub use table::TableJob;
