//! `gonio material --kramers-kronig`: n from k, or k from n.

use crate::cli::UsageError;
use anyhow::Result;
use clap::{Args, ValueEnum};
use gonio::medium::kramers_kronig::{Absorption, Between, Tails, extinction_from_index, maclaurin};
use gonio::medium::{Medium, MediumSpec, read_csv};
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::path::Path;

#[derive(Args, Clone, Debug)]
pub(super) struct TransformArgs {
    /// Index without the bands: a number or a material
    #[arg(long, value_name = "N|NAME", requires = "kramers_kronig")]
    background: Option<String>,
    /// How the integral is done
    #[arg(long, value_enum, default_value_t = Method::Analytic, requires = "kramers_kronig")]
    method: Method,
    /// What k does beyond the ends of the data
    #[arg(long, value_enum, default_value_t = TailsName::Taper, requires = "kramers_kronig")]
    tails: TailsName,
    /// From n to k instead
    #[arg(long, requires = "kramers_kronig")]
    inverse: bool,
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
    let Some(background) = &args.background else {
        let message = "--kramers-kronig: give --background, a number or a material's name".into();
        return Err(UsageError(message).into());
    };
    let background = background_medium(background)?;
    let mut base = Vec::with_capacity(table.wavelength.len());
    for &wavelength in &table.wavelength {
        base.push(background.index(wavelength)?.re);
    }
    let missing = |column: &str| UsageError(format!("{}: no column {column}", file.display()));
    let (n, k) = if args.inverse {
        if table.n.is_empty() {
            return Err(missing("n").into());
        }
        let k = inverse(args, &table.wavelength, &table.n, &base)?;
        (table.n, k)
    } else {
        if table.k.is_empty() {
            return Err(missing("k").into());
        }
        let change = forward(args, &table.wavelength, &table.k)?;
        (base.iter().zip(change).map(|(b, c)| b + c).collect(), table.k)
    };
    let nm: Vec<f64> = table.wavelength.iter().map(|w| w * 1e9).collect();
    let mut text = String::new();
    let _ = writeln!(text, "{:>14}  {:>12}  {:>12}", "wavelength_nm", "n", "k");
    for ((nm, n), k) in nm.iter().zip(&n).zip(&k) {
        let _ = writeln!(text, "{nm:>14.4}  {n:>12.8}  {k:>12.5e}");
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
        "n": n,
        "k": k,
        "n_background": base,
    });
    Ok((text, value))
}

fn background_medium(text: &str) -> Result<Medium> {
    let spec = match text.trim().parse::<f64>() {
        Ok(n) => MediumSpec::Index { n, k: 0.0 },
        Err(_) => MediumSpec::parse(text)?,
    };
    Ok(spec.resolve(Path::new("."))?)
}

fn forward(args: &TransformArgs, wavelength: &[f64], k: &[f64]) -> Result<Vec<f64>> {
    let tails = match args.tails {
        TailsName::Taper => Tails::Taper,
        TailsName::Band => Tails::LorentzBand,
    };
    let between = match args.method {
        Method::Maclaurin if args.tails == TailsName::Band => {
            let message = "--method maclaurin sums the rows of the file only: no --tails band";
            return Err(UsageError(message.into()).into());
        }
        Method::Maclaurin => return Ok(maclaurin(wavelength, k)?),
        Method::Analytic => Between::Spline,
        Method::Lines => Between::Lines,
    };
    let absorption = Absorption::with(wavelength, k, tails, between)?;
    Ok(wavelength.iter().map(|&w| absorption.index_change(w)).collect())
}

fn inverse(args: &TransformArgs, wavelength: &[f64], n: &[f64], base: &[f64]) -> Result<Vec<f64>> {
    let between = match args.method {
        Method::Analytic => Between::Spline,
        Method::Lines => Between::Lines,
        Method::Maclaurin => {
            let message = "--inverse: --method must be analytic or lines".into();
            return Err(UsageError(message).into());
        }
    };
    let change: Vec<f64> = n.iter().zip(base).map(|(n, b)| n - b).collect();
    Ok(extinction_from_index(wavelength, &change, between)?)
}
