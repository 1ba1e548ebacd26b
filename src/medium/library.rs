//! The library of named media: the catalogue of formulas, the shipped tables, the waters, the dyes.
//!
//! All data are compiled in; `data/media/README.md` lists sources and licences.

use crate::medium::band_model::BandModel;
use crate::medium::error::{MediumError, invalid};
use crate::medium::kinds::Medium;
use crate::medium::kramers_kronig::{Absorption, Tails};
use crate::medium::shipped::catalogue::{TABLES, entries, material};
use crate::medium::shipped::tables::table;
use crate::medium::solution::Dye;
use crate::medium::spelling::{key, nearest};
use crate::medium::water::daimon::Daimon;
use crate::medium::water::microwave::MicrowaveWater;
use std::sync::Arc;

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

/// Media that depend on temperature, density or salinity.
const WATERS: [&str; 5] =
    ["water", "sea-water", "water-daimon", "water-liebe-1991", "water-turner-2016"];

/// Dyes that are band models, not measurements: only solutes.
const MODELS: [&str; 2] = ["rose-bengal-model", "fuchsine-model"];

/// Other names of the media that are not in the catalogue.
const ALIASES: [(&str, &str); 16] = [
    ("h2o", "water"),
    ("seawater", "sea-water"),
    ("salt-water", "sea-water"),
    ("daimon", "water-daimon"),
    ("rhodamine-6g", "rhodamine6g"),
    ("rose-bengal", "rose-bengal-model"),
    ("rosebengal", "rose-bengal-model"),
    ("fuchsine", "fuchsine-model"),
    ("fuchsin", "fuchsine-model"),
    ("au", "gold"),
    ("ag", "silver"),
    ("cu", "copper"),
    ("al", "aluminium"),
    ("aluminum", "aluminium"),
    ("soot", "soot-acetylene"),
    ("alcohol", "ethanol"),
];

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

/// All spellings with the name each stands for.
fn names() -> Vec<(String, String)> {
    let mut all: Vec<(String, String)> = Vec::new();
    let plain = TABLES.iter().map(|t| t.0).chain(WATERS).chain(MODELS);
    all.extend(plain.map(|name| (name.to_string(), name.to_string())));
    all.extend(ALIASES.iter().map(|(alias, name)| (alias.to_string(), name.to_string())));
    for entry in entries() {
        let spellings = std::iter::once(&entry.name).chain(&entry.aliases);
        all.extend(spellings.map(|s| (s.clone(), entry.name.clone())));
    }
    all
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
    for item in entries() {
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
