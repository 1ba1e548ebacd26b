//! Eradiate's Aer-Core v2: `mu` ascending, ∫ p dμ = 2 by the trapezoid rule that Eradiate uses,
//! `pmom` of p11 with the factor 2l+1. The extinction is that of one particle per cubic metre;
//! `extinction_per_length` beside it that of the scene's amount.
//!
//! Elements stand in libRadtran's order, 11, 12, 33, 34 of spheres and then 22, 44 of spheroids (and whatever
//! else is no sphere): Eradiate 1.2 counts them by position and tells spheroids by their number, six.
//! Tables of several sizes make the layout that its pull request 599 calls Prt v1: dimensions `reff`
//! (µm) and `veff` between `w` and the angles.

use crate::export::ExportError;
use crate::export::atmosphere::database::{albedo, attributes, coefficients, variable};
use crate::export::atmosphere::size_grid::SizeGrid;
use crate::export::atmosphere::source::Source;
use crate::export::average::{Averaged, Curve};
use crate::hdf5::{NetcdfFile, NetcdfValues, NetcdfVariable};
use crate::phase_table::PhaseTable;
use crate::transfer::Expansion;

/// What is written: sizes, their averages, and the names of the dimensions between wavelength and angle.
struct Layout<'a> {
    source: Source<'a>,
    sizes: &'static [&'static str],
}

/// The database; `averaged` are the averages of the grid's tables, in their order.
///
/// # Errors
/// When there is no table.
pub fn database(
    grid: &SizeGrid,
    averaged: &[Averaged],
    moments: usize,
) -> Result<NetcdfFile, ExportError> {
    let source = Source::new(grid, averaged, moments)?;
    let (table, first) = (&grid.tables[0], source.first);
    let many = grid.tables.len() > 1;
    let sizes: &[&str] = if many { &["reff", "veff"] } else { &[] };
    let layout = Layout { source, sizes };
    let mut variables = layout.coordinates();
    variables.extend(layout.optics());
    let mut dimensions = vec![
        ("w".into(), first.curves.len()),
        ("phamat".into(), first.elements().len()),
        ("iangle".into(), first.theta.len()),
        ("imom".into(), moments),
    ];
    if many {
        dimensions.push(("reff".into(), grid.radii.len()));
        dimensions.push(("veff".into(), grid.variances.len()));
    }
    let shape = if first.spherical { "spherical" } else { "spheroidal" };
    let conventions = if many { "Prt v1 (Aer-Core v2 with reff, veff)" } else { "Aer-Core v2" };
    let more = [("Conventions", conventions), ("particle_shape", shape)];
    Ok(NetcdfFile { dimensions, variables, attributes: attributes(table, first, &more) })
}

impl Layout<'_> {
    /// Names of dimensions, wavelength first, then the sizes, then `more`.
    fn along(&self, more: &[&'static str]) -> Vec<&'static str> {
        ["w"].iter().chain(self.sizes).chain(more).copied().collect()
    }

    /// Curves by wavelength, then by size, each with its average.
    fn curves(&self) -> impl Iterator<Item = (&Averaged, &Curve)> {
        let wavelengths = self.source.first.curves.len();
        (0..wavelengths).flat_map(|w| self.source.averaged.iter().map(move |a| (a, &a.curves[w])))
    }

    fn number(&self, value: impl Fn(&Curve) -> f64) -> NetcdfValues {
        NetcdfValues::F64(self.curves().map(|(_, curve)| value(curve)).collect())
    }

    /// Wavelengths, sizes, elements, moments and angles.
    fn coordinates(&self) -> Vec<NetcdfVariable> {
        let (first, count) = (self.source.first, self.curves().count());
        let wavelengths = first.curves.iter().map(|curve| curve.wavelength * 1e9).collect();
        let elements = first.elements().iter().map(|(name, _)| name.to_string()).collect();
        let theta: Vec<f64> = first.theta.iter().rev().copied().collect();
        let repeated = |line: Vec<f64>| NetcdfValues::F64(line.repeat(count));
        let by_angle = self.along(&["iangle"]);
        let mut variables = vec![
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
            variable(
                "imom",
                &["imom"],
                NetcdfValues::I32((0..self.source.moments as i32).collect()),
                &[],
            ),
            variable(
                "mu",
                &by_angle,
                repeated(theta.iter().map(|theta| theta.cos()).collect()),
                &named("scattering_angle_cosine", "scattering angle cosine", "dimensionless"),
            ),
            variable(
                "theta",
                &by_angle,
                repeated(theta),
                &named("scattering_angle", "scattering angle", "rad"),
            ),
        ];
        if !self.sizes.is_empty() {
            let radii = self.source.grid.radii.iter().map(|radius| radius * 1e6).collect();
            variables.push(variable(
                "reff",
                &["reff"],
                NetcdfValues::F64(radii),
                &named("effective_radius", "effective radius", "um"),
            ));
            variables.push(variable(
                "veff",
                &["veff"],
                NetcdfValues::F64(self.source.grid.variances.clone()),
                &named("effective_variance", "effective variance", "dimensionless"),
            ));
        }
        variables
    }

    /// Extinction, albedo, phase matrix and its moments.
    fn optics(&self) -> Vec<NetcdfVariable> {
        let (plain, moments) = (self.along(&[]), self.source.moments);
        let counts = self.curves().count();
        let count = |length: usize| NetcdfValues::I32(vec![length as i32; counts]);
        let pmom = self.curves().flat_map(|(a, curve)| {
            let [p11, ..] = Expansion::of_curves(&a.theta, &curve.elements, moments).0.alpha;
            p11
        });
        let mut variables = vec![
            variable(
                "ext",
                &plain,
                self.number(|c| c.extinction_cross_section),
                &named(
                    "extinction_coefficient",
                    "extinction coefficient, one particle per m3",
                    "1/m",
                ),
            ),
            variable(
                "ssa",
                &plain,
                self.number(albedo),
                &named("single_scattering_albedo", "single-scattering albedo", "dimensionless"),
            ),
            variable(
                "phase",
                &[&["phamat"], &self.along(&["iangle"])[..]].concat(),
                NetcdfValues::F64(self.phase_matrix()),
                &named("phase_matrix", "phase matrix, integral over mu is 2", "1/sr"),
            ),
            variable(
                "nangles",
                &plain,
                count(self.source.first.theta.len()),
                &[
                    ("standard_name", "n_angular_samples"),
                    ("long_name", "number of angular samples"),
                ],
            ),
            variable(
                "nmom",
                &plain,
                count(moments),
                &[
                    ("standard_name", "n_legendre_polys"),
                    ("long_name", "number of Legendre polynomials"),
                ],
            ),
            variable(
                "pmom",
                &self.along(&["imom"]),
                NetcdfValues::F64(pmom.collect()),
                &[
                    ("standard_name", "legendre_polys"),
                    ("long_name", "Legendre polynomials"),
                    ("comment", "p11 only; including factor 2l+1"),
                ],
            ),
        ];
        variables.extend(coefficients(&plain, &self.with_tables()));
        variables
    }

    /// Curves in the same order, each with its table.
    fn with_tables(&self) -> Vec<(&PhaseTable, &Curve)> {
        let tables = &self.source.grid.tables;
        self.curves().zip(tables.iter().cycle()).map(|((_, curve), table)| (table, curve)).collect()
    }

    /// Values by element, wavelength, size and ascending μ, scaled to Eradiate's integral.
    fn phase_matrix(&self) -> Vec<f64> {
        let mu: Vec<f64> = self.source.first.theta.iter().rev().map(|theta| theta.cos()).collect();
        let mut phase = Vec::new();
        for (_, element) in self.source.first.elements() {
            for (_, curve) in self.curves() {
                let p11: Vec<f64> = curve.elements[0].iter().rev().copied().collect();
                let scale = 2.0 / trapezoid(&mu, &p11);
                phase.extend(curve.elements[*element].iter().rev().map(|value| value * scale));
            }
        }
        phase
    }
}

fn named<'a>(standard: &'a str, long: &'a str, units: &'a str) -> [(&'a str, &'a str); 3] {
    [("standard_name", standard), ("long_name", long), ("units", units)]
}

fn trapezoid(x: &[f64], y: &[f64]) -> f64 {
    let pairs = x.windows(2).zip(y.windows(2));
    pairs.map(|(x, y)| 0.5 * (x[1] - x[0]) * (y[0] + y[1])).sum()
}
