//! A medium inside another one.
//!
//! Waves know wavelengths and indices relative to what surrounds a particle: `λ' = λ/n(λ)` and
//! `m = (n + ik)/n(λ)` of a wavelength λ in vacuum. Everything that is computed of a particle is
//! computed of these two; λ is what scenes and tables name.

use super::body::Body;
use super::varied::Radial;
use crate::medium::error::MediumError;
use crate::medium::solution::Host;
use num_complex::Complex64;

/// A medium inside another one: indices are relative to it, wavelengths are those in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Immersed<M> {
    /// What scatters.
    pub inside: M,
    /// What is around it.
    pub outside: M,
}

/// Rounds of the search for a wavelength in vacuum; each wins a digit or more.
const ROUNDS: usize = 60;

impl<M: Host> Immersed<M> {
    /// The real index outside at a wavelength in vacuum (metres).
    ///
    /// # Errors
    /// A wavelength outside its data.
    pub fn outside(&self, vacuum: f64) -> Result<f64, MediumError> {
        Ok(self.outside.index(vacuum)?.re)
    }

    /// The wavelength in vacuum of one in the surroundings: the solution of `λ = λ' n(λ)`.
    ///
    /// # Errors
    /// A wavelength outside the data of the surroundings.
    pub fn vacuum(&self, wavelength: f64) -> Result<f64, MediumError> {
        let (from, to) = self.outside.valid_range();
        // A hair inside, where rounding does not leave the data.
        let within = |w: f64| w.clamp(from * (1.0 + 1e-13), to * (1.0 - 1e-13));
        let mut vacuum = within(1.33 * wavelength);
        for _ in 0..ROUNDS {
            let next = wavelength * self.outside(vacuum)?;
            if (next / vacuum - 1.0).abs() < 1e-15 {
                return Ok(next);
            }
            vacuum = within(next);
        }
        // Beyond the data the search stands at their end, where the index is asked for and refused.
        Ok(wavelength * self.outside(vacuum)?)
    }

    /// The relative index at a wavelength in the surroundings.
    ///
    /// # Errors
    /// A wavelength outside the data of either.
    pub fn index(&self, wavelength: f64) -> Result<Complex64, MediumError> {
        let vacuum = self.vacuum(wavelength)?;
        Ok(self.inside.index(vacuum)? / self.outside(vacuum)?)
    }

    /// Wavelengths in the surroundings that the data of both cover, metres.
    pub fn range(&self) -> (f64, f64) {
        let (a, b) = (self.inside.valid_range(), self.outside.valid_range());
        let (from, to) = (a.0.max(b.0), a.1.min(b.1));
        let seen = |vacuum: f64| self.outside(vacuum).map_or(vacuum, |n| vacuum / n);
        (seen(from), seen(to))
    }

    /// What it is called.
    pub fn name(&self) -> String {
        format!("{}, in {}", self.inside.name(), self.outside.name())
    }

    /// Where the data are from.
    pub fn source(&self) -> String {
        format!("{}; outside: {}", self.inside.source(), self.outside.source())
    }

    /// What the readers of its files changed or left out.
    pub fn notes(&self) -> Vec<String> {
        self.inside.notes().into_iter().chain(self.outside.notes()).collect()
    }

    /// The body of what varies inside, at a wavelength in the surroundings, for a particle of this radius
    /// (both metres).
    ///
    /// # Errors
    /// As [`Radial::at`].
    pub fn body(
        &self,
        radial: &Radial<M>,
        wavelength: f64,
        radius: f64,
    ) -> Result<Body, MediumError> {
        let vacuum = self.vacuum(wavelength)?;
        radial.at(vacuum, radius, self.outside(vacuum)?)
    }
}
