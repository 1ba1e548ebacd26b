//! The main path on one page: plan, trace, collect, interfere, diffract, tabulate.
//!
//! Wavelength by wavelength: rays are traced, order by order, into a [`FarField`] (meridians, beams, or
//! the patches of the published method); every azimuth of the table becomes a column of its amplitudes,
//! and the columns become a [`Slab`], which is handed on before the next wavelength is computed.

use crate::farfield::FarFieldSettings;
use crate::farfield::patches::{gaussian_filter, sheets};
use crate::farfield::{ErrorEstimate, FarField};
use crate::medium::MediumError;
use crate::optics::AmplitudeMatrix;
use crate::phase_table::{Axes, EnergyBudget, ForwardPeak, PhaseTable, Slab, TableHeader};
use crate::plan::{Engine, Plan, PlanError, Symmetry};
use crate::scene::{Particle, Scene};
use crate::series::SeriesError;
use crate::series::debye::Term;
use crate::series::mean::MeanError;
use crate::series::table::{Source, SphereJob, sphere_slab};
use crate::series::tmatrix::{TMatrix, TMatrixError, TableJob};
use crate::size_distribution::SizeDistribution;
use crate::tabulate::slab::{Tabulator, Values};
use crate::trace::{Tracer, Wavefront, energy_by_fate};
use num_complex::Complex64;
use std::f64::consts::TAU;

/// What can go wrong on the main path.
#[derive(Debug, thiserror::Error)]
pub enum SimulateError {
    #[error(transparent)]
    Plan(#[from] PlanError),
    #[error(transparent)]
    Medium(#[from] MediumError),
    #[error(transparent)]
    Series(#[from] SeriesError),
    #[error(transparent)]
    TMatrix(#[from] TMatrixError),
    #[error(transparent)]
    Mean(#[from] MeanError),
    #[error(
        "energy does not add up at {wavelength_nm} nm: {residual:e} of the light is unaccounted for"
    )]
    Energy { wavelength_nm: f64, residual: f64 },
}

/// Rays per side of the grid on which the energy budget is added up.
const ENERGY_GRID: usize = 100;
/// Largest share of light that the energy budget may lose to rounding.
const ENERGY_TOLERANCE: f64 = 1e-6;

/// Compute a table, slab by slab, in the order of the scene's wavelengths; `sink` gets each slab
/// with its index while the next one is being computed.
///
/// # Errors
/// The plan's, the medium's, or whatever `sink` returns; nothing is computed after an error.
pub fn simulate<E: From<SimulateError>>(
    scene: &Scene,
    mut sink: impl FnMut(usize, Slab) -> Result<(), E>,
) -> Result<(), E> {
    let plan = Plan::new(scene).map_err(SimulateError::from)?;
    std::thread::scope(|scope| {
        let (sender, receiver) = std::sync::mpsc::sync_channel(1);
        scope.spawn(move || {
            for (i, &wavelength) in scene.wavelengths.iter().enumerate() {
                let slab = slab(scene, &plan, wavelength);
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

/// One wavelength of a table.
///
/// # Errors
/// A wavelength outside the medium's data, or an energy budget that does not add up.
pub fn slab(scene: &Scene, plan: &Plan, wavelength: f64) -> Result<Slab, SimulateError> {
    let index = scene.medium.index(wavelength)?;
    if matches!(plan.engine, Engine::LorenzMie | Engine::Debye) {
        return Ok(series_slab(scene, plan, wavelength)?);
    }
    if plan.engine == Engine::TMatrix {
        return Ok(t_matrix_slab(scene, plan, wavelength, index)?);
    }
    let size_parameter = TAU * plan.radius / wavelength;
    let budget = energy(plan, wavelength, index, size_parameter)?;
    let in_table = plan.forward_diffraction && scene.forward_peak != ForwardPeak::Separate;
    let far_field = far_field(plan, index, size_parameter, &scene.phi, in_table);
    let sections = CrossSections::new(plan, &far_field, index, budget.absorbed);
    let azimuths = plan.table_azimuths(&scene.phi);
    let (computed, places) = plan.computed_azimuths(&azimuths);
    let tabulator = Tabulator {
        theta: &scene.theta,
        size_parameter,
        quantity: scene.quantity,
        forward_peak: scene.forward_peak,
        interference: scene.interference,
        filter: (scene.diffraction == crate::scene::Diffraction::Gaussian)
            .then(|| gaussian_filter::standard_deviation(plan.radius)),
        diffraction: plan.forward_diffraction.then(|| far_field.forward_wave()),
        scattering: sections.scattering(),
        shadow_area: far_field.silhouette().area(),
    };
    let axes = Axes { wavelength: vec![wavelength], theta: scene.theta.clone(), phi: azimuths };
    let Values { values, caustic_order, sum_before_peak, peak_share, asymmetry } =
        tabulator.tabulate(&far_field, &computed, &places, &axes);
    let error_estimate = far_field
        .error_estimate(&tracer(plan, index, size_parameter), budget.truncated)
        .unwrap_or(ErrorEstimate { weighted: scene.tolerance, by_band: scene.tolerance });
    Ok(Slab {
        wavelength,
        index,
        values,
        caustic_order,
        scattering_cross_section: sections.scattering() * plan.radius * plan.radius,
        extinction_cross_section: sections.extinction * plan.radius * plan.radius,
        asymmetry,
        energy: Some(budget),
        sum_before_peak,
        peak_share,
        error_estimate: error_estimate.weighted,
        error_by_band: error_estimate.by_band,
    })
}

/// Cross sections in units of the squared radius.
#[derive(Clone, Copy, Debug)]
pub struct CrossSections {
    pub extinction: f64,
    pub absorption: f64,
}

impl CrossSections {
    /// From the share of light on the shadow that rays lose inside. Extinction is what the wave
    /// straight ahead lacks (optical theorem) where diffraction and reflection are joined; else the
    /// shadow, and once more with diffraction.
    fn new(plan: &Plan, far_field: &FarField, index: Complex64, absorbed: f64) -> Self {
        let area = far_field.silhouette().area();
        let wave = far_field.forward_wave();
        let beyond = wave.edge.filter(|_| index.im > 0.0).map_or(0.0, |e| e.absorption(index));
        let extinction = match far_field.straight_forward() {
            Some(s) => TAU * (s.s1 + s.s2).re / wave.size_parameter.powi(2),
            None if plan.forward_diffraction => 2.0 * area,
            None => area,
        };
        Self { extinction, absorption: area * absorbed + beyond }
    }

    pub fn scattering(&self) -> f64 {
        self.extinction - self.absorption
    }
}

/// Amplitude matrices in chosen directions, absolute phase relative to a wave through the centre.
pub fn scatter(
    plan: &Plan,
    index: Complex64,
    size_parameter: f64,
    directions: &[(f64, f64)],
) -> Vec<AmplitudeMatrix> {
    scatter_far_field(plan, index, size_parameter, directions).0
}

/// The same with cross sections, for the share of light on the shadow that rays lose inside.
pub fn scatter_with_sections(
    plan: &Plan,
    index: Complex64,
    size_parameter: f64,
    directions: &[(f64, f64)],
    absorbed: f64,
) -> (Vec<AmplitudeMatrix>, CrossSections) {
    let (amplitudes, far_field) = scatter_far_field(plan, index, size_parameter, directions);
    (amplitudes, CrossSections::new(plan, &far_field, index, absorbed))
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
    let plan = Plan::new(scene)?;
    let rotational = plan.symmetry == Symmetry::Rotational;
    Ok(TableHeader {
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
        shape: match scene.particle {
            Particle::Sphere { .. } => "sphere",
            Particle::Spheroid { .. } => "spheroid",
            Particle::Raindrop { .. } => "raindrop",
        }
        .into(),
        radius: plan.radius,
        sun_elevation: scene.sun_elevation,
        scene_toml: scene.toml.clone(),
        command_line,
    })
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
    // An absorbing interface mixes incident and reflected power: a term of the order of k per hit.
    if fates.residual.abs() > ENERGY_TOLERANCE + f64::from(last + 1) * index.im {
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

/// Trace, and make the far field ready for columns and directions, with forward diffraction joined
/// to order 0 where asked.
fn far_field<'a>(
    plan: &'a Plan,
    index: Complex64,
    size_parameter: f64,
    azimuths: &[f64],
    diffraction: bool,
) -> FarField<'a> {
    let tracer = tracer(plan, index, size_parameter);
    if plan.engine == Engine::Meridians {
        let (azimuths, _) = plan.computed_azimuths(azimuths);
        let settings = FarFieldSettings {
            size_parameter,
            orders: &plan.orders,
            tolerance: plan.tolerance,
            diffraction,
            checked: plan.checked,
            azimuths: &azimuths,
        };
        return FarField::meridians(&tracer, &settings);
    }
    let wavefront = Wavefront::corners(&plan.shape, plan.rings, plan.spokes, FIRST_SPOKE);
    FarField::patches(
        &plan.shape,
        sheets::sheets(&tracer, &wavefront, &plan.orders),
        size_parameter,
    )
}

/// What traces a plan's rays.
fn tracer<'a>(plan: &'a Plan, index: Complex64, size_parameter: f64) -> Tracer<'a> {
    let last = plan.orders.iter().copied().max().unwrap_or(0);
    let tracer = Tracer::new(&plan.shape, index, size_parameter, last);
    if plan.engine == Engine::Meridians {
        return tracer.with_curved_interface(size_parameter);
    }
    tracer
}

/// Spokes start off the symmetry plane, so that no azimuth of a table falls on an edge of patches.
const FIRST_SPOKE: f64 = 0.0123;

/// The T-matrix of a body of revolution.
fn t_matrix_slab(
    scene: &Scene,
    plan: &Plan,
    wavelength: f64,
    index: Complex64,
) -> Result<Slab, TMatrixError> {
    let size_parameter = TAU * plan.radius / wavelength;
    let t = TMatrix::new(&plan.shape, size_parameter, index, scene.tolerance)?;
    let axes = Axes {
        wavelength: vec![wavelength],
        theta: scene.theta.clone(),
        phi: plan.table_azimuths(&scene.phi),
    };
    let job = TableJob {
        wavelength,
        radius: plan.radius,
        sun_elevation: scene.sun_elevation,
        axes: &axes,
        quantity: scene.quantity,
        forward_peak: scene.forward_peak,
    };
    Ok(job.slab(&t))
}

/// The exact series for a sphere.
fn series_slab(scene: &Scene, plan: &Plan, wavelength: f64) -> Result<Slab, MeanError> {
    let source = if plan.engine == Engine::LorenzMie {
        Source::LorenzMie
    } else {
        let orders = plan.orders.iter().map(|&p| Term::Order(p));
        Source::Debye(orders.chain(plan.forward_diffraction.then_some(Term::Diffraction)).collect())
    };
    let one = SizeDistribution::Delta { radius: plan.radius };
    let job = SphereJob {
        source,
        sizes: scene.size_distribution.unwrap_or(one),
        medium: &scene.medium,
        wavelength,
        bandwidth: scene.bandwidth,
        sun_disc: scene.sun_disc,
        tolerance: scene.tolerance,
    };
    sphere_slab(&job, &scene.theta, scene.quantity, scene.forward_peak)
}
