//! Where the light goes that meets the particle: by rays, order by order; and the same power added up over
//! the amplitudes that they make.

use super::cross_sections::CrossSections;
use super::error::SimulateError;
use crate::farfield::FarField;
use crate::phase_table::EnergyBudget;
use crate::plan::{Engine, Plan, Symmetry, last_order};
use crate::tabulate::scattered_power::scattered_power;
use crate::trace::{Tracer, Wavefront, energy_by_fate};
use num_complex::Complex64;

/// Rays per side of the grid on which the energy budget is added up.
const ENERGY_GRID: usize = 100;
/// Largest share of light that the energy budget may lose to rounding.
const ENERGY_TOLERANCE: f64 = 1e-6;

/// Trace a coarse wavefront for the budget of energy by fate.
pub(super) fn energy(
    plan: &Plan,
    wavelength: f64,
    index: Complex64,
    size_parameter: f64,
) -> Result<EnergyBudget, SimulateError> {
    // light that a list leaves out is followed too: it may be absorbed, or leave in other orders
    let listed = plan.orders.iter().copied().max().unwrap_or(0);
    let last = listed.max(last_order(index.re, plan.tolerance));
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

/// Share of the light on the shadow that is in orders which a list leaves out. Where all that matter are
/// summed the rest is below the tolerance, and counts as forward light.
pub(super) fn left_out(plan: &Plan, budget: &EnergyBudget) -> f64 {
    if plan.complete {
        return 0.0;
    }
    let other = |(order, share): (usize, &f64)| {
        if plan.orders.contains(&(order as u32)) { 0.0 } else { *share }
    };
    let others: f64 = budget.left_by_order.iter().enumerate().map(other).sum();
    others + budget.truncated + budget.totally_reflected
}

/// How far the power that the amplitudes scatter is from what extinction and absorption leave, as a share of
/// it: of the whole of the waves of small particles, where it can be added up.
pub(super) fn imbalance(
    plan: &Plan,
    far_field: &FarField,
    sections: &CrossSections,
    wavelength: f64,
) -> Result<Option<f64>, SimulateError> {
    let whole = plan.engine == Engine::Meridians && plan.complete && plan.forward_diffraction;
    if !whole || far_field.size_parameter() > plan.thresholds.largest_power_sum {
        return Ok(None);
    }
    let rotational = plan.symmetry == Symmetry::Rotational;
    let power = scattered_power(far_field, rotational);
    let lost = (power / sections.scattering() - 1.0).abs();
    if lost <= plan.thresholds.most_power_lost {
        return Ok(Some(lost));
    }
    let (wavelength_nm, left) = (wavelength * 1e9, sections.scattering());
    Err(SimulateError::Imbalance { wavelength_nm, power, left })
}
