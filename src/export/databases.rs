//! NetCDF databases of radiative transfer programs.

use super::average::{Averaged, Curve};
use super::legendre::{Moments, expand};
use crate::hdf5::{NetcdfFile, NetcdfValues, NetcdfVariable};
use crate::phase_table::PhaseTable;
use std::f64::consts::PI;

fn variable(
    name: &str,
    dimensions: &[&str],
    values: NetcdfValues,
    attributes: &[(&str, &str)],
) -> NetcdfVariable {
    NetcdfVariable {
        name: name.into(),
        dimensions: dimensions.iter().map(|name| name.to_string()).collect(),
        values,
        attributes: attributes.iter().map(|(a, b)| (a.to_string(), b.to_string())).collect(),
    }
}

fn per_curve(averaged: &[&Averaged], value: impl Fn(&Curve) -> f64) -> NetcdfValues {
    NetcdfValues::F64(averaged.iter().flat_map(|a| &a.curves).map(value).collect())
}

/// What was done to the forward peak, in words.
fn peak_words(averaged: &Averaged) -> String {
    format!(
        "Below {:.4} degree the phase function keeps its value there; the power cut off \
         (peak_share of the scattered power) counts as unscattered and is not in the cross-sections.",
        averaged.cap.to_degrees()
    )
}

fn attributes(
    table: &PhaseTable,
    averaged: &Averaged,
    more: &[(&str, &str)],
) -> Vec<(String, String)> {
    let mut attributes = vec![
        ("source".to_string(), format!("gonio {}", env!("CARGO_PKG_VERSION"))),
        ("scene".to_string(), table.header.scene_toml.clone()),
        ("forward_peak".to_string(), peak_words(averaged)),
        ("polarised".to_string(), if averaged.polarised { "yes" } else { "no" }.to_string()),
    ];
    attributes.extend(more.iter().map(|(name, text)| (name.to_string(), text.to_string())));
    attributes
}

/// Eradiate's Aer-Core v2: `mu` ascending, ∫ p dμ = 2 by the trapezoid rule that Eradiate uses,
/// `pmom` of p11 with the factor 2l+1. The extinction is that of one particle per cubic metre.
pub fn eradiate(table: &PhaseTable, averaged: &Averaged, moments: usize) -> NetcdfFile {
    let (curves, angles) = (&averaged.curves, averaged.theta.len());
    let theta: Vec<f64> = averaged.theta.iter().rev().copied().collect();
    let mu: Vec<f64> = theta.iter().map(|theta| theta.cos()).collect();
    // Places in `average::ELEMENTS` of the components that Eradiate knows.
    let components = [("11", 0), ("12", 1), ("33", 3), ("34", 4)];
    let used = if averaged.polarised { &components[..] } else { &components[..1] };

    let mut phase = Vec::with_capacity(used.len() * curves.len() * angles);
    for (_, element) in used {
        for curve in curves {
            let p11: Vec<f64> = curve.elements[0].iter().rev().copied().collect();
            let scale = 2.0 / trapezoid(&mu, &p11);
            phase.extend(curve.elements[*element].iter().rev().map(|value| value * scale));
        }
    }
    let repeated = |line: &[f64]| line.repeat(curves.len());
    let pmom = curves.iter().flat_map(|curve| expand(averaged, curve, moments).alpha[0].clone());
    let wavelengths = curves.iter().map(|curve| curve.wavelength * 1e9).collect();
    let count = |length: usize| NetcdfValues::I32(vec![length as i32; curves.len()]);
    let one = [averaged];
    let albedo = |c: &Curve| c.scattering_cross_section / c.extinction_cross_section;
    let named = |name: &'static str, long: &'static str, units: &'static str| {
        [("standard_name", name), ("long_name", long), ("units", units)]
    };
    NetcdfFile {
        dimensions: vec![
            ("w".into(), curves.len()),
            ("phamat".into(), used.len()),
            ("iangle".into(), angles),
            ("imom".into(), moments),
        ],
        variables: vec![
            variable(
                "w",
                &["w"],
                NetcdfValues::F64(wavelengths),
                &named("wavelength", "wavelength", "nm"),
            ),
            variable(
                "phamat",
                &["phamat"],
                NetcdfValues::Texts(used.iter().map(|(name, _)| name.to_string()).collect()),
                &[("standard_name", "component"), ("long_name", "phase matrix component")],
            ),
            variable("imom", &["imom"], NetcdfValues::I32((0..moments as i32).collect()), &[]),
            variable(
                "mu",
                &["w", "iangle"],
                NetcdfValues::F64(repeated(&mu)),
                &named("scattering_angle_cosine", "scattering angle cosine", "dimensionless"),
            ),
            variable(
                "theta",
                &["w", "iangle"],
                NetcdfValues::F64(repeated(&theta)),
                &named("scattering_angle", "scattering angle", "rad"),
            ),
            variable(
                "ext",
                &["w"],
                per_curve(&one, |c| c.extinction_cross_section),
                &named(
                    "extinction_coefficient",
                    "extinction coefficient, one particle per m3",
                    "1/m",
                ),
            ),
            variable(
                "ssa",
                &["w"],
                per_curve(&one, albedo),
                &named("single_scattering_albedo", "single-scattering albedo", "dimensionless"),
            ),
            variable(
                "phase",
                &["phamat", "w", "iangle"],
                NetcdfValues::F64(phase),
                &named("phase_matrix", "phase matrix, integral over mu is 2", "1/sr"),
            ),
            variable(
                "nangles",
                &["w"],
                count(angles),
                &[
                    ("standard_name", "n_angular_samples"),
                    ("long_name", "number of angular samples"),
                ],
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
        ],
        attributes: attributes(table, averaged, &[("Conventions", "Aer-Core v2")]),
    }
}

fn trapezoid(x: &[f64], y: &[f64]) -> f64 {
    let pairs = x.windows(2).zip(y.windows(2));
    pairs.map(|(x, y)| 0.5 * (x[1] - x[0]) * (y[0] + y[1])).sum()
}

/// sasktran2's scatterer database over (radius_um, wavelength_nm, legendre), 2l+1 included. Its Q
/// has the opposite sense of ours, so b1 and b2 are negated (Rayleigh scattering has `b1[2]` > 0).
/// `tables` are of one sweep of radii, ascending, each with its average; a single table has no
/// dimension of radii, for the program interpolates along every dimension that is there.
pub fn sasktran2(tables: &[(&PhaseTable, &Averaged)], moments: usize) -> NetcdfFile {
    let averaged: Vec<&Averaged> = tables.iter().map(|(_, averaged)| *averaged).collect();
    let Some(&(first_table, first)) = tables.first() else { return NetcdfFile::default() };
    let expanded: Vec<Moments> = averaged
        .iter()
        .flat_map(|a| a.curves.iter().map(|curve| expand(a, curve, moments)))
        .collect();
    let column = |pick: &dyn Fn(&Moments) -> &Vec<f64>, sign: f64| {
        NetcdfValues::F64(expanded.iter().flat_map(|m| pick(m).iter().map(|v| sign * v)).collect())
    };
    let radii = tables.iter().map(|(table, _)| table.header.radius * 1e6).collect();
    let wavelengths = first.curves.iter().map(|curve| curve.wavelength * 1e9).collect();
    let dimensions = ["radius_um", "wavelength_nm", "legendre"];
    let (deep, grid) = if tables.len() > 1 {
        (&dimensions[..], &dimensions[..2])
    } else {
        (&dimensions[1..], &dimensions[1..2])
    };
    let area = [("units", "m2")];
    let mut variables = vec![
        variable(
            "radius_um",
            if tables.len() > 1 { &["radius_um"] } else { &[] },
            NetcdfValues::F64(radii),
            &[("units", "um")],
        ),
        variable(
            "wavelength_nm",
            &["wavelength_nm"],
            NetcdfValues::F64(wavelengths),
            &[("units", "nm")],
        ),
        variable("xs_total", grid, per_curve(&averaged, |c| c.extinction_cross_section), &area),
        variable(
            "xs_scattering",
            grid,
            per_curve(&averaged, |c| c.scattering_cross_section),
            &area,
        ),
        variable("peak_share", grid, per_curve(&averaged, |c| c.peak_share), &[("units", "1")]),
    ];
    for (i, name) in ["lm_a1", "lm_a2", "lm_a3", "lm_a4"].into_iter().enumerate() {
        variables.push(variable(name, deep, column(&|m| &m.alpha[i], 1.0), &[]));
    }
    for (i, name) in ["lm_b1", "lm_b2"].into_iter().enumerate() {
        variables.push(variable(name, deep, column(&|m| &m.beta[i], -1.0), &[]));
    }
    let lengths = [tables.len(), first.curves.len(), moments];
    let named = dimensions.iter().map(|name| name.to_string()).zip(lengths);
    NetcdfFile {
        dimensions: named.skip(usize::from(tables.len() == 1)).collect(),
        variables,
        attributes: attributes(
            first_table,
            first,
            &[("moments", "generalised spherical functions, factor 2l+1 included")],
        ),
    }
}

/// libRadtran's `.mie.cdf` layout: one effective radius, elements 11, 12, 33, 34, θ ascending,
/// ∫ p dμ = 2, moments with 2l+1; extinction in km⁻¹ per g/m³ of water.
pub fn libradtran(table: &PhaseTable, averaged: &Averaged, moments: usize) -> NetcdfFile {
    const WATER_DENSITY: f64 = 1000.0;
    let curves = &averaged.curves;
    let (lines, angles) = (curves.len(), averaged.theta.len());
    let elements = if averaged.polarised { vec![0, 1, 3, 4] } else { vec![0] };
    let matrix = elements.len();
    let mut phase = Vec::with_capacity(lines * matrix * angles);
    let mut pmom = Vec::with_capacity(lines * matrix * moments);
    for curve in curves {
        let expanded = expand(averaged, curve, moments);
        let tables = [&expanded.alpha[0], &expanded.beta[0], &expanded.alpha[2], &expanded.beta[1]];
        for (&element, moments) in elements.iter().zip(tables) {
            phase.extend(curve.elements[element].iter().map(|v| (4.0 * PI * v) as f32));
            pmom.extend(moments.iter().map(|v| *v as f32));
        }
    }
    let degrees: Vec<f32> = averaged.theta.iter().map(|t| t.to_degrees() as f32).collect();
    let radius = table.header.radius;
    // One particle per volume V weighs ρ 4/3 π a³ / V: extinction per mass, then 1000 m and 0.001 kg.
    let mass = WATER_DENSITY * 4.0 / 3.0 * PI * radius.powi(3);
    let one = [averaged];
    let grid = ["nlam", "nreff"];
    let full = |count: usize| NetcdfValues::I32(vec![count as i32; lines * matrix]);
    let index = |imaginary: bool| {
        NetcdfValues::F64(
            table.slabs.iter().map(|s| if imaginary { s.index.im } else { s.index.re }).collect(),
        )
    };
    let wavelengths = curves.iter().map(|curve| curve.wavelength * 1e6).collect();
    NetcdfFile {
        dimensions: vec![
            ("nlam".into(), lines),
            ("nreff".into(), 1),
            ("nphamat".into(), matrix),
            ("nthetamax".into(), angles),
            ("nmommax".into(), moments),
        ],
        variables: vec![
            variable("wavelen", &["nlam"], NetcdfValues::F64(wavelengths), &[("units", "um")]),
            variable("reff", &["nreff"], NetcdfValues::F64(vec![radius * 1e6]), &[("units", "um")]),
            variable("ntheta", &["nlam", "nreff", "nphamat"], full(angles), &[]),
            variable(
                "theta",
                &["nlam", "nreff", "nphamat", "nthetamax"],
                NetcdfValues::F32(degrees.repeat(lines * matrix)),
                &[("units", "degree")],
            ),
            variable(
                "phase",
                &["nlam", "nreff", "nphamat", "nthetamax"],
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
            variable(
                "ext",
                &grid,
                per_curve(&one, |c| c.extinction_cross_section / mass),
                &[("units", "km-1/(g/m3)")],
            ),
            variable(
                "ssa",
                &grid,
                per_curve(&one, |c| c.scattering_cross_section / c.extinction_cross_section),
                &[],
            ),
            variable("gg", &grid, per_curve(&one, |c| c.asymmetry), &[]),
            variable("refre", &["nlam"], index(false), &[]),
            variable("refim", &["nlam"], index(true), &[]),
            variable("rho", &grid, NetcdfValues::F64(vec![1.0; lines]), &[("units", "g/cm3")]),
        ],
        attributes: attributes(table, averaged, &[("file_info", "libRadtran mie cdf layout")]),
    }
}
