//! sasktran2's scatterer database over (sizes …, wavelength_nm, legendre), 2l+1 included: all six elements,
//! whatever the particle.
//!
//! Its Q has the opposite sense of ours, so b1 and b2 are negated (Rayleigh scattering has
//! `b1[2]` > 0). Dimensions of sizes bear the names of its own databases: `median_radius` (nm) and
//! `mode_width` (geometric standard deviation) of log-normal sizes; `radius_um` of single ones; else the
//! name of the swept key.

use crate::export::atmosphere::database::{attributes, coefficients, per_curve, variable};
use crate::export::average::Averaged;
use crate::hdf5::{NetcdfFile, NetcdfValues};
use crate::phase_table::PhaseTable;
use crate::transfer::Expansion;

/// A swept dimension, as sasktran2 names it.
#[derive(Clone, Debug, PartialEq)]
pub struct SizeDimension {
    /// Its name.
    pub name: String,
    /// In the words of UDUNITS.
    pub units: String,
    /// Ascending.
    pub values: Vec<f64>,
}

impl SizeDimension {
    /// From a coordinate of a sweep: its name, units and values.
    ///
    /// ```
    /// use gonio::export::sasktran2::SizeDimension;
    /// let width = SizeDimension::of_coordinate("spread", "1", &[0.0, 1.0]);
    /// assert_eq!((width.name.as_str(), width.values[1]), ("mode_width", 1f64.exp()));
    /// ```
    pub fn of_coordinate(name: &str, units: &str, values: &[f64]) -> SizeDimension {
        let (name, units, values) = match name {
            "median_radius_um" => ("median_radius", "nm", values.iter().map(|r| r * 1e3).collect()),
            "spread" => ("mode_width", "1", values.iter().map(|s| s.exp()).collect()),
            _ => (name, units, values.to_vec()),
        };
        SizeDimension { name: name.into(), units: units.into(), values }
    }
}

/// The database. `tables` are those of a sweep over `sizes`, the last one fastest, each with its
/// average; a single table has no sizes, for the program interpolates along every dimension that is
/// there.
pub fn database(
    tables: &[(&PhaseTable, &Averaged)],
    sizes: &[SizeDimension],
    moments: usize,
) -> NetcdfFile {
    let averaged: Vec<&Averaged> = tables.iter().map(|(_, averaged)| *averaged).collect();
    let Some(&(first_table, first)) = tables.first() else { return NetcdfFile::default() };
    let expanded: Vec<Expansion> = averaged
        .iter()
        .flat_map(|a| {
            a.curves.iter().map(|curve| Expansion::of_curves(&a.theta, &curve.elements, moments).0)
        })
        .collect();
    let column = |pick: &dyn Fn(&Expansion) -> &Vec<f64>, sign: f64| {
        NetcdfValues::F64(expanded.iter().flat_map(|m| pick(m).iter().map(|v| sign * v)).collect())
    };
    let wavelengths = first.curves.iter().map(|curve| curve.wavelength * 1e9).collect();
    let names = sizes.iter().map(|size| size.name.as_str());
    let deep: Vec<&str> = names.chain(["wavelength_nm", "legendre"]).collect();
    let grid = &deep[..deep.len() - 1];
    let mut variables: Vec<_> = sizes
        .iter()
        .map(|size| {
            let values = NetcdfValues::F64(size.values.clone());
            variable(&size.name, &[&size.name], values, &[("units", &size.units)])
        })
        .collect();
    if sizes.is_empty() {
        let radius = first_table
            .header
            .bodies
            .as_ref()
            .map_or(first_table.header.radius, |bodies| bodies.effective_radius);
        let words = [("units", "um"), ("long_name", "effective radius")];
        variables.push(variable("radius_um", &[], NetcdfValues::F64(vec![radius * 1e6]), &words));
    }
    let area = [("units", "m2")];
    variables.extend([
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
    ]);
    let curves: Vec<_> = tables
        .iter()
        .flat_map(|(table, averaged)| averaged.curves.iter().map(|curve| (*table, curve)))
        .collect();
    variables.extend(coefficients(grid, &curves));
    for (i, name) in ["lm_a1", "lm_a2", "lm_a3", "lm_a4"].into_iter().enumerate() {
        variables.push(variable(name, &deep, column(&|m| &m.alpha[i], 1.0), &[]));
    }
    for (i, name) in ["lm_b1", "lm_b2"].into_iter().enumerate() {
        variables.push(variable(name, &deep, column(&|m| &m.beta[i], -1.0), &[]));
    }
    let mut dimensions: Vec<(String, usize)> =
        sizes.iter().map(|size| (size.name.clone(), size.values.len())).collect();
    dimensions.push(("wavelength_nm".into(), first.curves.len()));
    dimensions.push(("legendre".into(), moments));
    NetcdfFile {
        dimensions,
        variables,
        attributes: attributes(
            first_table,
            first,
            &[("moments", "generalised spherical functions, factor 2l+1 included")],
        ),
    }
}
