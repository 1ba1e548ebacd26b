//! What `gonio material` is told.

use super::transform::TransformArgs;
use crate::cli::args::ranges::{Wavelengths, frequencies, wavelengths};
use clap::Args;
use gonio::medium::{Abbe, AbbeLines};
use std::path::PathBuf;

/// Refractive index n+ik of a material by wavelength
#[derive(Args, Clone, Debug)]
#[command(after_help = AFTER_HELP, arg_required_else_help = true)]
pub struct MaterialArgs {
    /// Name in the library, FILE.yml (refractiveindex.info), FILE.csv, FILE.agf:GLASS (Zemax), or a
    /// table as in a scene file
    #[arg(value_name = "NAME", conflicts_with_all = ["list", "from_abbe", "kramers_kronig"])]
    pub(super) name: Option<String>,
    /// List the library
    #[arg(long, conflicts_with_all = ["from_abbe", "kramers_kronig"])]
    pub(super) list: bool,
    /// Wavelengths in vacuum: values and FROM:TO:STEP or FROM:TO:nCOUNT ranges, separated by
    /// commas
    #[arg(long, value_name = "NM", value_parser = wavelengths, requires = "name",
          conflicts_with_all = ["list", "from_abbe", "kramers_kronig"])]
    pub(super) wavelength_nm: Option<Wavelengths>,
    /// Frequencies in place of wavelengths: as those
    #[arg(long, value_name = "GHZ", value_parser = frequencies, requires = "name",
          conflicts_with_all = ["wavelength_nm", "list", "from_abbe", "kramers_kronig"])]
    pub(super) frequency_ghz: Option<Wavelengths>,
    /// Temperature of water (default 20)
    #[arg(long, value_name = "C", allow_negative_numbers = true, requires = "name",
          conflicts_with_all = ["list", "from_abbe", "kramers_kronig"])]
    pub(super) temperature_c: Option<f64>,
    /// Density of water or steam (default: the liquid at 1 atm)
    #[arg(long, value_name = "KG", allow_negative_numbers = true, requires = "name",
          conflicts_with_all = ["list", "from_abbe", "kramers_kronig"])]
    pub(super) density_kg_m3: Option<f64>,
    /// Salinity of sea water (default 35)
    #[arg(long, value_name = "G", allow_negative_numbers = true, requires = "name",
          conflicts_with_all = ["list", "from_abbe", "kramers_kronig"])]
    pub(super) salinity_g_kg: Option<f64>,
    /// Answer outside the data too: formulas go on, tables hold their end value
    #[arg(long, requires = "name",
          conflicts_with_all = ["list", "from_abbe", "kramers_kronig"])]
    pub(super) extrapolate: bool,
    /// A second material, to be set beside the first
    #[arg(long, value_name = "NAME", requires = "name")]
    pub(super) compare: Option<String>,
    /// Least-squares Cauchy formula of so many terms over the wavelengths (default 400 to 700 nm)
    #[arg(long, value_name = "TERMS", requires = "name", conflicts_with = "compare")]
    pub(super) to_cauchy: Option<usize>,
    /// Cauchy A and B from index and Abbe number, as in 1.5168,64.17
    #[arg(long, value_name = "N,V", value_parser = parse_abbe, conflicts_with = "kramers_kronig")]
    pub(super) from_abbe: Option<Abbe>,
    /// Lines that the Abbe number is taken at
    #[arg(long, value_name = "LINE", default_value = "d", value_parser = parse_lines,
          requires = "from_abbe", conflicts_with_all = ["name", "list", "kramers_kronig"])]
    pub(super) abbe_line: AbbeLines,
    /// n from the k in FILE.csv (or k from its n, with --inverse)
    #[arg(long, value_name = "FILE")]
    pub(super) kramers_kronig: Option<PathBuf>,
    #[command(flatten)]
    pub(super) transform: TransformArgs,
    /// Print JSON
    #[arg(long)]
    pub(super) json: bool,
    /// Write to a file; .png or .svg: a plot of n and k
    #[arg(short, long, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,
}

const AFTER_HELP: &str = "Examples:
  gonio material water --wavelength-nm 400,589.3,700 --temperature-c 20
  gonio material N-BK7 --compare SF10 -o glasses.svg
  gonio material '{ solute = \"rhodamine6g\", fraction = 0.01, host = \"water\" }' --json
  gonio material --from-abbe 1.5168,64.17
  gonio material --kramers-kronig k.csv --background 1.33 --method analytic";

/// `1.5168,64.17`
fn parse_abbe(text: &str) -> Result<Abbe, String> {
    let numbers: Option<Vec<f64>> = text.split(',').map(|part| part.trim().parse().ok()).collect();
    match numbers.as_deref() {
        Some(&[index, number]) => Ok(Abbe { index, number }),
        _ => Err("expected index and Abbe number, as in 1.5168,64.17".into()),
    }
}

/// `d`, `D` or `e`
fn parse_lines(text: &str) -> Result<AbbeLines, String> {
    AbbeLines::parse(text).ok_or("expected d (with F, C), D (with F, C) or e (with F', C')".into())
}
