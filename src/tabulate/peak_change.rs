//! What closing a table's sum changes about the forward peak: a deficit of the whole table is given to the peak,
//! and what is given may be as wrong as what was missed.

use crate::math::parallel::*;
use crate::phase_table::{Axes, ERROR_BANDS, error_theta};
use ndarray::{ArrayView2, Axis};
use std::f64::consts::PI;

/// Relative changes of the intensity, root mean square.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PeakChange {
    /// Over that of squared intensities from 10° to 170°.
    pub weighted: f64,
    /// Of each band, about the angles of [`error_theta`].
    pub by_direction: [f64; ERROR_BANDS],
}

impl PeakChange {
    /// Nothing was closed.
    pub const NONE: Self = Self { weighted: 0.0, by_direction: [0.0; ERROR_BANDS] };

    /// From the rows of the cells as they were and all values (θ, φ) as they are.
    pub fn new(axes: &Axes, before: ArrayView2<f64>, after: ArrayView2<f32>) -> Self {
        let (by_angle, by_azimuth) = axes.solid_angle_factors();
        let square = |values: &mut dyn Iterator<Item = f64>| -> f64 {
            values.zip(&by_azimuth).map(|(value, weight)| weight * value * value).sum()
        };
        let all: Vec<f64> = (after.axis_iter(Axis(0)).into_par_iter())
            .map(|row| square(&mut row.iter().map(|&value| f64::from(value))))
            .collect();
        let changed = |i: usize| {
            let row = before.row(i);
            square(&mut row.iter().zip(after.row(i)).map(|(old, &new)| f64::from(new) - old))
        };
        let (mut bands, mut means) = ([[0.0; 2]; ERROR_BANDS], [0.0; 2]);
        for (i, theta) in axes.theta.iter().enumerate() {
            let changed = if i < before.nrows() { changed(i) } else { 0.0 };
            let band = ((theta / error_theta(1)).round() as usize).min(ERROR_BANDS - 1);
            let counts = (PI / 18.0..=17.0 * PI / 18.0).contains(theta);
            for (k, sum) in [changed, all[i]].into_iter().enumerate() {
                bands[band][k] += by_angle[i] * sum;
                means[k] += if counts { by_angle[i] * sum } else { 0.0 };
            }
        }
        let ratio = |[changed, all]: [f64; 2]| if all > 0.0 { (changed / all).sqrt() } else { 0.0 };
        Self { weighted: ratio(means), by_direction: bands.map(ratio) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ndarray::Array2;

    #[test]
    fn changes_are_those_of_the_cells() {
        let theta: Vec<f64> = (0..=180).map(|i| f64::from(i).to_radians()).collect();
        let axes = Axes { wavelength: vec![1e-6], theta, phi: vec![0.0, 2.0, 4.0] };
        let after = Array2::from_shape_fn((181, 3), |(i, _)| if i < 12 { 4.0f32 } else { 1.0 });
        let before = after.slice(ndarray::s![..12, ..]).mapv(|value| f64::from(value) / 1.25);
        let change = PeakChange::new(&axes, before.view(), after.view());
        assert!((change.by_direction[0] - 0.2).abs() < 1e-9);
        // one of the five angles of the band at 12 degrees is of a cell
        assert!(change.by_direction[3] > 0.1 && change.by_direction[3] < 0.2);
        assert_eq!(change.by_direction[4], 0.0);
        assert!(change.weighted > 0.0 && change.weighted < 0.1);
    }
}
