//! What stands at the head of a table: its axes, how it was made, the particles as bodies, what it is a mean
//! over.

use super::error::SimulateError;
use crate::facets::mean::mean_shadow;
use crate::farfield::patches::gaussian_filter;
use crate::phase_table::{Averaging, Axes, Bodies, DiscOfSun, TableHeader};
use crate::plan::{Engine, Plan, Symmetry, shape, stand};
use crate::population;
use crate::scene::{Diffraction, Particle, Scene, SunDisc};
use std::collections::BTreeSet;

/// The header of the table that a scene makes.
///
/// # Errors
/// The plan's.
pub fn header(scene: &Scene, command_line: String) -> Result<TableHeader, SimulateError> {
    Ok(header_of(scene, &Plan::new(scene)?, command_line))
}

pub(super) fn header_of(scene: &Scene, plan: &Plan, command_line: String) -> TableHeader {
    let rotational = plan.symmetry == Symmetry::Rotational;
    // one word where all kinds have it
    let of_all = |word: &dyn Fn(&Scene, &Plan) -> String| -> String {
        let parts = scene.parts();
        let plans = if plan.parts.is_empty() { std::slice::from_ref(plan) } else { &plan.parts };
        let words: BTreeSet<String> = parts.iter().zip(plans).map(|(s, p)| word(s, p)).collect();
        words.into_iter().collect::<Vec<_>>().join(" + ")
    };
    TableHeader {
        axes: Axes {
            wavelength: scene.wavelengths.clone(),
            theta: scene.theta.clone(),
            phi: plan.table_azimuths(&scene.phi),
        },
        quantity: scene.quantity,
        forward_peak: scene.forward_peak,
        rotational_symmetry: rotational,
        method: of_all(&|_, plan| {
            let word = match plan.engine {
                Engine::Meridians | Engine::Patches => "rays",
                Engine::LorenzMie => "mie",
                Engine::Debye => "debye",
                Engine::TMatrix => "tmatrix",
                Engine::Facets => "facets",
            };
            word.into()
        }),
        shape: of_all(&|scene, _| {
            let word = match &scene.particle {
                Particle::Sphere { .. } => "sphere",
                Particle::Spheroid { .. } => "spheroid",
                Particle::Raindrop { .. } => "raindrop",
                Particle::Crystal { crystal, .. } => crystal.name(),
                Particle::Own { body, .. } => body.name(),
            };
            word.into()
        }),
        radius: match plan.parts.as_slice() {
            [] => plan.radius,
            _ => bodies(scene, plan).effective_radius,
        },
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
    let plans = if plan.parts.is_empty() { std::slice::from_ref(plan) } else { &plan.parts };
    let shadows: Vec<f64> =
        scene.parts().iter().zip(plans).map(|(part, plan)| shadow(part, plan)).collect();
    population::bodies(scene, &shadows)
}

/// Steps of the mean over shadows of flattened drops.
const SHADOWS: usize = 16;

/// Area of the shadow of a kind of particles, in units of the mean squared radius.
fn shadow(scene: &Scene, plan: &Plan) -> f64 {
    if let Some(body) = &plan.crystal {
        return mean_shadow(body, stand(scene), scene.sun_elevation, plan.orientations(scene)[0]);
    }
    let many = scene.size_distribution.as_ref().filter(|sizes| sizes.single().is_none());
    let Some(sizes) = many.filter(|_| !plan.shape.is_sphere()) else {
        return plan.shape.silhouette().area();
    };
    let (mut sum, mut squares) = (0.0, 0.0);
    for at in population::radii(sizes, sizes.bounds(), SHADOWS) {
        // the plan has judged the largest of them
        let Ok((shape, _)) = shape(&scene.particle_with_radius(at.radius), scene.sun_elevation)
        else {
            continue;
        };
        sum += at.weight * shape.silhouette().area();
        squares += at.weight;
    }
    sum / squares
}

/// What a scene averages over.
fn averaging(scene: &Scene, plan: &Plan) -> Averaging {
    let rays = matches!(plan.engine, Engine::Meridians | Engine::Patches);
    let filtered = rays && scene.diffraction == Diffraction::Gaussian;
    Averaging {
        sun_disc: match scene.sun_disc {
            SunDisc::None => DiscOfSun::None,
            SunDisc::Uniform => DiscOfSun::Uniform,
            SunDisc::LimbDarkened => DiscOfSun::LimbDarkened,
        },
        sizes: scene.parts().iter().any(|part| {
            part.size_distribution.as_ref().is_some_and(|sizes| sizes.single().is_none())
        }),
        bandwidth: scene.bandwidth,
        filter: if filtered { gaussian_filter::standard_deviation(plan.radius) } else { 0.0 },
    }
}
