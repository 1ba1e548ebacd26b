//! `gonio material`: index n + ik by wavelength, conversions, Kramers–Kronig, plots.

mod abbe;
mod evaluated;
mod figure;
mod listing;
mod transform;

use crate::cli::args::ranges::{Wavelengths, frequencies, wavelengths};
use crate::cli::show::{notes, plot};
use crate::cli::{Failure, Result};
use clap::Args;
use evaluated::Evaluated;
use gonio::medium::{
    Abbe, AbbeLines, Extinction, Medium, MediumError, MediumSpec, even_sample_nm, list,
    shown_wavelengths_nm,
};
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Refractive index n+ik of a material by wavelength
#[derive(Args, Clone, Debug)]
#[command(after_help = AFTER_HELP, arg_required_else_help = true)]
pub struct MaterialArgs {
    /// Name in the library, FILE.yml (refractiveindex.info), FILE.csv, FILE.agf:GLASS (Zemax), or a
    /// table as in a scene file
    #[arg(value_name = "NAME", conflicts_with_all = ["list", "from_abbe", "kramers_kronig"])]
    name: Option<String>,
    /// List the library
    #[arg(long, conflicts_with_all = ["from_abbe", "kramers_kronig"])]
    list: bool,
    /// Wavelengths in vacuum: values and FROM:TO:STEP ranges, separated by commas
    #[arg(long, value_name = "NM", value_parser = wavelengths, requires = "name",
          conflicts_with_all = ["list", "from_abbe", "kramers_kronig"])]
    wavelength_nm: Option<Wavelengths>,
    /// Frequencies in place of wavelengths: as those
    #[arg(long, value_name = "GHZ", value_parser = frequencies, requires = "name",
          conflicts_with_all = ["wavelength_nm", "list", "from_abbe", "kramers_kronig"])]
    frequency_ghz: Option<Wavelengths>,
    /// Temperature of water (default 20)
    #[arg(long, value_name = "C", allow_negative_numbers = true, requires = "name",
          conflicts_with_all = ["list", "from_abbe", "kramers_kronig"])]
    temperature_c: Option<f64>,
    /// Density of water or steam (default: the liquid at 1 atm)
    #[arg(long, value_name = "KG", allow_negative_numbers = true, requires = "name",
          conflicts_with_all = ["list", "from_abbe", "kramers_kronig"])]
    density_kg_m3: Option<f64>,
    /// Salinity of sea water (default 35)
    #[arg(long, value_name = "G", allow_negative_numbers = true, requires = "name",
          conflicts_with_all = ["list", "from_abbe", "kramers_kronig"])]
    salinity_g_kg: Option<f64>,
    /// Answer outside the data too: formulas go on, tables hold their end value
    #[arg(long, requires = "name",
          conflicts_with_all = ["list", "from_abbe", "kramers_kronig"])]
    extrapolate: bool,
    /// A second material, to be set beside the first
    #[arg(long, value_name = "NAME", requires = "name")]
    compare: Option<String>,
    /// Least-squares Cauchy formula of so many terms over the wavelengths (default 400 to 700 nm)
    #[arg(long, value_name = "TERMS", requires = "name", conflicts_with = "compare")]
    to_cauchy: Option<usize>,
    /// Cauchy A and B from index and Abbe number, as in 1.5168,64.17
    #[arg(long, value_name = "N,V", value_parser = abbe::parse_abbe, conflicts_with = "kramers_kronig")]
    from_abbe: Option<Abbe>,
    /// Lines that the Abbe number is taken at
    #[arg(long, value_name = "LINE", default_value = "d", value_parser = abbe::parse_lines,
          requires = "from_abbe", conflicts_with_all = ["name", "list", "kramers_kronig"])]
    abbe_line: AbbeLines,
    /// n from the k in FILE.csv (or k from its n, with --inverse)
    #[arg(long, value_name = "FILE")]
    kramers_kronig: Option<PathBuf>,
    #[command(flatten)]
    transform: transform::TransformArgs,
    /// Print JSON
    #[arg(long)]
    json: bool,
    /// Write to a file; .png or .svg: a plot of n and k
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

const AFTER_HELP: &str = "Examples:
  gonio material water --wavelength-nm 400,589.3,700 --temperature-c 20
  gonio material N-BK7 --compare SF10 -o glasses.svg
  gonio material '{ solute = \"rhodamine6g\", fraction = 0.01, host = \"water\" }' --json
  gonio material --from-abbe 1.5168,64.17
  gonio material --kramers-kronig k.csv --background 1.33 --method analytic";

/// Runs the command.
pub fn run(mut args: MaterialArgs) -> Result<()> {
    args.wavelength_nm = args.wavelength_nm.or(args.frequency_ghz.take());
    if args.list {
        let entries = list()?;
        return emit(&args, listing::text(&entries), listing::json(&entries));
    }
    if let Some(abbe) = args.from_abbe {
        return abbe::to_formulas(&args, abbe);
    }
    if let Some(file) = &args.kramers_kronig {
        let (text, value) = transform::run(file, &args.transform)?;
        return emit(&args, text, value);
    }
    let Some(name) = &args.name else {
        let message = "material: give a NAME, --list, --from-abbe or --kramers-kronig";
        return Err(Failure::usage(message));
    };
    let spec = conditioned(name, &args)?;
    let medium = match spec.resolve(Path::new(".")) {
        Err(error @ MediumError::OnlyExtinction { .. }) if args.to_cauchy.is_none() => {
            return extinction(&args, Path::new(name.trim()), error);
        }
        other => other?,
    };
    notes::tell(medium.notes());
    if let Some(terms) = args.to_cauchy {
        return abbe::to_cauchy(&args, &medium, terms);
    }
    let other = match &args.compare {
        Some(other) => Some(resolved(&MediumSpec::parse(other)?)?),
        None => None,
    };
    if let Some(path) = args.output.as_ref().filter(|path| is_plot(path)) {
        let media: Vec<&Medium> = std::iter::once(&medium).chain(&other).collect();
        let nm = args.wavelength_nm.as_ref().map(|w| w.0.as_slice());
        return plot::save(&figure::IndexFigure::new(&media, nm)?, path, figure::SIZE);
    }
    let nm = match &args.wavelength_nm {
        Some(given) => given.0.clone(),
        None => {
            let media: Vec<&Medium> = std::iter::once(&medium).chain(&other).collect();
            shown_wavelengths_nm(&media)
        }
    };
    let first = Evaluated::new(medium, &nm)?;
    match other {
        None => emit(&args, first.text(), first.json()),
        Some(other) => {
            let second = Evaluated::new(other, &nm)?;
            emit(
                &args,
                evaluated::comparison_text(&first, &second),
                evaluated::comparison_json(&first, &second),
            )
        }
    }
}

/// The medium of a name or file, with the conditions given by flags.
fn conditioned(name: &str, args: &MaterialArgs) -> Result<MediumSpec> {
    let mut spec = MediumSpec::parse(name)?;
    let refuse = |flags: &str| Err(Failure::usage(format!("{name}: {flags}")));
    let conditions = [args.temperature_c, args.density_kg_m3, args.salinity_g_kg];
    match &mut spec {
        MediumSpec::Named(named) => {
            let own =
                [&mut named.temperature_c, &mut named.density_kg_m3, &mut named.salinity_g_kg];
            for ((own, flag), key) in own.into_iter().zip(conditions).zip(CONDITIONS) {
                match (&own, flag) {
                    (Some(own), Some(flag)) if *own != flag => {
                        return refuse(&format!("{key} = {own} disagrees with the flag's {flag}"));
                    }
                    _ => *own = own.or(flag),
                }
            }
            named.extrapolate |= args.extrapolate;
        }
        _ if conditions.iter().any(Option::is_some) => {
            return refuse("temperature, density and salinity go with a name of the library");
        }
        MediumSpec::File { extrapolate, .. } => *extrapolate |= args.extrapolate,
        _ if args.extrapolate => {
            return refuse("--extrapolate goes with a name of the library or a file");
        }
        _ => {}
    }
    Ok(spec)
}

/// Keys of the conditions of a named medium, in the order of their flags.
const CONDITIONS: [&str; 3] = ["temperature_c", "density_kg_m3", "salinity_g_kg"];

/// k of a file that has no n, which is shown though it makes no medium.
fn extinction(args: &MaterialArgs, path: &Path, error: MediumError) -> Result<()> {
    let data = Extinction::read(path).ok().flatten();
    let plot = args.output.as_ref().is_some_and(|path| is_plot(path));
    let Some(data) = data.filter(|_| args.compare.is_none() && !plot) else {
        return Err(error.into());
    };
    notes::tell(data.notes.iter().map(|note| format!("{}: {note}", data.name)));
    notes::tell([error.to_string()]);
    let nm = match &args.wavelength_nm {
        Some(given) => given.0.clone(),
        None => even_sample_nm(data.range()),
    };
    let k = nm.iter().map(|nm| data.value(nm / 1e9)).collect::<Result<Vec<_>, _>>()?;
    let mut text = format!("{}\nsource: {}\n", data.name, data.source);
    let _ = writeln!(text, "{:>14}  {:>12}  {:>12}", "wavelength_nm", "n", "k");
    for (nm, k) in nm.iter().zip(&k) {
        let _ = writeln!(text, "{nm:>14}  {:>12}  {k:>12.5e}", "unknown");
    }
    let value = json!({
        "name": data.name, "source": data.source, "wavelength_nm": nm, "n": null, "k": k,
    });
    emit(args, text, value)
}

/// The medium; what its files' readers have to say goes to stderr.
fn resolved(spec: &MediumSpec) -> Result<Medium> {
    let medium = spec.resolve(Path::new("."))?;
    notes::tell(medium.notes());
    Ok(medium)
}

fn extent(values: &[f64]) -> (f64, f64) {
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    (low, high)
}

/// Prints the result, or writes it to the file asked for.
fn emit(args: &MaterialArgs, text: String, value: Value) -> Result<()> {
    let text = if args.json { format!("{value}\n") } else { text };
    match &args.output {
        Some(path) if is_plot(path) => {
            Err(Failure::usage("a plot (.png, .svg) is drawn of a NAME only"))
        }
        Some(path) => plot::write_whole(path, text.as_bytes()),
        None => {
            use std::io::Write;
            match std::io::stdout().write_all(text.as_bytes()) {
                // A reader that has seen enough (`| head`) is no failure.
                Err(e) if e.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
                other => Ok(other?),
            }
        }
    }
}

fn is_plot(path: &Path) -> bool {
    let ending = path.extension().and_then(|e| e.to_str()).unwrap_or("").to_lowercase();
    ["png", "svg"].contains(&ending.as_str())
}
