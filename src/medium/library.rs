//! The library of named media: the catalogue of formulas, the shipped tables, the waters, the dyes.
//!
//! All data are compiled in; `data/media/README.md` lists sources and licences.

use crate::medium::data::material::Material;
use crate::medium::data::table::Table;
use crate::medium::data::unit::Unit;
use crate::medium::dispersion::band_model::BandModel;
use crate::medium::dispersion::formula::Formula;
use crate::medium::error::{MediumError, invalid};
use crate::medium::kinds::Medium;
use crate::medium::kramers_kronig::{Absorption, Tails};
use crate::medium::read::csv_table;
use crate::medium::solution::Dye;
use crate::medium::water::daimon::Daimon;
use crate::medium::water::microwave::MicrowaveWater;
use serde::Deserialize;
use std::path::Path;
use std::sync::{Arc, OnceLock};

/// One line of the library's list.
#[derive(Clone, Debug, PartialEq)]
pub struct LibraryEntry {
    /// The name that scenes use.
    pub name: String,
    /// Other names that are accepted.
    pub aliases: Vec<String>,
    /// What it is in a few words.
    pub kind: String,
    /// Where the data are from.
    pub source: String,
    /// Wavelengths in metres.
    pub range: (f64, f64),
    /// Catalogue values of n_d and V_d where the catalogue prints them.
    pub catalogue: Option<(f64, f64)>,
}

#[derive(Debug, Deserialize)]
struct Catalogue {
    source: String,
    materials: Vec<CatalogueEntry>,
}

#[derive(Debug, Deserialize)]
struct CatalogueEntry {
    name: String,
    aliases: Vec<String>,
    reference: String,
    formula: u32,
    coefficients: Vec<f64>,
    range_um: (f64, f64),
    temperature_k: Option<f64>,
    catalogue_nd: Option<f64>,
    catalogue_vd: Option<f64>,
    note: Option<String>,
}

/// Media whose data are tables: name, file, what it is.
const TABLES: [(&str, &str, &str); 5] = [
    ("ice", "ice_warren_brandt_2008", "table of n and k"),
    ("water-segelstein", "water_segelstein_1981", "table of n and k"),
    ("water-hale-querry", "water_hale_querry_1973", "table of n and k"),
    ("diamond-phillip-taft", "diamond_phillip_taft_1964", "table of n and k"),
    ("rhodamine6g", "rhodamine6g_film_seckin_2023", "dye film, table of n and k; solute"),
];

/// Media that depend on temperature, density or salinity.
const WATERS: [&str; 5] =
    ["water", "sea-water", "water-daimon", "water-liebe-1991", "water-turner-2016"];

/// Dyes that are band models, not measurements: only solutes.
const MODELS: [&str; 2] = ["rose-bengal-model", "fuchsine-model"];

/// Other names of the media that are not in the catalogue.
const ALIASES: [(&str, &str); 9] = [
    ("h2o", "water"),
    ("seawater", "sea-water"),
    ("salt-water", "sea-water"),
    ("daimon", "water-daimon"),
    ("rhodamine-6g", "rhodamine6g"),
    ("rose-bengal", "rose-bengal-model"),
    ("rosebengal", "rose-bengal-model"),
    ("fuchsine", "fuchsine-model"),
    ("fuchsin", "fuchsine-model"),
];

/// A shipped table by the name of its file.
pub(super) fn table(file: &str) -> &'static Table {
    static TABLES: [OnceLock<Table>; FILES.len()] = [const { OnceLock::new() }; FILES.len()];
    let sound = "the shipped tables are sound: a test reads them";
    let index = FILES.iter().position(|(name, _)| *name == file).expect(sound);
    TABLES[index]
        .get_or_init(|| csv_table::parse(FILES[index].1, Path::new(FILES[index].0)).expect(sound))
}

macro_rules! shipped {
    ($($name:literal),*) => {
        [$(($name, include_str!(concat!("../../data/media/", $name, ".csv")))),*]
    };
}

/// Names and texts of the shipped tables.
const FILES: [(&str, &str); 7] = shipped![
    "ice_warren_brandt_2008",
    "water_segelstein_1981",
    "water_hale_querry_1973",
    "water_pope_fry_1997",
    "water_k_kedenburg_2012",
    "diamond_phillip_taft_1964",
    "rhodamine6g_film_seckin_2023"
];

fn catalogue() -> &'static Catalogue {
    static CATALOGUE: OnceLock<Catalogue> = OnceLock::new();
    CATALOGUE.get_or_init(|| {
        let text = include_str!("../../data/media/catalogue.json");
        serde_json::from_str(text).expect("the shipped catalogue is sound: a test reads it")
    })
}

/// Names are compared without case, blanks, hyphens and underscores.
fn key(name: &str) -> String {
    name.chars().filter(|c| !" -_".contains(*c)).flat_map(char::to_lowercase).collect()
}

/// The name that the library knows a medium by, or an error with the nearest one.
pub(super) fn canonical(name: &str) -> Result<String, MediumError> {
    let wanted = key(name);
    let known = names();
    if let Some((_, found)) = known.iter().find(|(spelling, _)| key(spelling) == wanted) {
        return Ok(found.clone());
    }
    let nearest = nearest(name, known.iter().map(|(spelling, _)| spelling.as_str()));
    Err(MediumError::Unknown { name: name.into(), nearest })
}

/// The name that a misspelt one may stand for.
pub(super) fn nearest<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> Option<String> {
    let wanted = key(name);
    known
        .map(|spelling| (distance(&wanted, &key(spelling)), spelling))
        .min()
        .filter(|(d, _)| *d <= 1 + wanted.chars().count() / 3)
        .map(|(_, spelling)| spelling.to_string())
}

/// All spellings with the name each stands for.
fn names() -> Vec<(String, String)> {
    let mut all: Vec<(String, String)> = Vec::new();
    let plain = TABLES.iter().map(|t| t.0).chain(WATERS).chain(MODELS);
    all.extend(plain.map(|name| (name.to_string(), name.to_string())));
    all.extend(ALIASES.iter().map(|(alias, name)| (alias.to_string(), name.to_string())));
    for entry in &catalogue().materials {
        let spellings = std::iter::once(&entry.name).chain(&entry.aliases);
        all.extend(spellings.map(|s| (s.clone(), entry.name.clone())));
    }
    all
}

/// The medium of a canonical name that needs no more than the name.
pub(super) fn material(name: &str) -> Result<Material, MediumError> {
    if let Some((name, file, _)) = TABLES.iter().find(|t| t.0 == name) {
        let table = table(file);
        let material = Material::from_curve(*name, &table.source, table.n.curve());
        return Ok(material.with_extinction(table.k.curve()));
    }
    let entry = catalogue().materials.iter().find(|e| e.name == name);
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

/// A dye by its canonical name: its absorption at fraction 1.
pub(super) fn dye(name: &str) -> Result<Dye, MediumError> {
    if let Some(model) = BandModel::by_name(name) {
        return model.dye();
    }
    if name == "rhodamine6g" {
        let table = table("rhodamine6g_film_seckin_2023");
        let (wavelength, k) = table.k.complete()?;
        let absorption = Absorption::new(wavelength, k, Tails::Taper)?;
        let source = table.source.clone();
        return Ok(Dye { name: name.into(), source, absorption, notes: Vec::new() });
    }
    Err(invalid("solute", name, &format!("rhodamine6g, {}", MODELS.join(", "))))
}

/// Temperatures (kelvin) and formulas of Daimon & Masumura's water.
pub(super) fn daimon_materials() -> Result<Vec<(f64, Material)>, MediumError> {
    let entries = catalogue().materials.iter().filter(|e| e.name.starts_with("water-daimon-"));
    entries.map(|e| Ok((e.temperature_k.unwrap_or_default(), material(&e.name)?))).collect()
}

/// Everything that has a name, in the order of the list.
pub fn list() -> Result<Vec<LibraryEntry>, MediumError> {
    let aliases = |name: &str| {
        ALIASES.iter().filter(|a| a.1 == name).map(|a| a.0.to_string()).collect::<Vec<_>>()
    };
    let entry = |name: &str, kind: &str, medium: &Medium| LibraryEntry {
        name: name.into(),
        aliases: aliases(name),
        kind: kind.into(),
        source: medium.source(),
        range: medium.valid_range(),
        catalogue: None,
    };
    let liquid = Medium::Water { temperature: 293.15 };
    let sea = Medium::SeaWater { temperature: 293.15, salinity: 35.0 };
    let daimon = Medium::Daimon(Arc::new(Daimon::new(293.15)?));
    let mut list = vec![
        entry("water", "formula of temperature and density; k from tables", &liquid),
        entry("sea-water", "formula of temperature and salinity; k of water", &sea),
        entry("water-daimon", "formulas at 19 to 24 °C", &daimon),
    ];
    for (name, model) in MicrowaveWater::NAMES {
        let water = Medium::MicrowaveWater { model, temperature: 293.15 };
        list.push(entry(name, "formula of temperature, microwave", &water));
    }
    for (name, _, kind) in TABLES {
        list.push(entry(name, kind, &Medium::Material(Arc::new(material(name)?))));
    }
    for item in &catalogue().materials {
        let medium = Medium::Material(Arc::new(material(&item.name)?));
        let mut entry = entry(&item.name, &format!("formula {}", item.formula), &medium);
        entry.aliases = item.aliases.clone();
        entry.catalogue = item.catalogue_nd.zip(item.catalogue_vd);
        list.push(entry);
    }
    for name in MODELS {
        let dye = dye(name)?;
        list.push(LibraryEntry {
            name: name.into(),
            aliases: aliases(name),
            kind: "dye, a model and no measurement; only solute".into(),
            source: dye.source.clone(),
            range: dye.absorption.range(),
            catalogue: None,
        });
    }
    Ok(list)
}

/// Levenshtein's distance.
fn distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut corner = row[0];
        row[0] = i + 1;
        for (j, y) in b.iter().enumerate() {
            let replace = corner + usize::from(x != *y);
            corner = row[j + 1];
            row[j + 1] = replace.min(corner + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}
