//! One wavelength of a scene by the T-matrix.

use crate::medium::Light;
use crate::phase_table::{Axes, Slab};
use crate::plan::{Plan, amplitude_tolerance};
use crate::scene::{Orientation, Scene};
use crate::series::tmatrix::{TMatrix, TMatrixError, TableJob};
use std::f64::consts::TAU;

pub(super) fn slab(
    scene: &Scene,
    plan: &Plan,
    Light { wavelength, index }: Light,
) -> Result<Slab, TMatrixError> {
    let size_parameter = TAU * plan.radius / wavelength;
    let tolerance = amplitude_tolerance(scene.tolerance);
    let t = TMatrix::new(&plan.shape, size_parameter, index, tolerance)?;
    let azimuths = plan.table_azimuths(&scene.phi);
    let (computed, places) = plan.computed_azimuths(&azimuths);
    let axes = Axes { wavelength: vec![wavelength], theta: scene.theta.clone(), phi: azimuths };
    let job = TableJob {
        wavelength,
        radius: plan.radius,
        sun_elevation: scene.sun_elevation,
        axes: &axes,
        computed: &computed,
        places: &places,
        quantity: scene.quantity,
        forward_peak: scene.forward_peak,
        tolerance: scene.tolerance,
    };
    match scene.orientation {
        Orientation::Random if !plan.shape.is_sphere() => Ok(job.random_slab(&t)?),
        _ => Ok(job.slab(&t)),
    }
}
