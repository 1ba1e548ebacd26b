//! What a volume and a mass of the particles take from the light, beside the cross-sections of one: coefficients
//! per metre where the number of particles is known, per kilogram where the density of their medium is.
//!
//! They are of the exported curves: a forward peak that was cut counts as unscattered in them too.

use super::average::{Averaged, Curve};
use crate::math::digits::to_digits;
use crate::phase_table::PhaseTable;

/// Extinction and scattering of one wavelength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coefficients {
    /// Extinction and scattering of a volume, 1/m.
    pub per_length: Option<[f64; 2]>,
    /// Extinction and scattering of a mass, m²/kg.
    pub per_mass: Option<[f64; 2]>,
}

impl Coefficients {
    /// Of a curve of a table.
    pub fn of(table: &PhaseTable, curve: &Curve) -> Self {
        let bodies = table.header.bodies.as_ref();
        let sections = [curve.extinction_cross_section, curve.scattering_cross_section];
        let number = bodies.and_then(|bodies| bodies.number_density);
        let mass = bodies.and_then(|bodies| bodies.mean_mass());
        Self {
            per_length: number.map(|number| sections.map(|section| section * number)),
            per_mass: mass.map(|mass| sections.map(|section| section / mass)),
        }
    }
}

/// The coefficients in words, one line per wavelength; none where neither is known.
pub(in crate::export) fn lines(table: &PhaseTable, averaged: &Averaged) -> Vec<String> {
    let of_curve = |curve: &Curve| {
        let found = Coefficients::of(table, curve);
        let told = |pair: Option<[f64; 2]>, units: &str| {
            pair.map(|[extinction, scattering]| {
                format!(
                    "extinction {:e} {units}, scattering {:e} {units}",
                    to_digits(extinction, 7),
                    to_digits(scattering, 7)
                )
            })
        };
        let words: Vec<String> = [told(found.per_length, "1/m"), told(found.per_mass, "m2/kg")]
            .into_iter()
            .flatten()
            .collect();
        let nm = to_digits(curve.wavelength * 1e9, 10);
        (!words.is_empty()).then(|| format!("{nm} nm: {}", words.join("; ")))
    };
    averaged.curves.iter().filter_map(of_curve).collect()
}

/// The coefficients as comma-separated values, one line per wavelength; what is not known is left empty.
pub(in crate::export) fn csv(table: &PhaseTable, averaged: &Averaged) -> String {
    let mut text = String::from(
        "wavelength_nm,albedo,extinction_per_m,scattering_per_m,extinction_m2_kg,scattering_m2_kg\n",
    );
    for curve in &averaged.curves {
        let found = Coefficients::of(table, curve);
        let pair = |pair: Option<[f64; 2]>| match pair {
            Some([extinction, scattering]) => format!("{extinction:e},{scattering:e}"),
            None => ",".into(),
        };
        text += &format!(
            "{},{},{},{}\n",
            to_digits(curve.wavelength * 1e9, 10),
            curve.scattering_cross_section / curve.extinction_cross_section,
            pair(found.per_length),
            pair(found.per_mass)
        );
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::export::average::average;
    use crate::phase_table::{Axes, Bodies, Quantity, Slab, TableHeader};

    fn table(bodies: Bodies) -> PhaseTable {
        let theta = (0..=180).map(|i| f64::from(i).to_radians()).collect();
        let axes = Axes { wavelength: vec![5e-7], theta, phi: vec![0.0] };
        let mut header = TableHeader::of_sphere(1e-5, axes, Quantity::PhaseFunction);
        header.bodies = Some(bodies);
        let values = ndarray::Array3::from_elem((1, 181, 1), (0.25 / std::f64::consts::PI) as f32);
        let slab = Slab::plain((5e-7, 1.33.into()), values, [6e-10, 8e-10], 0.0);
        PhaseTable { header, slabs: vec![slab] }
    }

    /// 100 droplets per cm³ of 8e-10 m² take 8 % per metre; their mass is 4/3 π r³ ρ each.
    #[test]
    fn coefficients_of_a_volume_and_a_mass() {
        let sphere = Bodies { number_density: Some(1e8), ..Bodies::sphere(1e-5) };
        let known = table(sphere.with_density(Some(1000.0), "water"));
        let averaged = average(&known, 0.0).unwrap();
        let found = Coefficients::of(&known, &averaged.curves[0]);
        let [extinction, scattering] = found.per_length.unwrap();
        assert!((extinction - 0.08).abs() < 1e-9 && (scattering - 0.06).abs() < 1e-9);
        let mass = 4.0 / 3.0 * std::f64::consts::PI * 1e-15 * 1000.0;
        assert!((found.per_mass.unwrap()[0] * mass / 8e-10 - 1.0).abs() < 1e-9);
        assert!(lines(&known, &averaged)[0].starts_with("500 nm: extinction 8e-2 1/m"));
        assert!(csv(&known, &averaged).lines().nth(1).unwrap().starts_with("500,0.75,8e-2,6e-2,"));
        let unknown = table(Bodies::sphere(1e-5));
        assert_eq!(Coefficients::of(&unknown, &averaged.curves[0]).per_length, None);
        assert!(lines(&unknown, &averaged).is_empty());
    }
}
