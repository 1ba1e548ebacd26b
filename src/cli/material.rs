//! `gonio material`: index n + ik by wavelength, conversions, Kramers–Kronig, plots.

mod figure;
mod transform;

use super::UsageError;
use super::plot;
use anyhow::Result;
use clap::Args;
use gonio::medium::{
    Abbe, AbbeLines, Extinction, LibraryEntry, Medium, MediumError, MediumSpec, abbe_to_sellmeier,
    fit_cauchy, list,
};
use num_complex::Complex64;
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
    #[arg(long, value_name = "NM", value_parser = parse_wavelengths, requires = "name",
          conflicts_with_all = ["list", "from_abbe", "kramers_kronig"])]
    wavelength_nm: Option<Wavelengths>,
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
    #[arg(long, value_name = "N,V", value_parser = parse_abbe, conflicts_with = "kramers_kronig")]
    from_abbe: Option<Abbe>,
    /// Lines that the Abbe number is taken at
    #[arg(long, value_name = "LINE", default_value = "d", value_parser = parse_lines,
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

/// Wavelengths in nanometres, in the order given.
#[derive(Clone, Debug)]
struct Wavelengths(Vec<f64>);

/// A medium with its values at the wavelengths asked for.
struct Evaluated {
    medium: Medium,
    nm: Vec<f64>,
    index: Vec<Complex64>,
}

/// Runs the command.
pub fn run(args: MaterialArgs) -> Result<()> {
    if args.list {
        return emit(&args, list_text(&list()?), list_json(&list()?));
    }
    if let Some(abbe) = args.from_abbe {
        return from_abbe(&args, abbe);
    }
    if let Some(file) = &args.kramers_kronig {
        let (text, value) = transform::run(file, &args.transform)?;
        return emit(&args, text, value);
    }
    let Some(name) = &args.name else {
        let message = "material: give a NAME, --list, --from-abbe or --kramers-kronig".into();
        return Err(UsageError(message).into());
    };
    let medium = match medium(name, &args) {
        Err(error) if only_extinction(&error) && args.to_cauchy.is_none() => {
            return extinction(&args, Path::new(name.trim()), error);
        }
        other => other?,
    };
    if let Some(terms) = args.to_cauchy {
        return to_cauchy(&args, &medium, terms);
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
    let nm = wavelengths(&args, &medium, other.as_ref());
    let first = Evaluated::new(medium, &nm)?;
    match other {
        None => emit(&args, first.text(), first.json()),
        Some(other) => {
            let second = Evaluated::new(other, &nm)?;
            emit(&args, comparison_text(&first, &second), comparison_json(&first, &second))
        }
    }
}

/// The medium of a name or file, with the conditions given by flags.
fn medium(name: &str, args: &MaterialArgs) -> Result<Medium> {
    let mut spec = MediumSpec::parse(name)?;
    let refuse = |flags: &str| Err(UsageError(format!("{name}: {flags}")).into());
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
    resolved(&spec)
}

/// Keys of the conditions of a named medium, in the order of their flags.
const CONDITIONS: [&str; 3] = ["temperature_c", "density_kg_m3", "salinity_g_kg"];

fn only_extinction(error: &anyhow::Error) -> bool {
    matches!(error.downcast_ref(), Some(MediumError::OnlyExtinction { .. }))
}

/// k of a file that has no n, which is shown though it makes no medium.
fn extinction(args: &MaterialArgs, path: &Path, error: anyhow::Error) -> Result<()> {
    let plot = args.output.as_ref().is_some_and(|path| is_plot(path));
    let data = match Extinction::read(path) {
        Ok(Some(data)) if args.compare.is_none() && !plot => data,
        _ => return Err(error),
    };
    super::notes::tell(data.notes.iter().map(|note| format!("{}: {note}", data.name)));
    super::notes::tell([error.to_string()]);
    let nm = match &args.wavelength_nm {
        Some(given) => given.0.clone(),
        None => {
            let (from, to) = data.range();
            (0..=20).map(|i| 1e9 * (from + (to - from) * f64::from(i) / 20.0)).collect()
        }
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
    super::notes::tell(medium.notes());
    Ok(medium)
}

/// What was asked for, or every 20 nm of visible light that the data cover.
fn wavelengths(args: &MaterialArgs, medium: &Medium, other: Option<&Medium>) -> Vec<f64> {
    if let Some(given) = &args.wavelength_nm {
        return given.0.clone();
    }
    let covers = |m: &Medium, nm: f64| m.index(nm / 1e9).is_ok();
    let visible = (0..=20).map(|i| 380.0 + 20.0 * f64::from(i));
    let inside: Vec<f64> =
        visible.filter(|&nm| covers(medium, nm) && other.is_none_or(|o| covers(o, nm))).collect();
    if !inside.is_empty() {
        return inside;
    }
    let (from, to) = medium.valid_range();
    let count = if to > from { 20 } else { 0 };
    let all: Vec<f64> =
        (0..=count).map(|i| 1e9 * (from + (to - from) * f64::from(i) / 20.0)).collect();
    let inside: Vec<f64> = all.iter().copied().filter(|&nm| covers(medium, nm)).collect();
    if inside.is_empty() { all } else { inside }
}

impl Evaluated {
    fn new(medium: Medium, nm: &[f64]) -> Result<Self> {
        let index = nm.iter().map(|nm| medium.index(nm / 1e9)).collect::<Result<_, _>>()?;
        Ok(Self { medium, nm: nm.to_vec(), index })
    }

    fn abbe(&self) -> [(&'static str, Option<Abbe>); 2] {
        [
            ("vd", Abbe::of_medium(AbbeLines::HeliumD, &self.medium)),
            ("ve", Abbe::of_medium(AbbeLines::MercuryE, &self.medium)),
        ]
    }

    fn json(&self) -> Value {
        let mut value = json!({
            "name": self.medium.name(),
            "source": self.medium.source(),
            "wavelength_nm": self.nm,
            "n": self.index.iter().map(|i| i.re).collect::<Vec<_>>(),
            "k": self.index.iter().map(|i| i.im).collect::<Vec<_>>(),
        });
        for (key, abbe) in self.abbe() {
            if let Some(abbe) = abbe {
                value[key] = json!(abbe.number);
                if key == "vd" {
                    value["nd"] = json!(abbe.index);
                }
            }
        }
        value
    }

    fn text(&self) -> String {
        let mut text = heading(&self.medium);
        for (key, abbe) in self.abbe() {
            if let Some(Abbe { index, number }) = abbe {
                let line = &key[1..];
                let _ = writeln!(text, "n_{line} = {index:.6}, V_{line} = {number:.3}");
            }
        }
        let _ = writeln!(text, "{:>14}  {:>12}  {:>12}", "wavelength_nm", "n", "k");
        for (nm, index) in self.nm.iter().zip(&self.index) {
            let _ = writeln!(text, "{nm:>14}  {:>12.8}  {:>12.5e}", index.re, index.im);
        }
        text
    }
}

fn heading(medium: &Medium) -> String {
    format!("{}\nsource: {}\n", medium.name(), medium.source())
}

fn comparison_json(a: &Evaluated, b: &Evaluated) -> Value {
    let difference: Vec<Complex64> = b.index.iter().zip(&a.index).map(|(b, a)| b - a).collect();
    let mut value = a.json();
    value["compare"] = b.json();
    value["n_difference"] = json!(difference.iter().map(|d| d.re).collect::<Vec<_>>());
    value["k_difference"] = json!(difference.iter().map(|d| d.im).collect::<Vec<_>>());
    value
}

fn comparison_text(a: &Evaluated, b: &Evaluated) -> String {
    let mut text = format!("1: {}2: {}", heading(&a.medium), heading(&b.medium));
    let _ = writeln!(
        text,
        "{:>14}  {:>11}  {:>11}  {:>11}  {:>11}  {:>11}  {:>11}",
        "wavelength_nm", "n 1", "n 2", "n 2 - n 1", "k 1", "k 2", "k 2 - k 1"
    );
    for ((nm, p), q) in a.nm.iter().zip(&a.index).zip(&b.index) {
        let d = q - p;
        let _ = writeln!(
            text,
            "{nm:>14}  {:>11.7}  {:>11.7}  {:>11.3e}  {:>11.4e}  {:>11.4e}  {:>11.3e}",
            p.re, q.re, d.re, p.im, q.im, d.im
        );
    }
    text
}

fn list_text(entries: &[LibraryEntry]) -> String {
    let mut text = String::new();
    for entry in entries {
        let (from, to) = (entry.range.0 * 1e9, entry.range.1 * 1e9);
        let also = match entry.aliases.is_empty() {
            true => String::new(),
            false => format!(" (also {})", entry.aliases.join(", ")),
        };
        let _ =
            writeln!(text, "{:22} {from:>5.0} to {to:>6.0} nm  {}{also}", entry.name, entry.kind);
    }
    text
}

fn list_json(entries: &[LibraryEntry]) -> Value {
    let entry = |e: &LibraryEntry| {
        json!({
            "name": e.name,
            "aliases": e.aliases,
            "kind": e.kind,
            "source": e.source,
            "range_nm": [e.range.0 * 1e9, e.range.1 * 1e9],
            "catalogue_nd": e.catalogue.map(|c| c.0),
            "catalogue_vd": e.catalogue.map(|c| c.1),
        })
    };
    Value::Array(entries.iter().map(entry).collect())
}

fn from_abbe(args: &MaterialArgs, abbe: Abbe) -> Result<()> {
    let [a, b] = abbe.to_cauchy(args.abbe_line)?;
    let [sb, sc] = abbe_to_sellmeier(abbe, args.abbe_line)?;
    let text = format!(
        "Cauchy n = A + B/λ²:            A = {a:.6}, B = {b:.6} µm²\n\
         Sellmeier n² = 1 + B λ²/(λ²−C): B = {sb:.6}, C = {sc:.6} µm²\n"
    );
    let value = json!({
        "cauchy_a": a, "cauchy_b": b, "sellmeier_b": sb, "sellmeier_c_um2": sc,
    });
    emit(args, text, value)
}

fn to_cauchy(args: &MaterialArgs, medium: &Medium, terms: usize) -> Result<()> {
    let nm = args.wavelength_nm.as_ref().map_or(vec![400.0, 700.0], |w| w.0.clone());
    let (from, to) = extent(&nm);
    if from >= to {
        let message = "--to-cauchy: --wavelength-nm must hold two different wavelengths".into();
        return Err(UsageError(message).into());
    }
    let law = |um: f64| Ok(medium.index(um / 1e6)?.re);
    let (coefficients, error) = fit_cauchy(terms, (from / 1e3, to / 1e3), law)?;
    let mut text = heading(medium);
    for (i, c) in coefficients.iter().enumerate() {
        let _ = writeln!(text, "c{i} = {c:.9e} µm^{}", 2 * i);
    }
    let _ = writeln!(text, "largest error from {from} to {to} nm: {error:.2e}");
    let value = json!({
        "name": medium.name(), "cauchy": coefficients, "range_nm": [from, to], "max_error": error,
    });
    emit(args, text, value)
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
            Err(UsageError("a plot (.png, .svg) is drawn of a NAME only".into()).into())
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

/// Most wavelengths of one call.
const MOST: f64 = 1e6;

fn parse_wavelengths(text: &str) -> Result<Wavelengths, String> {
    let number = |part: &str| {
        let value = part.trim().parse::<f64>().ok().filter(|v| v.is_finite() && *v > 0.0);
        value.ok_or(format!("\"{part}\": expected a positive number of nanometres"))
    };
    let mut all = Vec::new();
    for item in text.split(',') {
        match item.split(':').collect::<Vec<_>>().as_slice() {
            [one] => all.push(number(one)?),
            [from, to, step] => {
                let (from, to, step) = (number(from)?, number(to)?, number(step)?);
                // Rounding must not lose the last value of 380:780:0.1.
                let count = ((to - from) / step * (1.0 + 1e-12) + 1e-9).floor();
                if !(0.0..MOST).contains(&count) {
                    return Err(format!("\"{item}\": expected FROM:TO:STEP with FROM below TO"));
                }
                all.extend((0..=count as usize).map(|i| from + step * i as f64));
            }
            _ => return Err(format!("\"{item}\": expected a value or FROM:TO:STEP")),
        }
    }
    Ok(Wavelengths(all))
}

fn parse_abbe(text: &str) -> Result<Abbe, String> {
    let numbers: Option<Vec<f64>> = text.split(',').map(|part| part.trim().parse().ok()).collect();
    match numbers.as_deref() {
        Some(&[index, number]) => Ok(Abbe { index, number }),
        _ => Err("expected index and Abbe number, as in 1.5168,64.17".into()),
    }
}

fn parse_lines(text: &str) -> Result<AbbeLines, String> {
    AbbeLines::parse(text).ok_or("expected d (with F, C), D (with F, C) or e (with F', C')".into())
}
