//! How far a far field may be from the truth, as the method itself can tell.
//!
//! What the method is worth is measured on the sphere of equal volume ([`super::sphere_check`]). Of other
//! shapes two things are added: what interpolation over azimuth costs, by tracing meridians half-way
//! between those of the set and with twice the knots; and how far sums and patches are from exact
//! series. Waves of which no more is known than that they are wrong by `Δ` change the intensity `|S|²` by
//! `√2 |S||Δ|` on average over their phase.

use super::assignment::Method;
use super::cross_check::disagreement;
use super::direction::Direction;
use super::far_field::{FarField, Source};
use super::sphere_check::{SAMPLES, SphereErrors, band_squares, samples, spread};
use crate::farfield::azimuth::plane_set::{CHECKED_AZIMUTH, PlaneSet};
use crate::optics::AmplitudeMatrix;
use crate::phase_table::{ERROR_BANDS, error_theta};
use crate::trace::Tracer;

/// Bands from 10° to 170° count in the means: without the forward peak and its mirror image.
const COUNTED: std::ops::Range<usize> = 3..43;

/// Relative errors of the intensity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorEstimate {
    /// Root of the sum of squared errors over that of squared intensities, 10° to 170°.
    pub weighted: f64,
    /// Root mean square over bands of 4° from 10° to 170°, each relative to its own intensity.
    pub by_band: f64,
    /// Of each band, about the angles of [`crate::phase_table::error_theta`].
    pub by_direction: [f64; ERROR_BANDS],
    /// Straight back, where a glory may be narrower than its band.
    pub straight_back: f64,
}

impl ErrorEstimate {
    /// Nothing is known.
    pub const UNKNOWN: Self = Self {
        weighted: f64::NAN,
        by_band: f64::NAN,
        by_direction: [f64::NAN; ERROR_BANDS],
        straight_back: f64::NAN,
    };

    /// With means that are no less than this.
    pub fn at_least(self, least: f64) -> Self {
        let most = |error: f64| if error < least { least } else { error };
        Self { weighted: most(self.weighted), by_band: most(self.by_band), ..self }
    }

    /// With independent errors beside its own: weighted by intensity from 10° to 170°, and of each band.
    pub fn and(self, weighted: f64, by_direction: &[f64; ERROR_BANDS]) -> Self {
        let square = COUNTED.map(|band| by_direction[band].powi(2)).sum::<f64>();
        Self {
            weighted: self.weighted.hypot(weighted),
            by_band: self.by_band.hypot((square / COUNTED.len() as f64).sqrt()),
            by_direction: std::array::from_fn(|b| self.by_direction[b].hypot(by_direction[b])),
            ..self
        }
    }

    /// Relative error of the intensity about a scattering angle (radians).
    ///
    /// ```
    /// # use gonio::farfield::ErrorEstimate;
    /// # use gonio::phase_table::ERROR_BANDS;
    /// let mut by_direction = [0.01; ERROR_BANDS];
    /// by_direction[45] = 0.3; // of 178 to 180 degrees
    /// let worth = ErrorEstimate { by_direction, ..ErrorEstimate::UNKNOWN };
    /// assert_eq!(worth.at(179f64.to_radians()), 0.3);
    /// ```
    pub fn at(&self, theta: f64) -> f64 {
        let band = (theta / error_theta(1)).round() as usize;
        self.by_direction[band.min(ERROR_BANDS - 1)]
    }

    /// From squared relative errors and summed squared intensities of the bands; straight back what the sphere
    /// errs by beside what its band does not have from it.
    fn of_bands(
        squares: &[f64; ERROR_BANDS],
        intensities: &[f64; ERROR_BANDS],
        sphere: &SphereErrors,
    ) -> Self {
        let (mut weighted, mut total, mut relative) = (0.0, 0.0, 0.0);
        let last = ERROR_BANDS - 1;
        let beside_sphere = (squares[last] - sphere.squares[last]).max(0.0);
        for band in COUNTED {
            weighted += squares[band] * intensities[band];
            total += intensities[band];
            relative += squares[band].min(1.0);
        }
        Self {
            weighted: (weighted / total).sqrt(),
            by_band: (relative / COUNTED.len() as f64).sqrt(),
            by_direction: squares.map(f64::sqrt),
            straight_back: (sphere.straight_back + beside_sphere).sqrt(),
        }
    }
}

impl FarField<'_> {
    /// The method's own estimate of its error, from those that it has on the sphere of equal volume;
    /// `interference` says how a table adds up its patches, `doubts` by which shares of their amplitudes orders
    /// are known to be wrong, `azimuths` those asked for, at some of which it is measured.
    pub fn error_estimate(
        &self,
        tracer: &Tracer,
        sphere: &SphereErrors,
        interference: bool,
        doubts: &[(u32, f64)],
        azimuths: &[f64],
    ) -> ErrorEstimate {
        let theta = samples();
        let sphere_squares = if tracer.shape().is_sphere() {
            sphere.squares
        } else {
            spread(sphere, self.silhouette().deformation())
        }
        .map(|square| square + sphere.extinction);
        let Source::Planes(planes, fallback) = &self.source else {
            let found = self.patch_intensities(&theta, PATCH_AZIMUTH, true, interference, None);
            return ErrorEstimate::of_bands(&sphere_squares, &band_squares(&found), sphere);
        };
        let azimuths = some_azimuths(azimuths);
        let off = |a: &&f64| (*a - CHECKED_AZIMUTH).abs();
        let nearest = azimuths.iter().min_by(|a, b| off(a).total_cmp(&off(b)));
        let azimuth = nearest.copied().unwrap_or(CHECKED_AZIMUTH);
        let (waves, mut wrong) = fallback.doubted(&theta, azimuth);
        let missed = if tracer.shape().is_sphere() {
            vec![AmplitudeMatrix::default(); theta.len()]
        } else {
            planes.missed(tracer, &theta, azimuth)
        };
        let rays = planes.columns(&theta, &[azimuth]).swap_remove(0);
        let forward = self.forward_wave();
        let amplitudes: Vec<AmplitudeMatrix> = (0..theta.len())
            .map(|i| rays[i] + waves[i] + forward.beside_planes(&Direction::new(theta[i], azimuth)))
            .collect();
        let found: Vec<f64> = amplitudes.iter().map(|s| s.s11()).collect();
        let off: Vec<f64> =
            (0..theta.len()).map(|i| (amplitudes[i] + missed[i]).s11() - found[i]).collect();
        let inside: Vec<f64> = rays.iter().zip(&waves).map(|(r, w)| (*r + *w).s11()).collect();
        for &(order, doubt) in doubts {
            let waves = self.columns_of_order(order, &theta, &[azimuth]).unwrap_or_default();
            let waves = waves.iter().flatten();
            wrong.iter_mut().zip(waves).for_each(|(w, s)| *w += doubt * doubt * s.s11());
        }
        let compared = self.assignment().map(|all| all.cross_checked()).unwrap_or_default();
        if !compared.is_empty() && !azimuths.is_empty() {
            let apart = disagreement(planes, tracer, &compared, &theta, &azimuths);
            wrong.iter_mut().zip(apart).for_each(|(w, apart)| *w += apart);
        }
        let doubt = self.doubt_of_deformation();
        let most =
            if self.planes_in_place_of_waves() { f64::INFINITY } else { self.doubtful(&inside) };
        wrong.iter_mut().zip(&inside).for_each(|(w, s)| *w += doubt * doubt * s.min(most));
        let (intensities, off) = (band_squares(&found), band_squares(&off));
        let squares = std::array::from_fn(|band| {
            let sum = |v: &[f64]| v[band * SAMPLES..(band + 1) * SAMPLES].iter().sum::<f64>();
            sphere_squares[band]
                + (2.0 * sum(&wrong) / sum(&found)).min(1.0)
                + (off[band] / intensities[band]).min(1.0)
        });
        ErrorEstimate::of_bands(&squares, &intensities, sphere)
    }
}

impl FarField<'_> {
    /// Share of their amplitude by which the waves of a small deformed body may be wrong, by whatever
    /// method: what is wrong of its bows and rings stands in all directions, so that where the waves are
    /// brighter than their median it is a share of that.
    fn doubt_of_deformation(&self) -> f64 {
        let deformation = self.silhouette().deformation();
        let by = self.assignment().map(|assignment| assignment.thresholds());
        by.map_or(0.0, |by| by.doubt_of_deformation(self.size_parameter(), deformation))
    }

    /// Brightness up to which waves are doubtful: their median where a body is slightly deformed, more and more up
    /// to their brightest where its bows are no longer those of a sphere.
    fn doubtful(&self, inside: &[f64]) -> f64 {
        let brightest = inside.iter().copied().fold(0.0, f64::max);
        let deformation = self.silhouette().deformation();
        let by = self.assignment().map(|assignment| assignment.thresholds());
        let strange = by.map_or(0.0, |by| (deformation / by.strange_deformation).powi(4).min(1.0));
        median(inside) * (1.0 - strange) + brightest * strange
    }

    /// Whether scattering planes serve transmitted light where partial waves should, since the radial lines
    /// of their rays break off: then the bright directions are as doubtful as the dark ones.
    fn planes_in_place_of_waves(&self) -> bool {
        let Some(assignment) = self.assignment() else { return false };
        let small = self.size_parameter() < assignment.thresholds().partial_waves_below;
        small && assignment.orders_of(Method::Planes).iter().any(|&order| order > 0)
    }
}

/// Some of these azimuths, in [0, π].
fn some_azimuths(azimuths: &[f64]) -> Vec<f64> {
    const MOST: usize = 5;
    let mut all: Vec<f64> = azimuths.iter().map(|phi| phi.cos().acos()).collect();
    all.sort_by(f64::total_cmp);
    all.dedup();
    let step = all.len().div_ceil(MOST).max(1);
    all.into_iter().skip(step / 2).step_by(step).collect()
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(0.0)
}

/// An azimuth off the spokes of patches.
const PATCH_AZIMUTH: f64 = 1.0;

impl PlaneSet<'_> {
    /// What interpolation misses at some scattering angles of an azimuth, all orders together: what it errs by in
    /// phase alone changes the intensity only where waves meet.
    fn missed(&self, tracer: &Tracer, theta: &[f64], azimuth: f64) -> Vec<AmplitudeMatrix> {
        let mut missed = vec![AmplitudeMatrix::default(); theta.len()];
        for [interpolated, traced] in self.checks(tracer, theta, azimuth) {
            for (sum, (a, b)) in missed.iter_mut().zip(interpolated.into_iter().zip(traced)) {
                *sum += b - a;
            }
        }
        missed
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bright_bands_count_in_one_mean_and_all_alike_in_the_other() {
        let (mut squares, mut intensities) = ([0.01; ERROR_BANDS], [1e-6; ERROR_BANDS]);
        (squares[5], intensities[5]) = (0.25, 1e3);
        let sphere = SphereErrors { squares, intensities, straight_back: 4.0, extinction: 0.0 };
        let estimate = ErrorEstimate::of_bands(&squares, &intensities, &sphere);
        assert_eq!(estimate.straight_back, 2.0);
        assert!((estimate.weighted - 0.5).abs() < 1e-6);
        assert!((estimate.by_band - (0.016f64).sqrt()).abs() < 1e-12);
        assert_eq!(estimate.by_direction[5], 0.5);
    }
}
