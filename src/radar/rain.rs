//! Drops of many sizes in a beam.

use super::drop_shape::DropShape;
use super::spectrum::DropSpectrum;
use super::sums::{RadarQuantities, RadarSums};
use crate::fault::{Blame, Fault};
use crate::math::parallel::*;
use crate::series::tmatrix::{TMatrix, TMatrixError};
use crate::shape::ShapeError;
use num_complex::Complex64;
use std::f64::consts::PI;

/// A radar's beam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beam {
    /// Metres.
    pub wavelength: f64,
    /// Above the horizon, radians.
    pub elevation: f64,
    /// `|K|²` by which reflectivities are defined.
    pub dielectric_factor: f64,
}

impl Beam {
    /// Along the horizon, with `|K|²` = 0.93.
    pub fn horizontal(wavelength: f64) -> Self {
        Self { wavelength, elevation: 0.0, dielectric_factor: 0.93 }
    }
}

/// Drops of all sizes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rain {
    /// By size.
    pub shape: DropShape,
    /// Index of water.
    pub index: Complex64,
    /// Standard deviation of the axes' tilt from the vertical, radians.
    pub canting: f64,
    /// Relative error of amplitudes asked for.
    pub tolerance: f64,
}

/// Why rain cannot be measured.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say what each case and field is")]
pub enum RadarError {
    #[error("a drop of {diameter_mm:.4} mm: {source}")]
    Drop { diameter_mm: f64, source: TMatrixError },
    #[error(transparent)]
    Shape(#[from] ShapeError),
}

impl Blame for RadarError {
    fn fault(&self) -> Fault {
        match self {
            RadarError::Drop { source, .. } => source.fault(),
            RadarError::Shape(error) => error.fault(),
        }
    }
}

/// Share of the largest term (number of drops times the sixth power of the diameter) below which a size is left
/// out.
const FAINT: f64 = 1e-12;

impl Rain {
    /// What a beam measures of drops by diameter (metres) and number per m³.
    ///
    /// # Errors
    /// A drop outside its shape's model, or one whose T-matrix does not converge.
    pub fn measure(
        &self,
        beam: &Beam,
        drops: &[(f64, f64)],
    ) -> Result<RadarQuantities, RadarError> {
        let weight = |&(diameter, number): &(f64, f64)| number * diameter.powi(6);
        let most = drops.iter().map(weight).fold(0.0, f64::max);
        let sums = drops
            .par_iter()
            .filter(|drop| weight(drop) >= FAINT * most)
            .map(|&(diameter, number)| self.sums(beam, diameter, number))
            .collect::<Result<Vec<_>, RadarError>>()?;
        // in the order of the drops, whatever the number of threads
        let sums = sums.iter().fold(RadarSums::default(), |sum, one| sum.with(one));
        Ok(sums.quantities(beam.wavelength, beam.dielectric_factor))
    }

    /// The same of a spectrum between two diameters (metres).
    ///
    /// # Errors
    /// As [`Rain::measure`].
    pub fn measure_spectrum(
        &self,
        beam: &Beam,
        spectrum: &DropSpectrum,
        range: (f64, f64),
    ) -> Result<RadarQuantities, RadarError> {
        self.measure(beam, &spectrum.nodes(range, &self.shape.kinks()))
    }

    fn sums(&self, beam: &Beam, diameter: f64, number: f64) -> Result<RadarSums, RadarError> {
        let shape = self.shape.at(diameter)?;
        let size_parameter = PI * diameter / beam.wavelength;
        let t = TMatrix::new(&shape, size_parameter, self.index, self.tolerance)
            .map_err(|source| RadarError::Drop { diameter_mm: diameter * 1e3, source })?;
        let canting = if shape.is_sphere() { 0.0 } else { self.canting };
        let mut sums = RadarSums::default();
        sums.add(&t, number, beam.wavelength, beam.elevation, canting);
        Ok(sums)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::radar::AxisRatioLaw;

    /// The example of pytmatrix (its test of radar quantities): a normalised gamma spectrum at C band and 10 °C,
    /// which ends at three times the median volume diameter, spheroids after Thurai et al., canting of 20°; three
    /// digits of each. Its means over canting are of few nodes, which LDR and the small phase show.
    #[test]
    fn the_published_example_of_pytmatrix() {
        let rain = Rain {
            shape: DropShape::SpheroidBy(AxisRatioLaw::Thurai2007),
            index: Complex64::new(8.601, 1.687),
            canting: 20f64.to_radians(),
            tolerance: 1e-4,
        };
        let spectrum = DropSpectrum::NormalisedGamma {
            intercept: 1e6,
            median_volume_diameter: 2e-3,
            shape: 4.0,
        };
        let beam = Beam::horizontal(53.5e-3);
        let q = rain.measure_spectrum(&beam, &spectrum, (0.0, 6e-3)).unwrap();
        let linear = |db: f64| 10f64.powf(0.1 * db);
        for (name, found, known) in [
            ("Z_h", q.z_h, 6383.73378973),
            ("Z_v", q.z_v, 5066.721040036321),
            ("ldr", linear(q.ldr_db), 0.0021960626647629547),
            ("Z_dr", linear(q.z_dr_db), 1.2599339374097778),
            ("delta_hv", q.delta_hv_deg.to_radians(), -0.00021227778705544846),
            ("rho_hv", q.rho_hv, 0.996030804609838),
            ("K_dp", q.k_dp_deg_km, 0.19334678024367824),
            ("A_h", q.a_h_db_km, 0.018923976733777458),
            ("A_v", q.a_h_db_km - q.a_dp_db_km, 0.016366340549483317),
        ] {
            println!("{name}: {found} {known}");
            let bound = match name {
                "ldr" => 2e-3 * known,
                "delta_hv" => 3e-5,
                _ => 3e-4 * known,
            };
            assert!((found - known).abs() < bound, "{name}: {found} {known}");
        }
    }
}
