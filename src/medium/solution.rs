//! Solutions: a dye in a host. Its k adds to the host's, its change of n follows by Kramers–Kronig.
//!
//! `n = n_host + f Δn(λ)`, `k = k_host + f k_dye(λ)`, with f the volume fraction and Δn the
//! Kramers–Kronig transform of k_dye over the range of the dye's data (so that bands beyond it
//! leave Δn without their smooth background). The host is taken as undisturbed: good for dilute
//! solutions, where the dye displaces little of it.

use crate::medium::error::{MediumError, check_range, invalid};
use crate::medium::kramers_kronig::Absorption;
use num_complex::Complex64;

/// A dye at fraction 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Dye {
    /// What it is called.
    pub name: String,
    /// Where the data are from.
    pub source: String,
    /// How it absorbs.
    pub absorption: Absorption,
    /// What the reader of its file changed or left out.
    pub notes: Vec<String>,
}

/// What a dye can be dissolved in: whatever has an index.
pub trait Host {
    /// Complex index at a wavelength in metres.
    fn index(&self, wavelength: f64) -> Result<Complex64, MediumError>;
    /// Wavelengths in metres that the data cover.
    fn valid_range(&self) -> (f64, f64);
    /// What it is called.
    fn name(&self) -> String;
    /// Where its data are from.
    fn source(&self) -> String;
    /// What the readers of its files changed or left out.
    fn notes(&self) -> Vec<String>;
}

/// A dye in a host.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution<H> {
    dye: Dye,
    fraction: f64,
    host: H,
    /// Whether the index follows the absorption; without it n is the host's (for comparison).
    dispersion: bool,
}

impl<H: Host> Solution<H> {
    /// `fraction` from 0 to 1.
    pub fn new(dye: Dye, fraction: f64, host: H) -> Result<Self, MediumError> {
        if !(0.0..=1.0).contains(&fraction) {
            return Err(invalid("fraction", fraction, "0 to 1 (0.01 is one per cent by volume)"));
        }
        let solution = Self { dye, fraction, host, dispersion: true };
        let (from, to) = solution.range();
        if from >= to {
            return Err(invalid(
                "solute",
                solution.dye.name,
                "a dye whose wavelengths overlap those of the host",
            ));
        }
        Ok(solution)
    }

    /// The same with or without the change of n: without it, only the colour is the dye's.
    pub fn with_dispersion(mut self, dispersion: bool) -> Self {
        self.dispersion = dispersion;
        self
    }

    /// Complex index at a wavelength in metres.
    pub fn index(&self, wavelength: f64) -> Result<Complex64, MediumError> {
        check_range(&self.name(), wavelength, self.range())?;
        let host = self.host.index(wavelength)?;
        let absorption = &self.dye.absorption;
        let change = if self.dispersion { absorption.index_change(wavelength) } else { 0.0 };
        let k = absorption.extinction(wavelength);
        Ok(host + self.fraction * Complex64::new(change, k))
    }

    /// Wavelengths in metres that both dye and host cover.
    pub fn range(&self) -> (f64, f64) {
        let (a, b) = (self.dye.absorption.range(), self.host.valid_range());
        (a.0.max(b.0), a.1.min(b.1))
    }

    /// What it is called, with host and strength.
    pub fn name(&self) -> String {
        format!("{} {} in {}", self.dye.name, self.fraction, self.host.name())
    }

    pub(super) fn notes(&self) -> Vec<String> {
        let own = self.dye.notes.iter().map(|note| format!("{}: {note}", self.dye.name));
        own.chain(self.host.notes()).collect()
    }

    /// Where the data are from.
    pub fn source(&self) -> String {
        let n = if self.dispersion { "n by Kramers–Kronig" } else { "n of the host" };
        format!("dye: {} ({n}); host: {}", self.dye.source, self.host.source())
    }
}
