//! One wavelength of a table by the T-matrix: columns of all azimuths, the forward peak in its cells.

use super::far_field::{Azimuth, Scattered};
use super::matrix::TMatrix;
use crate::phase_table::{Axes, ForwardPeak, Quantity, Slab};
use crate::series::table::{coarse_cells, samples};
use ndarray::{Array2, Array3};
use rayon::prelude::*;
use std::f64::consts::PI;

/// What a slab is made for.
#[derive(Clone, Copy, Debug)]
pub struct TableJob<'a> {
    /// Wavelength in the medium around, metres.
    pub wavelength: f64,
    /// Radius of the sphere of equal volume, metres.
    pub radius: f64,
    pub sun_elevation: f64,
    pub axes: &'a Axes,
    pub quantity: Quantity,
    pub forward_peak: ForwardPeak,
}

/// Mueller elements of a row of azimuths.
type Row = Vec<[f64; 16]>;

impl TableJob<'_> {
    /// The slab; values over the whole sphere close to 1 where the forward peak is averaged.
    pub fn slab(&self, t: &TMatrix) -> Slab {
        let scattered = Scattered::new(t, self.sun_elevation);
        let q = scattered.efficiencies();
        let azimuths: Vec<Azimuth> =
            self.axes.phi.iter().map(|&phi| scattered.azimuth(phi)).collect();
        let theta = &self.axes.theta;
        let mut rows: Vec<Row> =
            theta.par_iter().map(|&theta| row(&scattered, theta, &azimuths)).collect();
        let weights = self.axes.solid_angle();
        let scale = 1.0 / (t.size_parameter().powi(2) * PI * q.q_sca);
        let sum_before_peak = sum(&rows, &weights) * scale;
        if self.forward_peak == ForwardPeak::CellAverage {
            self.average_peak(&scattered, &azimuths, &mut rows, &weights, scale);
        }
        let shape = (self.quantity.elements(), theta.len(), self.axes.phi.len());
        let values = Array3::from_shape_fn(shape, |(e, i, j)| (rows[i][j][e] * scale) as f32);
        let shadow = PI * self.radius * self.radius;
        // an intensity is twice as wrong as its amplitude
        let error = 2.0 * t.error();
        Slab {
            wavelength: self.wavelength,
            index: t.index(),
            values,
            caustic_order: None,
            scattering_cross_section: q.q_sca * shadow,
            extinction_cross_section: q.q_ext * shadow,
            asymmetry: q.asymmetry,
            energy: None,
            sum_before_peak,
            peak_share: 0.0,
            error_estimate: error,
            error_by_band: error,
        }
    }

    /// Means over the cells about the forward direction that are coarser than its lobes.
    fn average_peak(
        &self,
        scattered: &Scattered,
        azimuths: &[Azimuth],
        rows: &mut [Row],
        weights: &Array2<f64>,
        scale: f64,
    ) {
        let cells = coarse_cells(&self.axes.theta, scattered.size_parameter());
        let means: Vec<Row> = cells
            .par_iter()
            .map(|&(low, high)| {
                let (angles, shares) = samples(low, high, scattered.size_parameter());
                let mut mean = vec![[0.0; 16]; azimuths.len()];
                for (&theta, share) in angles.iter().zip(&shares) {
                    let fine = row(scattered, theta, azimuths);
                    let to = mean.iter_mut().flatten();
                    to.zip(fine.iter().flatten()).for_each(|(to, from)| *to += share * from);
                }
                mean
            })
            .collect();
        let count = means.len();
        rows[..count].clone_from_slice(&means);
        if count > 0 && self.axes.cover_sphere() {
            let peak = sum(&rows[..count], weights) * scale;
            let rest = sum(rows, weights) * scale - peak;
            let factor = ((1.0 - rest) / peak).clamp(0.5, 2.0);
            rows[..count].iter_mut().flatten().flatten().for_each(|value| *value *= factor);
        }
    }
}

fn row(scattered: &Scattered, theta: f64, azimuths: &[Azimuth]) -> Row {
    let flat = |matrix: [[f64; 4]; 4]| {
        let mut out = [0.0; 16];
        out.iter_mut().zip(matrix.iter().flatten()).for_each(|(to, from)| *to = *from);
        out
    };
    scattered.amplitudes(theta, azimuths).iter().map(|s| flat(s.mueller())).collect()
}

/// Σ of the first element times solid angle.
fn sum(rows: &[Row], weights: &Array2<f64>) -> f64 {
    rows.iter()
        .enumerate()
        .map(|(i, row)| -> f64 {
            row.iter().enumerate().map(|(j, m)| m[0] * weights[[i, j]]).sum()
        })
        .sum()
}
