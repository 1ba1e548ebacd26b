//! From what a scene file says about a medium to the [`Medium`] itself: names are looked up, files
//! read, coefficients checked.

use crate::medium::band_model::BandModel;
use crate::medium::data::material::Material;
use crate::medium::data::table::name_of;
use crate::medium::dispersion::abbe::Abbe;
use crate::medium::dispersion::formula::Formula;
use crate::medium::error::{MediumError, PLAUSIBLE_INDEX, file_error, invalid, is_plausible};
use crate::medium::kinds::Medium;
use crate::medium::kramers_kronig::{Absorption, Tails};
use crate::medium::library;
use crate::medium::read::ending::has_ending;
use crate::medium::read::{agf, csv_table, refractive_index_info};
use crate::medium::shipped::catalogue;
use crate::medium::solution::{Dye, Solution};
use crate::medium::spec::{MediumSpec, NamedSpec};
use crate::medium::water::daimon::Daimon;
use crate::medium::water::microwave::MicrowaveWater;
use crate::pending_file::FILES;
use num_complex::Complex64;
use std::path::Path;
use std::sync::Arc;

impl MediumSpec {
    /// The medium; files are looked for in `base_dir`.
    pub fn resolve(&self, base_dir: &Path) -> Result<Medium, MediumError> {
        match self {
            Self::Named(named) => named.resolve(),
            Self::Index { n, k } => constant(*n, *k),
            Self::File { path, glass, extrapolate } => {
                let mut material = read_material(&base_dir.join(path), glass.as_deref())?;
                material.extrapolate = *extrapolate;
                Ok(Medium::Material(Arc::new(material)))
            }
            Self::Sellmeier { b, c_um2 } => {
                from_formula("Sellmeier", Formula::sellmeier(b, c_um2)?)
            }
            Self::Cauchy(coefficients) => from_formula("Cauchy", Formula::cauchy(coefficients)?),
            Self::Abbe { index, number, line } => {
                let abbe = Abbe { index: *index, number: *number };
                from_formula("Abbe", Formula::cauchy(&abbe.to_cauchy(*line)?)?)
            }
            Self::Solution { solute, fraction, host, dispersion } => {
                let dye = if has_ending(Path::new(solute), &["csv"]) {
                    dye_of_file(&base_dir.join(solute))?
                } else {
                    library::dye(&library::canonical(solute)?)?
                };
                solution(dye, *fraction, host.resolve(base_dir)?, *dispersion)
            }
            Self::Absorbance { path, path_mm, host, dispersion } => {
                let dye = dye_of_absorbance(&base_dir.join(path), *path_mm)?;
                solution(dye, 1.0, host.resolve(base_dir)?, *dispersion)
            }
            Self::Radial(radial) => {
                let radial = radial.resolve(base_dir, |layer| layer.plain(base_dir))?;
                Ok(Medium::Radial(Arc::new(radial)))
            }
        }
    }
}

impl MediumSpec {
    /// A layer of something larger, which must be the same everywhere.
    fn plain(&self, base_dir: &Path) -> Result<Medium, MediumError> {
        match self.resolve(base_dir)? {
            Medium::Radial(radial) => {
                let accepted = "a medium that is the same everywhere";
                Err(invalid("medium: layers: medium", radial.name(), accepted))
            }
            plain => Ok(plain),
        }
    }
}

impl NamedSpec {
    fn resolve(&self) -> Result<Medium, MediumError> {
        let name = library::canonical(&self.name)?;
        self.refuse_foreign_conditions(&name)?;
        let temperature = self.temperature_c.unwrap_or(20.0) + 273.15;
        if let Some(model) = MicrowaveWater::by_name(&name) {
            let medium = Medium::MicrowaveWater { model, temperature };
            medium.check_conditions()?;
            return Ok(medium);
        }
        let medium = match name.as_str() {
            "water" => match self.density_kg_m3 {
                Some(density) => Medium::WaterOfDensity { temperature, density },
                None => Medium::Water { temperature },
            },
            "sea-water" => {
                Medium::SeaWater { temperature, salinity: self.salinity_g_kg.unwrap_or(35.0) }
            }
            "water-daimon" => Medium::Daimon(Arc::new(Daimon::new(temperature)?)),
            model if BandModel::by_name(model).is_some() => {
                let accepted = format!(
                    "a medium; this is a dye: {{ solute = \"{model}\", fraction = 0.01, host = \
                     \"water\" }}"
                );
                return Err(invalid("medium", &self.name, &accepted));
            }
            other => {
                let mut material = catalogue::material(other)?;
                material.extrapolate = self.extrapolate;
                Medium::Material(Arc::new(material))
            }
        };
        medium.check_conditions()?;
        Ok(medium)
    }

    /// Refuses a condition that the medium does not depend on, rather than ignore it.
    fn refuse_foreign_conditions(&self, name: &str) -> Result<(), MediumError> {
        let water = ["water", "sea-water", "water-daimon"].contains(&name)
            || MicrowaveWater::by_name(name).is_some();
        let foreign = [
            ("temperature_c", self.temperature_c, water),
            ("density_kg_m3", self.density_kg_m3, name == "water"),
            ("salinity_g_kg", self.salinity_g_kg, name == "sea-water"),
            ("extrapolate", self.extrapolate.then_some(1.0), !water),
        ];
        match foreign.into_iter().find(|(_, value, known)| value.is_some() && !known) {
            Some((field, value, _)) => {
                let value = value.unwrap_or_default();
                Err(invalid(field, value, &format!("nothing: {name} does not depend on it")))
            }
            None => Ok(()),
        }
    }
}

fn constant(n: f64, k: f64) -> Result<Medium, MediumError> {
    if !(n > 0.0 && n.is_finite()) {
        return Err(invalid("index: n", n, "a positive number"));
    }
    if !(k >= 0.0 && k.is_finite()) {
        return Err(invalid("index: k", k, "0 or more (n + ik absorbs for k > 0)"));
    }
    let index = Complex64::new(n, k);
    if !is_plausible(index) {
        return Err(invalid("index", format!("[{n:e}, {k:e}]"), PLAUSIBLE_INDEX));
    }
    Ok(Medium::Constant(index))
}

/// A medium by a formula of the user's: valid between the poles on either side of visible light.
fn from_formula(name: &str, formula: Formula) -> Result<Medium, MediumError> {
    let (from, to) = formula.interval_about(0.58);
    // Wavelengths that anyone may ask for, and a hair's breadth off the poles.
    let (from, to) = ((from * 1.000_001).max(0.1), (to * 0.999_999).min(20.0));
    // Visible light must be in it: a pole there is a slip of the pen, not a wish.
    formula.check_range(0.38, 0.78)?;
    let range = (from / 1e6, to / 1e6);
    let material = Material::from_formula(name, "given by its coefficients", formula, range);
    Ok(Medium::Material(Arc::new(material)))
}

fn solution(
    dye: Dye,
    fraction: f64,
    host: Medium,
    dispersion: bool,
) -> Result<Medium, MediumError> {
    let solution = Solution::new(dye, fraction, host)?.with_dispersion(dispersion);
    Ok(Medium::Solution(Arc::new(solution)))
}

/// A material from a YAML file, a Zemax catalogue or a text table, which must have n.
fn read_material(path: &Path, glass: Option<&str>) -> Result<Material, MediumError> {
    if !FILES {
        return Err(file_error(path, None, "there are no files in a browser"));
    }
    if has_ending(path, &["agf"]) {
        return agf::read(path, glass);
    }
    if let Some(glass) = glass {
        return Err(invalid("glass", glass, "a file that is a Zemax catalogue (.agf)"));
    }
    if !has_ending(path, &["csv", "txt", "tsv"]) {
        return refractive_index_info::read(path);
    }
    let table = csv_table::read(path)?;
    let name = name_of(path);
    if table.n.is_empty() && !table.k.is_empty() {
        return Err(MediumError::OnlyExtinction { path: path.into() });
    }
    if table.n.is_empty() {
        return Err(file_error(path, None, "no column n"));
    }
    let mut material = Material::from_curve(name, table.source, table.n.curve());
    (material.unit, material.notes) = (table.unit, table.notes);
    Ok(match table.k.is_empty() {
        true => material,
        false => material.with_extinction(table.k.curve()),
    })
}

fn dye_of_file(path: &Path) -> Result<Dye, MediumError> {
    let table = csv_table::read(path)?;
    let (wavelength, k) = table.k.complete()?;
    dye(path, table.source, (wavelength, k), "k", table.notes.clone())
}

/// k from decadic absorbance: `A = log10(I0/I)`, `I = I0 exp(−4πkL/λ)`, so `k = A ln(10) λ/4πL`.
fn dye_of_absorbance(path: &Path, path_mm: f64) -> Result<Dye, MediumError> {
    if !(path_mm > 0.0 && path_mm.is_finite()) {
        return Err(invalid("path_mm", path_mm, "a positive length"));
    }
    let table = csv_table::read(path)?;
    let per_wavelength = std::f64::consts::LN_10 / (4.0 * std::f64::consts::PI * path_mm * 1e-3);
    let (wavelength, absorbance) = table.absorbance.complete()?;
    let rows = wavelength.iter().zip(absorbance);
    let k: Vec<f64> = rows.map(|(w, a)| a * per_wavelength * w).collect();
    let source = format!("{} (absorbance over {path_mm} mm)", table.source);
    dye(path, source, (wavelength, &k), "absorbance", table.notes.clone())
}

fn dye(
    path: &Path,
    source: String,
    (wavelength, k): (&[f64], &[f64]),
    column: &str,
    notes: Vec<String>,
) -> Result<Dye, MediumError> {
    if k.is_empty() {
        let message = format!("no column {column}");
        return Err(MediumError::File { path: path.into(), line: None, message });
    }
    let name = name_of(path);
    Ok(Dye { name, source, absorption: Absorption::new(wavelength, k, Tails::Taper)?, notes })
}
