//! The power that amplitudes scatter, added up over the sphere: the other way to the scattering
//! cross-section, which is extinction straight ahead less absorption.
//!
//! A table's own sum cannot tell: its samples may be few, and the forward peak is scaled until it is right.
//! Here Gauss's nodes in cos θ resolve every fringe of a small particle, the forward peak too, so that the
//! two ways differ by the error of the method alone.

use crate::farfield::FarField;
use crate::math::gauss_legendre;
use crate::math::parallel::*;
use std::f64::consts::{PI, TAU};

/// Nodes in cos θ per size parameter and beside: the pattern of a size parameter x is a polynomial of
/// degree 2x and some, exact with half as many nodes; rays have kinks.
const PER_SIZE: f64 = 1.5;
const MORE: f64 = 40.0;
/// Azimuths per half-turn.
const AZIMUTHS: usize = 10;

/// Scattering cross-section of a far field with its forward diffraction, in units of the squared radius.
pub fn scattered_power(far_field: &FarField, rotational: bool) -> f64 {
    let x = far_field.size_parameter();
    let nodes = gauss_legendre::nodes((PER_SIZE * x + MORE) as usize);
    let azimuths = if rotational { 1 } else { AZIMUTHS };
    let azimuth = |j: usize| PI * (j as f64 + 0.5) / azimuths as f64;
    let directions: Vec<(f64, f64)> = (0..azimuths)
        .flat_map(|j| nodes.iter().map(move |(cosine, _)| (cosine.acos(), azimuth(j))))
        .collect();
    let found = far_field.scatter(&directions, true);
    let weights = nodes.iter().map(|(_, weight)| weight).cycle();
    let sum: f64 = found.iter().zip(weights).map(|(s, weight)| s.s11() * weight).sum();
    TAU / azimuths as f64 * sum / (x * x)
}

/// Angles and azimuths at which the power of an order is added up: its fringes are many more, and as often
/// bright as dark.
const ORDER_ANGLES: usize = 1440;
const ORDER_AZIMUTHS: usize = 8;

/// Scattering cross-sections of single orders without diffraction, in units of the squared radius, of those
/// of some orders whose waves are known one by one.
pub fn scattered_by_order(far_field: &FarField, orders: &[u32]) -> Vec<(u32, f64)> {
    let x = far_field.size_parameter();
    let (angles, azimuths) = (ORDER_ANGLES, ORDER_AZIMUTHS);
    let step = PI / angles as f64;
    let theta: Vec<f64> = (0..angles).map(|i| (i as f64 + 0.5) * step).collect();
    let azimuth = |j: usize| PI * (j as f64 + 0.5) / azimuths as f64;
    let azimuths: Vec<f64> = (0..azimuths).map(azimuth).collect();
    let power = |&order: &u32| {
        let columns = far_field.columns_of_order(order, &theta, &azimuths)?;
        let sum: f64 = columns
            .iter()
            .flat_map(|column| column.iter().zip(&theta))
            .map(|(s, theta)| s.s11() * theta.sin())
            .sum();
        Some((order, sum * step * TAU / azimuths.len() as f64 / (x * x)))
    };
    orders.par_iter().filter_map(power).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::farfield::FarFieldSettings;
    use crate::farfield::assignment::{Assignment, Thresholds};
    use crate::series::lorenz_mie::Sphere;
    use crate::shape::Shape;
    use crate::trace::Tracer;
    use num_complex::Complex64;

    /// A clear sphere scatters what Lorenz–Mie says that it takes from the light.
    #[test]
    fn a_clear_sphere_scatters_its_extinction() {
        let (x, index, orders) = (100.0, Complex64::new(1.5, 0.0), [0, 1, 2, 3, 4, 5, 6]);
        let shape = Shape::sphere();
        let tracer = Tracer::new(&shape, index, x, 6).with_curved_interface(x);
        let settings = FarFieldSettings {
            size_parameter: x,
            orders: &orders,
            tolerance: 0.01,
            diffraction: true,
        };
        let by = Thresholds::MEASURED;
        let assignment = Assignment::as_if(false, &tracer, &orders, [x, 0.01], &by);
        let far_field = FarField::assigned(&tracer, &settings, assignment);
        let power = scattered_power(&far_field, true);
        // the same by another rule, far finer
        let step = PI / 40_000.0;
        let line: Vec<(f64, f64)> = (0..40_000).map(|i| ((i as f64 + 0.5) * step, 0.0)).collect();
        let found = far_field.scatter(&line, true);
        let plain: f64 = found.iter().zip(&line).map(|(s, at)| s.s11() * at.0.sin()).sum();
        let plain = TAU * step * plain / (x * x);
        assert!((power / plain - 1.0).abs() < 1e-3, "{power} {plain}");
        // rays of this sphere, between resonances or on one, scatter 1.2 % less than it does
        let exact = PI * Sphere::new(x, index).unwrap().efficiencies().q_sca;
        assert!((power / exact - 1.0).abs() < 0.015, "{power} {exact}");
    }
}
