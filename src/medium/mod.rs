//! Media: the complex refractive index `n + ik` by wavelength in vacuum.
//!
//! [`MediumSpec`] is what a scene file says; [`MediumSpec::resolve`] makes a [`Medium`], which
//! answers [`Medium::index`]. Outside the data there is an error, never a guess, unless the user
//! asked for one. Water is relative to vacuum; glasses are as catalogues give them, relative to
//! air, which this program takes as index 1.
//!
//! `spec` holds what is written down, `read` the readers of files, `data` rows made curves, `dispersion`
//! formulas, `shipped` what is compiled in, `water` the waters, [`radial`] what varies along the radius, [`kramers_kronig`] the transform; `kinds` is the
//! closed set of media, `library` the media by name.
//!
//! ```
//! use gonio::medium::MediumSpec;
//! use std::path::Path;
//!
//! #[derive(serde::Deserialize)]
//! struct Keys {
//!     medium: MediumSpec,
//! }
//! let keys: Keys = toml::from_str("medium = { name = \"water\", temperature_c = 20 }")?;
//! let water = keys.medium.resolve(Path::new("."))?;
//! assert!((water.index(589.3e-9)?.re - 1.33336).abs() < 2e-5);
//! assert!(water.index(1.0).is_err());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod band_model;
mod data;
mod dispersion;
mod error;
mod kinds;
pub mod kramers_kronig;
mod library;
mod own;
pub mod radial;
mod read;
mod shipped;
mod shown;
mod solution;
mod spec;
mod spelling;
mod surroundings;
mod water;

pub use band_model::BandModel;
pub use data::extinction::Extinction;
pub use data::material::{Material, RealIndex};
pub use data::samples::{DataCurve, Samples};
pub use data::table::Table;
pub use data::unit::Unit;
pub use dispersion::abbe::{Abbe, AbbeLines, abbe_to_sellmeier, fit_cauchy};
pub use dispersion::formula::Formula;
pub use error::MediumError;
pub use kinds::Medium;
pub use library::{LibraryEntry, list};
pub use own::OwnMedium;
pub use read::csv_table::read as read_csv;
pub use shown::{even_sample_nm, shown_wavelengths_nm};
pub use solution::Solution;
pub use spec::density::Density;
pub use spec::film::FilmSpec;
pub use spec::index_text::parse_index;
pub use spec::{MediumSpec, NamedSpec};
pub use surroundings::Light;
pub use water::daimon::Daimon;
pub use water::microwave::{MicrowaveWater, wavelength_of_ghz};
