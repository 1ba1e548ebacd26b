//! What `gonio radar` is asked, and one row of its answer.

use crate::cli::args::particle::{Index, parse_index};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum RadarShape {
    Raindrop,
    Spheroid,
    Sphere,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum WaterModel {
    #[value(name = "liebe-1991")]
    Liebe,
    #[value(name = "turner-2016")]
    Turner,
}

/// What a radar measures of rain: reflectivities, phases, attenuations
///
/// One row per frequency and temperature, and per diameter where diameters are given (one drop of each per m³
/// unless --number-per-m3 says otherwise).
#[derive(Args)]
#[command(
    after_help = "Examples: gonio radar --band X --marshall-palmer-mm-h 5 --canting-deg 7 --json
gonio radar --band S,C,X,Ku,Ka,W --temperature-c 0,10,20 --diameter-mm 0.1:6:100 -o lookup.csv"
)]
pub struct RadarArgs {
    /// Bands S (2.8 GHz), C (5.6), X (9.4), Ku (13.6), Ka (35.5), W (94), separated by commas
    #[arg(long, value_name = "LIST")]
    pub(super) band: Option<String>,
    /// Frequencies in place of bands: values and FROM:TO:COUNT or FROM:TO:sSTEP ranges, separated by commas
    #[arg(long, value_name = "GHZ", conflicts_with = "band")]
    pub(super) frequency_ghz: Option<String>,
    /// Wavelengths in place of bands
    #[arg(long, value_name = "MM", conflicts_with_all = ["band", "frequency_ghz"])]
    pub(super) wavelength_mm: Option<String>,
    /// Temperatures of water, separated by commas
    #[arg(long, value_name = "C", default_value = "10", allow_hyphen_values = true)]
    pub(super) temperature_c: String,
    /// Formula of the permittivity of water
    #[arg(long, value_enum, default_value = "liebe-1991")]
    pub(super) water: WaterModel,
    /// Index n+k in place of water
    #[arg(long, value_parser = parse_index, allow_hyphen_values = true, conflicts_with_all = ["temperature_c", "water"])]
    pub(super) index: Option<Index>,
    /// Diameters of equal volume: values and FROM:TO:COUNT or FROM:TO:sSTEP ranges, separated by commas; each by itself
    #[arg(long, value_name = "MM")]
    pub(super) diameter_mm: Option<String>,
    /// Number of drops of each diameter (default: 1)
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub(super) number_per_m3: Option<f64>,
    /// Drops of Marshall & Palmer at this rain rate
    #[arg(
        long,
        value_name = "MM_H",
        allow_negative_numbers = true,
        conflicts_with = "diameter_mm"
    )]
    pub(super) marshall_palmer_mm_h: Option<f64>,
    /// Drops N0 exp(-SLOPE D): N0 in 1/(m³ mm), the slope in 1/mm
    #[arg(long, value_name = "N0,SLOPE", conflicts_with_all = ["diameter_mm", "marshall_palmer_mm_h"])]
    pub(super) exponential: Option<String>,
    /// Drops of a normalised gamma spectrum: N_w in 1/(m³ mm), median volume diameter in mm, shape μ
    #[arg(long, value_name = "NW,D0,MU", allow_hyphen_values = true,
        conflicts_with_all = ["diameter_mm", "marshall_palmer_mm_h", "exponential"])]
    pub(super) normalised_gamma: Option<String>,
    /// Smallest diameter of a spectrum (default: 0.05)
    #[arg(long, value_name = "MM", allow_negative_numbers = true, conflicts_with = "diameter_mm")]
    pub(super) from_diameter_mm: Option<f64>,
    /// Largest diameter of a spectrum (default: that of the shape's model, or 8)
    #[arg(long, value_name = "MM", allow_negative_numbers = true, conflicts_with = "diameter_mm")]
    pub(super) to_diameter_mm: Option<f64>,
    /// Real shapes, spheroids or spheres
    #[arg(long, value_enum, default_value = "raindrop")]
    pub(super) shape: RadarShape,
    /// Raindrop model (default: beard-chuang-1987)
    #[arg(long)]
    pub(super) model: Option<String>,
    /// Vertical over horizontal axis of spheroids: a number, or a law of the diameter: thurai-2007 (default),
    /// beard-chuang-1987, brandes-2002, pruppacher-beard-1970
    #[arg(long, value_name = "RATIO_OR_LAW")]
    pub(super) axis_ratio: Option<String>,
    /// Standard deviation of the axes' tilt
    #[arg(long, value_name = "DEG", default_value_t = 0.0, allow_negative_numbers = true)]
    pub(super) canting_deg: f64,
    /// Beam above the horizon
    #[arg(long, value_name = "DEG", default_value_t = 0.0, allow_negative_numbers = true)]
    pub(super) elevation_deg: f64,
    /// |K|² that defines reflectivities
    #[arg(long, value_name = "K2", default_value_t = 0.93, allow_negative_numbers = true)]
    pub(super) k_squared: f64,
    /// Relative error asked of amplitudes
    #[arg(long, default_value_t = 1e-3, allow_negative_numbers = true)]
    pub(super) tolerance: f64,
    /// Write to a file
    #[arg(short, long, value_name = "FILE.csv")]
    pub(super) output: Option<PathBuf>,
    /// JSON in place of CSV
    #[arg(long)]
    pub(super) json: bool,
}
