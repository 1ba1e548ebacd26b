//! What is found out once for all wavelengths of a table, and the far field of each by it.

use super::drops::{DropGuides, Steps, steps_of_kinds};
use super::error::SimulateError;
use crate::farfield::assignment::Method;
use crate::farfield::patches::sheets;
use crate::farfield::{FarField, FarFieldSettings, Guides};
use crate::medium::{Light, MediumError};
use crate::plan::{Engine, Plan, Symmetry};
use crate::scene::Scene;
use crate::trace::Wavefront;
use num_complex::Complex64;
use std::f64::consts::TAU;

/// What all wavelengths of one kind of particles share.
#[derive(Debug)]
pub(super) struct Prepared {
    /// Radii that stand for many drops by rays.
    pub steps: Option<Steps>,
    /// Where the rays of those start and leave.
    pub drops: DropGuides,
    /// Where the rays of scattering planes of one drop do.
    pub guides: Option<Guides>,
}

impl Prepared {
    /// For each kind of particles of a scene, when so many of its wavelengths are computed.
    ///
    /// # Errors
    /// A radius outside the model of a shape, or a wavelength outside a medium's data.
    pub(super) fn of_kinds(
        scene: &Scene,
        plan: &Plan,
        wavelengths: usize,
    ) -> Result<Vec<Self>, SimulateError> {
        let plans = if plan.parts.is_empty() { std::slice::from_ref(plan) } else { &plan.parts };
        let kinds = scene.parts().into_iter().zip(plans).zip(steps_of_kinds(scene, plan)?);
        let of_kind = |((part, plan), steps): ((Scene, &Plan), Option<Steps>)| {
            let many = wavelengths >= plan.thresholds.fewest_guided;
            let drops = match &steps {
                Some(steps) if many => DropGuides::new(&part, plan, steps)?,
                _ => DropGuides::default(),
            };
            let one = many && steps.is_none();
            let guides = if one { guides(&part, plan)? } else { None };
            Ok(Self { steps, drops, guides })
        };
        kinds.map(of_kind).collect()
    }
}

/// Guides to the scattering planes of one kind of particles, if there are any.
fn guides(scene: &Scene, plan: &Plan) -> Result<Option<Guides>, MediumError> {
    if plan.engine != Engine::Meridians || plan.symmetry == Symmetry::Rotational {
        return Ok(None);
    }
    let lights: Vec<Light> = scene
        .wavelengths
        .iter()
        .map(|&wavelength| plan.light(scene, wavelength))
        .collect::<Result<_, _>>()?;
    let indices = || lights.iter().map(|light| light.index.re);
    let range = [indices().fold(f64::MAX, f64::min), indices().fold(f64::MIN, f64::max)];
    let middle = &lights[lights.len() / 2];
    let x = TAU * plan.radius / middle.wavelength;
    let assignment = plan.assignment(&plan.tracer(middle.index, x), x);
    let orders = assignment.map_or_else(Vec::new, |all| all.orders_of(Method::Planes));
    let guides = || Guides::new(&plan.shape, &orders, plan.tolerance, range, &plan.thresholds);
    Ok((!orders.is_empty()).then(guides))
}

/// Trace, and make the far field ready for columns and directions, with forward diffraction joined
/// to order 0 where asked, by guides to its planes where there are any.
pub(super) fn far_field<'a>(
    plan: &'a Plan,
    index: Complex64,
    size_parameter: f64,
    diffraction: bool,
    guides: Option<&Guides>,
) -> FarField<'a> {
    let tracer = plan.tracer(index, size_parameter);
    if let Some(assignment) =
        plan.assignment(&tracer, size_parameter).filter(|_| plan.engine == Engine::Meridians)
    {
        let settings = FarFieldSettings {
            size_parameter,
            orders: &plan.orders,
            tolerance: plan.tolerance,
            diffraction,
        };
        return FarField::guided(&tracer, &settings, assignment, guides);
    }
    let wavefront = Wavefront::corners(&plan.shape, plan.rings, plan.spokes, FIRST_SPOKE);
    FarField::patches(
        &plan.shape,
        sheets::sheets(&tracer, &wavefront, &plan.orders),
        size_parameter,
    )
}

/// Spokes start off the symmetry plane, so that no azimuth of a table falls on an edge of patches.
const FIRST_SPOKE: f64 = 0.0123;
