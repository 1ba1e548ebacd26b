//! Names and words of the schema, and the attributes of the whole.

use super::Store;
use super::circumstances::write_attributes;
use crate::phase_table::{Quantity, TableHeader};
use std::time::{SystemTime, UNIX_EPOCH};

/// Root attribute `format` of a table.
pub const FORMAT: &str = "gonio phase table";
/// Root attribute `format_version`.
pub const FORMAT_VERSION: i32 = 1;

/// The conventions in words, in every file.
const CONVENTIONS_IN_WORDS: &str = "Time factor exp(-i omega t); refractive index n + ik, k >= 0 \
absorbs. theta: scattering angle, 0 is forward. phi: azimuth about the direction of the incident \
light, right-handed, 0 is the upper half of the vertical plane that holds the particle's axis. \
phase_function P = (1/C_sca) dC_sca/dOmega for unpolarised light in sr-1: its integral over the \
sphere is 1. Mueller elements have the same scaling, S11 = P; Stokes Q = I_parallel - \
I_perpendicular with respect to the scattering plane, so that the degree of linear polarisation is \
-S12/S11. Radii are those of the sphere of equal volume. Wavelengths are in vacuum.";

const LICENSE: &str = "CC0-1.0 (no rights reserved)";

/// Names of the Mueller elements, row by row.
pub const ELEMENTS: [&str; 16] = [
    "11", "12", "13", "14", "21", "22", "23", "24", "31", "32", "33", "34", "41", "42", "43", "44",
];

/// Name of the variable that holds the values.
pub fn values_name(quantity: Quantity) -> &'static str {
    quantity.word()
}

/// What the root attributes tell beside the header.
#[derive(Clone, Debug)]
pub struct Root<'a> {
    /// [`FORMAT`], or that of a sweep.
    pub format: &'a str,
    /// Bits of the mantissa that are kept.
    pub bit_round: Option<u8>,
    /// Whether the time of creation is told.
    pub dated: bool,
    /// More of them: names and texts.
    pub attributes: &'a [(String, String)],
}

/// Root attributes of tables and sweeps.
pub fn write_root<S: Store>(
    file: &S,
    header: &TableHeader,
    root: &Root<'_>,
) -> Result<(), S::Error> {
    let title = match header.quantity {
        Quantity::PhaseFunction => "Phase function of a single particle",
        Quantity::Mueller => "Scattering (Mueller) matrix of a single particle",
    };
    file.attribute("Conventions", "CF-1.11")?;
    file.attribute("title", title)?;
    file.attribute("format", root.format)?;
    file.attribute_integer("format_version", FORMAT_VERSION)?;
    file.attribute("program", env!("CARGO_PKG_NAME"))?;
    file.attribute("program_version", env!("CARGO_PKG_VERSION"))?;
    file.attribute("git_hash", env!("GONIO_GIT_HASH"))?;
    if let Some(date) = creation_date(root.dated) {
        file.attribute("date_created", &date)?;
    }
    file.attribute("scene", &header.scene_toml)?;
    file.attribute("command_line", &header.command_line)?;
    file.attribute("conventions", CONVENTIONS_IN_WORDS)?;
    file.attribute("license", LICENSE)?;
    file.attribute("quantity", values_name(header.quantity))?;
    file.attribute("method", &header.method)?;
    file.attribute("shape", &header.shape)?;
    file.attribute("forward_peak", header.forward_peak.word())?;
    file.attribute_integer("rotational_symmetry", i32::from(header.rotational_symmetry))?;
    if let Some(bits) = root.bit_round {
        file.attribute_integer("bit_round", i32::from(bits))?;
    }
    write_attributes(file, header)?;
    root.attributes.iter().try_for_each(|(name, text)| file.attribute(name, text))
}

/// ISO 8601 in UTC: `SOURCE_DATE_EPOCH` where set, else now where `dated`.
fn creation_date(dated: bool) -> Option<String> {
    let given = std::env::var("SOURCE_DATE_EPOCH").ok().and_then(|text| text.trim().parse().ok());
    let now = || SystemTime::now().duration_since(UNIX_EPOCH).ok().map(|time| time.as_secs());
    given.or_else(|| if dated { now() } else { None }).map(iso_date)
}

/// Seconds since 1970 as `2026-01-31T12:00:00Z` (Hinnant's civil-from-days algorithm).
fn iso_date(seconds: u64) -> String {
    let (days, rest) = (seconds / 86_400, seconds % 86_400);
    let days = days + 719_468;
    let (era, day_of_era) = (days / 146_097, days % 146_097);
    let year_of_era =
        (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let month_index = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * month_index + 2) / 5 + 1;
    let month = if month_index < 10 { month_index + 3 } else { month_index - 9 };
    let year = 400 * era + year_of_era + u64::from(month <= 2);
    let (hour, minute, second) = (rest / 3600, rest / 60 % 60, rest % 60);
    format!("{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}Z")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_are_civil() {
        assert_eq!(iso_date(0), "1970-01-01T00:00:00Z");
        assert_eq!(iso_date(951_782_400), "2000-02-29T00:00:00Z");
        assert_eq!(iso_date(1_769_860_799), "2026-01-31T11:59:59Z");
    }
}
