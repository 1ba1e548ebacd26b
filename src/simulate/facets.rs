//! One wavelength of a scene by the beams of a crystal.

use crate::facets::beams::Incidence;
use crate::facets::table::{TableJob, azimuths};
use crate::medium::Light;
use crate::phase_table::{Axes, Slab};
use crate::plan::{Plan, PlanError, stand};
use crate::scene::Scene;
use std::f64::consts::TAU;

pub(super) fn slab(
    scene: &Scene,
    plan: &Plan,
    wavelength: f64,
    light: Light,
) -> Result<Slab, PlanError> {
    let body = plan.crystal.as_ref().ok_or(PlanError::FacetsNeedCrystal)?;
    let size_parameter = TAU * plan.radius / light.wavelength;
    let table = plan.table_azimuths(&scene.phi);
    let (computed, places) = plan.computed_azimuths(&table);
    let axes = Axes { wavelength: vec![wavelength], theta: scene.theta.clone(), phi: table };
    let light = Incidence { index: light.index, size_parameter };
    let azimuths = azimuths(stand(scene), &computed);
    let job = TableJob {
        request: plan.crystal_request(scene, body, light, &scene.theta, azimuths),
        wavelength,
        radius: plan.radius,
        axes: &axes,
        places: &places,
        quantity: scene.quantity,
        forward_peak: scene.forward_peak,
        tolerance: scene.tolerance,
        method_error: plan.error_of_facets(scene, size_parameter),
    };
    Ok(if scene.is_of_rays_alone() { job.ray_slab() } else { job.slab() })
}

#[cfg(test)]
mod tests;
