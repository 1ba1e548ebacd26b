//! Eradiate's Aer-Core v2: `mu` ascending, ∫ p dμ = 2 by the trapezoid rule that Eradiate uses,
//! `pmom` of p11 with the factor 2l+1. The extinction is that of one particle per cubic metre.

use super::average::Averaged;
use super::database::{albedo, attributes, per_curve, sphere_elements, variable};
use super::legendre::expand;
use crate::hdf5::{NetcdfFile, NetcdfValues, NetcdfVariable};
use crate::phase_table::PhaseTable;

/// The database.
pub fn database(table: &PhaseTable, averaged: &Averaged, moments: usize) -> NetcdfFile {
    let mut variables = coordinates(averaged, moments);
    variables.extend(optics(averaged, moments));
    NetcdfFile {
        dimensions: vec![
            ("w".into(), averaged.curves.len()),
            ("phamat".into(), sphere_elements(averaged).len()),
            ("iangle".into(), averaged.theta.len()),
            ("imom".into(), moments),
        ],
        variables,
        attributes: attributes(table, averaged, &[("Conventions", "Aer-Core v2")]),
    }
}

/// Wavelengths, elements, moments and angles.
fn coordinates(averaged: &Averaged, moments: usize) -> Vec<NetcdfVariable> {
    let wavelengths = averaged.curves.iter().map(|curve| curve.wavelength * 1e9).collect();
    let elements = sphere_elements(averaged).iter().map(|(name, _)| name.to_string()).collect();
    let theta: Vec<f64> = averaged.theta.iter().rev().copied().collect();
    let repeated = |line: Vec<f64>| NetcdfValues::F64(line.repeat(averaged.curves.len()));
    vec![
        variable(
            "w",
            &["w"],
            NetcdfValues::F64(wavelengths),
            &named("wavelength", "wavelength", "nm"),
        ),
        variable(
            "phamat",
            &["phamat"],
            NetcdfValues::Texts(elements),
            &[("standard_name", "component"), ("long_name", "phase matrix component")],
        ),
        variable("imom", &["imom"], NetcdfValues::I32((0..moments as i32).collect()), &[]),
        variable(
            "mu",
            &["w", "iangle"],
            repeated(theta.iter().map(|theta| theta.cos()).collect()),
            &named("scattering_angle_cosine", "scattering angle cosine", "dimensionless"),
        ),
        variable(
            "theta",
            &["w", "iangle"],
            repeated(theta),
            &named("scattering_angle", "scattering angle", "rad"),
        ),
    ]
}

/// Extinction, albedo, phase matrix and its moments.
fn optics(averaged: &Averaged, moments: usize) -> Vec<NetcdfVariable> {
    let curves = &averaged.curves;
    let count = |length: usize| NetcdfValues::I32(vec![length as i32; curves.len()]);
    let pmom = curves.iter().flat_map(|curve| expand(averaged, curve, moments).alpha[0].clone());
    vec![
        variable(
            "ext",
            &["w"],
            per_curve(&[averaged], |c| c.extinction_cross_section),
            &named("extinction_coefficient", "extinction coefficient, one particle per m3", "1/m"),
        ),
        variable(
            "ssa",
            &["w"],
            per_curve(&[averaged], albedo),
            &named("single_scattering_albedo", "single-scattering albedo", "dimensionless"),
        ),
        variable(
            "phase",
            &["phamat", "w", "iangle"],
            NetcdfValues::F64(phase_matrix(averaged)),
            &named("phase_matrix", "phase matrix, integral over mu is 2", "1/sr"),
        ),
        variable(
            "nangles",
            &["w"],
            count(averaged.theta.len()),
            &[("standard_name", "n_angular_samples"), ("long_name", "number of angular samples")],
        ),
        variable(
            "nmom",
            &["w"],
            count(moments),
            &[
                ("standard_name", "n_legendre_polys"),
                ("long_name", "number of Legendre polynomials"),
            ],
        ),
        variable(
            "pmom",
            &["w", "imom"],
            NetcdfValues::F64(pmom.collect()),
            &[
                ("standard_name", "legendre_polys"),
                ("long_name", "Legendre polynomials"),
                ("comment", "p11 only; including factor 2l+1"),
            ],
        ),
    ]
}

/// Values by element, wavelength and ascending μ, scaled to Eradiate's integral.
fn phase_matrix(averaged: &Averaged) -> Vec<f64> {
    let mu: Vec<f64> = averaged.theta.iter().rev().map(|theta| theta.cos()).collect();
    let mut phase = Vec::new();
    for (_, element) in sphere_elements(averaged) {
        for curve in &averaged.curves {
            let p11: Vec<f64> = curve.elements[0].iter().rev().copied().collect();
            let scale = 2.0 / trapezoid(&mu, &p11);
            phase.extend(curve.elements[*element].iter().rev().map(|value| value * scale));
        }
    }
    phase
}

fn named<'a>(standard: &'a str, long: &'a str, units: &'a str) -> [(&'a str, &'a str); 3] {
    [("standard_name", standard), ("long_name", long), ("units", units)]
}

fn trapezoid(x: &[f64], y: &[f64]) -> f64 {
    let pairs = x.windows(2).zip(y.windows(2));
    pairs.map(|(x, y)| 0.5 * (x[1] - x[0]) * (y[0] + y[1])).sum()
}
