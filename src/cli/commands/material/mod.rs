//! `gonio material`: index n + ik by wavelength, conversions, Kramers–Kronig, plots.

mod abbe;
mod args;
mod evaluated;
mod figure;
mod listing;
mod output;
mod transform;

pub use args::MaterialArgs;

use crate::cli::failure::{Failure, Result};
use crate::cli::show::{notes, plot};
use evaluated::Evaluated;
use gonio::medium::{
    Extinction, Medium, MediumError, MediumSpec, even_sample_nm, list, shown_wavelengths_nm,
};
use output::{emit, is_plot};
use serde_json::json;
use std::fmt::Write as _;
use std::path::Path;

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
