//! The shipped tables of n and k, read when first asked for.

use crate::medium::data::table::Table;
use crate::medium::read::csv_table;
use std::path::Path;
use std::sync::OnceLock;

/// A shipped table by the name of its file.
pub(in crate::medium) fn table(file: &str) -> &'static Table {
    static TABLES: [OnceLock<Table>; FILES.len()] = [const { OnceLock::new() }; FILES.len()];
    let sound = "the shipped tables are sound: a test reads them";
    let index = FILES.iter().position(|(name, _)| *name == file).expect(sound);
    TABLES[index]
        .get_or_init(|| csv_table::parse(FILES[index].1, Path::new(FILES[index].0)).expect(sound))
}

macro_rules! shipped {
    ($($name:literal),*) => {
        [$(($name, include_str!(concat!("../../../data/media/", $name, ".csv")))),*]
    };
}

/// Names and texts of the shipped tables.
const FILES: [(&str, &str); 15] = shipped![
    "ice_warren_brandt_2008",
    "water_segelstein_1981",
    "water_hale_querry_1973",
    "water_pope_fry_1997",
    "water_k_kedenburg_2012",
    "diamond_phillip_taft_1964",
    "rhodamine6g_film_seckin_2023",
    "gold_johnson_christy_1972",
    "silver_johnson_christy_1972",
    "copper_johnson_christy_1972",
    "aluminium_rakic_1995",
    "soot_acetylene_dalzell_1969",
    "soot_propane_dalzell_1969",
    "soot_diesel_querry_1987",
    "ethanol_sani_2016"
];
