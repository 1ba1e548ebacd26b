//! From spectra per direction to XYZ per direction.

use super::directions::DirectionGrid;
use crate::color::{ColorError, ColorWeights, Illuminant, LimbDarkening, Observer};
use crate::math::parallel::*;
use crate::phase_table::{Axes, PhaseTable};
use crate::sun_disc::smooth_over_sun;

/// XYZ (in sr⁻¹: 1 would be the illuminant's white) over the directions of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Tristimulus {
    /// Directions of the values.
    pub grid: DirectionGrid,
    /// θ-major.
    pub xyz: Vec<[f32; 3]>,
}

impl Tristimulus {
    /// XYZ of one Mueller element (0 for `phase_function`) of a table. With `mu`, the light is
    /// that of the ring of the sun's disc at this heliocentric cosine.
    ///
    /// # Errors
    /// [`ColorError`] when the table's wavelengths make no colour.
    pub fn of_table(
        table: &PhaseTable,
        element: usize,
        illuminant: Illuminant,
        observer: Observer,
        mu: Option<f64>,
    ) -> Result<Self, ColorError> {
        let axes = &table.header.axes;
        let weights = ColorWeights::new(&axes.wavelength, illuminant, observer)?;
        let grid = DirectionGrid::new(axes);
        let mut xyz = vec![[0.0_f32; 3]; grid.len()];
        for (slab, weight) in table.slabs.iter().zip(&weights.weights) {
            let limb = mu.map_or(1.0, |mu| LimbDarkening::at(slab.wavelength).brightness(mu));
            let weight = weight.map(|w| (w * limb) as f32);
            let values = slab.values.index_axis(ndarray::Axis(0), element);
            for (sum, &value) in xyz.iter_mut().zip(values) {
                for c in 0..3 {
                    sum[c] += weight[c] * value;
                }
            }
        }
        Ok(Self { grid, xyz })
    }

    /// XYZ of one element of a table without azimuth dependence, averaged over the sun's disc, on
    /// angles 0.05° apart.
    ///
    /// # Errors
    /// [`ColorError`] when the table's wavelengths make no colour.
    pub fn smoothed(
        table: &PhaseTable,
        element: usize,
        illuminant: Illuminant,
        observer: Observer,
        sun_radius: f64,
    ) -> Result<Self, ColorError> {
        let axes = &table.header.axes;
        let (from, to) = (axes.theta[0], axes.theta[axes.theta.len() - 1]);
        let count = ((to - from) / 0.05_f64.to_radians()).ceil().max(1.0) as usize;
        let theta: Vec<f64> =
            (0..=count).map(|i| from + (to - from) * i as f64 / count as f64).collect();
        let xyz = rotational_xyz(table, element, illuminant, observer, sun_radius, &theta)?;
        let axes = Axes { wavelength: Vec::new(), theta, phi: vec![0.0] };
        let xyz = xyz.into_iter().map(|v| v.map(|c| c as f32)).collect();
        Ok(Self { grid: DirectionGrid::new(&axes), xyz })
    }

    /// XYZ in a direction (radians), where the table reaches.
    pub fn at(&self, theta: f64, phi: f64) -> Option<[f64; 3]> {
        let corners = self.grid.corners(theta, phi)?;
        let mut xyz = [0.0; 3];
        for (index, weight) in corners {
            for (sum, &value) in xyz.iter_mut().zip(&self.xyz[index]) {
                *sum += weight * f64::from(value);
            }
        }
        Some(xyz)
    }

    /// Mean over the directions of the sun's disc around (θ, φ), rings weighted alike (build one
    /// per ring with `mu` for limb darkening). Directions beyond the table are left out.
    #[cfg(feature = "pictures")]
    pub fn over_disc(&self, disc: &crate::sun_disc::DiscPoints, theta: f64, phi: f64) -> [f64; 3] {
        let (mut sum, mut count) = ([0.0; 3], 0.0);
        for ring in 0..disc.ring.len() {
            for (t, p) in disc.around(ring, theta, phi) {
                if let Some(xyz) = self.at(t, p) {
                    (0..3).for_each(|c| sum[c] += xyz[c]);
                    count += 1.0;
                }
            }
        }
        sum.map(|v| v / f64::max(count, 1.0))
    }
}

/// XYZ of a table without azimuth dependence, averaged over the sun's disc wavelength by
/// wavelength, at the angles `out` (radians).
///
/// # Errors
/// [`ColorError`] when the table's wavelengths make no colour.
pub fn rotational_xyz(
    table: &PhaseTable,
    element: usize,
    illuminant: Illuminant,
    observer: Observer,
    sun_radius: f64,
    out: &[f64],
) -> Result<Vec<[f64; 3]>, ColorError> {
    let axes = &table.header.axes;
    let weights = ColorWeights::new(&axes.wavelength, illuminant, observer)?;
    let curves: Vec<Vec<f64>> = table
        .slabs
        .par_iter()
        .map(|slab| {
            let values = slab.values.index_axis(ndarray::Axis(0), element);
            let curve: Vec<f64> = values.column(0).iter().map(|&v| f64::from(v)).collect();
            smooth_over_sun(&axes.theta, &curve, slab.wavelength, sun_radius, out)
        })
        .collect();
    let mut xyz = vec![[0.0; 3]; out.len()];
    for (curve, weight) in curves.iter().zip(&weights.weights) {
        for (sum, value) in xyz.iter_mut().zip(curve) {
            for c in 0..3 {
                sum[c] += weight[c] * value;
            }
        }
    }
    Ok(xyz)
}
