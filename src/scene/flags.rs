//! How the flags of scene keys are read: words of closed sets, media, indices.

use super::{Choice, Named};
use crate::medium::{FilmSpec, MediumSpec, parse_index};
use clap::builder::{PossibleValuesParser, TypedValueParser};

/// Parser of a word from a closed set; `--help` lists the set.
pub(super) fn word<T: Named + Send + Sync>() -> impl TypedValueParser<Value = Choice<T>> {
    PossibleValuesParser::new(T::NAMES.iter().map(|(name, _)| *name))
        .try_map(|word| T::from_name(&word).map(Choice))
}

/// `1.333`, `1.333+0.001`
pub(super) fn index(text: &str) -> Result<[f64; 2], String> {
    let index = parse_index(text).map_err(|error| error.to_string())?;
    Ok([index.re, index.im])
}

/// `water`, `glass.yml`, `{ solute = … }`
pub(super) fn medium(text: &str) -> Result<MediumSpec, String> {
    MediumSpec::parse(text).map_err(|error| error.to_string())
}

/// The same, or an index.
pub(super) fn outside(text: &str) -> Result<MediumSpec, String> {
    match parse_index(text) {
        Ok(index) => Ok(MediumSpec::Index { n: index.re, k: index.im }),
        Err(_) => medium(text),
    }
}

/// `1,0,-0.05`
pub(super) fn coefficients(text: &str) -> Result<Vec<f64>, String> {
    let number = |word: &str| {
        word.trim().parse().map_err(|_| format!("\"{word}\" is no number; accepted: 1,0,-0.05"))
    };
    text.split(',').map(number).collect()
}

/// `[{ medium = "ethanol", thickness_nm = 100 }]`
pub(super) fn coating(text: &str) -> Result<Vec<FilmSpec>, String> {
    FilmSpec::parse_list(text).map_err(|error| error.to_string())
}
