//! Rain as a radar sees it: reflectivities, phases and attenuations of drops, by their T-matrices.
//!
//! [`DropSpectrum`] says how many drops of a size there are, [`DropShape`] how they are shaped, [`Rain`] what they
//! are made of and how their axes waver; [`Rain::measure`] adds up what a [`Beam`] gets back. [`Observation`] asks for
//! many wavelengths, temperatures and drops at once.
//!
//! ```
//! use gonio::medium::{MicrowaveWater, wavelength_of_ghz};
//! use gonio::radar::{Beam, DropShape, Rain};
//! use gonio::shape::RaindropModel;
//!
//! // a drop of 4 mm per cubic metre at 10 GHz and 20 °C
//! let wavelength = wavelength_of_ghz(10.0);
//! let rain = Rain {
//!     shape: DropShape::Raindrop(RaindropModel::BeardChuang1987),
//!     index: MicrowaveWater::Liebe1991.index(wavelength, 293.15)?,
//!     canting: 0.0,
//!     tolerance: 1e-3,
//! };
//! let seen = rain.measure(&Beam::horizontal(wavelength), &[(4e-3, 1.0)])?;
//! assert!((seen.z_dr_db - 2.60).abs() < 0.01);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod asked;
mod drop_shape;
mod observation;
mod rain;
mod spectrum;
mod sums;

pub use crate::shape::AxisRatioLaw;
pub use asked::{BANDS, Drops, ObservationError, Water, band, number};
pub use drop_shape::DropShape;
pub use observation::{Observation, Row};
pub use rain::{Beam, RadarError, Rain};
pub use spectrum::DropSpectrum;
pub use sums::{RadarQuantities, RadarSums};
