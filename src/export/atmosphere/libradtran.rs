//! libRadtran's `.mie.cdf` layout: effective radii ascending, elements 11, 12, 33, 34 of spheres and then 22,
//! 44 of other particles (its own order), θ ascending, ∫ p dμ = 2, moments with 2l+1; extinction in km⁻¹ per
//! g/m³ of the particles' medium.
//!
//! The mass is that of the mean particle, density times mean volume: for a distribution of sizes the
//! effective radius does not give it (⟨r³⟩ is (1 − v)(1 − 2v) r_eff³ for gamma, exp(−3s²) r_eff³ for
//! log-normal). A table without density is refused.

use crate::export::atmosphere::database::{albedo, attributes, coefficients, variable};
use crate::export::atmosphere::size_grid::{SizeGrid, untold};
use crate::export::atmosphere::source::Source;
use crate::export::average::{Averaged, Curve};
use crate::export::{ExportError, invalid};
use crate::hdf5::{NetcdfFile, NetcdfValues, NetcdfVariable};
use crate::phase_table::PhaseTable;
use crate::transfer::Expansion;
use std::f64::consts::PI;

/// Name and units of what a table is refused without.
const DENSITY: &str = "medium_density";

/// What is written: by wavelength, then by size.
struct Layout<'a> {
    source: Source<'a>,
    /// Density (kg/m³) and mass of the mean particle (kg), per table.
    masses: Vec<(f64, f64)>,
}

/// The database; `averaged` are the averages of the grid's tables, in their order.
///
/// # Errors
/// When a density is not known, or the tables differ in their effective variance, which the layout has
/// no room for.
pub fn database(
    grid: &SizeGrid,
    averaged: &[Averaged],
    moments: usize,
) -> Result<NetcdfFile, ExportError> {
    let source = Source::new(grid, averaged, moments)?;
    let (table, first) = (&grid.tables[0], source.first);
    if grid.variances.len() > 1 {
        let accepted = "one effective variance: libRadtran's layout has effective radii alone";
        return Err(invalid("sweep", format!("{} variances", grid.variances.len()), accepted));
    }
    let masses = grid.tables.iter().map(mass).collect::<Result<_, _>>()?;
    let layout = Layout { source, masses };
    let mut variables = layout.angular();
    variables.extend(layout.optics());
    let variance = grid.variances[0].to_string();
    let more = [("file_info", "libRadtran mie cdf layout"), ("effective_variance", &variance)];
    Ok(NetcdfFile {
        dimensions: vec![
            ("nlam".into(), first.curves.len()),
            ("nreff".into(), grid.radii.len()),
            ("nphamat".into(), first.elements().len()),
            ("nthetamax".into(), first.theta.len()),
            ("nmommax".into(), moments),
        ],
        variables,
        attributes: attributes(table, first, &more),
    })
}

/// Density and mass of the mean particle of a table, kg/m³ and kg.
fn mass(table: &PhaseTable) -> Result<(f64, f64), ExportError> {
    let bodies = table.header.bodies.as_ref().ok_or_else(|| untold(table))?;
    let (Some(density), Some(mass)) = (bodies.density, bodies.mean_mass()) else {
        let accepted = "extinction per mass needs the density of the medium: give density_kg_m3 under \
                        [particle] of the scene (particle.density_kg_m3), or --density-kg-m3 here";
        return Err(invalid(DENSITY, "not known", accepted));
    };
    Ok((density, mass))
}

impl Layout<'_> {
    /// Curves by wavelength, then by size, each with the number of its table.
    fn curves(&self) -> impl Iterator<Item = (usize, &Curve)> {
        let wavelengths = self.source.first.curves.len();
        (0..wavelengths).flat_map(|w| {
            self.source.averaged.iter().enumerate().map(move |(table, a)| (table, &a.curves[w]))
        })
    }

    fn number(&self, value: impl Fn(usize, &Curve) -> f64) -> NetcdfValues {
        NetcdfValues::F64(self.curves().map(|(table, curve)| value(table, curve)).collect())
    }

    /// Wavelengths and radii, angles, phase matrix and its moments.
    fn angular(&self) -> Vec<NetcdfVariable> {
        let (first, moments) = (self.source.first, self.source.moments);
        let wavelengths = first.curves.iter().map(|curve| curve.wavelength * 1e6).collect();
        let lines = self.curves().count() * first.elements().len();
        let full = |count: usize| NetcdfValues::I32(vec![count as i32; lines]);
        let degrees: Vec<f32> = first.theta.iter().map(|t| t.to_degrees() as f32).collect();
        let (phase, pmom) = self.phase_and_moments();
        let micrometres = [("units", "um")];
        let radii =
            NetcdfValues::F64(self.source.grid.radii.iter().map(|radius| radius * 1e6).collect());
        let names = first.elements().iter().map(|(name, _)| name.to_string()).collect();
        let by_angle = ["nlam", "nreff", "nphamat", "nthetamax"];
        vec![
            variable("wavelen", &["nlam"], NetcdfValues::F64(wavelengths), &micrometres),
            variable("reff", &["nreff"], radii, &micrometres),
            variable(
                "phamat",
                &["nphamat"],
                NetcdfValues::Texts(names),
                &[("long_name", "elements of the phase matrix, in this order")],
            ),
            variable("ntheta", &["nlam", "nreff", "nphamat"], full(first.theta.len()), &[]),
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

    /// Values and moments by wavelength, size and element.
    fn phase_and_moments(&self) -> (Vec<f32>, Vec<f32>) {
        let (mut phase, mut pmom) = (Vec::new(), Vec::new());
        for (table, curve) in self.curves() {
            let theta = &self.source.averaged[table].theta;
            let (expanded, _) = Expansion::of_curves(theta, &curve.elements, self.source.moments);
            let [a1, a2, a3, a4] = &expanded.alpha;
            let [b1, b2] = &expanded.beta;
            // In the order of `Averaged::elements`: 11, 12, 33, 34, 22, 44.
            for (&(_, element), moments) in
                self.source.first.elements().iter().zip([a1, b1, a3, b2, a2, a4])
            {
                phase.extend(curve.elements[element].iter().map(|v| (4.0 * PI * v) as f32));
                pmom.extend(moments.iter().map(|v| *v as f32));
            }
        }
        (phase, pmom)
    }

    /// Extinction, albedo, asymmetry, index and density.
    fn optics(&self) -> Vec<NetcdfVariable> {
        let grid = ["nlam", "nreff"];
        let slabs = &self.source.grid.tables[0].slabs;
        let index = |value: fn(&crate::phase_table::Slab) -> f64| {
            NetcdfValues::F64(slabs.iter().map(value).collect())
        };
        let mut variables = vec![
            // One particle per volume V has its mass per V: m²/kg, then 1000 m and 0.001 kg.
            variable(
                "ext",
                &grid,
                self.number(|table, c| c.extinction_cross_section / self.masses[table].1),
                &[("units", "km-1/(g/m3)")],
            ),
            variable("ssa", &grid, self.number(|_, c| albedo(c)), &[]),
            variable("gg", &grid, self.number(|_, c| c.asymmetry), &[]),
            variable("refre", &["nlam"], index(|slab| slab.index.re), &[]),
            variable("refim", &["nlam"], index(|slab| slab.index.im), &[]),
            variable(
                "rho",
                &grid,
                self.number(|table, _| self.masses[table].0 / 1000.0),
                &[("units", "g/cm3")],
            ),
        ];
        let tables = &self.source.grid.tables;
        let curves: Vec<_> = self.curves().map(|(table, curve)| (&tables[table], curve)).collect();
        variables.extend(coefficients(&grid, &curves));
        variables
    }
}
