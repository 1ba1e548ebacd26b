//! Densities of the library's media, for whatever is told per mass.
//!
//! Liquid water is IAPWS's at its temperature, sea water the UNESCO equation of state; glasses are of
//! Schott's data sheets; crystals are of their lattice constants (a test adds them up). Media whose density
//! is a matter of composition (cubic zirconia, dyes) or that are given by an index, a formula or a file have
//! none: `density_kg_m3` tells it.
//!
//! ```
//! use gonio::medium::MediumSpec;
//!
//! let ice = MediumSpec::name("ice").density()?.unwrap();
//! assert_eq!(ice.kg_m3, 917.0);
//! assert!(MediumSpec::Index { n: 1.5, k: 0.0 }.density()?.is_none());
//! # Ok::<(), gonio::medium::MediumError>(())
//! ```

use crate::medium::error::MediumError;
use crate::medium::spec::{MediumSpec, NamedSpec};
use crate::medium::{library, water};

/// A density with its source.
#[derive(Clone, Debug, PartialEq)]
pub struct Density {
    /// kg/m³
    pub kg_m3: f64,
    /// In words.
    pub source: String,
}

const SCHOTT: &str = "Schott Zemax catalogue of 2017-01-20, via refractiveindex.info";
const LATTICE: &str = "X-ray density: mass of the unit cell over its volume";

/// Media of one density: name, kg/m³, source.
const SOLIDS: [(&str, f64, &str); 42] = [
    ("ice", 917.0, "ice Ih, S. G. Warren & R. E. Brandt, J. Geophys. Res. 113, D14220 (2008)"),
    ("diamond", 3515.0, LATTICE),
    ("diamond-phillip-taft", 3515.0, LATTICE),
    ("fused-silica", 2201.0, "Corning 7980 data sheet"),
    ("sapphire-o", 3987.0, LATTICE),
    ("sapphire-e", 3987.0, LATTICE),
    ("spinel", 3578.0, LATTICE),
    ("fluorite", 3181.0, LATTICE),
    ("MgF2-o", 3175.0, LATTICE),
    ("rutile-o", 4248.0, LATTICE),
    ("rock-salt", 2164.0, LATTICE),
    ("YAG", 4555.0, LATTICE),
    ("PMMA", 1185.0, "data sheets of cast sheets, 1180 to 1190"),
    ("gold", 19_283.0, LATTICE),
    ("silver", 10_500.0, LATTICE),
    ("copper", 8_935.0, LATTICE),
    ("aluminium", 2_698.0, LATTICE),
    ("polystyrene", 1050.0, "data sheets of latex spheres, 1050 to 1055"),
    ("ethanol", 789.3, "liquid at 20 °C, CRC Handbook of Chemistry and Physics, 95th ed."),
    ("air", 1.225, "dry air at 15 °C and 101 325 Pa, ISO 2533"),
    ("LITHOSIL-Q", 2200.0, SCHOTT),
    ("N-BK7", 2510.0, SCHOTT),
    ("N-FK51A", 3675.0, SCHOTT),
    ("N-PK51", 3855.0, SCHOTT),
    ("N-K5", 2590.0, SCHOTT),
    ("N-BAK4", 3046.0, SCHOTT),
    ("N-SK16", 3580.0, SCHOTT),
    ("N-LAK9", 3510.0, SCHOTT),
    ("N-BAF10", 3745.0, SCHOTT),
    ("F2", 3599.0, SCHOTT),
    ("N-F2", 2651.0, SCHOTT),
    ("SF5", 4070.0, SCHOTT),
    ("N-SF5", 2858.0, SCHOTT),
    ("SF10", 4280.0, SCHOTT),
    ("N-SF10", 3050.0, SCHOTT),
    ("SF11", 4740.0, SCHOTT),
    ("N-SF11", 3224.0, SCHOTT),
    ("SF6", 5180.0, SCHOTT),
    ("N-SF6", 3369.0, SCHOTT),
    ("N-LASF9", 4410.0, SCHOTT),
    ("N-SF66", 3996.0, SCHOTT),
    ("P-SF68", 6194.0, SCHOTT),
];

/// Waters of one temperature, °C.
const WATERS: [(&str, f64); 8] = [
    ("water-daimon-19", 19.0),
    ("water-daimon-20", 20.0),
    ("water-daimon-21.5", 21.5),
    ("water-daimon-24", 24.0),
    ("water-kedenburg", 20.0),
    ("water-bashkatov", 20.0),
    ("water-segelstein", 25.0),
    ("water-hale-querry", 25.0),
];

impl MediumSpec {
    /// The density, where the library knows it; `None` for what is given by numbers or a file.
    ///
    /// # Errors
    /// A name that the library does not know.
    pub fn density(&self) -> Result<Option<Density>, MediumError> {
        match self {
            Self::Named(named) => named.density(),
            _ => Ok(None),
        }
    }
}

impl NamedSpec {
    fn density(&self) -> Result<Option<Density>, MediumError> {
        let name = library::canonical(&self.name)?;
        let celsius = self.temperature_c.unwrap_or(20.0);
        Ok(match name.as_str() {
            "water" => Some(match self.density_kg_m3 {
                Some(kg_m3) => Density { kg_m3, source: "given with the medium".into() },
                None => liquid_water(celsius),
            }),
            "water-daimon" | "water-liebe-1991" | "water-turner-2016" => {
                Some(liquid_water(celsius))
            }
            "sea-water" => Some(sea_water(celsius, self.salinity_g_kg.unwrap_or(35.0))),
            other => {
                let water = WATERS.iter().find(|(name, _)| *name == other);
                let solid = SOLIDS.iter().find(|(name, ..)| *name == other);
                water.map(|(_, celsius)| liquid_water(*celsius)).or_else(|| {
                    solid.map(|(_, kg_m3, source)| Density {
                        kg_m3: *kg_m3,
                        source: (*source).to_string(),
                    })
                })
            }
        })
    }
}

fn liquid_water(celsius: f64) -> Density {
    let kg_m3 = water::liquid_density(celsius + 273.15);
    Density { kg_m3, source: format!("liquid water at {celsius} °C, IAPWS SR6-08") }
}

/// The international equation of state of sea water at one atmosphere, Millero & Poisson, Deep-Sea Res.
/// 28, 625 (1981); practical salinity, which the salinity in g/kg is close to.
fn sea_water(celsius: f64, salinity: f64) -> Density {
    let (t, s) = (celsius, salinity);
    let pure = polynomial(
        t,
        &[999.842_594, 6.793_952e-2, -9.095_290e-3, 1.001_685e-4, -1.120_083e-6, 6.536_332e-9],
    );
    let a = polynomial(t, &[0.824_493, -4.089_9e-3, 7.643_8e-5, -8.246_7e-7, 5.387_5e-9]);
    let b = polynomial(t, &[-5.724_66e-3, 1.022_7e-4, -1.654_6e-6]);
    Density {
        kg_m3: pure + a * s + b * s.powf(1.5) + 4.831_4e-4 * s * s,
        source: format!("sea water at {celsius} °C, {salinity} g/kg, Millero & Poisson 1981"),
    }
}

fn polynomial(x: f64, coefficients: &[f64]) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Check values of UNESCO technical papers in marine science 44 (1983).
    #[test]
    fn sea_water_meets_the_published_check_values() {
        for (s, t, expected) in [
            (0.0, 5.0, 999.966_75),
            (0.0, 25.0, 997.047_96),
            (35.0, 5.0, 1_027.675_47),
            (35.0, 25.0, 1_023.343_06),
        ] {
            let density = sea_water(t, s).kg_m3;
            assert!((density - expected).abs() < 1e-5, "{s} {t}: {density}");
        }
    }

    /// Cells: formula units, molar mass (g/mol), volume (Å³) from lattice constants at 25 °C.
    #[test]
    fn crystals_weigh_what_their_cells_weigh() {
        let tetragonal = |a: f64, c: f64| a * a * c;
        let hexagonal = |a: f64, c: f64| 0.75f64.sqrt() * a * a * c;
        for (name, units, molar_mass, volume) in [
            ("diamond", 8.0, 12.011, 3.5671f64.powi(3)),
            ("rock-salt", 4.0, 58.443, 5.6402f64.powi(3)),
            ("gold", 4.0, 196.967, 4.0786f64.powi(3)),
            ("silver", 4.0, 107.868, 4.0862f64.powi(3)),
            ("copper", 4.0, 63.546, 3.6149f64.powi(3)),
            ("aluminium", 4.0, 26.982, 4.0496f64.powi(3)),
            ("fluorite", 4.0, 78.075, 5.4626f64.powi(3)),
            ("spinel", 8.0, 142.266, 8.0831f64.powi(3)),
            ("YAG", 8.0, 593.62, 12.0075f64.powi(3)),
            ("MgF2-o", 2.0, 62.302, tetragonal(4.621, 3.052)),
            ("rutile-o", 2.0, 79.866, tetragonal(4.5937, 2.9587)),
            ("sapphire-o", 6.0, 101.961, hexagonal(4.7589, 12.991)),
        ] {
            // g/mol over Å³ and Avogadro's number is 1660.539 kg/m³.
            let expected = 1660.539 * units * molar_mass / volume;
            let found = MediumSpec::name(name).density().unwrap().unwrap().kg_m3;
            assert!((found / expected - 1.0).abs() < 5e-4, "{name}: {found} {expected}");
        }
    }

    #[test]
    fn every_name_of_the_tables_is_known_and_water_follows_its_conditions() {
        let names = SOLIDS.iter().map(|s| s.0).chain(WATERS.iter().map(|w| w.0));
        for name in names {
            assert_eq!(library::canonical(name).unwrap(), name);
            assert!(MediumSpec::name(name).density().unwrap().is_some(), "{name}");
        }
        let density = |text: &str| {
            MediumSpec::parse(text).unwrap().density().unwrap().map(|density| density.kg_m3)
        };
        // IAPWS-95 at 20 °C and 1 atm.
        assert!((density("water").unwrap() - 998.207).abs() < 2e-3);
        assert_eq!(density("{ name = \"water\", density_kg_m3 = 950.0 }"), Some(950.0));
        for unknown in ["cubic-zirconia", "{ index = 1.5 }", "rhodamine6g"] {
            assert_eq!(density(unknown), None, "{unknown}");
        }
    }
}
