//! A slab of spheres by the exact series.

use crate::medium::Light;
use crate::phase_table::Slab;
use crate::plan::{Engine, Plan};
use crate::scene::Scene;
use crate::series::debye::Term;
use crate::series::mean::MeanError;
use crate::series::table::{Source, SphereJob, sphere_slab};
use crate::size_distribution::SizeDistribution;

/// The slab of one wavelength: in vacuum, and as the surroundings see it.
///
/// # Errors
/// Those of [`sphere_slab`].
pub fn slab(scene: &Scene, plan: &Plan, vacuum: f64, light: Light) -> Result<Slab, MeanError> {
    let wavelength = light.wavelength;
    let source = if plan.engine == Engine::LorenzMie {
        Source::LorenzMie
    } else {
        let orders = plan.orders.iter().map(|&p| Term::Order(p));
        Source::Debye(orders.chain(plan.forward_diffraction.then_some(Term::Diffraction)).collect())
    };
    let one = SizeDistribution::delta(plan.radius);
    let job = SphereJob {
        source,
        sizes: scene.size_distribution.clone().unwrap_or(one),
        medium: &scene.medium,
        wavelength,
        bandwidth: scene.bandwidth * wavelength / vacuum,
        sun_disc: scene.sun_disc,
        tolerance: scene.tolerance,
        allow_unmet: scene.allow_unmet_tolerance,
    };
    sphere_slab(&job, &scene.theta, scene.quantity, scene.forward_peak)
}
