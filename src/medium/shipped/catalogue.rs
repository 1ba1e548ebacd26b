//! The catalogue of formulas, and the materials of canonical names, by formula or by table.

use crate::medium::data::material::Material;
use crate::medium::data::unit::Unit;
use crate::medium::dispersion::formula::Formula;
use crate::medium::error::MediumError;
use crate::medium::shipped::tables::table;
use serde::Deserialize;
use std::sync::OnceLock;

#[derive(Debug, Deserialize)]
struct Catalogue {
    source: String,
    materials: Vec<CatalogueEntry>,
}

/// One material of the catalogue.
#[derive(Debug, Deserialize)]
pub(in crate::medium) struct CatalogueEntry {
    pub name: String,
    pub aliases: Vec<String>,
    reference: String,
    pub formula: u32,
    coefficients: Vec<f64>,
    range_um: (f64, f64),
    temperature_k: Option<f64>,
    pub catalogue_nd: Option<f64>,
    pub catalogue_vd: Option<f64>,
    note: Option<String>,
}

/// Media whose data are tables: name, file, what it is.
pub(in crate::medium) const TABLES: [(&str, &str, &str); 13] = [
    ("ice", "ice_warren_brandt_2008", "table of n and k"),
    ("water-segelstein", "water_segelstein_1981", "table of n and k"),
    ("water-hale-querry", "water_hale_querry_1973", "table of n and k"),
    ("diamond-phillip-taft", "diamond_phillip_taft_1964", "table of n and k"),
    ("gold", "gold_johnson_christy_1972", "table of n and k"),
    ("silver", "silver_johnson_christy_1972", "table of n and k"),
    ("copper", "copper_johnson_christy_1972", "table of n and k"),
    ("aluminium", "aluminium_rakic_1995", "table of n and k"),
    ("soot-acetylene", "soot_acetylene_dalzell_1969", "table of n and k"),
    ("soot-propane", "soot_propane_dalzell_1969", "table of n and k"),
    ("soot-diesel", "soot_diesel_querry_1987", "table of n and k"),
    ("ethanol", "ethanol_sani_2016", "table of n and k"),
    ("rhodamine6g", "rhodamine6g_film_seckin_2023", "dye film, table of n and k; solute"),
];

fn catalogue() -> &'static Catalogue {
    static CATALOGUE: OnceLock<Catalogue> = OnceLock::new();
    CATALOGUE.get_or_init(|| {
        let text = include_str!("../../../data/media/catalogue.json");
        serde_json::from_str(text).expect("the shipped catalogue is sound: a test reads it")
    })
}

/// The materials of the catalogue, in its order.
pub(in crate::medium) fn entries() -> &'static [CatalogueEntry] {
    &catalogue().materials
}

/// The medium of a canonical name that needs no more than the name.
pub(in crate::medium) fn material(name: &str) -> Result<Material, MediumError> {
    if let Some((name, file, _)) = TABLES.iter().find(|t| t.0 == name) {
        let table = table(file);
        let material = Material::from_curve(*name, &table.source, table.n.curve());
        return Ok(material.with_extinction(table.k.curve()));
    }
    let entry = entries().iter().find(|e| e.name == name);
    let Some(entry) = entry else {
        return Err(MediumError::Unknown { name: name.into(), nearest: None });
    };
    let um = |value| Unit::Micrometre.to_metres(value);
    let range = (um(entry.range_um.0), um(entry.range_um.1));
    let formula = Formula::new(entry.formula, entry.coefficients.clone())?;
    formula.check_range(entry.range_um.0, entry.range_um.1)?;
    let material = Material::from_formula(&entry.name, source(entry), formula, range);
    if name == "water-kedenburg" {
        return Ok(material.with_extinction(table("water_k_kedenburg_2012").k.curve()));
    }
    Ok(material)
}

fn source(entry: &CatalogueEntry) -> String {
    let mut text = format!("{} | via {}", entry.reference, catalogue().source);
    if let Some(kelvin) = entry.temperature_k {
        text.push_str(&format!(" | at {:.2} °C", kelvin - 273.15));
    }
    if let Some(note) = &entry.note {
        text.push_str(&format!(" | {note}"));
    }
    text
}

/// Temperatures (kelvin) and formulas of Daimon & Masumura's water.
pub(in crate::medium) fn daimon_materials() -> Result<Vec<(f64, Material)>, MediumError> {
    let entries = entries().iter().filter(|e| e.name.starts_with("water-daimon-"));
    entries.map(|e| Ok((e.temperature_k.unwrap_or_default(), material(&e.name)?))).collect()
}
