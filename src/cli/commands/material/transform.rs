//! `gonio material --kramers-kronig`: n from k, or k from n.

use crate::cli::failure::{Failure, Result};
use crate::cli::show::notes;
use clap::{Args, ValueEnum};
use gonio::medium::kramers_kronig::transform::{
    TransformMethod, Transformed, extinction_of_index, index_of_extinction,
};
use gonio::medium::kramers_kronig::{Between, Tails};
use gonio::medium::{Medium, MediumSpec, read_csv};
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::path::Path;

/// What else there is to ask: none of it goes with a transform. Said of each flag by itself, since clap
/// drops what an argument requires where that conflicts with another that is given.
const OTHERS: [&str; 3] = ["name", "list", "from_abbe"];

#[derive(Args, Clone, Debug)]
pub(super) struct TransformArgs {
    /// Index without the bands: a number or a material
    #[arg(long, value_name = "N|NAME", requires = "kramers_kronig",
          conflicts_with_all = OTHERS)]
    background: Option<String>,
    /// How the integral is done
    #[arg(long, value_enum, default_value_t = Method::Analytic, requires = "kramers_kronig",
          conflicts_with_all = OTHERS)]
    method: Method,
    /// What k does beyond the ends of the data
    #[arg(long, value_enum, default_value_t = TailsName::Taper, requires = "kramers_kronig",
          conflicts_with_all = OTHERS)]
    tails: TailsName,
    /// From n to k instead
    #[arg(long, requires = "kramers_kronig",
          conflicts_with_all = OTHERS)]
    inverse: bool,
    /// Print a k below zero too, which no passive material has
    #[arg(long, requires = "inverse", conflicts_with_all = OTHERS)]
    allow_negative_k: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Method {
    /// A quintic spline through the rows, integrated exactly through the pole
    Analytic,
    /// Straight lines between the rows, integrated exactly through the pole
    Lines,
    /// Every other row, which steps over the pole (Ohta & Ishida 1988)
    Maclaurin,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum TailsName {
    /// It falls to zero over one row's spacing
    Taper,
    /// It goes on as the wing of the data's highest band
    Band,
}

/// Reads the file, transforms, and returns the result as text and as JSON.
pub(super) fn run(file: &Path, args: &TransformArgs) -> Result<(String, Value)> {
    let table = read_csv(file)?;
    notes::tell(table.notes.iter().map(|note| format!("{}: {note}", file.display())));
    let Some(background) = &args.background else {
        let message = "--kramers-kronig: give --background, a number or a material's name";
        return Err(Failure::usage(message));
    };
    let background = background_medium(background)?;
    let column = if args.inverse { &table.n } else { &table.k };
    let (wavelength, values) = column.complete()?;
    if wavelength.len() < 2 {
        let name = if args.inverse { "n" } else { "k" };
        let message = format!("{}: no column {name} of two rows or more", file.display());
        return Err(Failure::usage(message));
    }
    let mut base = Vec::with_capacity(wavelength.len());
    for &wavelength in wavelength {
        base.push(background.index(wavelength)?.re);
    }
    let result = match args.inverse {
        true => inverse(args, wavelength, values, &base)?,
        false => forward(args, wavelength, values, &base)?,
    };
    let nm: Vec<f64> = wavelength.iter().map(|w| w * 1e9).collect();
    if args.inverse {
        check_sign(args, &nm, &result)?;
    }
    let method = args.method.to_possible_value().map(|v| v.get_name().to_string());
    let tails = args.tails.to_possible_value().map(|v| v.get_name().to_string());
    let value = json!({
        "method": method,
        "tails": tails,
        "inverse": args.inverse,
        "background": background.name(),
        "source": table.source,
        "wavelength_nm": nm,
        "n": result.n,
        "k": result.k,
        "n_background": base,
        "range_uncertainty": result.worth,
    });
    Ok((text(args, &nm, &result), value))
}

fn text(args: &TransformArgs, nm: &[f64], result: &Transformed) -> String {
    let of = if args.inverse { "k" } else { "n" };
    let mut text = String::new();
    let (first, last) = (nm[0], nm[nm.len() - 1]);
    let _ = match result.worth_within(nm) {
        Some((middle, ends)) => {
            let given = if args.inverse { "n" } else { "k" };
            writeln!(
                text,
                "{given} is known from {first:.1} to {last:.1} nm only: what lies beyond may change \
                 {of} by {middle:.1e} in the middle half and by {ends:.1e} at the ends"
            )
        }
        None => writeln!(
            text,
            "data from {first:.1} to {last:.1} nm only, without a band to judge by what lies beyond"
        ),
    };
    let _ = writeln!(text, "{:>14}  {:>12}  {:>12}", "wavelength_nm", "n", "k");
    for ((nm, n), k) in nm.iter().zip(&result.n).zip(&result.k) {
        let _ = writeln!(text, "{nm:>14.4}  {n:>12.8}  {k:>12.5e}");
    }
    text
}

/// Refuses a k below zero, which says that the range or the background is at fault.
fn check_sign(args: &TransformArgs, nm: &[f64], result: &Transformed) -> Result<()> {
    let Some((row, below)) = result.below_zero().filter(|_| !args.allow_negative_k) else {
        return Ok(());
    };
    let (nm, k) = (nm[row], result.k[row]);
    let worth = result.worth.as_ref().map_or(f64::NAN, |worth| worth[row]);
    let message = format!(
        "--inverse: k is below 0 in {below} of {} rows, k = {k:.3e} at {nm} nm, where the ends of the \
         data are worth {worth:.1e}: give n over a wider range, another --background, or \
         --allow-negative-k",
        result.k.len()
    );
    Err(Failure::usage(message))
}

fn background_medium(text: &str) -> Result<Medium> {
    let spec = match text.trim().parse::<f64>() {
        Ok(n) => MediumSpec::Index { n, k: 0.0 },
        Err(_) => MediumSpec::parse(text)?,
    };
    Ok(spec.resolve(Path::new("."))?)
}

fn forward(
    args: &TransformArgs,
    wavelength: &[f64],
    k: &[f64],
    base: &[f64],
) -> Result<Transformed> {
    let tails = match args.tails {
        TailsName::Taper => Tails::Taper,
        TailsName::Band => Tails::LorentzBand,
    };
    let method = match args.method {
        Method::Maclaurin if args.tails == TailsName::Band => {
            let message = "--method maclaurin sums the rows of the file only: no --tails band";
            return Err(Failure::usage(message));
        }
        Method::Maclaurin => TransformMethod::Maclaurin,
        Method::Analytic => TransformMethod::Continuous { between: Between::Spline, tails },
        Method::Lines => TransformMethod::Continuous { between: Between::Lines, tails },
    };
    Ok(index_of_extinction(wavelength, k, base, method)?)
}

fn inverse(
    args: &TransformArgs,
    wavelength: &[f64],
    n: &[f64],
    base: &[f64],
) -> Result<Transformed> {
    let between = match args.method {
        Method::Analytic => Between::Spline,
        Method::Lines => Between::Lines,
        Method::Maclaurin => {
            let message = "--inverse: --method must be analytic or lines";
            return Err(Failure::usage(message));
        }
    };
    if args.tails == TailsName::Band {
        let message = "--inverse: the change of n has no wing of a band: --tails must be taper";
        return Err(Failure::usage(message));
    }
    Ok(extinction_of_index(wavelength, n, base, between)?)
}
