//! One wavelength of a table of many drops.

use super::azimuths::Azimuths;
use super::error::band_errors;
use super::groups::{Part, groups};
use super::guided::DropGuides;
use super::one_drop::Drop;
use super::seen::Seen;
use super::steps::{OF_DIFFERENCE, Steps, add, sizes_of};
use crate::farfield::forward::penumbra_layout::near_axis;
use crate::math::parallel::*;
use crate::medium::Light;
use crate::phase_table::{Axes, ERROR_BANDS, ForwardPeak, MethodPart, Slab};
use crate::plan::Plan;
use crate::population::{Radius, radii};
use crate::scene::Scene;
use crate::simulate::error::SimulateError;
use crate::tabulate::peak_change::PeakChange;
use crate::tabulate::slab::asymmetry;
use ndarray::{Array2, Array3, Axis, s};
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

/// Drops computed at once: their values are held until they are added.
const AT_ONCE: usize = 16;

/// The mean over the sizes of one kind of drops at a wavelength (metres).
pub(crate) fn slab(
    scene: &Scene,
    plan: &Plan,
    (steps, guides): (&Steps, &DropGuides),
    wavelength: f64,
) -> Result<Slab, SimulateError> {
    let sizes = &sizes_of(scene);
    let Light { wavelength: seen, index } = scene.medium.light(wavelength)?;
    let light = (seen, index);
    let table = plan.table_azimuths(&scene.phi);
    let azimuths = Azimuths::of(scene, plan);
    let computed = azimuths.computed();
    let disc = Seen::new(scene, wavelength, &azimuths);
    let traced = disc.scene(scene);
    let shape = (scene.quantity.elements(), traced.theta.len(), computed.len());
    let mut means = [Array3::zeros(shape), Array3::zeros(shape)];
    let mut sections = [0.0; 2];
    let mut drops = groups(sizes, steps.parts.iter());
    // those that take longest first, so that no thread is left without work
    drops.sort_by(|a, b| b.at.radius.total_cmp(&a.at.radius));
    for some in drops.chunks(AT_ONCE) {
        let found: Vec<Vec<Array3<f32>>> = some
            .par_iter()
            .map(|group| {
                let drop = Drop::new(&traced, plan, &group.at, light)?;
                let guides = guides.of(&group.at);
                Ok(drop.orders(&traced, &group.numbers(), &computed, guides))
            })
            .collect::<Result<_, SimulateError>>()?;
        for (orders, group) in found.iter().zip(some) {
            for (values, (_, weights)) in orders.iter().zip(&group.orders) {
                add(&mut means, values, *weights);
            }
        }
    }
    for part in steps.parts.iter().filter(|part| part.order == plan.orders[0]) {
        let all = radii(sizes, part.stretch, part.steps);
        let [extinction, absorption] = cross_sections(scene, plan, &all, light)?;
        sections[0] += extinction;
        sections[1] += absorption;
    }
    let means = disc.means(means);
    let [extinction, absorption] = sections;
    let scattering = extinction - absorption;
    let size_parameter = TAU * sizes.effective_radius() / seen;
    let errors = band_errors(&scene.theta, &((&means[0] - &means[1]) * OF_DIFFERENCE), &means[0])
        .and(|theta| plan.thresholds.doubt_of_powers(size_parameter, theta))
        .beside(disc.error(), &[disc.error(); ERROR_BANDS]);
    let axes =
        Axes { wavelength: vec![wavelength], theta: scene.theta.clone(), phi: table.clone() };
    let mut values = azimuths.spread(&means[0], &table) / scattering;
    let (smallest, _) = sizes.bounds();
    let (sum_before_peak, closed) = close(scene, &axes, &mut values, TAU * smallest / seen);
    let values = values.mapv(|value| value as f32);
    let change = PeakChange::new(&axes, closed.view(), values.index_axis(Axis(0), 0));
    let errors = errors.beside(change.weighted, &change.by_direction);
    let weights = axes.solid_angle_factors();
    Ok(Slab {
        wavelength,
        index,
        outside_index: 1.0,
        asymmetry: asymmetry(&values, (&weights.0, &weights.1), &axes.theta),
        values,
        caustic_order: None,
        scattering_cross_section: scattering,
        extinction_cross_section: extinction,
        absorption_cross_section: absorption,
        forward_extinction: Some(extinction),
        energy: None,
        sum_before_peak,
        peak_share: 0.0,
        error_estimate: errors.weighted,
        error_by_band: errors.by_band,
        // every direction counts: the bright forward light alone would be too easy
        tolerance_met: Some(errors.by_band <= scene.tolerance),
        error_by_direction: errors.by_direction,
        left_out: 0.0,
        methods: methods(&steps.parts, errors.by_band),
    })
}

/// Mean extinction and absorption, m².
fn cross_sections(
    scene: &Scene,
    plan: &Plan,
    all: &[Radius],
    light: (f64, Complex64),
) -> Result<[f64; 2], SimulateError> {
    let of_one = |at: &Radius| -> Result<[f64; 2], SimulateError> {
        let sections = Drop::new(scene, plan, at, light)?.sections()?;
        Ok([at.weight * sections.extinction, at.weight * sections.absorption])
    };
    let found: Vec<[f64; 2]> = all.par_iter().map(of_one).collect::<Result<_, _>>()?;
    Ok(found.iter().fold([0.0; 2], |sum, one| [sum[0] + one[0], sum[1] + one[1]]))
}

/// Give the forward peak what the rest of the sphere does not hold, so that all adds up to 1; the sum before, and
/// the rows of the peak before, shape (θ, φ).
fn close(
    scene: &Scene,
    axes: &Axes,
    values: &mut Array3<f64>,
    smallest: f64,
) -> (f64, Array2<f64>) {
    let (theta, phi) = axes.solid_angle_factors();
    let ring = |values: &Array3<f64>, i: usize| -> f64 {
        let row = values.slice(s![0, i, ..]);
        theta[i] * row.iter().zip(&phi).map(|(value, weight)| value * weight).sum::<f64>()
    };
    let sum: f64 = (0..theta.len()).map(|i| ring(values, i)).sum();
    if scene.forward_peak != ForwardPeak::CellAverage || !axes.cover_sphere() {
        return (sum, Array2::zeros((0, phi.len())));
    }
    let reach = near_axis(smallest).min(0.1 * PI);
    let peak = scene.theta.partition_point(|angle| *angle < reach);
    let before = values.slice(s![0, ..peak, ..]).to_owned();
    let held: f64 = (0..peak).map(|i| ring(values, i)).sum();
    if held > 0.0 {
        let factor = ((1.0 - sum + held) / held).clamp(0.5, 2.0);
        values.slice_mut(s![.., ..peak, ..]).mapv_inplace(|value| value * factor);
    }
    (sum, before)
}

/// By which method each order is computed.
fn methods(parts: &[Part], error: f64) -> Vec<MethodPart> {
    let mut orders: Vec<u32> = parts.iter().map(|part| part.order).collect();
    orders.sort_unstable();
    orders.dedup();
    let of_order = |order: u32| {
        let radii: usize =
            parts.iter().filter(|part| part.order == order).map(|part| part.steps + 1).sum();
        MethodPart {
            order: Some(order),
            method: "mean over sizes of rays of scattering planes".into(),
            reason: format!("orders add as powers; {radii} radii"),
            expected_error: Some(error),
            ..MethodPart::default()
        }
    };
    orders.into_iter().map(of_order).collect()
}
