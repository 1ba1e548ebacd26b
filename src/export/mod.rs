//! Tables for other programs. Each file says what its program takes and which sign it expects.
//!
//! Most programs take one curve per wavelength: the mean over azimuth ([`average`]). The forward
//! peak of a drop is far narrower than their grids and would need thousands of Legendre moments;
//! so it is cut at an angle (`--cap-deg`, recorded), what was cut counts as unscattered, and its
//! share is written into the file.
//!
//! Particles that are no spheres have six elements in that mean (11, 12, 22, 33, 34, 44): Eradiate,
//! libRadtran, sasktran2 and CSV take all of them. Mitsuba's `tabphase` and plugin, the OpenEXR map and the
//! colour strip take unpolarised light, element 11 alone; the map and the strip and the full CSV keep the
//! azimuth. [`bulk`] are coefficients per metre and per kilogram, where the table tells number and density;
//! [`notes`] what a user is told beside: an error that was not met, what was averaged over.
//!
//! ```
//! use gonio::export::{average::average, csv};
//! use gonio::scene::{Scene, SceneFile, SceneText};
//! use gonio::simulate;
//!
//! let text = r#"
//! [particle]
//! shape = "sphere"
//! radius_um = 5
//! [light]
//! wavelengths_nm = [550]
//! [table]
//! theta_deg = { from = 0, to = 180, count = 91 }
//! azimuth_deg = [0]
//! "#;
//! let text = SceneText::parse("example", text.into())?;
//! let scene = Scene::from_text(text, &SceneFile::default())?;
//! let table = simulate::table(&scene)?;
//! let averaged = average(&table, 3f64.to_radians())?;
//! let text = csv::averaged(&table, &averaged);
//! assert!(text.contains("wavelength_nm,theta_deg,peak_share,p11_per_sr"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod atmosphere;
pub mod average;
pub mod bulk;
#[cfg(feature = "pictures")]
mod colours;
pub mod csv;
#[cfg(feature = "pictures")]
pub mod exr;
pub mod mitsuba;
pub mod notes;
pub mod source;
#[cfg(feature = "pictures")]
pub mod strip;

pub use atmosphere::{eradiate, libradtran, sasktran2, size_grid};

use crate::color::ColorError;
use crate::fault::{Blame, Fault};
use crate::hdf5::TableError;
use std::path::PathBuf;

/// What went wrong with an export.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say what each case and field is")]
pub enum ExportError {
    #[error("{field} = {value}: {accepted}")]
    Invalid { field: String, value: String, accepted: String },
    #[error("{}: a sweep; {why}", path.display())]
    Sweep { path: PathBuf, why: String },
    #[error("colours: {0}")]
    Color(#[from] ColorError),
    #[cfg(feature = "pictures")]
    #[error("picture: {0}")]
    Png(#[from] png::EncodingError),
    #[cfg(feature = "pictures")]
    #[error("picture: {0}")]
    Exr(#[from] ::exr::error::Error),
    #[error(transparent)]
    Table(#[from] TableError),
}

impl Blame for ExportError {
    fn fault(&self) -> Fault {
        match self {
            ExportError::Invalid { .. } | ExportError::Sweep { .. } | ExportError::Color(_) => {
                Fault::Input
            }
            ExportError::Table(error) => error.fault(),
            #[cfg(feature = "pictures")]
            ExportError::Png(_) | ExportError::Exr(_) => Fault::Run,
        }
    }
}

fn invalid(field: &str, value: impl ToString, accepted: &str) -> ExportError {
    ExportError::Invalid {
        field: field.into(),
        value: value.to_string(),
        accepted: accepted.into(),
    }
}
