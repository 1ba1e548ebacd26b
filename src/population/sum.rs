//! The sum of what several kinds of particles scatter at one wavelength.

use crate::phase_table::{ERROR_BANDS, MethodPart, Slab};
use ndarray::{Array3, Axis};

/// Slabs added up, each by its share of the number of particles.
///
/// All of one wavelength, quantity and θ axis; azimuths may be many in some and one in others (which then
/// stands for all).
#[derive(Clone, Debug, Default)]
pub struct Sum {
    slabs: Vec<(Slab, f64)>,
}

impl Sum {
    /// Add the slab of a kind of particles with its share of their number.
    pub fn add(&mut self, slab: &Slab, share: f64) {
        self.slabs.push((slab.clone(), share));
    }

    /// Scattering cross-section of the mean particle, m².
    pub fn scattering(&self) -> f64 {
        self.total(|slab| slab.scattering_cross_section)
    }

    fn total(&self, of: impl Fn(&Slab) -> f64) -> f64 {
        self.slabs.iter().map(|(slab, share)| share * of(slab)).sum()
    }

    /// Mean weighted with the scattered light.
    fn by_light(&self, of: impl Fn(&Slab) -> f64) -> f64 {
        self.total(|slab| slab.scattering_cross_section * of(slab)) / self.scattering()
    }

    /// The slab of all of them; `None` where nothing was added. Its index is that of the first.
    pub fn slab(self, tolerance: f64) -> Option<Slab> {
        let (first, _) = self.slabs.first()?;
        let scattering = self.scattering();
        let azimuths = self.slabs.iter().map(|(slab, _)| slab.values.dim().2).max()?;
        let (elements, theta, _) = first.values.dim();
        let mut values = Array3::<f64>::zeros((elements, theta, azimuths));
        for (slab, share) in &self.slabs {
            let weight = share * slab.scattering_cross_section / scattering;
            let part = slab.values.broadcast(values.dim())?;
            values.zip_mut_with(&part, |sum, value| *sum += weight * f64::from(*value));
        }
        let mut ahead = Some(0.0);
        for (slab, share) in &self.slabs {
            ahead = ahead.zip(slab.forward_extinction).map(|(sum, area)| sum + share * area);
        }
        let error_estimate = self.by_light(|slab| slab.error_estimate);
        let mut error_by_direction = [0.0; ERROR_BANDS];
        let weights = self.band_weights(theta);
        for (band, error) in error_by_direction.iter_mut().enumerate() {
            let of = |(slab, weight): (&(Slab, f64), &Vec<f64>)| {
                slab.0.error_by_direction[band] * weight[band]
            };
            let total: f64 = weights.iter().map(|weight| weight[band]).sum();
            *error = self.slabs.iter().zip(&weights).map(of).sum::<f64>() / total;
        }
        Some(Slab {
            wavelength: first.wavelength,
            index: first.index,
            outside_index: first.outside_index,
            values: values.mapv(|value| value as f32),
            caustic_order: None,
            scattering_cross_section: scattering,
            extinction_cross_section: self.total(|slab| slab.extinction_cross_section),
            absorption_cross_section: self.total(|slab| slab.absorption_cross_section),
            forward_extinction: ahead,
            asymmetry: self.by_light(|slab| slab.asymmetry),
            energy: None,
            sum_before_peak: self.by_light(|slab| slab.sum_before_peak),
            peak_share: self.by_light(|slab| slab.peak_share),
            error_estimate,
            error_by_band: self.by_light(|slab| slab.error_by_band),
            tolerance_met: (!error_estimate.is_nan()).then_some(error_estimate <= tolerance),
            error_by_direction,
            left_out: self.by_light(|slab| slab.left_out),
            methods: self.methods(),
        })
    }

    /// The light of each kind near the middle of each band in which errors are stated.
    fn band_weights(&self, theta: usize) -> Vec<Vec<f64>> {
        let row = |band: usize| (theta - 1) * band / (ERROR_BANDS - 1);
        let weight = |(slab, share): &(Slab, f64)| -> Vec<f64> {
            let face = slab.values.index_axis(Axis(0), 0);
            let mean = |band: usize| f64::from(face.row(row(band)).mean().unwrap_or(0.0));
            let light = share * slab.scattering_cross_section;
            (0..ERROR_BANDS).map(|band| (light * mean(band)).max(f64::MIN_POSITIVE)).collect()
        };
        self.slabs.iter().map(weight).collect()
    }

    /// The methods of all kinds, each with the number of its kind where there are several.
    fn methods(&self) -> Vec<MethodPart> {
        let kinds = self.slabs.iter().enumerate();
        let of_kind = |(place, (slab, _)): (usize, &(Slab, f64))| {
            let named = move |part: &MethodPart| MethodPart {
                reason: format!("particles[{}]: {}", place + 1, part.reason),
                ..part.clone()
            };
            slab.methods.iter().map(named).collect::<Vec<_>>()
        };
        kinds.flat_map(of_kind).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_complex::Complex64;

    fn slab(value: f32, azimuths: usize, sections: [f64; 2], asymmetry: f64) -> Slab {
        let values = Array3::from_elem((1, 91, azimuths), value);
        let place = (5e-7, Complex64::new(1.33, 0.0));
        Slab::plain(place, values, sections, asymmetry).with_error(0.01 * sections[0])
    }

    /// Cross-sections add by number, all else by what is scattered; one azimuth stands for all.
    #[test]
    fn powers_add() {
        let mut sum = Sum::default();
        sum.add(&slab(1.0, 1, [1.0, 2.0], 0.8), 0.75);
        sum.add(&slab(3.0, 4, [5.0, 5.0], 0.4), 0.25);
        assert_eq!(sum.scattering(), 2.0);
        let all = sum.slab(0.1).unwrap();
        assert_eq!(all.values.dim(), (1, 91, 4));
        assert!((all.values[(0, 7, 3)] - (0.75 + 1.25 * 3.0) / 2.0).abs() < 1e-6);
        assert_eq!((all.extinction_cross_section, all.absorption_cross_section), (2.75, 0.75));
        assert!((all.asymmetry - (0.75 * 0.8 + 1.25 * 0.4) / 2.0).abs() < 1e-15);
        assert!((all.error_estimate - (0.75 * 0.01 + 1.25 * 0.05) / 2.0).abs() < 1e-15);
        let by_light = (0.75 * 0.01 + 3.75 * 0.05) / 4.5;
        assert!((all.error_by_direction[3] - by_light).abs() < 1e-12);
        assert_eq!(all.tolerance_met, Some(true));
        assert!(Sum::default().slab(0.1).is_none());
    }
}
