//! Spectrum to XYZ: the weights of a spectrum's own wavelengths.
//!
//! The integral is linear in the spectrum, so it is folded once into one weight per wavelength
//! ([`ColorWeights`]); a colour is then a dot product, however many spectra share the axis.

use super::tabulated::bracket;
use super::{ColorError, Illuminant, Observer};

/// A colour needs the spectrum from here …
const VISIBLE_FROM: f64 = 420e-9;
/// … to here; 97 % of D65's luminance and of the sum of the three stimuli lie in between.
const VISIBLE_TO: f64 = 660e-9;
/// Widest step between neighbours for which linear interpolation of a bow still gives a colour.
const LARGEST_STEP: f64 = 60e-9;

/// Weights that turn values at fixed wavelengths into XYZ.
#[derive(Clone, Debug, PartialEq)]
pub struct ColorWeights {
    /// One triple per wavelength, in the caller's order; the Y weights sum to 1.
    pub weights: Vec<[f64; 3]>,
}

impl ColorWeights {
    /// Weights for spectra given at `wavelengths` (metres, any order, irregular allowed): linear
    /// interpolation between them, summed on a 1 nm grid.
    ///
    /// # Errors
    /// [`ColorError`] when the wavelengths do not cover the visible or leave a wide gap in it.
    pub fn new(
        wavelengths: &[f64],
        illuminant: Illuminant,
        observer: Observer,
    ) -> Result<Self, ColorError> {
        check_coverage(wavelengths)?;
        Ok(Self::with_step(wavelengths, illuminant, observer, 1))
    }

    /// The same on a coarser grid of `step_nm` nanometres, without the check on coverage: the sum
    /// over a measured spectrum's own 5 nm nodes, as ASTM E308 tabulates it.
    pub fn with_step(
        wavelengths: &[f64],
        illuminant: Illuminant,
        observer: Observer,
        step_nm: usize,
    ) -> Self {
        let mut order: Vec<usize> = (0..wavelengths.len()).collect();
        order.sort_by(|&i, &j| wavelengths[i].total_cmp(&wavelengths[j]));
        let axis: Vec<f64> = order.iter().map(|&i| wavelengths[i]).collect();

        let mut weights = vec![[0.0; 3]; wavelengths.len()];
        let mut luminance = 0.0;
        for (wavelength, stimulus) in stimuli(illuminant, observer, step_nm) {
            let (low, fraction) = bracket(&axis, wavelength);
            let high = order[(low + 1).min(axis.len() - 1)];
            for c in 0..3 {
                weights[order[low]][c] += (1.0 - fraction) * stimulus[c];
                weights[high][c] += fraction * stimulus[c];
            }
            luminance += stimulus[1];
        }
        for weight in &mut weights {
            *weight = weight.map(|w| w / luminance);
        }
        Self { weights }
    }

    /// Weights of a quadrature of one's own: each wavelength (metres) stands for an interval of
    /// the given width. For spectra with ripple that no 1 nm grid resolves.
    pub fn quadrature(
        wavelengths: &[f64],
        widths: &[f64],
        illuminant: Illuminant,
        observer: Observer,
    ) -> Self {
        let mut weights: Vec<[f64; 3]> = wavelengths
            .iter()
            .zip(widths)
            .map(|(&w, width)| observer.matching(w).map(|m| m * width * illuminant.power(w)))
            .collect();
        let luminance: f64 = weights.iter().map(|w| w[1]).sum();
        for weight in &mut weights {
            *weight = weight.map(|w| w / luminance);
        }
        Self { weights }
    }

    /// XYZ of one spectrum; `values` in the order of the wavelengths.
    pub fn xyz(&self, values: impl IntoIterator<Item = f64>) -> [f64; 3] {
        let mut xyz = [0.0; 3];
        for (weight, value) in self.weights.iter().zip(values) {
            for c in 0..3 {
                xyz[c] += weight[c] * value;
            }
        }
        xyz
    }
}

/// XYZ of `values` at `wavelengths` (metres) under an illuminant; 1 everywhere gives `Y = 1`.
///
/// # Errors
/// [`ColorError`] as [`ColorWeights::new`], or when the two lengths differ.
pub fn spectrum_to_xyz(
    wavelengths: &[f64],
    values: &[f64],
    illuminant: Illuminant,
    observer: Observer,
) -> Result<[f64; 3], ColorError> {
    if wavelengths.len() != values.len() {
        return Err(ColorError::Length { wavelengths: wavelengths.len(), values: values.len() });
    }
    let weights = ColorWeights::new(wavelengths, illuminant, observer)?;
    Ok(weights.xyz(values.iter().copied()))
}

/// XYZ of the illuminant itself, `Y = 1`.
pub fn illuminant_white(illuminant: Illuminant, observer: Observer) -> [f64; 3] {
    ColorWeights::with_step(&[560e-9], illuminant, observer, 1).weights[0]
}

/// Illuminant times matching functions on a grid over the range that both cover.
fn stimuli(
    illuminant: Illuminant,
    observer: Observer,
    step_nm: usize,
) -> impl Iterator<Item = (f64, [f64; 3])> {
    let ((eye_from, eye_to), (lamp_from, lamp_to)) = (observer.range(), illuminant.range());
    let from = (eye_from.max(lamp_from) * 1e9).round() as usize;
    let to = (eye_to.min(lamp_to) * 1e9).round() as usize;
    (from..=to).step_by(step_nm).map(move |nm| {
        let wavelength = nm as f64 * 1e-9;
        let power = illuminant.power(wavelength);
        (wavelength, observer.matching(wavelength).map(|m| m * power))
    })
}

/// Refuse a spectrum that says nothing about part of the visible.
fn check_coverage(wavelengths: &[f64]) -> Result<(), ColorError> {
    let mut axis = wavelengths.to_vec();
    axis.sort_by(f64::total_cmp);
    let nm = |w: f64| (w * 1e12).round() * 1e-3;
    let (from, to) = match (axis.first(), axis.last()) {
        (Some(&from), Some(&to)) => (from, to),
        _ => (f64::NAN, f64::NAN),
    };
    let covered = from <= VISIBLE_FROM * (1.0 + 1e-9) && to >= VISIBLE_TO * (1.0 - 1e-9);
    if !covered {
        return Err(ColorError::NotVisible {
            from_nm: nm(from),
            to_nm: nm(to),
            needed_from_nm: nm(VISIBLE_FROM),
            needed_to_nm: nm(VISIBLE_TO),
        });
    }
    for pair in axis.windows(2) {
        let inside = pair[1] > VISIBLE_FROM && pair[0] < VISIBLE_TO;
        if inside && pair[1] - pair[0] > LARGEST_STEP * (1.0 + 1e-9) {
            return Err(ColorError::Gap {
                from_nm: nm(pair[0]),
                to_nm: nm(pair[1]),
                largest_nm: nm(LARGEST_STEP),
            });
        }
    }
    Ok(())
}
