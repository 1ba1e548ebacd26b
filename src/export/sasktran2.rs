//! sasktran2's scatterer database over (radius_um, wavelength_nm, legendre), 2l+1 included.
//!
//! Its Q has the opposite sense of ours, so b1 and b2 are negated (Rayleigh scattering has
//! `b1[2]` > 0).

use super::average::Averaged;
use super::database::{attributes, per_curve, variable};
use super::legendre::{Moments, expand};
use crate::hdf5::{NetcdfFile, NetcdfValues};
use crate::phase_table::PhaseTable;

/// The database. `tables` are of one sweep of radii, ascending, each with its average; a single
/// table has no dimension of radii, for the program interpolates along every dimension that is
/// there.
pub fn database(tables: &[(&PhaseTable, &Averaged)], moments: usize) -> NetcdfFile {
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
