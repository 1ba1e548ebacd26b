//! libRadtran's `.mie.cdf` layout: one effective radius, elements 11, 12, 33, 34, θ ascending,
//! ∫ p dμ = 2, moments with 2l+1; extinction in km⁻¹ per g/m³ of water.

use super::average::Averaged;
use super::database::{albedo, attributes, per_curve, sphere_elements, variable};
use super::legendre::expand;
use crate::hdf5::{NetcdfFile, NetcdfValues, NetcdfVariable};
use crate::phase_table::PhaseTable;
use std::f64::consts::PI;

/// Density of water, kg/m³.
const WATER_DENSITY: f64 = 1000.0;

/// The database.
pub fn database(table: &PhaseTable, averaged: &Averaged, moments: usize) -> NetcdfFile {
    let mut variables = angular(table, averaged, moments);
    variables.extend(optics(table, averaged));
    NetcdfFile {
        dimensions: vec![
            ("nlam".into(), averaged.curves.len()),
            ("nreff".into(), 1),
            ("nphamat".into(), sphere_elements(averaged).len()),
            ("nthetamax".into(), averaged.theta.len()),
            ("nmommax".into(), moments),
        ],
        variables,
        attributes: attributes(table, averaged, &[("file_info", "libRadtran mie cdf layout")]),
    }
}

/// Wavelengths and radius, angles, phase matrix and its moments.
fn angular(table: &PhaseTable, averaged: &Averaged, moments: usize) -> Vec<NetcdfVariable> {
    let curves = &averaged.curves;
    let wavelengths = curves.iter().map(|curve| curve.wavelength * 1e6).collect();
    let lines = curves.len() * sphere_elements(averaged).len();
    let full = |count: usize| NetcdfValues::I32(vec![count as i32; lines]);
    let degrees: Vec<f32> = averaged.theta.iter().map(|t| t.to_degrees() as f32).collect();
    let (phase, pmom) = phase_and_moments(averaged, moments);
    let micrometres = [("units", "um")];
    let radius = NetcdfValues::F64(vec![table.header.radius * 1e6]);
    let by_angle = ["nlam", "nreff", "nphamat", "nthetamax"];
    vec![
        variable("wavelen", &["nlam"], NetcdfValues::F64(wavelengths), &micrometres),
        variable("reff", &["nreff"], radius, &micrometres),
        variable("ntheta", &["nlam", "nreff", "nphamat"], full(averaged.theta.len()), &[]),
        variable(
            "theta",
            &by_angle,
            NetcdfValues::F32(degrees.repeat(lines)),
            &[("units", "degree")],
        ),
        variable(
            "phase",
            &by_angle,
            NetcdfValues::F32(phase),
            &[("comment", "integral over mu is 2")],
        ),
        variable("nmom", &["nlam", "nreff", "nphamat"], full(moments), &[]),
        variable(
            "pmom",
            &["nlam", "nreff", "nphamat", "nmommax"],
            NetcdfValues::F32(pmom),
            &[("comment", "factor 2l+1 included")],
        ),
    ]
}

/// Values and moments by wavelength and element.
fn phase_and_moments(averaged: &Averaged, moments: usize) -> (Vec<f32>, Vec<f32>) {
    let (mut phase, mut pmom) = (Vec::new(), Vec::new());
    for curve in &averaged.curves {
        let expanded = expand(averaged, curve, moments);
        let tables = [&expanded.alpha[0], &expanded.beta[0], &expanded.alpha[2], &expanded.beta[1]];
        for (&(_, element), moments) in sphere_elements(averaged).iter().zip(tables) {
            phase.extend(curve.elements[element].iter().map(|v| (4.0 * PI * v) as f32));
            pmom.extend(moments.iter().map(|v| *v as f32));
        }
    }
    (phase, pmom)
}

/// Extinction, albedo, asymmetry, index and density.
fn optics(table: &PhaseTable, averaged: &Averaged) -> Vec<NetcdfVariable> {
    let grid = ["nlam", "nreff"];
    // One particle per volume V weighs ρ 4/3 π a³ / V: extinction per mass, then 1000 m and 0.001 kg.
    let mass = WATER_DENSITY * 4.0 / 3.0 * PI * table.header.radius.powi(3);
    let index = |imaginary: bool| {
        NetcdfValues::F64(
            table.slabs.iter().map(|s| if imaginary { s.index.im } else { s.index.re }).collect(),
        )
    };
    let density = NetcdfValues::F64(vec![WATER_DENSITY / 1000.0; averaged.curves.len()]);
    vec![
        variable(
            "ext",
            &grid,
            per_curve(&[averaged], |c| c.extinction_cross_section / mass),
            &[("units", "km-1/(g/m3)")],
        ),
        variable("ssa", &grid, per_curve(&[averaged], albedo), &[]),
        variable("gg", &grid, per_curve(&[averaged], |c| c.asymmetry), &[]),
        variable("refre", &["nlam"], index(false), &[]),
        variable("refim", &["nlam"], index(true), &[]),
        variable("rho", &grid, density, &[("units", "g/cm3")]),
    ]
}
