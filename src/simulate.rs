//! The main path on one page: plan, trace, collect, interfere, diffract, tabulate.
//!
//! Wavelength by wavelength: rays are traced, order by order, into a [`FarField`] (meridians, beams, or
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

use crate::farfield::patches::{gaussian_filter, sheets};
use crate::farfield::sphere_check::{CheckedMethod, SphereCheck};
use crate::farfield::{Direction, ErrorEstimate, FarField, FarFieldSettings};
use crate::fault::{Blame, Fault};
use crate::medium::MediumError;
use crate::optics::AmplitudeMatrix;
use crate::phase_table::{
    Averaging, Axes, Bodies, DiscOfSun, EnergyBudget, ForwardPeak, InvalidTable, PhaseTable, Slab,
    TableHeader,
};
use crate::plan::{Engine, Plan, PlanError, Symmetry};
use crate::scene::{Diffraction, Particle, Scene, SunDisc};
use crate::series::SeriesError;
use crate::series::debye::Term;
use crate::series::mean::MeanError;
use crate::series::table::{Source, SphereJob, sphere_slab};
use crate::size_distribution::SizeDistribution;
use crate::tabulate::scattered_power::scattered_power;
use crate::tabulate::slab::{Tabulator, Values};
use crate::trace::{Tracer, Wavefront, energy_by_fate};
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

/// What can go wrong on the main path.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say what each case and field is")]
pub enum SimulateError {
    #[error(transparent)]
    Plan(#[from] PlanError),
    #[error(transparent)]
    Medium(#[from] MediumError),
    #[error(transparent)]
    Series(#[from] SeriesError),
    #[error(transparent)]
    Mean(#[from] MeanError),
    #[error(
        "energy does not add up at {wavelength_nm} nm: {residual:e} of the light is unaccounted for"
    )]
    Energy { wavelength_nm: f64, residual: f64 },
    #[error(
        "energy does not add up at {wavelength_nm} nm: in units of the squared radius the amplitudes \
         scatter {power:.3}, while extinction less absorption is {left:.3}; rays do not serve a particle \
         as small, soft or deformed as this one"
    )]
    Imbalance { wavelength_nm: f64, power: f64, left: f64 },
    #[error("the table would be wrong: {0}")]
    Wrong(#[from] InvalidTable),
    #[error("the amplitudes would be wrong: {0}")]
    Amplitudes(InvalidTable),
}

impl Blame for SimulateError {
    fn fault(&self) -> Fault {
        match self {
            SimulateError::Plan(error) => error.fault(),
            SimulateError::Medium(error) => error.fault(),
            SimulateError::Series(error) => error.fault(),
            SimulateError::Mean(error) => error.fault(),
            SimulateError::Energy { .. }
            | SimulateError::Wrong(_)
            | SimulateError::Imbalance { .. }
            | SimulateError::Amplitudes(_) => Fault::Run,
        }
    }
}

/// Rays per side of the grid on which the energy budget is added up.
const ENERGY_GRID: usize = 100;
/// Largest share of light that the energy budget may lose to rounding.
const ENERGY_TOLERANCE: f64 = 1e-6;

/// Largest share of the scattered power by which its two sums may differ; up to there the difference is in
/// the stated error.
const MOST_LOST: f64 = 0.25;

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
    let plan = Plan::new(scene).map_err(SimulateError::from)?;
    let header = header(scene, String::new())?;
    std::thread::scope(|scope| {
        let (sender, receiver) = std::sync::mpsc::sync_channel(1);
        let header = &header;
        scope.spawn(move || {
            for (i, &wavelength) in scene.wavelengths.iter().enumerate() {
                let slab = checked_slab(scene, &plan, header, wavelength);
                let failed = slab.is_err();
                if sender.send((i, slab)).is_err() || failed {
                    return;
                }
            }
        });
        receiver.into_iter().try_for_each(|(i, slab)| sink(i, slab?))
    })
}

/// A whole table in memory, for those who look at it at once.
///
/// # Errors
/// As [`simulate`].
pub fn table(scene: &Scene) -> Result<PhaseTable, SimulateError> {
    let header = header(scene, String::new())?;
    let mut slabs = Vec::new();
    simulate::<SimulateError>(scene, |_, slab| {
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
    checked_slab(scene, plan, &header_of(scene, plan, String::new()), wavelength)
}

fn checked_slab(
    scene: &Scene,
    plan: &Plan,
    header: &TableHeader,
    wavelength: f64,
) -> Result<Slab, SimulateError> {
    let slab = computed_slab(scene, plan, wavelength)?;
    slab.validate(header, 0.0)?;
    Ok(slab)
}

fn computed_slab(scene: &Scene, plan: &Plan, wavelength: f64) -> Result<Slab, SimulateError> {
    let index = scene.medium.index(wavelength)?;
    if matches!(plan.engine, Engine::LorenzMie | Engine::Debye) {
        let slab = series_slab(scene, plan, wavelength)?;
        return Ok(Slab { methods: plan.series_parts(), ..slab });
    }
    let size_parameter = TAU * plan.radius / wavelength;
    let budget = energy(plan, wavelength, index, size_parameter)?;
    let in_table = plan.forward_diffraction && scene.forward_peak != ForwardPeak::Separate;
    let far_field = far_field(plan, index, size_parameter, &scene.phi, in_table);
    // Kept apart, the peak is not joined to the rays at the edge; cross-sections are those of the whole.
    let apart = plan.forward_diffraction && !in_table && plan.engine == Engine::Meridians;
    let joined = apart.then(|| self::far_field(plan, index, size_parameter, &scene.phi, true));
    let whole = joined.as_ref().unwrap_or(&far_field);
    let sections = CrossSections::new(plan, whole, index, budget.absorbed);
    // What the edge takes beyond the shadow goes with the peak.
    let beyond = sections.extinction
        - CrossSections::new(plan, &far_field, index, budget.absorbed).extinction;
    let azimuths = plan.table_azimuths(&scene.phi);
    let (computed, places) = plan.computed_azimuths(&azimuths);
    let treatment = Treatment {
        interference: scene.interference,
        filter: (scene.diffraction == Diffraction::Gaussian)
            .then(|| gaussian_filter::standard_deviation(plan.radius)),
    };
    let left_out = left_out(plan, &budget) * far_field.silhouette().area() / sections.scattering();
    let methods = far_field.assignment().cloned();
    let methods =
        methods.or_else(|| plan.assignment(&plan.tracer(index, size_parameter), size_parameter));
    let methods = methods.map_or_else(Vec::new, |all| all.parts(&budget.left_by_order));
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
    };
    let axes = Axes { wavelength: vec![wavelength], theta: scene.theta.clone(), phi: azimuths };
    let Values { values, caustic_order, sum_before_peak, peak_share, asymmetry } =
        tabulator.tabulate(&far_field, &computed, &places, &axes);
    let error_estimate = if plan.checked {
        let squares = sphere_check(plan, index, size_parameter, treatment).squares()?;
        let tracer = plan.tracer(index, size_parameter);
        far_field.error_estimate(&tracer, &squares, treatment.interference)
    } else {
        ErrorEstimate::UNKNOWN
    };
    let error_estimate = match imbalance(plan, whole, &sections, wavelength)? {
        Some(lost) => error_estimate.at_least(lost),
        None => error_estimate,
    };
    let known = !error_estimate.weighted.is_nan();
    let tolerance_met = known.then_some(error_estimate.weighted <= scene.tolerance);
    Ok(Slab {
        wavelength,
        index,
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

/// How far the power that the amplitudes scatter is from what extinction and absorption leave, as a share of
/// it: of the whole of the waves of small particles, where it can be added up.
fn imbalance(
    plan: &Plan,
    far_field: &FarField,
    sections: &CrossSections,
    wavelength: f64,
) -> Result<Option<f64>, SimulateError> {
    if !(plan.engine == Engine::Meridians && plan.complete && plan.forward_diffraction) {
        return Ok(None);
    }
    let rotational = plan.symmetry == Symmetry::Rotational;
    let Some(power) = scattered_power(far_field, rotational) else { return Ok(None) };
    let lost = (power / sections.scattering() - 1.0).abs();
    if lost <= MOST_LOST {
        return Ok(Some(lost));
    }
    let (wavelength_nm, left) = (wavelength * 1e9, sections.scattering());
    Err(SimulateError::Imbalance { wavelength_nm, power, left })
}

/// Extinction by the optical theorem, in units of the squared radius, from what the columns of a table
/// have at θ = 0 of one azimuth. `S1 + S2` there is a trace, the same in the plane of every azimuth.
fn straight_ahead(far_field: &FarField, azimuth: f64) -> f64 {
    let rays = far_field.columns(&[0.0], &[azimuth], false).swap_remove(0).amplitude[0];
    let wave = far_field.forward_wave();
    let whole = rays + wave.peak(&Direction::new(0.0, azimuth));
    TAU * (whole.s1 + whole.s2).re / wave.size_parameter.powi(2)
}

/// What a table makes of the amplitudes of patches.
#[derive(Clone, Copy, Debug)]
struct Treatment {
    interference: bool,
    /// Standard deviation of the Gaussian filter, radians.
    filter: Option<f64>,
}

/// Share of the light on the shadow that is in orders which a list leaves out. Where all that matter are
/// summed the rest is below the tolerance, and counts as forward light.
fn left_out(plan: &Plan, budget: &EnergyBudget) -> f64 {
    if plan.complete {
        return 0.0;
    }
    let other = |(order, share): (usize, &f64)| {
        if plan.orders.contains(&(order as u32)) { 0.0 } else { *share }
    };
    let others: f64 = budget.left_by_order.iter().enumerate().map(other).sum();
    others + budget.truncated + budget.totally_reflected
}

/// The measurement on the sphere of equal volume that a plan's method is judged by.
fn sphere_check(
    plan: &Plan,
    index: Complex64,
    size_parameter: f64,
    treatment: Treatment,
) -> SphereCheck<'_> {
    let Treatment { interference, filter } = treatment;
    SphereCheck {
        index,
        size_parameter,
        orders: &plan.orders,
        complete: plan.complete,
        diffraction: plan.forward_diffraction,
        tolerance: plan.tolerance,
        method: match plan.engine {
            Engine::Patches => CheckedMethod::Patches { rings: plan.rings, interference, filter },
            _ => CheckedMethod::Meridians { deformed: !plan.shape.rotational_symmetry() },
        },
        thresholds: plan.thresholds,
    }
}

/// Relative error of the intensity from 10° to 170°, weighted by intensity, that rays have on the sphere
/// of equal volume.
///
/// # Errors
/// What the exact series refuse.
pub fn worth_of_rays(
    plan: &Plan,
    index: Complex64,
    size_parameter: f64,
) -> Result<ErrorEstimate, SeriesError> {
    let treatment = Treatment { interference: true, filter: None };
    let squares = sphere_check(plan, index, size_parameter, treatment).squares()?;
    let far_field = far_field(plan, index, size_parameter, &[0.0], plan.forward_diffraction);
    Ok(far_field.error_estimate(&plan.tracer(index, size_parameter), &squares, true))
}

/// Cross sections in units of the squared radius.
#[derive(Clone, Copy, Debug)]
pub struct CrossSections {
    /// What the light loses.
    pub extinction: f64,
    /// What turns into heat.
    pub absorption: f64,
}

impl CrossSections {
    /// From the share of light on the shadow that rays lose inside. Extinction is what the wave
    /// straight ahead lacks (optical theorem) where diffraction is part of it, twice the shadow for
    /// patches, which have no sound wave there; without diffraction the shadow alone.
    fn new(plan: &Plan, far_field: &FarField, index: Complex64, absorbed: f64) -> Self {
        let area = far_field.silhouette().area();
        let wave = far_field.forward_wave();
        let beyond = wave.edge.filter(|_| index.im > 0.0).map_or(0.0, |e| e.absorption(index));
        let ahead = far_field.straight_forward().filter(|_| plan.forward_diffraction);
        let extinction = match ahead {
            Some(s) => TAU * (s.s1 + s.s2).re / wave.size_parameter.powi(2),
            None if plan.forward_diffraction => 2.0 * area,
            None => area,
        };
        Self { extinction, absorption: area * absorbed + beyond }
    }

    /// Extinction less absorption.
    pub fn scattering(&self) -> f64 {
        self.extinction - self.absorption
    }

    /// Numbers, with something scattered and no more absorbed than is taken from the light.
    fn validate(&self) -> Result<(), SimulateError> {
        let slack = 1e-6 * self.extinction.abs();
        let absorbed = (-slack..=self.extinction).contains(&self.absorption);
        if self.extinction.is_finite() && self.scattering() > 0.0 && absorbed {
            return Ok(());
        }
        let accepted = "0 or more of it absorbed, and more than 0 scattered".to_string();
        let value = format!("{:e}, absorption {:e}", self.extinction, self.absorption);
        let field = "extinction in units of the squared radius".into();
        Err(SimulateError::Amplitudes(InvalidTable { field, value, accepted }))
    }
}

/// Amplitude matrices in chosen directions, absolute phase relative to a wave through the centre; as
/// computed: [`finite`] checks them.
pub fn scatter(
    plan: &Plan,
    index: Complex64,
    size_parameter: f64,
    directions: &[(f64, f64)],
) -> Vec<AmplitudeMatrix> {
    scatter_far_field(plan, index, size_parameter, directions).0
}

/// The same with cross sections, for the share of light on the shadow that rays lose inside.
///
/// With a `filter` (radians) amplitudes of patches have the intensities that it leaves near bows.
///
/// # Errors
/// Amplitudes that are no numbers, cross-sections that are none or out of balance.
pub fn scatter_with_sections(
    plan: &Plan,
    index: Complex64,
    size_parameter: f64,
    directions: &[(f64, f64)],
    absorbed: f64,
    filter: Option<f64>,
) -> Result<(Vec<AmplitudeMatrix>, CrossSections), SimulateError> {
    let (mut amplitudes, far_field) = scatter_far_field(plan, index, size_parameter, directions);
    if let Some(sigma) = filter {
        amplitudes = far_field.scatter_filtered(directions, plan.forward_diffraction, sigma);
    }
    let sections = CrossSections::new(plan, &far_field, index, absorbed);
    sections.validate()?;
    Ok((finite(amplitudes, directions)?, sections))
}

/// Amplitudes as they are, where all of them are numbers.
///
/// # Errors
/// The first direction whose amplitude is none.
pub fn finite(
    amplitudes: Vec<AmplitudeMatrix>,
    directions: &[(f64, f64)],
) -> Result<Vec<AmplitudeMatrix>, SimulateError> {
    let Some(bad) = amplitudes.iter().position(|amplitude| !amplitude.s11().is_finite()) else {
        return Ok(amplitudes);
    };
    let (theta, phi) = directions.get(bad).copied().unwrap_or((f64::NAN, f64::NAN));
    Err(SimulateError::Amplitudes(InvalidTable {
        field: "amplitude".into(),
        value: format!("{:?}", amplitudes[bad]),
        accepted: format!(
            "finite at theta {:.4}°, azimuth {:.4}°",
            theta.to_degrees(),
            phi.to_degrees()
        ),
    }))
}

fn scatter_far_field<'a>(
    plan: &'a Plan,
    index: Complex64,
    size_parameter: f64,
    directions: &[(f64, f64)],
) -> (Vec<AmplitudeMatrix>, FarField<'a>) {
    let azimuths: Vec<f64> = directions.iter().map(|d| d.1).collect();
    let far_field = far_field(plan, index, size_parameter, &azimuths, plan.forward_diffraction);
    (far_field.scatter(directions, plan.forward_diffraction), far_field)
}

/// The header of the table that a scene makes.
///
/// # Errors
/// The plan's.
pub fn header(scene: &Scene, command_line: String) -> Result<TableHeader, SimulateError> {
    Ok(header_of(scene, &Plan::new(scene)?, command_line))
}

fn header_of(scene: &Scene, plan: &Plan, command_line: String) -> TableHeader {
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
    let rays = matches!(plan.engine, Engine::Meridians | Engine::Patches);
    let filtered = rays && scene.diffraction == crate::scene::Diffraction::Gaussian;
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

/// Trace a coarse wavefront for the budget of energy by fate.
fn energy(
    plan: &Plan,
    wavelength: f64,
    index: Complex64,
    size_parameter: f64,
) -> Result<EnergyBudget, SimulateError> {
    let last = plan.orders.iter().copied().max().unwrap_or(0);
    let tracer = Tracer::new(&plan.shape, index, size_parameter, last);
    let spokes = if plan.symmetry == Symmetry::Rotational { 4 } else { ENERGY_GRID };
    let fates = energy_by_fate(&tracer, &Wavefront::midpoints(&plan.shape, ENERGY_GRID, spokes));
    if !adds_up(fates.residual, index, last) {
        let wavelength_nm = wavelength * 1e9;
        return Err(SimulateError::Energy { wavelength_nm, residual: fates.residual });
    }
    Ok(EnergyBudget {
        left_by_order: fates.left_by_order,
        absorbed: fates.absorbed,
        totally_reflected: fates.totally_reflected,
        truncated: fates.truncated,
        residual: fates.residual,
    })
}

/// Whether the light unaccounted for is rounding, for rays up to an order. An absorbing interface mixes
/// incident and reflected power: a term of the order of k per hit.
pub fn adds_up(residual: f64, index: Complex64, last_order: u32) -> bool {
    residual.abs() <= ENERGY_TOLERANCE + f64::from(last_order + 1) * index.im
}

/// Trace, and make the far field ready for columns and directions, with forward diffraction joined
/// to order 0 where asked.
fn far_field<'a>(
    plan: &'a Plan,
    index: Complex64,
    size_parameter: f64,
    azimuths: &[f64],
    diffraction: bool,
) -> FarField<'a> {
    let tracer = plan.tracer(index, size_parameter);
    if let Some(assignment) =
        plan.assignment(&tracer, size_parameter).filter(|_| plan.engine == Engine::Meridians)
    {
        let (azimuths, _) = plan.computed_azimuths(azimuths);
        let settings = FarFieldSettings {
            size_parameter,
            orders: &plan.orders,
            tolerance: plan.tolerance,
            diffraction,
            checked: plan.checked,
            azimuths: &azimuths,
        };
        return FarField::assigned(&tracer, &settings, assignment);
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

/// The exact series for a sphere.
fn series_slab(scene: &Scene, plan: &Plan, wavelength: f64) -> Result<Slab, MeanError> {
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
        bandwidth: scene.bandwidth,
        sun_disc: scene.sun_disc,
        tolerance: scene.tolerance,
        allow_unmet: scene.allow_unmet_tolerance,
    };
    sphere_slab(&job, &scene.theta, scene.quantity, scene.forward_peak)
}
