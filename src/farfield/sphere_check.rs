//! What a ray method is worth, measured: the same method on the sphere of equal volume against the exact
//! series.
//!
//! Everything that rays miss is in the difference: next terms of the uniform formulas, edges of the lit
//! side, orders left out, glory, critical angle, soft particles, the grid of the patches and what a
//! filter makes of bows. Of a sphere it is the error; of other shapes the bows lie elsewhere, so that a
//! band shares with its neighbours as far as the outline is deformed. Where the sphere is too large for
//! the series a smaller one with the same absorption along its diameter speaks for it: no error of the
//! method grows with the size. With a list of orders the truth are their Debye terms, else Lorenz–Mie.

use super::assignment::{Assignment, Outcome, Thresholds};
use super::far_field::FarField;
use super::patches::sheets;
use super::settings::FarFieldSettings;
use crate::phase_table::{ERROR_BANDS, error_theta};
use crate::series::SeriesError;
use crate::series::debye::{DebyeSeries, Term};
use crate::series::lorenz_mie::Sphere;
use crate::shape::Shape;
use crate::trace::{Tracer, Wavefront};
use num_complex::Complex64;
use std::f64::consts::PI;

/// Scattering angles looked at in each band: many fringes, of which the mean square counts.
pub(super) const SAMPLES: usize = 40;
/// Half the width of a band, radians.
const HALF_BAND: f64 = 0.5 * PI / (ERROR_BANDS - 1) as f64;
/// Spokes of the patch grid at most: see [`off_spoke`].
const SPOKES: usize = 96;

/// A method on the sphere of equal volume.
#[derive(Clone, Debug)]
pub struct SphereCheck<'a> {
    /// Index of the particle.
    pub index: Complex64,
    /// Circumference of the sphere over the wavelength.
    pub size_parameter: f64,
    /// Orders (chords) that the method sums.
    pub orders: &'a [u32],
    /// Whether these are all that matter: then the truth is Lorenz–Mie.
    pub complete: bool,
    /// Whether forward diffraction is part of it.
    pub diffraction: bool,
    /// Whether a table leaves it out, peak and tails, so that it misses them beyond the peak.
    pub peak_apart: bool,
    /// Relative error asked for.
    pub tolerance: f64,
    /// What is judged.
    pub method: CheckedMethod,
    /// By which methods are chosen, and how large the sphere may be.
    pub thresholds: Thresholds,
}

/// How amplitudes are found, and what is made of them.
#[derive(Clone, Debug, PartialEq)]
pub enum CheckedMethod {
    /// Meridians; small deformed particles have partial waves in their place.
    Meridians {
        /// Whether the particle is no body of revolution about the light.
        deformed: bool,
        /// Orders that scattering planes serve.
        by_planes: Vec<u32>,
    },
    /// Patches; without interference means over bands are compared.
    Patches {
        /// Rings of the grid.
        rings: usize,
        /// Whether amplitudes add, or intensities.
        interference: bool,
        /// Standard deviation of the Gaussian filter, radians.
        filter: Option<f64>,
    },
}

/// What a method errs by on the sphere of equal volume.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphereErrors {
    /// Squared relative error of the intensity in each band.
    pub squares: [f64; ERROR_BANDS],
    /// Sum of the squared intensities (`S11`) that the sphere has at the samples of each band.
    pub intensities: [f64; ERROR_BANDS],
    /// Squared relative error of the intensity straight back, where a glory may be narrower than its band.
    pub straight_back: f64,
    /// Squared relative error of the extinction of a list of orders with diffraction, by which P is normalised;
    /// 0 where all that matters is summed, which is checked otherwise.
    pub extinction: f64,
}

/// Scattering angles in the bands, ascending; steps of an irrational ratio, so that no sample keeps to
/// the knots of an interpolation.
pub(super) fn samples() -> Vec<f64> {
    let band = |band| {
        let place = |k: usize| {
            let offset = ((k as f64 + 0.5) * 0.618_033_988_749_895).fract();
            let theta = (error_theta(band) + (2.0 * offset - 1.0) * HALF_BAND).abs();
            theta.min(2.0 * PI - theta)
        };
        let mut angles: Vec<f64> = (0..SAMPLES).map(place).collect();
        angles.sort_by(f64::total_cmp);
        angles
    };
    (0..ERROR_BANDS).flat_map(band).collect()
}

impl SphereCheck<'_> {
    /// Errors in each band, and the light that they are relative to.
    ///
    /// # Errors
    /// What the series refuse.
    pub fn errors(&self) -> Result<SphereErrors, SeriesError> {
        let mut theta = samples();
        theta.extend([PI, 0.0]);
        let exact = self.exact(&theta)?;
        let (found, found_ahead) = self.found(&theta[..theta.len() - 1]);
        let exact_ahead = exact.last().map_or(f64::NAN, |(s1, s2)| (s1 + s2).re);
        let exact: Vec<f64> =
            exact.iter().map(|(s1, s2)| 0.5 * (s1.norm_sqr() + s2.norm_sqr())).collect();
        let by_means = matches!(self.method, CheckedMethod::Patches { interference: false, .. });
        let squares = std::array::from_fn(|band| {
            let of = |v: &[f64]| v[band * SAMPLES..(band + 1) * SAMPLES].to_vec();
            let (found, exact) = (of(&found), of(&exact));
            if by_means {
                let (found, exact): (f64, f64) = (found.iter().sum(), exact.iter().sum());
                return (found / exact - 1.0).powi(2);
            }
            let off: f64 = found.iter().zip(&exact).map(|(f, e)| (f - e).powi(2)).sum();
            off / exact.iter().map(|e| e * e).sum::<f64>()
        });
        // rays are brighter on a larger sphere as its area is
        let larger = (self.size_parameter / self.sphere().0).powi(4);
        let intensities = band_squares(&exact).map(|sum| sum * larger);
        let back = found.len() - 1;
        let straight_back = (found[back] / exact[back] - 1.0).powi(2);
        let part = self.diffraction && !self.peak_apart && !self.complete;
        let ahead = found_ahead.filter(|_| part);
        let extinction = ahead.map_or(0.0, |ahead| (ahead / exact_ahead - 1.0).powi(2));
        Ok(SphereErrors { squares, intensities, straight_back, extinction })
    }

    /// Size parameter and index of the sphere that is computed.
    fn sphere(&self) -> (f64, Complex64) {
        let x = self.size_parameter.min(self.thresholds.largest_checked_sphere);
        (x, Complex64::new(self.index.re, self.index.im * self.size_parameter / x))
    }

    fn exact(&self, theta: &[f64]) -> Result<Vec<(Complex64, Complex64)>, SeriesError> {
        let (x, index) = self.sphere();
        Ok(if self.complete {
            Sphere::new(x, index)?.amplitudes_parallel(theta)
        } else {
            let orders = self.orders.iter().map(|&order| Term::Order(order));
            let terms: Vec<Term> =
                orders.chain(self.diffraction.then_some(Term::Diffraction)).collect();
            DebyeSeries::new(x, index)?.sum_parallel(&terms, theta)
        })
    }

    /// Intensities, and the real part of `S1 + S2` straight ahead where there are amplitudes.
    fn found(&self, theta: &[f64]) -> (Vec<f64>, Option<f64>) {
        let (x, index) = self.sphere();
        let diffraction = self.diffraction && !self.peak_apart;
        let shape = Shape::sphere();
        let last = self.orders.iter().copied().max().unwrap_or(0);
        let tracer = Tracer::new(&shape, index, x, last);
        match &self.method {
            CheckedMethod::Meridians { deformed, by_planes } => {
                let tracer = tracer.with_curved_interface(x);
                let settings = FarFieldSettings {
                    size_parameter: x,
                    orders: self.orders,
                    tolerance: self.tolerance,
                    diffraction: diffraction && self.orders.contains(&0),
                };
                let (numbers, by) = ([x, self.tolerance], &self.thresholds);
                let assignment = Assignment::as_if(*deformed, &tracer, self.orders, numbers, by)
                    .after(Outcome::RadialLines(by_planes));
                let far_field = FarField::assigned(&tracer, &settings, assignment);
                let directions: Vec<(f64, f64)> =
                    theta.iter().chain(&[0.0]).map(|&t| (t, 0.0)).collect();
                let mut amplitudes = far_field.scatter(&directions, diffraction);
                let ahead = amplitudes.pop().map(|s| (s.s1 + s.s2).re);
                (amplitudes.iter().map(|s| s.s11()).collect(), ahead)
            }
            &CheckedMethod::Patches { rings, interference, filter } => {
                let spokes = (2 * rings).min(SPOKES);
                let wavefront = Wavefront::corners(&shape, rings, spokes, 0.0);
                let sheets = sheets::sheets(&tracer, &wavefront, self.orders);
                let far_field = FarField::patches(&shape, sheets, x);
                let azimuth = off_spoke(2 * rings, spokes);
                let found =
                    far_field.patch_intensities(theta, azimuth, diffraction, interference, filter);
                (found, None)
            }
        }
    }
}

/// An azimuth at which a grid of fewer spokes errs as one of `all` spokes does on average: the error of a
/// linear interpolation over azimuth is `f(1 - f)` of the squared step, whose mean over a step is a sixth.
fn off_spoke(all: usize, spokes: usize) -> f64 {
    let fewer = all as f64 / spokes as f64;
    let share = 0.5 - (0.25 - 1.0 / (6.0 * fewer * fewer)).sqrt();
    share * 2.0 * PI / spokes as f64
}

/// Sums of squared intensities by band.
pub(super) fn band_squares(found: &[f64]) -> [f64; ERROR_BANDS] {
    std::array::from_fn(|band| {
        found[band * SAMPLES..(band + 1) * SAMPLES].iter().map(|s| s * s).sum()
    })
}

/// Squared relative errors where bows move about the azimuth, by about twice the deformation of the outline: what
/// a band and its neighbours miss together, over the light that they have together. What a dark neighbour
/// misses is little beside the light of a bright one.
pub(super) fn spread(sphere: &SphereErrors, deformation: f64) -> [f64; ERROR_BANDS] {
    let reach = (deformation / HALF_BAND).round() as usize;
    std::array::from_fn(|band| {
        let near = band.saturating_sub(reach)..(band + reach + 1).min(ERROR_BANDS);
        let missed: f64 = near.clone().map(|i| sphere.squares[i] * sphere.intensities[i]).sum();
        missed / sphere.intensities[near].iter().sum::<f64>()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_fill_the_bands() {
        let theta = samples();
        assert_eq!(theta.len(), SAMPLES * ERROR_BANDS);
        for (k, t) in theta.iter().enumerate() {
            assert!((t - error_theta(k / SAMPLES)).abs() < HALF_BAND + 1e-12);
        }
    }

    #[test]
    fn a_grid_of_all_spokes_is_looked_at_where_it_errs_on_average() {
        let f = off_spoke(10, 10) * 10.0 / (2.0 * PI);
        assert!((f * (1.0 - f) - 1.0 / 6.0).abs() < 1e-12);
    }

    #[test]
    fn neighbours_share_where_the_outline_is_deformed() {
        let [squares, intensities] = [[0.0; ERROR_BANDS], [1.0; ERROR_BANDS]];
        let mut sphere = SphereErrors { squares, intensities, straight_back: 0.0, extinction: 0.0 };
        sphere.squares[20] = 0.9;
        assert_eq!(spread(&sphere, 0.0), sphere.squares);
        let shared = spread(&sphere, 2.0 * HALF_BAND);
        assert!((shared[18] - 0.18).abs() < 1e-12 && shared[17] == 0.0);
        // a band a thousand times as bright does not mind what its neighbour misses
        sphere.intensities[19] = 1e6;
        assert!(spread(&sphere, 2.0 * HALF_BAND)[19] < 1e-6);
    }
}
