//! What a radar is asked, and the rows of its answer: wavelengths, temperatures of water, and drops each by itself or
//! together.
//!
//! The program and the Python package both ask by this.

use super::asked::{Drops, ObservationError, Water, number, refused};
use super::drop_shape::DropShape;
use super::rain::{Beam, RadarError, Rain};
use super::sums::RadarQuantities;
use crate::cancel;
use crate::math::parallel::*;
use crate::medium::MediumError;
use num_complex::Complex64;

/// What is looked at, and how.
///
/// ```
/// use gonio::medium::MicrowaveWater;
/// use gonio::radar::{DropShape, Drops, Observation, Water, band};
///
/// let asked = Observation {
///     wavelengths: vec![band("S")?, band("X")?],
///     water: Water::Celsius(MicrowaveWater::Liebe1991, vec![10.0]),
///     drops: Drops::Each { diameters: vec![1e-3, 2e-3], number_per_m3: 1.0 },
///     shape: DropShape::spheroid("thurai-2007")?,
///     canting: 0.0,
///     elevation: 0.0,
///     dielectric_factor: 0.93,
///     tolerance: 1e-3,
/// };
/// let rows = asked.rows(|| ())?;
/// assert_eq!(rows.len(), 4);
/// assert!(rows[1].seen.z_dr_db > rows[0].seen.z_dr_db, "larger drops are flatter");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Observation {
    /// In vacuum, metres.
    pub wavelengths: Vec<f64>,
    /// What drops are made of.
    pub water: Water,
    /// How many of which size.
    pub drops: Drops,
    /// By size.
    pub shape: DropShape,
    /// Standard deviation of the axes' tilt, radians.
    pub canting: f64,
    /// Beam above the horizon, radians.
    pub elevation: f64,
    /// `|K|²` that defines reflectivities.
    pub dielectric_factor: f64,
    /// Relative error of amplitudes asked for.
    pub tolerance: f64,
}

/// What is seen of one wavelength, temperature and drop or population.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// Metres.
    pub wavelength: f64,
    /// °C, where water has a temperature.
    pub celsius: Option<f64>,
    /// Of the drops.
    pub index: Complex64,
    /// Metres, where drops are seen by themselves.
    pub diameter: Option<f64>,
    /// What a radar measures.
    pub seen: RadarQuantities,
}

impl Observation {
    /// How many rows there will be.
    pub fn count(&self) -> usize {
        let waters = match &self.water {
            Water::Index(_) => 1,
            Water::Celsius(_, temperatures) => temperatures.len(),
        };
        let drops = match &self.drops {
            Drops::Each { diameters, .. } => diameters.len(),
            Drops::Together(_) | Drops::Spectrum(..) => 1,
        };
        self.wavelengths.len() * waters * drops
    }

    /// One row per wavelength, temperature and, where drops are seen by themselves, diameter; the last runs
    /// fastest. `done` is called after each, from any thread.
    ///
    /// # Errors
    /// Numbers outside what is accepted, water beyond its model, drops outside their shape's model, T-matrices that
    /// do not converge.
    pub fn rows(&self, done: impl Fn() + Sync) -> Result<Vec<Row>, ObservationError> {
        self.check()?;
        let mut jobs = Vec::with_capacity(self.count());
        for &wavelength in &self.wavelengths {
            for (celsius, index) in self.indices(wavelength)? {
                let job = |diameter| (wavelength, celsius, index, diameter);
                match &self.drops {
                    Drops::Each { diameters, .. } => {
                        jobs.extend(diameters.iter().map(|&d| job(Some(d))));
                    }
                    Drops::Together(_) | Drops::Spectrum(..) => jobs.push(job(None)),
                }
            }
        }
        let row = |&(wavelength, celsius, index, diameter)| {
            cancel::checkpoint();
            let seen = self.seen(wavelength, index, diameter)?;
            done();
            Ok(Row { wavelength, celsius, index, diameter, seen })
        };
        jobs.par_iter().with_max_len(1).map(row).collect()
    }

    fn check(&self) -> Result<(), ObservationError> {
        for wavelength in &self.wavelengths {
            number("wavelength_mm", in_mm(*wavelength))?;
        }
        let drops: &[(f64, f64)] = match &self.drops {
            Drops::Each { diameters, number_per_m3 } => {
                number("number_per_m3", *number_per_m3)?;
                &diameters.iter().map(|&d| (d, *number_per_m3)).collect::<Vec<_>>()
            }
            Drops::Together(drops) => drops,
            Drops::Spectrum(..) => &[],
        };
        for &(diameter, number) in drops {
            if !(diameter > 0.0 && diameter.is_finite()) {
                let accepted = "diameters above 0 are accepted";
                return Err(refused("diameter_mm", in_mm(diameter), accepted));
            }
            if !(0.0..=1e12).contains(&number) {
                return Err(refused("number_per_m3", number, "0 to 1e12 is accepted"));
            }
            // before anything is computed, and in order
            self.shape.at(diameter).map_err(RadarError::from)?;
        }
        Ok(())
    }

    /// Temperatures, where there are any, and indices.
    fn indices(&self, wavelength: f64) -> Result<Vec<(Option<f64>, Complex64)>, MediumError> {
        match &self.water {
            Water::Index(index) => Ok(vec![(None, *index)]),
            Water::Celsius(model, temperatures) => temperatures
                .iter()
                .map(|&celsius| Ok((Some(celsius), model.index(wavelength, celsius + 273.15)?)))
                .collect(),
        }
    }

    fn seen(
        &self,
        wavelength: f64,
        index: Complex64,
        diameter: Option<f64>,
    ) -> Result<RadarQuantities, RadarError> {
        let Self { shape, canting, tolerance, elevation, dielectric_factor, .. } = *self;
        let rain = Rain { shape, index, canting, tolerance };
        let beam = Beam { wavelength, elevation, dielectric_factor };
        match (&self.drops, diameter) {
            (Drops::Spectrum(spectrum, range), _) => rain.measure_spectrum(&beam, spectrum, *range),
            (Drops::Together(drops), _) => rain.measure(&beam, drops),
            (Drops::Each { diameters, number_per_m3 }, one) => {
                let diameters = one.as_ref().map_or(diameters.as_slice(), std::slice::from_ref);
                let drops: Vec<_> = diameters.iter().map(|&d| (d, *number_per_m3)).collect();
                rain.measure(&beam, &drops)
            }
        }
    }
}

/// A length in metres as it was asked for in mm: without what the way by metres adds to its last digits.
fn in_mm(metres: f64) -> f64 {
    (metres * 1e15).round() / 1e12
}

#[cfg(test)]
mod tests {
    use super::*;

    fn asked(drops: Drops) -> Observation {
        Observation {
            wavelengths: vec![0.1, 0.03],
            water: Water::Index(Complex64::new(8.0, 2.0)),
            drops,
            shape: DropShape::Spheroid(0.8),
            canting: 0.0,
            elevation: 0.0,
            dielectric_factor: 0.93,
            tolerance: 1e-4,
        }
    }

    /// Reflectivities of drops seen together are the sum of theirs by themselves.
    #[test]
    fn together_is_the_sum_of_each() {
        let diameters = vec![1e-3, 2e-3];
        let each = asked(Drops::Each { diameters, number_per_m3: 3.0 });
        let each = each.rows(|| ()).unwrap();
        let together = asked(Drops::Together(vec![(1e-3, 3.0), (2e-3, 3.0)])).rows(|| ()).unwrap();
        for (pair, sum) in each.chunks(2).zip(&together) {
            let known = pair[0].seen.z_h + pair[1].seen.z_h;
            assert!((sum.seen.z_h / known - 1.0).abs() < 1e-12);
            assert!(sum.diameter.is_none() && pair[1].diameter == Some(2e-3));
        }
    }

    #[test]
    fn what_is_no_drop_or_no_beam_is_refused() {
        let words = |observation: &Observation| observation.rows(|| ()).unwrap_err().to_string();
        let each = |d: f64| asked(Drops::Each { diameters: vec![d], number_per_m3: 1.0 });
        assert!(words(&each(-1e-3)).starts_with("diameter_mm = -1: "));
        assert!(words(&asked(Drops::Together(vec![(1e-3, f64::NAN)]))).contains("number_per_m3"));
        let mut short = each(1e-3);
        short.wavelengths = vec![1e-7];
        assert!(words(&short).starts_with("wavelength_mm = 0.0001"), "{}", words(&short));
    }
}
