//! The power of each order, added up over the sphere from its amplitudes, against what its rays bring.
//!
//! An order by itself, without diffraction, scatters the light that its rays carry out of the particle; of
//! high orders, whose rays leave near the rim, it is more by what tunnels there, which the Debye term of the
//! sphere of equal volume tells. What an order has too much or too little is wrong whatever made it. Round bodies
//! are compared with exact terms ([`crate::farfield`]), and small ones scatter no more like rays.

use super::error::SimulateError;
use crate::farfield::FarField;
use crate::phase_table::{EnergyBudget, MethodPart};
use crate::plan::{Engine, Plan, Symmetry};
use crate::series::SeriesError;
use crate::series::debye::{DebyeSeries, Term};
use crate::shape::Shape;
use crate::tabulate::scattered_power::scattered_by_order;
use crate::trace::{Tracer, Wavefront, energy_by_fate};
use num_complex::Complex64;

/// Power of one order, as shares of the light on the shadow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct OrderPower {
    /// Number of chords.
    pub order: u32,
    /// Of the amplitudes.
    pub scattered: f64,
    /// Of the rays, and of what tunnels.
    pub brought: f64,
}

impl OrderPower {
    fn ratio(&self) -> f64 {
        self.scattered / self.brought
    }

    /// Share of its amplitude by which the order's wave is wrong at least.
    fn doubt(&self) -> f64 {
        (1.0 - self.ratio().sqrt().recip()).abs()
    }
}

/// The orders that hold light and whose waves are known one by one.
///
/// # Errors
/// What the series of the sphere refuses.
pub(super) fn order_powers(
    plan: &Plan,
    far_field: &FarField,
    index: Complex64,
    budget: &EnergyBudget,
) -> Result<Vec<OrderPower>, SeriesError> {
    let round = plan.symmetry == Symmetry::Rotational;
    let small = far_field.size_parameter() < plan.thresholds.wavefront_from;
    if plan.engine != Engine::Meridians || round || small {
        return Ok(Vec::new());
    }
    let least = plan.thresholds.least_checked_power;
    let rays = |order: u32| budget.left_by_order.get(order as usize).copied().unwrap_or(0.0);
    let orders: Vec<u32> =
        plan.orders.iter().copied().filter(|&order| order > 0 && rays(order) > least).collect();
    let found = scattered_by_order(far_field, &orders);
    if found.is_empty() {
        return Ok(Vec::new());
    }
    let x = far_field.size_parameter().min(plan.thresholds.largest_checked_sphere);
    let sphere = Tunnelling::new(x, index, orders.iter().copied().max().unwrap_or(1))?;
    let area = far_field.silhouette().area();
    let power = |&(order, scattered): &(u32, f64)| OrderPower {
        order,
        scattered: scattered / area,
        brought: rays(order) * sphere.factor(order),
    };
    Ok(found.iter().map(power).collect())
}

/// Shares of the amplitudes by which orders are wrong at least.
pub(super) fn doubts(powers: &[OrderPower]) -> Vec<(u32, f64)> {
    powers.iter().map(|power| (power.order, power.doubt())).collect()
}

/// Note in the methods of a table what their waves scatter, and mark those that are off.
pub(super) fn mark(parts: &mut [MethodPart], powers: &[OrderPower], most_off: f64) {
    for part in parts {
        let Some(power) = powers.iter().find(|power| Some(power.order) == part.order) else {
            continue;
        };
        part.share_scattered = Some(power.scattered);
        let ratio = power.ratio();
        if (ratio - 1.0).abs() > most_off {
            let percent = 100.0 * ratio;
            part.reason += &format!("; its wave holds {percent:.0} % of the light that rays bring");
        }
    }
}

/// Refuse amplitudes whose orders together are off by more than a share of the light on the shadow.
pub(super) fn refuse_imbalance(
    powers: &[OrderPower],
    most: f64,
    area: f64,
    wavelength: f64,
) -> Result<(), SimulateError> {
    let off: f64 = powers.iter().map(|power| (power.scattered - power.brought).abs()).sum();
    if off <= most {
        return Ok(());
    }
    let sum = |share: fn(&OrderPower) -> f64| area * powers.iter().map(share).sum::<f64>();
    let (power, left) = (sum(|power| power.scattered), sum(|power| power.brought));
    Err(SimulateError::Imbalance { wavelength_nm: wavelength * 1e9, power, left })
}

/// By how much Debye terms of a sphere hold more than its rays.
struct Tunnelling {
    series: DebyeSeries,
    rays: Vec<f64>,
    size_parameter: f64,
}

impl Tunnelling {
    fn new(size_parameter: f64, index: Complex64, last: u32) -> Result<Self, SeriesError> {
        const RINGS: usize = 400;
        let shape = Shape::sphere();
        let tracer = Tracer::new(&shape, index, size_parameter, last);
        let rays = energy_by_fate(&tracer, &Wavefront::midpoints(&shape, RINGS, 4)).left_by_order;
        Ok(Self { series: DebyeSeries::new(size_parameter, index)?, rays, size_parameter })
    }

    fn factor(&self, order: u32) -> f64 {
        let (a, b) = self.series.coefficients(&[Term::Order(order)]);
        let waves = a.iter().zip(&b).enumerate();
        let sum: f64 =
            waves.map(|(k, (a, b))| (2 * k + 3) as f64 * (a.norm_sqr() + b.norm_sqr())).sum();
        let x = self.size_parameter;
        2.0 * sum / (x * x) / self.rays[order as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// Low orders of a large sphere hold what their rays bring; high ones, whose rays leave near the rim, more.
    #[test]
    fn high_orders_tunnel() {
        let sphere = Tunnelling::new(5000.0, 1.333.into(), 5).unwrap();
        let factors: Vec<f64> = (1..=5).map(|order| sphere.factor(order)).collect();
        assert!((factors[0] - 1.0).abs() < 5e-3, "{factors:?}");
        assert!((factors[1] - 1.0).abs() < 0.02, "{factors:?}");
        assert!(factors.windows(2).all(|w| w[1] > w[0] - 1e-3), "{factors:?}");
        // the excess falls with the size
        let large = Tunnelling::new(20_000.0, 1.333.into(), 5).unwrap();
        assert!(large.factor(5) - 1.0 < 0.8 * (factors[4] - 1.0), "{factors:?}");
    }

    #[test]
    fn orders_that_are_off_are_marked_and_doubted() {
        let power = |order, scattered| OrderPower { order, scattered, brought: 0.01 };
        let powers = [power(1, 0.01), power(4, 0.0004)];
        let part = |order| MethodPart { order: Some(order), ..MethodPart::default() };
        let mut parts = vec![part(0), part(1), part(4)];
        mark(&mut parts, &powers, 0.05);
        assert_eq!(parts[0], part(0));
        assert_eq!((parts[1].share_scattered, parts[1].reason.as_str()), (Some(0.01), ""));
        assert!(parts[2].reason.contains("holds 4 % of the light"), "{}", parts[2].reason);
        // a wave of a fifth of its amplitude misses four times what it is
        let doubts = doubts(&powers);
        assert!(doubts[0].1.abs() < 1e-12 && (doubts[1].1 - 4.0).abs() < 1e-12, "{doubts:?}");
        assert!(refuse_imbalance(&powers, 0.01, PI, 5e-7).is_ok());
        assert!(refuse_imbalance(&powers, 0.009, PI, 5e-7).is_err());
    }
}
