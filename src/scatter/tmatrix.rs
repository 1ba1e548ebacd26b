//! Bodies of revolution by the T-matrix.

use super::{Request, Scattering};
use crate::farfield::ErrorEstimate;
use crate::phase_table::ERROR_BANDS;
use crate::series::tmatrix::{Scattered, Sections, StatedError, TMatrix, TMatrixError};
use crate::shape::Shape;

/// A body of revolution, its axis where the shape has it, by the T-matrix.
///
/// # Errors
/// A body, a size or a tolerance that the T-matrix does not serve.
pub fn t_matrix(request: &Request, shape: &Shape) -> Result<Scattering, TMatrixError> {
    let t = TMatrix::new(shape, request.size_parameter, request.index, request.tolerance)?;
    let scattered = Scattered::new(&t, shape.sun_elevation());
    let directions: Vec<(f64, f64)> =
        request.theta.iter().map(|&theta| (theta, request.azimuth)).collect();
    let q = scattered.efficiencies();
    let sections = Sections::new(&q, &t);
    let StatedError { weighted, by_band, by_direction } =
        StatedError::of_fixed(&t, &scattered).at_least(sections.lost);
    let straight_back = by_direction[ERROR_BANDS - 1];
    Ok(Scattering {
        amplitudes: scattered.directions(&directions),
        efficiencies: sections.efficiencies(&q),
        diffraction_included: true,
        remainder: None,
        worth: Some(ErrorEstimate { weighted, by_band, by_direction, straight_back }),
        bows: Vec::new(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scatter::lorenz_mie;

    /// A sphere by the general path is Lorenz–Mie's, by whatever axis.
    #[test]
    fn a_sphere_is_lorenz_mie() {
        let request = Request {
            size_parameter: 12.0,
            index: num_complex::Complex64::new(1.4, 0.02),
            theta: (0..=18).map(|i| f64::from(10 * i).to_radians()).collect(),
            azimuth: 0.7,
            tolerance: 1e-6,
        };
        let known = lorenz_mie(&request).unwrap();
        let found = t_matrix(&request, &Shape::spheroid(1.0, 0.6).unwrap()).unwrap();
        let scale = known.amplitudes[0].s1.norm();
        for (a, b) in found.amplitudes.iter().zip(&known.amplitudes) {
            let off = (*a - *b).s11().sqrt();
            assert!(off < 1e-10 * scale, "{off:e} of {scale}");
        }
        let (a, b) = (found.efficiencies, known.efficiencies);
        assert!((a.q_abs / b.q_abs - 1.0).abs() < 1e-9 && (a.q_ext / b.q_ext - 1.0).abs() < 1e-10);
        assert!(found.worth.unwrap().weighted < 1e-6);
    }
}
