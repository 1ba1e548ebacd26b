//! The main path on one page: plan, trace, collect, interfere, diffract, tabulate.
//!
//! Wavelength by wavelength: rays are traced, order by order, into a [`FarField`] (meridians, sums, or
//! the patches of the published method); every azimuth of the table becomes a column of its amplitudes,
//! and the columns become a [`Slab`], which is handed on before the next wavelength is computed.
//!
//! ```
//! use gonio::scene::{Scene, SceneFile, SceneText};
//! use gonio::simulate;
//!
//! let text = r#"
//! [particle]
//! shape = "sphere"
//! radius_um = 5
//! [light]
//! wavelengths_nm = [550]
//! [table]
//! theta_deg = { from = 0, to = 180, count = 91 }
//! azimuth_deg = [0]
//! "#;
//! let text = SceneText::parse("example", text.into())?;
//! let scene = Scene::from_text(text, &SceneFile::default())?;
//! let table = simulate::table(&scene)?;
//! let slab = &table.slabs[0];
//! assert!((slab.sum(&table.header.axes) - 1.0).abs() < 1e-6, "a phase function integrates to 1");
//! assert!(slab.asymmetry > 0.8, "a drop scatters forwards");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod cross_sections;
mod directions;
mod drops;
mod energy;
mod error;
mod facets;
mod header;
mod order_power;
mod prepared;
mod series;
mod t_matrix;

pub use cross_sections::CrossSections;
pub use directions::{Seen, finite, scatter, scatter_with_sections};
pub use drops::{Steps, steps_of_kinds};
pub use energy::adds_up;
pub use error::SimulateError;
pub use header::header;

use crate::farfield::assignment::{Assignment, Method};
use crate::farfield::patches::gaussian_filter;
use crate::farfield::sphere_check::{CheckedMethod, SphereCheck};
use crate::farfield::{ErrorEstimate, FarField};
use crate::medium::Light;
use crate::phase_table::{Axes, ForwardPeak, InvalidTable, PhaseTable, Slab, TableHeader};
use crate::plan::{Engine, Plan, PlanError};
use crate::population;
use crate::scene::{Diffraction, Interference, Scene};
use crate::series::SeriesError;
use crate::tabulate::slab::{Tabulator, Values};
use cross_sections::straight_ahead;
use energy::{energy, imbalance, left_out};
use header::header_of;
use num_complex::Complex64;
use order_power::{doubts, mark, order_powers, refuse_imbalance};
use prepared::{Prepared, far_field};
use std::f64::consts::TAU;

/// Compute a table, slab by slab, in the order of the scene's wavelengths; `sink` gets each slab
/// with its index while the next one is being computed. No slab is handed on that
/// [`Slab::validate`] refuses.
///
/// # Errors
/// The plan's, the medium's, or whatever `sink` returns; nothing is computed after an error.
pub fn simulate<E: From<SimulateError>>(
    scene: &Scene,
    mut sink: impl FnMut(usize, Slab) -> Result<(), E>,
) -> Result<(), E> {
    std::thread::scope(|scope| {
        let (sender, receiver) = std::sync::mpsc::sync_channel(1);
        scope.spawn(move || {
            let computed =
                in_turn(scene, |i, slab| sender.send(Ok((i, slab))).map_err(|_| Ended::Unheard));
            if let Err(Ended::Failed(error)) = computed {
                // Nobody listens where the sink failed first.
                let _ = sender.send(Err(error));
            }
        });
        receiver.into_iter().try_for_each(|computed| {
            let (i, slab) = computed?;
            sink(i, slab)
        })
    })
}

/// The same on the calling thread alone and those of rayon that belong to it: no slab is computed while the one
/// before is handed on. For computations that [`crate::cancel`] is to stop.
///
/// # Errors
/// As [`simulate`].
pub fn in_turn<E: From<SimulateError>>(
    scene: &Scene,
    mut sink: impl FnMut(usize, Slab) -> Result<(), E>,
) -> Result<(), E> {
    let plan = Plan::new(scene).map_err(SimulateError::from)?;
    let header = header_of(scene, &plan, String::new());
    let prepared = Prepared::of_kinds(scene, &plan, scene.wavelengths.len())?;
    for (i, &wavelength) in scene.wavelengths.iter().enumerate() {
        sink(i, checked_slab(scene, &plan, &prepared, &header, wavelength)?)?;
    }
    Ok(())
}

/// Why no more slabs are computed.
enum Ended {
    Failed(SimulateError),
    /// The sink has failed.
    Unheard,
}

impl From<SimulateError> for Ended {
    fn from(error: SimulateError) -> Self {
        Self::Failed(error)
    }
}

/// A whole table in memory, for those who look at it at once.
///
/// # Errors
/// As [`simulate`].
pub fn table(scene: &Scene) -> Result<PhaseTable, SimulateError> {
    let header = header(scene, String::new())?;
    let mut slabs = Vec::new();
    in_turn::<SimulateError>(scene, |_, slab| {
        slabs.push(slab);
        Ok(())
    })?;
    Ok(PhaseTable { header, slabs })
}

/// One wavelength of a table, checked as [`simulate`] does.
///
/// # Errors
/// A wavelength outside the medium's data, an energy budget that does not add up, or a slab that
/// [`Slab::validate`] refuses.
pub fn slab(scene: &Scene, plan: &Plan, wavelength: f64) -> Result<Slab, SimulateError> {
    let prepared = Prepared::of_kinds(scene, plan, 1)?;
    checked_slab(scene, plan, &prepared, &header_of(scene, plan, String::new()), wavelength)
}

fn checked_slab(
    scene: &Scene,
    plan: &Plan,
    prepared: &[Prepared],
    header: &TableHeader,
    wavelength: f64,
) -> Result<Slab, SimulateError> {
    let slab = if plan.parts.is_empty() {
        computed_slab(scene, plan, &prepared[0], wavelength)?
    } else {
        of_all_kinds(scene, plan, prepared, wavelength)?
    };
    let outside_index =
        wavelength / scene.medium.seen_outside(wavelength).map_err(PlanError::from)?;
    let slab = Slab { outside_index, ..slab };
    slab.validate(header, 0.0)?;
    Ok(slab)
}

/// The slab of one kind of particles.
fn computed_slab(
    scene: &Scene,
    plan: &Plan,
    prepared: &Prepared,
    wavelength: f64,
) -> Result<Slab, SimulateError> {
    if let Some(steps) = &prepared.steps {
        return drops::slab(scene, plan, (steps, &prepared.drops), wavelength);
    }
    // Everything is computed of the wavelength and the index relative to the surroundings.
    let light = plan.light(scene, wavelength)?;
    if matches!(plan.engine, Engine::LorenzMie | Engine::Debye) {
        let slab = series::slab(scene, plan, wavelength, light)?;
        return Ok(Slab { wavelength, methods: plan.series_parts(scene), ..slab });
    }
    if plan.engine == Engine::Facets {
        return Ok(facets::slab(scene, plan, wavelength, light)?);
    }
    if plan.engine == Engine::TMatrix {
        return Ok(Slab { wavelength, ..t_matrix::slab(scene, plan, light)? });
    }
    let Light { wavelength: seen, index } = light;
    let size_parameter = TAU * plan.radius / seen;
    let budget = energy(plan, wavelength, index, size_parameter)?;
    let in_table = plan.forward_diffraction && scene.forward_peak != ForwardPeak::Separate;
    let guides = prepared.guides.as_ref();
    let far_field = far_field(plan, index, size_parameter, in_table, guides);
    // Kept apart, the peak is not joined to the rays at the edge; cross-sections are those of the whole.
    let apart = plan.forward_diffraction && !in_table && plan.engine == Engine::Meridians;
    let joined = apart.then(|| self::far_field(plan, index, size_parameter, true, guides));
    let whole = joined.as_ref().unwrap_or(&far_field);
    let sections = CrossSections::new(plan, whole, index, budget.absorbed);
    // What the edge takes beyond the shadow goes with the peak.
    let beyond = sections.extinction
        - CrossSections::new(plan, &far_field, index, budget.absorbed).extinction;
    let azimuths = plan.table_azimuths(&scene.phi);
    let (computed, places) = plan.computed_azimuths(&azimuths);
    let treatment = Treatment {
        interference: scene.interference != Interference::Powers,
        filter: (scene.diffraction == Diffraction::Gaussian)
            .then(|| gaussian_filter::standard_deviation(plan.radius)),
        peak_apart: scene.forward_peak == ForwardPeak::Separate,
    };
    let left_out = left_out(plan, &budget) * far_field.silhouette().area() / sections.scattering();
    let methods = far_field.assignment().cloned();
    let methods =
        methods.or_else(|| plan.assignment(&plan.tracer(index, size_parameter), size_parameter));
    let mut methods = methods.map_or_else(Vec::new, |all| all.parts(&budget.left_by_order));
    let tabulator = Tabulator {
        theta: &scene.theta,
        size_parameter,
        quantity: scene.quantity,
        forward_peak: scene.forward_peak,
        interference: treatment.interference,
        filter: treatment.filter,
        diffraction: plan.forward_diffraction.then(|| far_field.forward_wave()),
        scattering: sections.scattering(),
        shadow_area: far_field.silhouette().area() + beyond,
        left_out,
        closes: true,
        peak_edge: plan.thresholds.peak_edge,
        order: None,
    };
    let axes = Axes { wavelength: vec![wavelength], theta: scene.theta.clone(), phi: azimuths };
    let Values { values, caustic_order, sum_before_peak, peak_change, peak_share, asymmetry } =
        tabulator.tabulate(&far_field, &computed, &places, &axes);
    let error_estimate = if plan.checked {
        let powers = order_powers(plan, &far_field, index, &budget)?;
        let (by, area) = (&plan.thresholds, far_field.silhouette().area());
        refuse_imbalance(&powers, by.most_power_lost, area, wavelength)?;
        mark(&mut methods, &powers, by.most_order_off);
        worth(&far_field, plan, index, size_parameter, treatment, &doubts(&powers), &computed)?
    } else {
        ErrorEstimate::UNKNOWN
    };
    let error_estimate = match imbalance(plan, whole, &sections, wavelength)? {
        Some(lost) => error_estimate.at_least(lost),
        None => error_estimate,
    };
    let error_estimate = error_estimate.and(peak_change.weighted, &peak_change.by_direction);
    let known = !error_estimate.weighted.is_nan();
    let tolerance_met = known.then_some(error_estimate.weighted <= scene.tolerance);
    Ok(Slab {
        wavelength,
        index,
        outside_index: 1.0,
        values,
        caustic_order,
        scattering_cross_section: sections.scattering() * plan.radius * plan.radius,
        extinction_cross_section: sections.extinction * plan.radius * plan.radius,
        absorption_cross_section: sections.absorption * plan.radius * plan.radius,
        // Patches have no sound wave straight ahead.
        forward_extinction: (plan.forward_diffraction && whole.straight_forward().is_some())
            .then(|| straight_ahead(whole, computed[0]) * plan.radius * plan.radius),
        asymmetry,
        energy: Some(budget),
        sum_before_peak,
        peak_share,
        error_estimate: error_estimate.weighted,
        error_by_band: error_estimate.by_band,
        error_by_direction: error_estimate.by_direction,
        left_out,
        methods,
        tolerance_met,
    })
}

/// The sum of several kinds of particles.
fn of_all_kinds(
    scene: &Scene,
    plan: &Plan,
    prepared: &[Prepared],
    wavelength: f64,
) -> Result<Slab, SimulateError> {
    let mut sum = population::Sum::default();
    let kinds = scene.parts().into_iter().zip(&plan.parts).zip(prepared);
    for (((part, plan), prepared), share) in kinds.zip(scene.number_shares()) {
        sum.add(&computed_slab(&part, plan, prepared, wavelength)?, share);
    }
    sum.slab(scene.tolerance).ok_or_else(|| {
        let (field, value) = ("particles".into(), "none".into());
        SimulateError::Wrong(InvalidTable { field, value, accepted: "at least one kind".into() })
    })
}

/// What a table makes of the amplitudes of patches.
#[derive(Clone, Copy, Debug)]
struct Treatment {
    interference: bool,
    /// Standard deviation of the Gaussian filter, radians.
    filter: Option<f64>,
    /// Whether diffraction is left out of the samples.
    peak_apart: bool,
}

/// The measurement on the sphere of equal volume that a plan's method is judged by.
fn sphere_check<'p>(
    plan: &'p Plan,
    index: Complex64,
    size_parameter: f64,
    treatment: Treatment,
    assignment: Option<&Assignment>,
) -> SphereCheck<'p> {
    let by_planes = || assignment.map_or_else(Vec::new, |a| a.orders_of(Method::Planes));
    let Treatment { interference, filter, peak_apart } = treatment;
    SphereCheck {
        index,
        size_parameter,
        orders: &plan.orders,
        complete: plan.complete,
        diffraction: plan.forward_diffraction,
        peak_apart,
        tolerance: plan.tolerance,
        method: match plan.engine {
            Engine::Patches => CheckedMethod::Patches { rings: plan.rings, interference, filter },
            _ => CheckedMethod::Meridians {
                deformed: !plan.shape.rotational_symmetry(),
                by_planes: by_planes(),
            },
        },
        thresholds: plan.thresholds,
    }
}

/// The estimate of its error that a far field makes of itself, from what the method is worth on the sphere of
/// equal volume.
///
/// # Errors
/// What the exact series refuse.
fn worth(
    far_field: &FarField,
    plan: &Plan,
    index: Complex64,
    size_parameter: f64,
    treatment: Treatment,
    doubts: &[(u32, f64)],
    azimuths: &[f64],
) -> Result<ErrorEstimate, SeriesError> {
    let assignment = far_field.assignment();
    let sphere = sphere_check(plan, index, size_parameter, treatment, assignment).errors()?;
    let tracer = plan.tracer(index, size_parameter);
    Ok(far_field.error_estimate(&tracer, &sphere, treatment.interference, doubts, azimuths))
}
