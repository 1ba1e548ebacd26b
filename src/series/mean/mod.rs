//! Means over drop sizes and over a band of wavelengths, with a stated error.
//!
//! The integrand has ever narrower resonances; equal steps in x converge to it only as 1/steps
//! (a gamma distribution about x = 114 needs 5·10⁵ sizes for 1e-4). So for spheres that have narrow
//! resonances the Debye series is cut behind an order Q: up to there the intensity is band-limited
//! in x by the longest path, and the rule of equal steps has no error once the step resolves that
//! path, whatever the number of steps; the orders behind the cut enter by their mean power
//! (`behind.rs` of the series), absorption without its beats. Q grows until the difference to Q/2 says that the
//! error is met.
//!
//! Small spheres have no narrow resonances, and too few waves for orders to average out: they enter
//! with their exact coefficients on Gauss panels, halved until they agree (`nodes.rs`).

mod ensemble;
mod error;
mod nodes;
mod sum;
mod value;

pub use ensemble::Ensemble;
pub use error::MeanError;
pub use value::Mean;
