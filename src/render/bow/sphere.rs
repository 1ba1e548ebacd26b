//! One sphere of a picture by Lorenz–Mie.

use super::error::BowError;
use crate::lee::Beats;
use crate::lee::sampling::{Sampling, SamplingNeed};
use crate::math::parallel::*;
use crate::medium::Medium;
use crate::optics::AmplitudeMatrix;
use crate::phase_table::{Axes, PhaseTable, Quantity, Slab, TableHeader};
use crate::series::lorenz_mie::Sphere;
use ndarray::Array3;
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

/// Of the wavelengths of a Lee diagram, which shows a single size at single angles, every third, and no more
/// than so many: the picture's time.
const EVERY: usize = 3;
const MOST: usize = 300;
/// Scattering angles, degrees; nearer to the sun nobody looks.
const FROM: f64 = 2.0;

/// A sphere by Lorenz–Mie from a least scattering angle (radians) on, sampled so that its ripple averages out over the
/// sun's disc.
pub(super) fn sphere(
    medium: &Medium,
    radius: f64,
    quantity: Quantity,
    least: f64,
) -> Result<PhaseTable, BowError> {
    let (from, to) = (FROM.to_radians().max(least), PI);
    let sampling = Sampling::new(&SamplingNeed {
        radius,
        index: medium.index(550e-9)?.re,
        sun_disc: true,
        beats: Beats::All,
        size_spread: 0.0,
        angles: (from, to),
        fineness: 1.0,
    });
    let step = sampling.finest_step.max(2e-4);
    let count = ((to - from) / step).ceil() as usize;
    let theta: Vec<f64> =
        (0..=count).map(|i| from + (to - from) * i as f64 / count as f64).collect();
    let stride = sampling.wavelengths.len().div_ceil(MOST).max(EVERY);
    let mut wavelength: Vec<f64> = sampling.wavelengths.into_iter().step_by(stride).collect();
    wavelength.sort_by(f64::total_cmp);
    mie_table(medium, radius, wavelength, theta, quantity)
}

/// The table of a sphere by Lorenz–Mie (metres, radians).
fn mie_table(
    medium: &Medium,
    radius: f64,
    wavelength: Vec<f64>,
    theta: Vec<f64>,
    quantity: Quantity,
) -> Result<PhaseTable, BowError> {
    let slabs = wavelength
        .par_iter()
        .map(|&w| {
            let index = medium.index(w)?;
            let solved = Sphere::new(TAU * radius / w, index)?;
            Ok(slab(&solved, radius, w, index, &theta, quantity))
        })
        .collect::<Result<Vec<_>, BowError>>()?;
    let axes = Axes { wavelength, theta, phi: vec![0.0] };
    let header = TableHeader::of_sphere(radius, axes, quantity);
    Ok(PhaseTable { header, slabs })
}

fn slab(
    solved: &Sphere,
    radius: f64,
    wavelength: f64,
    index: Complex64,
    theta: &[f64],
    quantity: Quantity,
) -> Slab {
    let q = solved.efficiencies();
    let area = PI * radius * radius;
    let scale = (wavelength / TAU).powi(2) / (q.q_sca * area);
    let amplitudes = solved.amplitudes(theta);
    let shape = (quantity.elements(), theta.len(), 1);
    let values = Array3::from_shape_fn(shape, |(element, t, _)| {
        let (s1, s2) = amplitudes[t];
        let matrix = AmplitudeMatrix { s1, s2, ..Default::default() };
        let value = match quantity {
            Quantity::PhaseFunction => matrix.s11(),
            Quantity::Mueller => matrix.mueller()[element / 4][element % 4],
        };
        (scale * value) as f32
    });
    let sections = [q.q_sca * area, q.q_ext * area];
    Slab::plain((wavelength, index), values, sections, q.asymmetry).with_error(1e-10)
}
