//! What stands at the head of a table: its axes, how it was made, the particles as bodies, what it is a mean
//! over.

use super::error::SimulateError;
use crate::farfield::patches::gaussian_filter;
use crate::phase_table::{Averaging, Axes, Bodies, DiscOfSun, TableHeader};
use crate::plan::{Engine, Plan, Symmetry};
use crate::scene::{Diffraction, Particle, Scene, SunDisc};
use std::f64::consts::PI;

/// The header of the table that a scene makes.
///
/// # Errors
/// The plan's.
pub fn header(scene: &Scene, command_line: String) -> Result<TableHeader, SimulateError> {
    Ok(header_of(scene, &Plan::new(scene)?, command_line))
}

pub(super) fn header_of(scene: &Scene, plan: &Plan, command_line: String) -> TableHeader {
    let rotational = plan.symmetry == Symmetry::Rotational;
    TableHeader {
        axes: Axes {
            wavelength: scene.wavelengths.clone(),
            theta: scene.theta.clone(),
            phi: plan.table_azimuths(&scene.phi),
        },
        quantity: scene.quantity,
        forward_peak: scene.forward_peak,
        rotational_symmetry: rotational,
        method: match plan.engine {
            Engine::Meridians | Engine::Patches => "rays",
            Engine::LorenzMie => "mie",
            Engine::Debye => "debye",
            Engine::TMatrix => "tmatrix",
        }
        .into(),
        shape: match &scene.particle {
            Particle::Sphere { .. } => "sphere",
            Particle::Spheroid { .. } => "spheroid",
            Particle::Raindrop { .. } => "raindrop",
            Particle::Own { body, .. } => body.name(),
        }
        .into(),
        radius: plan.radius,
        sun_elevation: scene.sun_elevation,
        bodies: Some(bodies(scene, plan)),
        averaging: averaging(scene, plan),
        tolerance: scene.tolerance,
        scene_toml: scene.toml.clone(),
        command_line,
    }
}

/// The particles of a scene as bodies.
fn bodies(scene: &Scene, plan: &Plan) -> Bodies {
    let bodies = match &scene.size_distribution {
        Some(sizes) => Bodies {
            effective_radius: sizes.effective_radius(),
            effective_variance: sizes.effective_variance(),
            mean_volume: 4.0 / 3.0 * PI * sizes.moment(3.0),
            mean_area: PI * sizes.moment(2.0),
            ..Bodies::sphere(plan.radius)
        },
        None => Bodies::of_one_size(
            4.0 / 3.0 * PI * plan.radius.powi(3),
            plan.shape.silhouette().area() * plan.radius.powi(2),
        ),
    };
    match &scene.density {
        Some(density) => bodies.with_density(Some(density.kg_m3), &density.source),
        None => bodies,
    }
}

/// What a scene averages over.
fn averaging(scene: &Scene, plan: &Plan) -> Averaging {
    let filtered = !plan.engine.is_exact() && scene.diffraction == Diffraction::Gaussian;
    Averaging {
        sun_disc: match scene.sun_disc {
            SunDisc::None => DiscOfSun::None,
            SunDisc::Uniform => DiscOfSun::Uniform,
            SunDisc::LimbDarkened => DiscOfSun::LimbDarkened,
        },
        sizes: scene.size_distribution.as_ref().is_some_and(|sizes| sizes.single().is_none()),
        bandwidth: scene.bandwidth,
        filter: if filtered { gaussian_filter::standard_deviation(plan.radius) } else { 0.0 },
    }
}
