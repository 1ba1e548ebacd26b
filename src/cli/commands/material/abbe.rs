//! Conversions between Abbe numbers, Cauchy's formula and Sellmeier's.

use super::args::MaterialArgs;
use super::evaluated::{extent, heading};
use super::output::emit;
use crate::cli::failure::{Failure, Result};
use gonio::medium::{Abbe, Medium, abbe_to_sellmeier, fit_cauchy};
use serde_json::json;
use std::fmt::Write as _;

/// Cauchy's and Sellmeier's formulas of an Abbe number.
pub(super) fn to_formulas(args: &MaterialArgs, abbe: Abbe) -> Result<()> {
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

/// Cauchy's formula fitted to a medium.
pub(super) fn to_cauchy(args: &MaterialArgs, medium: &Medium, terms: usize) -> Result<()> {
    let nm = args.wavelength_nm.as_ref().map_or(vec![400.0, 700.0], |w| w.0.clone());
    let (from, to) = extent(&nm);
    if from >= to {
        let message = "--to-cauchy: --wavelength-nm must hold two different wavelengths";
        return Err(Failure::usage(message));
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
