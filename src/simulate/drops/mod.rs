//! Many drops by rays: the mean over sizes.
//!
//! Waves of drops of different sizes beat with phases that run through many turns within any distribution;
//! what is left of interference are the fringes within each order (supernumeraries). So of every order the
//! amplitudes of one drop add, and orders add as powers: the mean converges with a tenth of the radii that
//! the coherent sum needs, to the same (`validation/population.md`). Of each order as many radii are taken
//! as it needs ([`Steps`]), each with another tilt where drops cant ([`tilt`]), azimuths are as few as the mean is smooth by ([`azimuths`]), the sun's disc smooths
//! the mean where it is asked for ([`seen`]), and the difference to every second radius is the error that the table
//! states.

mod azimuths;
mod error;
mod groups;
mod guided;
mod one_drop;
mod seen;
mod slab;
mod steps;
mod tilt;

pub(super) use guided::DropGuides;
pub(super) use slab::slab;
pub use steps::Steps;

use super::error::SimulateError;
use crate::plan::{Engine, Plan};
use crate::scene::Scene;
use steps::sizes_of;

/// How many radii stand for each kind of particles: for kinds of many drops by rays.
///
/// # Errors
/// A radius outside the model of the shape, or a wavelength outside the medium's data.
pub fn steps_of_kinds(scene: &Scene, plan: &Plan) -> Result<Vec<Option<Steps>>, SimulateError> {
    let plans = if plan.parts.is_empty() { std::slice::from_ref(plan) } else { &plan.parts };
    let of_kind = |(part, plan): (&Scene, &Plan)| match &part.size_distribution {
        Some(sizes) if sizes.single().is_none() && plan.engine == Engine::Meridians => {
            Steps::new(part, plan, sizes).map(Some)
        }
        _ if part.canting > 0.0 && plan.engine == Engine::Meridians => {
            Steps::new(part, plan, &sizes_of(part)).map(Some)
        }
        _ => Ok(None),
    };
    scene.parts().iter().zip(plans).map(of_kind).collect()
}
