//! A material by data: n from a formula or a table, k from a table or none.

use super::{Formula, MediumError, invalid};
use crate::math::monotone::MonotoneCurve;
use num_complex::Complex64;

/// The real part by wavelength.
#[derive(Clone, Debug, PartialEq)]
pub enum RealIndex {
    /// A formula in micrometres.
    Formula(Formula),
    /// A table, wavelengths in metres.
    Table(MonotoneCurve),
}

/// Name, source and data of one material.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    pub name: String,
    /// Publication and database the data are from.
    pub source: String,
    pub real: RealIndex,
    /// Extinction coefficient by wavelength in metres; none: transparent.
    pub extinction: Option<MonotoneCurve>,
    /// Wavelengths in metres that the data cover.
    pub range: (f64, f64),
    /// Whether wavelengths outside are answered: formulas go on, tables hold their end value.
    pub extrapolate: bool,
}

impl Material {
    /// A material of a formula over a range in metres, which must be free of poles.
    pub fn from_formula(
        name: impl Into<String>,
        source: impl Into<String>,
        formula: Formula,
        range: (f64, f64),
    ) -> Result<Self, MediumError> {
        formula.check_range(range.0 * 1e6, range.1 * 1e6)?;
        Ok(Self {
            name: name.into(),
            source: source.into(),
            real: RealIndex::Formula(formula),
            extinction: None,
            range,
            extrapolate: false,
        })
    }

    /// A material of tables; the range is what both cover.
    pub fn from_tables(
        name: impl Into<String>,
        source: impl Into<String>,
        real: MonotoneCurve,
        extinction: Option<MonotoneCurve>,
    ) -> Result<Self, MediumError> {
        let range = real.range();
        let material = Self {
            name: name.into(),
            source: source.into(),
            real: RealIndex::Table(real),
            extinction: None,
            range,
            extrapolate: false,
        };
        match extinction {
            Some(curve) => material.with_extinction(curve),
            None => Ok(material),
        }
    }

    /// Adds k; the range shrinks to what n and k both cover.
    pub fn with_extinction(mut self, curve: MonotoneCurve) -> Result<Self, MediumError> {
        let (from, to) = curve.range();
        let range = (self.range.0.max(from), self.range.1.min(to));
        if range.0 >= range.1 {
            return Err(invalid(
                &format!("{}: range of k", self.name),
                format!("{} to {} nm", from * 1e9, to * 1e9),
                "a range that overlaps that of n",
            ));
        }
        self.range = range;
        self.extinction = Some(curve);
        Ok(self)
    }

    /// Complex index at a wavelength in metres.
    pub fn index(&self, wavelength: f64) -> Result<Complex64, MediumError> {
        if !self.extrapolate {
            super::check_range(&self.name, wavelength, self.range)?;
        }
        let n = match &self.real {
            RealIndex::Formula(formula) => formula.index(wavelength * 1e6),
            RealIndex::Table(curve) => curve.value(wavelength),
        };
        let k = self.extinction.as_ref().map_or(0.0, |curve| curve.value(wavelength));
        if n.is_finite() && n > 0.0 {
            Ok(Complex64::new(n, k))
        } else {
            Err(invalid(
                &format!("index of {} at {} nm", self.name, wavelength * 1e9),
                n,
                "a wavelength at which the formula gives a positive real index",
            ))
        }
    }
}
