//! The power that amplitudes scatter, added up over the sphere: the other way to the scattering
//! cross-section, which is extinction straight ahead less absorption.
//!
//! A table's own sum cannot tell: its samples may be few, and the forward peak is scaled until it is right.
//! Here Gauss's nodes in cos θ resolve every fringe of a small particle, the forward peak too, so that the
//! two ways differ by the error of the method alone.

use crate::farfield::FarField;
use crate::math::gauss_legendre;
use std::f64::consts::{PI, TAU};

/// Size parameter up to which it is worth its time; beyond, rays lose less than 1 % of the light.
pub const LARGEST: f64 = 200.0;
/// Nodes in cos θ per size parameter and beside: the pattern of a size parameter x is a polynomial of
/// degree 2x and some, exact with half as many nodes; rays have kinks.
const PER_SIZE: f64 = 1.5;
const MORE: f64 = 40.0;
/// Azimuths per half-turn.
const AZIMUTHS: usize = 10;

/// Scattering cross-section of a far field with its forward diffraction, in units of the squared radius;
/// `None` where it can be asked at chosen azimuths only, or where this would take long.
pub fn scattered_power(far_field: &FarField, rotational: bool) -> Option<f64> {
    let x = far_field.size_parameter();
    if x > LARGEST || !far_field.serves_any_azimuth() {
        return None;
    }
    let nodes = gauss_legendre::nodes((PER_SIZE * x + MORE) as usize);
    let azimuths = if rotational { 1 } else { AZIMUTHS };
    let azimuth = |j: usize| PI * (j as f64 + 0.5) / azimuths as f64;
    let directions: Vec<(f64, f64)> = (0..azimuths)
        .flat_map(|j| nodes.iter().map(move |(cosine, _)| (cosine.acos(), azimuth(j))))
        .collect();
    let found = far_field.scatter(&directions, true);
    let weights = nodes.iter().map(|(_, weight)| weight).cycle();
    let sum: f64 = found.iter().zip(weights).map(|(s, weight)| s.s11() * weight).sum();
    Some(TAU / azimuths as f64 * sum / (x * x))
}
