//! A material by data: n from a formula or a table, k from a table or none.
//!
//! Only the wavelength that is asked for is judged: a pole of the formula, an unsound row or the end
//! of the table of k elsewhere does no harm.

use crate::medium::data::samples::DataCurve;
use crate::medium::data::unit::Unit;
use crate::medium::dispersion::formula::Formula;
use crate::medium::error::{MediumError, check_range, digits, invalid, nanometres, range_text};
use num_complex::Complex64;

/// The real part by wavelength.
#[derive(Clone, Debug, PartialEq)]
pub enum RealIndex {
    /// A formula in micrometres, and the wavelengths in metres it is stated for.
    Formula(Formula, (f64, f64)),
    /// A table, wavelengths in metres.
    Table(DataCurve),
}

impl RealIndex {
    fn range(&self) -> (f64, f64) {
        match self {
            Self::Formula(_, range) => *range,
            Self::Table(curve) => curve.range(),
        }
    }
}

/// Name, source and data of one material.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    pub name: String,
    /// Publication and database the data are from.
    pub source: String,
    pub real: RealIndex,
    /// Extinction coefficient by wavelength in metres; none: transparent.
    pub extinction: Option<DataCurve>,
    /// Wavelengths in metres that the data cover, those of n and of k.
    pub range: (f64, f64),
    /// Whether wavelengths outside are answered: formulas go on, tables hold their end value.
    pub extrapolate: bool,
    /// The unit of the wavelengths in the file the data are from.
    pub unit: Option<Unit>,
    /// What the reader of the file changed or left out.
    pub notes: Vec<String>,
}

/// Nearest that a wavelength may come to a pole of a formula, relative.
const POLE: f64 = 0.01;
/// Steepest `|d ln n / d ln λ|` of a formula that has a pole in its range.
const STEEPEST: f64 = 1.0;

impl Material {
    /// A material of a formula over a range in metres.
    pub fn from_formula(
        name: impl Into<String>,
        source: impl Into<String>,
        formula: Formula,
        range: (f64, f64),
    ) -> Self {
        Self::new(name.into(), source.into(), RealIndex::Formula(formula, range))
    }

    /// A material of a table of n, transparent.
    pub fn from_curve(name: impl Into<String>, source: impl Into<String>, real: DataCurve) -> Self {
        Self::new(name.into(), source.into(), RealIndex::Table(real))
    }

    fn new(name: String, source: String, real: RealIndex) -> Self {
        let range = real.range();
        let (extinction, extrapolate, unit, notes) = (None, false, None, Vec::new());
        Self { name, source, real, extinction, range, extrapolate, unit, notes }
    }

    /// Adds k; the range shrinks to what n and k both cover. A k that is zero in every row says that
    /// the material is transparent, however few rows there are.
    pub fn with_extinction(mut self, curve: DataCurve) -> Self {
        let (from, to) = curve.range();
        let (n_from, n_to) = self.real.range();
        if curve.is_zero() {
            if from > n_from || to < n_to {
                let rows = range_text((from, to));
                self.notes.push(format!("k is 0 in all its rows ({rows}): taken as 0 throughout"));
            }
            return self;
        }
        self.range = (n_from.max(from), n_to.min(to));
        self.extinction = Some(curve);
        self
    }

    /// Complex index at a wavelength in metres.
    pub fn index(&self, wavelength: f64) -> Result<Complex64, MediumError> {
        let n = self.real_index(wavelength)?;
        let Some(curve) = &self.extinction else {
            return Ok(Complex64::new(n, 0.0));
        };
        let k = match curve.value(wavelength) {
            Some(k) => k?,
            None if self.extrapolate => curve.held(wavelength)?,
            None => {
                let (from, to) = curve.range();
                return Err(MediumError::OutOfRange {
                    name: format!("k of {}", self.name),
                    wavelength: nanometres(wavelength),
                    range: range_text((from, to)),
                    hint: format!(
                        "; its n, {}, reaches from {}",
                        digits(n),
                        range_text(self.real.range())
                    ),
                });
            }
        };
        Ok(Complex64::new(n, k))
    }

    fn real_index(&self, wavelength: f64) -> Result<f64, MediumError> {
        let range = self.real.range();
        let suspect = self.unit.and_then(|unit| Some((unit, unit.suspect(wavelength, range)?)));
        let outside = check_range(&self.name, wavelength, range);
        match &self.real {
            // An unsound row at the end of the table explains more than its range.
            RealIndex::Table(curve) if let Some(n) = curve.value(wavelength) => return n,
            _ => {}
        }
        if let (
            Some((unit, suspect)),
            Err(MediumError::OutOfRange { name, wavelength, range, .. }),
        ) = (suspect, &outside)
        {
            return Err(MediumError::OutOfRange {
                name: name.clone(),
                wavelength: wavelength.clone(),
                range: range.clone(),
                hint: format!(
                    "; the file's wavelengths are declared in {} (they look like {})",
                    unit.symbol(),
                    suspect.symbol()
                ),
            });
        }
        if !self.extrapolate {
            outside?;
        }
        match &self.real {
            RealIndex::Table(curve) => curve.held(wavelength),
            RealIndex::Formula(formula, range) => self.by_formula(formula, *range, wavelength),
        }
    }

    fn by_formula(
        &self,
        formula: &Formula,
        range: (f64, f64),
        wavelength: f64,
    ) -> Result<f64, MediumError> {
        let um = wavelength * 1e6;
        let n = formula.index(um);
        let field = format!("index of {} at {} nm", self.name, nanometres(wavelength));
        let inside = |p: &f64| (range.0 * 1e6..=range.1 * 1e6).contains(p);
        let poles = formula.poles().into_iter().filter(inside);
        if let Some(pole) = poles.min_by(|a, b| (a - um).abs().total_cmp(&(b - um).abs())) {
            let step = 1e-4;
            let (above, below) =
                (formula.index(um * (1.0 + step)), formula.index(um * (1.0 - step)));
            let slope = (above - below) / (2.0 * step * n);
            // Written so that a slope that is no number is refused too.
            if !((um - pole).abs() > POLE * pole && slope.abs() < STEEPEST) {
                let accepted = format!(
                    "a wavelength farther from the pole of the formula at {} nm, where it means \
                     nothing",
                    digits(pole * 1e3)
                );
                return Err(invalid(&field, digits(n), &accepted));
            }
        }
        if n.is_finite() && n > 0.0 {
            return Ok(n);
        }
        Err(invalid(&field, n, "a wavelength at which the formula gives a positive real index"))
    }
}
