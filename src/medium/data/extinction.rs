//! The extinction coefficient k without an n: no medium, but data to be looked at.

use crate::medium::data::samples::DataCurve;
use crate::medium::error::{MediumError, check_range};

/// k by wavelength, from a file without n.
#[derive(Clone, Debug, PartialEq)]
pub struct Extinction {
    /// What it is called.
    pub name: String,
    /// Where the data are from.
    pub source: String,
    /// What the reader of the file changed or left out.
    pub notes: Vec<String>,
    curve: DataCurve,
}

impl Extinction {
    pub(in crate::medium) fn new(
        name: String,
        source: String,
        notes: Vec<String>,
        curve: DataCurve,
    ) -> Self {
        Self { name, source, notes, curve }
    }

    /// Wavelengths in metres that the data cover.
    pub fn range(&self) -> (f64, f64) {
        self.curve.range()
    }

    /// k at a wavelength in metres.
    pub fn value(&self, wavelength: f64) -> Result<f64, MediumError> {
        match self.curve.value(wavelength) {
            Some(value) => value,
            None => {
                check_range(&self.name, wavelength, self.range())?;
                self.curve.held(wavelength)
            }
        }
    }
}
